//! Steady creeping flow past bodies, solved at once: no time is marched (R section 7.4 marches to the same state).

use std::cell::RefCell;

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
    let respond = |forces: &[f64], mean: Vector, field: &mut FaceField| {
        field.component.iter_mut().for_each(|values| values.fill(0.0));
        constraint.spread(forces, field);
        flow.solve_stokes(field, problem.viscosity, 0.0, mean);
    };
    // One field for all flows: fresh memory of that size costs as much as a part of the transforms.
    let field = RefCell::new(FaceField::zeros(grid));
    let operator = |forces: &[f64]| {
        let field = &mut *field.borrow_mut();
        respond(forces, Vector::zeros(), field);
        let mut values = constraint.sample(field);
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
    respond(&vec![0.0; constraint.len()], problem.mean_velocity, &mut field.borrow_mut());
    let mut right = missing(&field.borrow());
    constraint.project(&mut right);
    let solved = if constraint.is_symmetric() {
        conjugate_gradients(operator, precondition, &right, problem.tolerance, problem.most_iterations)
    } else {
        gmres(operator, precondition, &right, problem.tolerance, problem.most_iterations)
    };
    let mut velocity = field.into_inner();
    respond(&solved.solution, problem.mean_velocity, &mut velocity);
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

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::coupling::resolved::constraint::Load;
    use crate::coupling::resolved::ghosts::{Continuation, Ghosts};
    use crate::coupling::resolved::immersed::ImmersedBody;
    use crate::coupling::resolved::surface::Ball;
    use crate::fluid::grid::Grid;
    use crate::fluid::operators::divergence;

    const PROBLEM: SteadyProblem =
        SteadyProblem { viscosity: 0.8, mean_velocity: Vector::new(1.0, 0.0, 0.0), tolerance: 1e-9, most_iterations: 200 };

    fn flow(cells: usize) -> PeriodicBox {
        PeriodicBox::new(Grid::new([cells; 3], 1.0 / cells as f64, Vector::zeros()).expect("enough cells"))
    }

    fn ball(radius: f64) -> ImmersedBody {
        ImmersedBody::fixed(Arc::new(Ball { radius }), Vector::new(0.52, 0.47, 0.51))
    }

    fn ghosts(flow: &PeriodicBox, bodies: &[ImmersedBody]) -> Ghosts {
        Ghosts::new(flow.grid(), bodies, Continuation::Quadratic).expect("bodies in their box")
    }

    /// The operator written out column by column and solved by singular values, which find the pockets by themselves.
    #[test]
    fn a_dense_matrix_gives_the_same_flow() {
        let flow = flow(10);
        let constraint = ghosts(&flow, &[ball(0.31)]);
        let respond = |forces: &[f64], mean: Vector| {
            let mut field = FaceField::zeros(flow.grid());
            constraint.spread(forces, &mut field);
            flow.solve_stokes(&mut field, PROBLEM.viscosity, 0.0, mean);
            field
        };
        let length = constraint.len();
        let unit = |place: usize| (0..length).map(|other| f64::from(u8::from(other == place))).collect::<Vec<f64>>();
        let columns = (0..length).map(|place| nalgebra::DVector::from_vec(constraint.sample(&respond(&unit(place), Vector::zeros()))));
        let matrix = nalgebra::DMatrix::from_columns(&columns.collect::<Vec<_>>());
        let singular = matrix.clone().svd(true, true);
        let least = 1e-9 * singular.singular_values.max();
        assert_eq!(length - singular.rank(least), constraint.pockets());
        let undisturbed = constraint.sample(&respond(&vec![0.0; length], PROBLEM.mean_velocity));
        let mut right: Vec<f64> = constraint.wanted().iter().zip(undisturbed).map(|(wanted, value)| wanted - value).collect();
        // What the projected equations can meet.
        constraint.project(&mut right);
        let project = |column: nalgebra::DVectorView<'_, f64>| {
            let mut values: Vec<f64> = column.iter().copied().collect();
            constraint.project(&mut values);
            nalgebra::DVector::from_vec(values)
        };
        let projected = nalgebra::DMatrix::from_columns(&matrix.column_iter().map(project).collect::<Vec<_>>());
        let dense = projected.svd(true, true).solve(&nalgebra::DVector::from_vec(right), least).expect("singular vectors are there");
        let wanted = respond(dense.as_slice(), PROBLEM.mean_velocity);
        let got = solve(&flow, &constraint, &PROBLEM).velocity;
        let worst = got.component.iter().flatten().zip(wanted.component.iter().flatten()).map(|(got, wanted)| (got - wanted).abs());
        let worst = worst.fold(0.0, f64::max);
        // The tolerance of the iteration, times the condition of what is left of the matrix.
        assert!(worst < 1e3 * PROBLEM.tolerance, "{worst}");
    }

    #[test]
    fn velocity_has_no_divergence_and_the_body_is_held_at_the_same_time() {
        let flow = flow(16);
        let constraint = ghosts(&flow, &[ball(0.31)]);
        let steady = solve(&flow, &constraint, &PROBLEM);
        let largest = divergence(flow.grid(), &steady.velocity).into_iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
        assert!(largest * flow.grid().spacing() < 1e-13, "{largest}");
        assert!(steady.residual <= PROBLEM.tolerance && steady.iterations < 70);
        assert!((steady.velocity.mean() - PROBLEM.mean_velocity).norm() < 1e-14);
        // Balance of the box: the pressure gradient drives what the body holds.
        let drag = constraint.loads(&steady.forces, 1)[0].force;
        assert!((steady.mean_pressure_gradient * flow.grid().volume() + drag).norm() < 1e-12 * drag.norm());
    }

    fn load(body: ImmersedBody, mean_velocity: Vector) -> Load {
        let flow = flow(16);
        let constraint = ghosts(&flow, &[body]);
        let steady = solve(&flow, &constraint, &SteadyProblem { mean_velocity, ..PROBLEM });
        constraint.loads(&steady.forces, 1)[0]
    }

    #[test]
    fn only_the_relative_velocity_counts() {
        let moving = Vector::new(-0.4, 0.2, 0.1);
        let at_rest = load(ball(0.31), Vector::x());
        let carried = load(ImmersedBody { velocity: moving, ..ball(0.31) }, Vector::x() + moving);
        assert!((at_rest.force - carried.force).norm() < 1e3 * PROBLEM.tolerance * at_rest.force.norm());
    }

    /// A lone turning sphere feels $8 \pi \mu a^3 \omega$; in a box that repeats the fluid outside turns back by the solid fraction.
    #[test]
    fn a_turning_sphere_feels_the_torque_of_its_array() {
        let (radius, rate) = (0.25, Vector::new(0.0, 0.0, 2.0));
        let torque = load(ImmersedBody { angular_velocity: rate, ..ball(radius) }, Vector::zeros()).torque;
        let alone = 8.0 * std::f64::consts::PI * PROBLEM.viscosity * radius.powi(3) * rate.z;
        let fraction = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
        // The next term of the array is of the power 10/3 of the fraction: 6e-4 here. Four spacings a radius leave a part of their square.
        assert!((torque.z / -(alone / (1.0 - fraction)) - 1.0).abs() < 0.5 / 16.0, "{}", torque.z / alone);
        assert!(torque.xy().norm() < 5e-3 * alone);
    }
}
