//! How the flow carries its own momentum in a box that repeats: central fluxes on the staggered grid (R eq. 7.1).

use super::grid::{FaceField, Grid};
use crate::parallel;

/// Rates $\nabla \cdot (u u_a)$ in m/s^2 at which the flow carries each component away.
///
/// Fluxes between faces from the means of the two values next to them. If the velocity has no divergence they make neither momentum nor energy
/// (Harlow and Welch 1965, Morinishi et al. 1998).
pub fn advection(grid: &Grid, velocity: &FaceField) -> FaceField {
    let mut rates = FaceField::zeros(grid);
    let length = grid.cells()[0];
    for (component, values) in rates.component.iter_mut().enumerate() {
        let mut rows: Vec<(usize, &mut [f64])> = values.chunks_exact_mut(length).enumerate().collect();
        parallel::for_each_part_of(grid.len(), &mut rows, |part| {
            for (row, rates) in part {
                let of_row = Row { grid, velocity, cell: grid.cell(*row * length) };
                (0..3).for_each(|direction| of_row.add_flux_difference(component, direction, rates));
            }
        });
    }
    rates
}

/// A row of faces along the first direction, by its first cell.
struct Row<'a> {
    grid: &'a Grid,
    velocity: &'a FaceField,
    cell: [usize; 3],
}

impl Row<'_> {
    /// A component along the row that is moved by some cells, and the shift of places within it.
    fn moved(&self, component: usize, steps: [isize; 3]) -> (&[f64], isize) {
        let [_, j, k] = self.cell.map(|number| number as isize);
        let start = self.grid.index_around([0, j + steps[1], k + steps[2]]);
        (&self.velocity.component[component][start..][..self.grid.cells()[0]], steps[0])
    }

    /// Adds the difference over a cell of what the flow along a direction carries of a component.
    fn add_flux_difference(&self, component: usize, direction: usize, rates: &mut [f64]) {
        let unit = |along: usize, step: isize| std::array::from_fn(|other| if other == along { step } else { 0 });
        let (behind, ahead, aside) = (unit(direction, -1), unit(direction, 1), unit(component, -1));
        let both: [isize; 3] = std::array::from_fn(|other| ahead[other] + aside[other]);
        let carried = [behind, [0; 3], ahead].map(|steps| self.moved(component, steps));
        let carrier = [[0; 3], aside, ahead, both].map(|steps| self.moved(direction, steps));
        let factor = 0.25 / self.grid.spacing();
        let flux_difference = |[behind, here, ahead]: [f64; 3], [inward, inward_aside, outward, outward_aside]: [f64; 4]| {
            factor * ((outward + outward_aside) * (ahead + here) - (inward + inward_aside) * (here + behind))
        };
        // The ends of the row have neighbours around the box; between them places are even and the loop is a plain one.
        let length = rates.len();
        for place in [0, length - 1] {
            let at = |(row, shift): (&[f64], isize)| row[(place as isize + shift).rem_euclid(length as isize) as usize];
            rates[place] += flux_difference(carried.map(at), carrier.map(at));
        }
        let [behind, here, ahead] = carried.map(|(row, shift)| &row[(1 + shift) as usize..][..length - 2]);
        let [inward, inward_aside, outward, outward_aside] = carrier.map(|(row, shift)| &row[(1 + shift) as usize..][..length - 2]);
        for (place, rate) in rates[1..length - 1].iter_mut().enumerate() {
            *rate += flux_difference(
                [behind[place], here[place], ahead[place]],
                [inward[place], inward_aside[place], outward[place], outward_aside[place]],
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vector;
    use crate::fluid::border::Border;
    use crate::fluid::periodic::PeriodicBox;
    use crate::fluid::sides::{Ends, Sides};
    use crate::fluid::stencils;

    fn wave(component: usize, place: Vector) -> f64 {
        (3.0 * place.x + (component + 1) as f64 * place.y).sin() + (2.0 * place.z - place.x + component as f64).cos()
    }

    #[test]
    fn rates_are_those_of_a_box_with_sides_that_repeat() {
        let grid = Grid::new([5, 6, 4], 0.3, Vector::zeros()).expect("enough cells");
        let velocity = FaceField::from_fn(&grid, wave);
        let border = Border::new(grid, Sides::new([Ends::Periodic; 3]).expect("sides"));
        let stored: stencils::Velocity = std::array::from_fn(|component| {
            let mut field = border.zeros();
            border.add(Some(component), &mut field, 1.0, &velocity.component[component]);
            field
        });
        let rates = advection(&grid, &velocity);
        for component in 0..3 {
            let wanted = stencils::advection(&border, &stored, component);
            assert!(rates.component[component].iter().zip(wanted).all(|(got, wanted)| (got - wanted).abs() < 1e-13));
        }
    }

    #[test]
    fn a_flow_without_divergence_neither_gains_nor_loses_momentum_and_energy() {
        let grid = Grid::new([8, 6, 10], 0.3, Vector::zeros()).expect("enough cells");
        let mut velocity = FaceField::from_fn(&grid, wave);
        PeriodicBox::new(grid).solve_stokes(&mut velocity, 0.1, 1.0, Vector::new(0.3, -0.2, 0.5));
        let rates = advection(&grid, &velocity);
        let power: f64 =
            (0..3).flat_map(|component| rates.component[component].iter().zip(&velocity.component[component])).map(|(a, b)| a * b).sum();
        assert!(rates.mean().norm() < 1e-15 && power.abs() < 1e-12, "{power}");
    }
}
