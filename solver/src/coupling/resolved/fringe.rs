//! A zone where the flow is made uniform again, so that a box that repeats acts as one with an inlet and an outlet.
//!
//! What leaves the box on one side would come in at the other. In the fringe a force pulls the velocity towards that of the inflow (Nordström, Nordin and Henningson
//! 1999): wakes end there. Mass is not added or taken: pressure alone makes the flow uniform across.

use std::f64::consts::PI;

use crate::Vector;
use crate::fluid::advection::advection;
use crate::fluid::grid::{FaceField, Grid};

/// Rates of change in m/s^2 that a flow tells of itself: what it carries along, if it does, and what a fringe pulls with.
pub(super) fn explicit_rates(grid: &Grid, velocity: &FaceField, carries: bool, fringe: Option<&Fringe>) -> FaceField {
    let mut rates = if carries { advection(grid, velocity) } else { FaceField::zeros(grid) };
    rates.component.iter_mut().flatten().for_each(|rate| *rate = -*rate);
    if let Some(fringe) = fringe {
        fringe.add_rates(grid, velocity, &mut rates);
    }
    rates
}

/// A fringe across the first direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fringe {
    /// Where it begins and ends in m.
    pub between: [f64; 2],
    /// Rate in 1/s in its middle; it rises and falls as the square of a sine.
    pub rate: f64,
    /// Velocity in m/s that it leaves.
    pub velocity: Vector,
}

impl Fringe {
    /// Adds its acceleration in m/s^2.
    pub fn add_rates(&self, grid: &Grid, velocity: &FaceField, rates: &mut FaceField) {
        let length = grid.cells()[0];
        for component in 0..3 {
            let strengths: Vec<f64> = (0..length).map(|i| self.strength(grid, component, i)).collect();
            let rows = rates.component[component].chunks_exact_mut(length).zip(velocity.component[component].chunks_exact(length));
            for (rates, values) in rows {
                for ((rate, value), strength) in rates.iter_mut().zip(values).zip(&strengths) {
                    *rate += strength * (self.velocity[component] - value);
                }
            }
        }
    }

    /// Rate in 1/s at a face of a component.
    fn strength(&self, grid: &Grid, component: usize, i: usize) -> f64 {
        let [begin, end] = self.between;
        let share = (grid.position(Some(component), [i as isize, 0, 0]).x - begin) / (end - begin);
        if (0.0..=1.0).contains(&share) { self.rate * (PI * share).sin().powi(2) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_pulls_within_and_leaves_the_rest_alone() {
        let grid = Grid::new([20, 4, 4], 0.1, Vector::zeros()).expect("enough cells");
        let fringe = Fringe { between: [1.0, 2.0], rate: 3.0, velocity: Vector::new(1.0, 0.0, -0.5) };
        let mut rates = FaceField::zeros(&grid);
        fringe.add_rates(&grid, &FaceField::zeros(&grid), &mut rates);
        // The face at 1.5 m is in the middle; faces of the other components stand half a cell on.
        let at = |component: usize, i: usize| rates.component[component][grid.index([i, 1, 2])];
        assert!((at(0, 15) - 3.0).abs() < 1e-14 && (at(2, 15) + 1.5 * (PI * 0.55).sin().powi(2)).abs() < 1e-14);
        assert!(at(0, 5) == 0.0 && at(2, 9) == 0.0 && at(1, 15) == 0.0 && at(0, 11) > 0.0);
        let mut rates = FaceField::zeros(&grid);
        fringe.add_rates(&grid, &FaceField::from_fn(&grid, |component, _| fringe.velocity[component]), &mut rates);
        assert_eq!(rates, FaceField::zeros(&grid));
    }
}
