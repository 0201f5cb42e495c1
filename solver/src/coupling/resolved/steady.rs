//! Steady creeping flow past bodies, solved at once: no time is marched (R section 7.4 marches to the same state).

use super::constraint::Constraint;
use super::krylov::{conjugate_gradients, gmres};
use crate::Vector;
use crate::fluid::grid::FaceField;
use crate::fluid::periodic::PeriodicBox;

/// What is asked of the solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyProblem {
    /// In Pa s.
    pub viscosity: f64,
    /// Mean of the velocity over the whole box, bodies included, in m/s.
    pub mean_velocity: Vector,
    /// Residual of the conditions at which to stop, over their right side.
    pub tolerance: f64,
    /// Most flows to solve for.
    pub most_iterations: usize,
}

/// A steady flow and what holds it.
#[derive(Debug, Clone)]
pub struct SteadyFlow {
    /// In m/s.
    pub velocity: FaceField,
    /// Force densities of the constraint on the fluid in N/m^3.
    pub forces: Vec<f64>,
    /// Pressure gradient that drives the mean flow, in Pa/m: the mean force of the constraint.
    pub mean_pressure_gradient: Vector,
    /// Flows solved for.
    pub iterations: usize,
    /// Residual of the conditions that can be met, over their right side.
    pub residual: f64,
    /// Root mean square in m/s of the residual of all conditions, with the part that no flow without divergence can meet.
    pub full_residual: f64,
}

/// Solves for the flow that meets all conditions and has no divergence.
pub fn solve(flow: &PeriodicBox, constraint: &dyn Constraint, problem: &SteadyProblem) -> SteadyFlow {
    let grid = flow.grid();
    let respond = |forces: &[f64], mean: Vector| {
        let mut field = FaceField::zeros(grid);
        constraint.spread(forces, &mut field);
        flow.solve_stokes(&mut field, problem.viscosity, 0.0, mean);
        field
    };
    let operator = |forces: &[f64]| {
        let mut values = constraint.sample(&respond(forces, Vector::zeros()));
        constraint.project(&mut values);
        values
    };
    let precondition = |residual: &[f64]| {
        let mut forces = constraint.precondition(residual);
        forces.iter_mut().for_each(|force| *force *= problem.viscosity);
        constraint.project(&mut forces);
        forces
    };
    let missing = |velocity: &FaceField| -> Vec<f64> {
        constraint.wanted().iter().zip(constraint.sample(velocity)).map(|(wanted, value)| wanted - value).collect()
    };
    let undisturbed = respond(&vec![0.0; constraint.len()], problem.mean_velocity);
    let mut right = missing(&undisturbed);
    constraint.project(&mut right);
    let solved = if constraint.is_symmetric() {
        conjugate_gradients(operator, precondition, &right, problem.tolerance, problem.most_iterations)
    } else {
        gmres(operator, precondition, &right, problem.tolerance, problem.most_iterations)
    };
    let velocity = respond(&solved.solution, problem.mean_velocity);
    let left = missing(&velocity);
    let mut force = FaceField::zeros(grid);
    constraint.spread(&solved.solution, &mut force);
    SteadyFlow {
        full_residual: (left.iter().map(|value| value * value).sum::<f64>() / left.len().max(1) as f64).sqrt(),
        mean_pressure_gradient: force.mean(),
        velocity,
        forces: solved.solution,
        iterations: solved.iterations,
        residual: solved.residual,
    }
}
