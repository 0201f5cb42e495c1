//! A window through which bodies come: a point, a flat surface or a box (R figure 4.1), at random places in it, turned at random.

use super::{Draws, NewBody, NoRoom, Occupancy, Population};
use crate::{Orientation, Vector};

/// Where centres of new bodies lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Window {
    /// Always here, in m.
    Point(Vector),
    /// Anywhere on a parallelogram.
    Rectangle {
        /// A corner in m.
        corner: Vector,
        /// From there to its two neighbours, in m.
        edges: [Vector; 2],
    },
    /// Anywhere in a box.
    Box {
        /// Lower corner in m.
        lower: Vector,
        /// Upper corner in m.
        upper: Vector,
    },
}

/// How new bodies are turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Turned {
    /// Uniformly at random.
    Random,
    /// All the same way.
    As(Orientation),
}

impl Turned {
    /// The orientation of a body.
    pub fn draw(&self, draws: &mut Draws) -> Orientation {
        match self {
            Turned::Random => draws.orientation(),
            Turned::As(orientation) => *orientation,
        }
    }
}

impl Window {
    /// A place in the window.
    pub fn draw(&self, draws: &mut Draws) -> Vector {
        match self {
            Window::Point(point) => *point,
            Window::Rectangle { corner, edges } => corner + edges[0] * draws.unit() + edges[1] * draws.unit(),
            Window::Box { lower, upper } => draws.in_box(lower, upper),
        }
    }

    /// Lower and upper corner of a box round the window, in m.
    pub fn bounds(&self) -> [Vector; 2] {
        match self {
            Window::Point(point) => [*point; 2],
            Window::Rectangle { corner, edges } => {
                let corners = [*corner, corner + edges[0], corner + edges[1], corner + edges[0] + edges[1]];
                [corners.iter().fold(*corner, |least, other| least.inf(other)), corners.iter().fold(*corner, |most, other| most.sup(other))]
            }
            Window::Box { lower, upper } => [*lower, *upper],
        }
    }

    /// One attempt: a random place and, if there is room, a random turn.
    pub(super) fn attempt(
        &self,
        turned: &Turned,
        mut draws: Draws,
        has_room: impl FnOnce(&Vector) -> bool,
    ) -> Option<(Vector, Orientation)> {
        let position = self.draw(&mut draws);
        has_room(&position).then(|| (position, turned.draw(&mut draws)))
    }

    /// All bodies of a population at once, one after the other at places where nothing stands; `taken` knows of those that are there, and learns of the new
    /// ones. This is random sequential addition: balls of one size jam at 0.38 of the volume (Torquato et al. 2006), long before a vessel is full.
    ///
    /// # Errors
    ///
    /// A body that finds no room in so many attempts.
    pub fn fill(
        &self,
        population: &Population,
        turned: &Turned,
        (seed, stream): (u64, u64),
        attempts: u64,
        taken: &mut Occupancy,
        is_free: impl Fn(&Vector, f64) -> bool,
    ) -> Result<Vec<NewBody>, NoRoom> {
        let mut placed = Vec::with_capacity(population.len());
        let mut place = 0;
        while let Some((kind, scale)) = population.body(placed.len()) {
            let radius = population.radius(kind, scale);
            let has_room = |position: &Vector| taken.is_free(position, radius) && is_free(position, radius);
            let try_at = |place: u64| Some((place, self.attempt(turned, Draws::new(seed, stream, place), has_room)?));
            let Some((found_at, (position, orientation))) = (place..place + attempts).find_map(try_at) else {
                return Err(NoRoom::Attempts { left: population.len() - placed.len(), wanted: population.len(), attempts });
            };
            place = found_at + 1;
            taken.add(position, radius);
            placed.push(NewBody { kind, scale, radius, position, orientation });
        }
        Ok(placed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::insertion::Kind;

    fn balls(number: usize, scale: [f64; 2]) -> Population {
        Population::new(vec![Kind { radius: 0.05, fraction: 1.0, scale }], number, 5, 0)
    }

    fn fill(window: &Window, population: &Population, seed: u64) -> Result<Vec<NewBody>, NoRoom> {
        let [lower, upper] = window.bounds();
        let mut taken = Occupancy::new(lower, upper, population.largest_radius(), population.len());
        window.fill(population, &Turned::Random, (seed, 1), 10_000, &mut taken, |position, radius| position.z + radius < 0.9)
    }

    const CUBE: Window = Window::Box { lower: Vector::new(0.0, 0.0, 0.0), upper: Vector::new(1.0, 1.0, 1.0) };

    #[test]
    fn bodies_do_not_overlap_and_keep_out_of_what_is_not_free() {
        let population = balls(300, [0.5, 1.0]);
        let found = fill(&CUBE, &population, 5).unwrap();
        assert_eq!(found.len(), 300);
        for (place, one) in found.iter().enumerate() {
            assert!(found[..place].iter().all(|other| (other.position - one.position).norm() >= one.radius + other.radius));
            assert!(one.position.z + one.radius < 0.9 && one.position.min() >= 0.0);
            assert_eq!((one.kind, one.scale), population.body(place).unwrap());
        }
        assert_eq!(fill(&CUBE, &population, 5).unwrap(), found);
        assert_ne!(fill(&CUBE, &population, 6).unwrap(), found);
    }

    #[test]
    fn what_does_not_fit_is_counted() {
        // A point has room for one, a box of 1 m^3 not for a volume of 0.52 m^3 at random.
        let error = fill(&Window::Point(Vector::repeat(0.5)), &balls(3, [1.0; 2]), 5).unwrap_err();
        assert_eq!(error, NoRoom::Attempts { left: 2, wanted: 3, attempts: 10_000 });
        assert!(matches!(fill(&CUBE, &balls(1000, [1.0; 2]), 5), Err(NoRoom::Attempts { wanted: 1000, left: 1..900, .. })));
    }

    /// Mean and variance of places over a parallelogram: those of two uniform numbers.
    #[test]
    fn places_are_uniform_over_a_surface() {
        let window = Window::Rectangle { corner: Vector::new(1.0, 2.0, 3.0), edges: [Vector::x() * 2.0, Vector::new(0.0, 3.0, 4.0)] };
        let places: Vec<Vector> = (0..10_000).map(|place| window.draw(&mut Draws::new(1, 0, place))).collect();
        let mean = places.iter().sum::<Vector>() / 1e4;
        let expected = Vector::new(2.0, 3.5, 5.0);
        // Deviations of the mean: edge / sqrt(12 * 10^4).
        assert!((mean - expected).abs() < Vector::new(2.0, 3.0, 4.0) * (4.0 / 12e4_f64.sqrt()), "{mean}");
        let variance = places.iter().map(|place| (place - expected).component_mul(&(place - expected))).sum::<Vector>() / 1e4;
        assert!((variance.component_div(&Vector::new(4.0, 9.0, 16.0)) * 12.0 - Vector::repeat(1.0)).amax() < 4.0 * 0.009, "{variance}");
        assert!(places.iter().all(|place| ((place.y - 2.0) * 4.0 - (place.z - 3.0) * 3.0).abs() < 1e-14));
        // The two edges are drawn apart: no correlation, to four deviations.
        let product = places.iter().map(|place| (place.x - 2.0) / 2.0 * (place.y - 3.5) / 3.0).sum::<f64>() / 1e4;
        assert!((12.0 * product).abs() < 4.0 / 1e2, "{product}");
        assert_eq!(window.bounds(), [Vector::new(1.0, 2.0, 3.0), Vector::new(3.0, 5.0, 7.0)]);
    }
}
