//! Bodies in rows and layers, each a little off its site: the quick way to fill a vessel (R section 5.4.1).

use super::{Draws, NewBody, NoRoom, Population, Turned};
use crate::Vector;

/// Sites in rows along x, layers along y and storeys along z, half a spacing inside the box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    /// Lower corner of the box in m.
    pub lower: Vector,
    /// Upper corner in m.
    pub upper: Vector,
    /// Distances of neighbours in m along each axis.
    pub spacing: Vector,
    /// Largest shift of a body off its site along each axis, in m.
    pub jitter: f64,
}

/// A row holds one more site than rounding may deny it.
const ROUNDING: f64 = 1e-9;

impl Lattice {
    /// Sites along each axis.
    pub fn counts(&self) -> [usize; 3] {
        std::array::from_fn(|axis| ((self.upper[axis] - self.lower[axis]) / self.spacing[axis] + ROUNDING).floor().max(0.0) as usize)
    }

    /// How many sites there are: more than can be counted in a box that is large enough.
    pub fn number_of_sites(&self) -> usize {
        self.counts().into_iter().fold(1, usize::saturating_mul)
    }

    /// Largest shift in m at which balls of a radius in m neither overlap each other nor leave the box; negative if there is none.
    pub fn largest_jitter(&self, radius: f64) -> f64 {
        0.5 * self.spacing.min() - radius
    }

    /// The site of a number: along x first, along z last, so that the box fills from below.
    fn site(&self, number: usize, counts: &[usize; 3]) -> Vector {
        let place = [number % counts[0], number / counts[0] % counts[1], number / counts[0] / counts[1]];
        Vector::from_fn(|axis, _| self.lower[axis] + (place[axis] as f64 + 0.5) * self.spacing[axis])
    }

    /// All bodies of a population, each at the next site that is free for it.
    ///
    /// # Errors
    ///
    /// Fewer free sites than bodies.
    pub fn fill(
        &self,
        population: &Population,
        turned: &Turned,
        (seed, stream): (u64, u64),
        is_free: impl Fn(&Vector, f64) -> bool,
    ) -> Result<Vec<NewBody>, NoRoom> {
        let counts = self.counts();
        let mut placed = Vec::with_capacity(population.len());
        for number in 0..self.number_of_sites() {
            let Some((kind, scale)) = population.body(placed.len()) else { break };
            let mut draws = Draws::new(seed, stream, number as u64);
            let shift = Vector::repeat(self.jitter);
            let position = self.site(number, &counts) + draws.in_box(&-shift, &shift);
            let radius = population.radius(kind, scale);
            if is_free(&position, radius) {
                placed.push(NewBody { kind, scale, radius, position, orientation: turned.draw(&mut draws) });
            }
        }
        if placed.len() < population.len() {
            return Err(NoRoom::Sites { placed: placed.len(), wanted: population.len() });
        }
        Ok(placed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::insertion::{Kind, Occupancy};

    fn lattice(jitter: f64) -> Lattice {
        Lattice { lower: Vector::zeros(), upper: Vector::new(0.3, 0.4, 0.5), spacing: Vector::repeat(0.1), jitter }
    }

    fn balls(number: usize, scale: [f64; 2]) -> Population {
        Population::new(vec![Kind { radius: 0.04, fraction: 1.0, scale }], number, 5, 0)
    }

    /// All 3 x 4 x 5 sites: at the largest jitter no two overlap and none leaves the box, at none they stand in rows.
    #[test]
    fn sixty_bodies_stand_in_sixty_sites() {
        let jitter = lattice(0.0).largest_jitter(0.04);
        assert!((jitter - 0.01).abs() < 1e-15);
        let found = lattice(jitter).fill(&balls(60, [1.0; 2]), &Turned::Random, (5, 1), |_, _| true).unwrap();
        assert_eq!(found.len(), 60);
        for (place, one) in found.iter().enumerate() {
            assert!(found[..place].iter().all(|other| (other.position - one.position).norm() >= 0.08 - 1e-15));
            assert!((0..3).all(|axis| one.position[axis] >= 0.04 && one.position[axis] <= lattice(0.0).upper[axis] - 0.04 + 1e-15));
        }
        let shifts: Vec<f64> = found.iter().map(|body| (body.position.x / 0.1).fract() * 0.1 - 0.05).collect();
        assert!(shifts.iter().copied().fold(0.0, f64::max) > 0.008 && shifts.iter().copied().fold(0.0, f64::min) < -0.008);
        let still = lattice(0.0).fill(&balls(2, [1.0; 2]), &Turned::Random, (5, 1), |_, _| true).unwrap();
        assert!((still[1].position - Vector::new(0.15, 0.05, 0.05)).norm() < 1e-15);
        let again = lattice(jitter).fill(&balls(60, [1.0; 2]), &Turned::Random, (5, 1), |_, _| true).unwrap();
        assert_eq!(again, found);
        assert_ne!(lattice(jitter).fill(&balls(60, [1.0; 2]), &Turned::Random, (6, 1), |_, _| true).unwrap(), found);
    }

    #[test]
    fn sites_that_are_taken_are_left_out_and_no_body_is_lost() {
        let mut taken = Occupancy::new(Vector::zeros(), lattice(0.0).upper, 0.05, 10);
        taken.add(Vector::new(0.05, 0.05, 0.05), 0.01);
        let is_free = |position: &Vector, radius: f64| taken.is_free(position, radius);
        let found = lattice(0.0).fill(&balls(59, [0.5, 1.0]), &Turned::Random, (5, 1), is_free).unwrap();
        assert!((found[0].position.x - 0.15).abs() < 1e-15);
        let numbers: Vec<f64> = found.iter().map(|body| body.scale).collect();
        let wanted: Vec<f64> = (0..59).map(|number| balls(59, [0.5, 1.0]).body(number).unwrap().1).collect();
        assert_eq!(numbers, wanted);
        let full = lattice(0.0).fill(&balls(60, [1.0; 2]), &Turned::Random, (5, 1), is_free);
        assert_eq!(full, Err(NoRoom::Sites { placed: 59, wanted: 60 }));
        let flat = Lattice { upper: Vector::new(0.3, 0.4, 0.05), ..lattice(0.0) };
        assert_eq!(flat.fill(&balls(1, [1.0; 2]), &Turned::Random, (5, 1), |_, _| true), Err(NoRoom::Sites { placed: 0, wanted: 1 }));
    }
}
