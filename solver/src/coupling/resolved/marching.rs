//! Creeping flow marched in time as R states it (section 7.3.3): a projection scheme that knows nothing of bodies, then a step that only holds the bodies.
//!
//! The two are split, so the velocity is free of divergence or rigid in the bodies, but not both on the way, and without $\gamma$ not even at the end. The
//! inertia terms, of order of the Reynolds number, are left out. With $\gamma = 1$ the force of the last step predicts the next, and the steady state no longer
//! depends on the step (R eq. 7.9 to 7.13). R eq. 7.9 prints the new pressure and the projected velocity where the old pressure and the predicted velocity belong: else it is no projection.

use super::constraint::Constraint;
use super::krylov::conjugate_gradients;
use crate::Vector;
use crate::fluid::grid::FaceField;
use crate::fluid::operators::{divergence, gradient, laplacian};
use crate::fluid::periodic::PeriodicBox;

/// What does not change during a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MarchingProblem {
    /// In kg/m^3.
    pub density: f64,
    /// In Pa s.
    pub viscosity: f64,
    /// Force density in N/m^3 that drives the flow: minus a mean pressure gradient.
    pub driving: Vector,
    /// In s.
    pub step: f64,
    /// $\gamma$: the share of the last forces that predicts the next, 0 to 1. R takes 1.
    pub explicit_forcing: f64,
    /// Residual of the rigid motion at which a step's iteration stops, over its first.
    pub tolerance: f64,
}

/// A flow on its way through time.
pub struct Marching<'a> {
    flow: &'a PeriodicBox,
    constraint: &'a dyn Constraint,
    problem: MarchingProblem,
    /// In m/s.
    pub velocity: FaceField,
    /// In Pa.
    pub pressure: Vec<f64>,
    /// Force densities on the fluid in N/m^3.
    pub forces: Vec<f64>,
    /// Iterations of all steps.
    pub iterations: usize,
}

impl<'a> Marching<'a> {
    /// A flow at rest.
    pub fn new(flow: &'a PeriodicBox, constraint: &'a dyn Constraint, problem: MarchingProblem) -> Marching<'a> {
        let grid = flow.grid();
        let (velocity, pressure) = (FaceField::zeros(grid), vec![0.0; grid.len()]);
        Marching { flow, constraint, problem, velocity, pressure, forces: vec![0.0; constraint.len()], iterations: 0 }
    }

    /// One step: predict, project, hold the bodies.
    pub fn step(&mut self) {
        self.predict();
        self.project();
        self.hold_bodies();
    }

    /// Viscosity by Crank and Nicolson, with the old pressure and the old forces.
    fn predict(&mut self) {
        let MarchingProblem { density, viscosity, driving, step, .. } = self.problem;
        let grid = self.flow.grid();
        let slopes = gradient(grid, &self.pressure);
        let mut right = FaceField::zeros(grid);
        self.forces.iter_mut().for_each(|force| *force *= self.problem.explicit_forcing);
        self.constraint.spread(&self.forces, &mut right);
        for direction in 0..3 {
            let viscous = laplacian(grid, &self.velocity.component[direction]);
            let velocity = &self.velocity.component[direction];
            for (index, value) in right.component[direction].iter_mut().enumerate() {
                *value += driving[direction] - slopes.component[direction][index]
                    + 0.5 * viscosity * viscous[index]
                    + density / step * velocity[index];
            }
            self.flow.solve_helmholtz(&mut right.component[direction], 0.5 * viscosity, density / step);
        }
        self.velocity = right;
    }

    /// Takes the divergence out and advances the pressure.
    fn project(&mut self) {
        let MarchingProblem { density, viscosity, step, .. } = self.problem;
        let grid = self.flow.grid();
        let mut correction: Vec<f64> = divergence(grid, &self.velocity).into_iter().map(|value| value * density / step).collect();
        self.flow.solve_poisson(&mut correction);
        let slopes = gradient(grid, &correction);
        for (values, slopes) in self.velocity.component.iter_mut().zip(&slopes.component) {
            values.iter_mut().zip(slopes).for_each(|(value, slope)| *value -= step / density * slope);
        }
        let viscous = laplacian(grid, &correction);
        for ((pressure, correction), viscous) in self.pressure.iter_mut().zip(&correction).zip(&viscous) {
            *pressure += correction - 0.5 * step * viscosity / density * viscous;
        }
    }

    /// Makes the bodies rigid by the least change of the velocity (R eq. 7.12 and 7.13).
    fn hold_bodies(&mut self) {
        let MarchingProblem { density, step, tolerance, .. } = self.problem;
        let grid = self.flow.grid();
        let spread = |forces: &[f64]| {
            let mut field = FaceField::zeros(grid);
            self.constraint.spread(forces, &mut field);
            field
        };
        let missing: Vec<f64> = self
            .constraint
            .wanted()
            .iter()
            .zip(self.constraint.sample(&self.velocity))
            .map(|(wanted, value)| (wanted - value) * density / step)
            .collect();
        let operator = |forces: &[f64]| self.constraint.sample(&spread(forces));
        let solved = conjugate_gradients(operator, <[f64]>::to_vec, &missing, tolerance, 1000);
        for (force, change) in self.forces.iter_mut().zip(&solved.solution) {
            *force += change;
        }
        let change = spread(&solved.solution);
        for (values, change) in self.velocity.component.iter_mut().zip(&change.component) {
            values.iter_mut().zip(change).for_each(|(value, change)| *value += step / density * change);
        }
        self.iterations += solved.iterations;
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;
    use std::sync::Arc;

    use super::*;
    use crate::coupling::resolved::immersed::ImmersedBody;
    use crate::coupling::resolved::interpolation::Degree;
    use crate::coupling::resolved::points::{PointRules, Points};
    use crate::coupling::resolved::steady::{SteadyProblem, solve};
    use crate::coupling::resolved::surface::Ball;
    use crate::fluid::grid::Grid;

    const PROBLEM: MarchingProblem = MarchingProblem {
        density: 1.3,
        viscosity: 0.7,
        driving: Vector::new(0.0, 0.0, 0.0),
        step: 0.01,
        explicit_forcing: 1.0,
        tolerance: 1e-10,
    };

    fn flow(cells: usize) -> PeriodicBox {
        PeriodicBox::new(Grid::new([cells; 3], 1.0 / cells as f64, Vector::zeros()).expect("enough cells"))
    }

    fn points(flow: &PeriodicBox, bodies: &[ImmersedBody]) -> Points {
        Points::new(flow.grid(), bodies, &PointRules { distance: 1.5, degree: Degree::QuadraticOutward, interior: true })
            .expect("bodies in their box")
    }

    #[test]
    fn vortices_decay_by_the_factor_of_crank_and_nicolson() {
        let flow = flow(12);
        let nobody = points(&flow, &[]);
        let mut marching = Marching::new(&flow, &nobody, PROBLEM);
        let vortices = FaceField::from_fn(flow.grid(), |component, place| match component {
            0 => (TAU * place.x).sin() * (TAU * place.y).cos(),
            1 => -(TAU * place.x).cos() * (TAU * place.y).sin(),
            _ => 0.0,
        });
        marching.velocity = vortices.clone();
        (0..3).for_each(|_| marching.step());
        // The discrete Laplacian of these waves, twice that of one direction.
        let symbol = 2.0 * (2.0 * (TAU / 24.0).sin() * 12.0).powi(2);
        let half = 0.5 * PROBLEM.step * PROBLEM.viscosity / PROBLEM.density * symbol;
        let factor = ((1.0 - half) / (1.0 + half)).powi(3);
        let values = marching.velocity.component.iter().flatten().zip(vortices.component.iter().flatten());
        let worst = values.map(|(got, start)| (got - factor * start).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-13, "{worst}");
    }

    /// A velocity with a divergence: the pressure of the step balances the momentum of before and after to rounding, its own diffusion included.
    #[test]
    fn a_step_without_bodies_is_that_of_crank_and_nicolson_with_its_own_pressure() {
        let flow = flow(8);
        let grid = flow.grid();
        let nobody = points(&flow, &[]);
        let mut marching = Marching::new(&flow, &nobody, PROBLEM);
        let before =
            FaceField::from_fn(grid, |component, place| (TAU * (place.x + component as f64 * place.y)).sin() + (TAU * place.z).cos());
        marching.velocity = before.clone();
        marching.step();
        let slopes = gradient(grid, &marching.pressure);
        for (component, before) in before.component.iter().enumerate() {
            let after = &marching.velocity.component[component];
            let mean: Vec<f64> = after.iter().zip(before).map(|(after, before)| 0.5 * (after + before)).collect();
            let viscous = laplacian(grid, &mean);
            for index in 0..grid.len() {
                let inertia = PROBLEM.density / PROBLEM.step * (after[index] - before[index]);
                let left = inertia + slopes.component[component][index] - PROBLEM.viscosity * viscous[index];
                // Rounding of terms that are a thousand times the velocity.
                assert!(left.abs() < 1e-10, "{left}");
            }
        }
    }

    #[test]
    fn a_driven_fluid_without_bodies_accelerates() {
        let flow = flow(8);
        let nobody = points(&flow, &[]);
        let mut marching = Marching::new(&flow, &nobody, MarchingProblem { driving: Vector::new(2.6, 0.0, -1.3), ..PROBLEM });
        (0..5).for_each(|_| marching.step());
        assert!((marching.velocity.mean() - Vector::new(0.1, 0.0, -0.05)).norm() < 1e-14);
    }

    /// With explicit forcing both halves of a step agree in the end, and with them the flow of the same points solved at once.
    #[test]
    fn the_steady_state_is_that_of_the_points_solved_at_once_if_forces_are_kept() {
        let flow = flow(10);
        let body = ImmersedBody::fixed(Arc::new(Ball { radius: 0.31 }), Vector::new(0.52, 0.47, 0.51));
        let points = points(&flow, &[body]);
        let at_once = solve(
            &flow,
            &points,
            &SteadyProblem { viscosity: PROBLEM.viscosity, mean_velocity: Vector::x(), tolerance: 1e-10, most_iterations: 300 },
        );
        // Velocity of the mean under a unit pressure gradient.
        let mobility = 1.0 / at_once.mean_pressure_gradient.x.abs();
        let marched = |explicit_forcing: f64| {
            let problem = MarchingProblem { driving: Vector::x(), explicit_forcing, ..PROBLEM };
            let mut marching = Marching::new(&flow, &points, problem);
            (0..300).for_each(|_| marching.step());
            marching.velocity.mean().x / mobility
        };
        let (kept, dropped) = (marched(1.0), marched(0.0));
        // Forces that hardly move the fluid settle slowly.
        assert!((kept - 1.0).abs() < 2e-5, "{kept}");
        assert!((dropped - 1.0).abs() > 0.05, "{dropped}");
    }
}
