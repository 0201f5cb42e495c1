//! Steady flow with inertia past bodies that are held, without marching: Picard's iteration, advection of the last flow against friction and constraint of the
//! next, accelerated by Anderson (1965) over the last flows.
//!
//! Each iteration solves a creeping flow under the force $-\rho\,\mathbf u_k \cdot \nabla \mathbf u_k$ exactly, divergence-free and rigid
//! ([`super::balance`]). By itself that converges only while inertia is weak; the mixture of the last flows whose change is least makes of it what GMRES is to
//! Richardson's iteration, and passes that limit by far. A fringe is stiff and explicit: as much inertia as it pulls with is put on both sides.

use super::balance::{Balance, Driving, Implicit, Motion, Stop};
use super::constraint::{Constraint, Load};
use super::fringe::{Fringe, explicit_rates};
use super::ghosts::Ghosts;
use super::walls::Walls;
use crate::Vector;
use crate::fluid::grid::FaceField;
use crate::fluid::operators::dot;
use crate::fluid::periodic::PeriodicBox;

/// What is asked of the solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InertialProblem {
    /// Of the fluid in kg/m^3.
    pub density: f64,
    /// In Pa s.
    pub viscosity: f64,
    /// Mean of the velocity over the whole box, bodies included, in m/s.
    pub mean_velocity: Vector,
    /// Where the flow is made uniform.
    pub fringe: Option<Fringe>,
    /// Root mean square in m/s of the change of the velocity in an iteration at which to stop. Loads settle long before the stream far behind bodies does.
    pub change: f64,
    /// Root mean square in m/s of what is left of the conditions that can be met.
    pub slip: f64,
    /// Most iterations, of many flows each.
    pub most_iterations: usize,
}

/// A steady flow and what holds it.
#[derive(Debug, Clone)]
pub struct InertialFlow {
    /// In m/s.
    pub velocity: FaceField,
    /// Force densities in N/m^3 on the fluid but for friction: of the constraint, of the momentum that the flow carries, of the fringe.
    pub force_densities: FaceField,
    /// What the forces of the constraint do to each body.
    pub loads: Vec<Load>,
    /// Picard's.
    pub iterations: usize,
    /// Flows solved for.
    pub flows: usize,
    /// Root mean square in m/s of the last change of the velocity.
    pub change: f64,
    /// Root mean square in m/s of what is left of the conditions that can be met.
    pub slip: f64,
}

/// The iteration did not end.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "after {iterations} iterations one still changed the velocity by {change:e} m/s, and left a slip of {slip:e}; {wanted:e} was asked for"
)]
pub struct NotSteady {
    /// Picard's.
    pub iterations: usize,
    /// In m/s.
    pub change: f64,
    /// In m/s.
    pub slip: f64,
    /// Change in m/s.
    pub wanted: f64,
}

/// Flows that are mixed, each for two fields of memory. With twenty the last iterations take as many again.
const REMEMBERED: usize = 60;
/// Most flows of an iteration.
const MOST_FLOWS: usize = 600;

/// Solves for the flow past bodies at rest, from another flow.
///
/// # Errors
///
/// [`NotSteady`] if the flow is none in the end, as when it has no steady state or is not resolved.
pub fn solve_inertial(flow: &PeriodicBox, ghosts: &Ghosts, problem: &InertialProblem, start: FaceField) -> Result<InertialFlow, NotSteady> {
    let InertialProblem { density, viscosity, mean_velocity, fringe, slip, most_iterations, .. } = *problem;
    let (grid, walls) = (flow.grid(), Walls::none(flow.grid()));
    let inertia = density * fringe.map_or(0.0, |fringe| fringe.rate);
    let implicit = Implicit { viscosity, inertia, driving: Driving::MeanVelocity(mean_velocity) };
    let balance = Balance { flow, ghosts, walls: &walls, sheets: &[], implicit, free: &[] };
    let at_rest = vec![Motion::default(); ghosts.bodies()];
    let (mut velocity, mut forces) = (start, vec![0.0; ghosts.len()]);
    let (mut mixture, mut flows) = (Mixture::default(), 0);
    let (mut change, mut left) = (f64::INFINITY, f64::INFINITY);
    for iterations in 1..=most_iterations {
        let mut explicit = explicit_rates(grid, &velocity, true, fringe.as_ref());
        combine(&mut explicit, density, &velocity, inertia);
        // No slip is left for later iterations: the mixture would take it for a difference of flows.
        let stop = Stop { slip, most_iterations: MOST_FLOWS };
        let next = balance.solve(&explicit, &forces, &at_rest, &stop);
        flows += next.flows;
        forces = next.forces;
        let mut step = next.velocity.clone();
        combine(&mut step, 1.0, &velocity, -1.0);
        left = next.slip;
        change = norm(&step) / ((3 * grid.len()) as f64).sqrt();
        if change <= problem.change && next.slip <= 2.0 * slip {
            let mut force_densities = explicit_rates(grid, &next.velocity, true, fringe.as_ref());
            force_densities.component.iter_mut().flatten().for_each(|rate| *rate *= density);
            ghosts.spread(&forces, &mut force_densities);
            let loads = ghosts.loads(&forces, ghosts.bodies());
            return Ok(InertialFlow { velocity: next.velocity, force_densities, loads, iterations, flows, change, slip: next.slip });
        }
        if !change.is_finite() {
            return Err(NotSteady { iterations, change, slip: left, wanted: problem.change });
        }
        velocity = mixture.next(next.velocity, step);
    }
    Err(NotSteady { iterations: most_iterations, change, slip: left, wanted: problem.change })
}

/// Replaces a field by so many times itself and so many times another.
fn combine(field: &mut FaceField, own: f64, other: &FaceField, factor: f64) {
    let values = field.component.iter_mut().flatten().zip(other.component.iter().flatten());
    values.for_each(|(value, other)| *value = own * *value + factor * other);
}

fn product(one: &FaceField, other: &FaceField) -> f64 {
    one.component.iter().zip(&other.component).map(|(one, other)| dot(one, other)).sum()
}

fn norm(field: &FaceField) -> f64 {
    product(field, field).sqrt()
}

/// Takes so many times each of others off a field, block by block: the field is then read and written once, not once for each.
fn take_off<'a>(field: &mut FaceField, others: impl Iterator<Item = &'a FaceField> + Clone, factors: &[f64]) {
    const BLOCK: usize = 2048;
    for (component, values) in field.component.iter_mut().enumerate() {
        for (number, block) in values.chunks_mut(BLOCK).enumerate() {
            let range = number * BLOCK..number * BLOCK + block.len();
            for (other, factor) in others.clone().zip(factors) {
                let other = &other.component[component][range.clone()];
                block.iter_mut().zip(other).for_each(|(value, other)| *value -= factor * other);
            }
        }
    }
}

/// A difference of two flows and of the steps by which they changed.
struct Difference {
    of_found: FaceField,
    /// At right angles to all others, of unit size.
    of_step: FaceField,
    /// The last step along it.
    along: f64,
}

/// The last flows that iterations gave, and the steps by which they changed.
#[derive(Default)]
struct Mixture {
    /// The last ones.
    last: Option<(FaceField, FaceField)>,
    /// As many as are remembered.
    differences: Vec<Difference>,
}

/// Part of a difference that must be new, if it is not to be rounding.
const NEW: f64 = 1e-8;

impl Mixture {
    /// The flow to go on from: that whose step, as far as steps are linear in flows, is the least of all mixtures of the last ones.
    fn next(&mut self, found: FaceField, step: FaceField) -> FaceField {
        if let Some((mut of_found, mut of_step)) = self.last.take() {
            combine(&mut of_found, -1.0, &found, 1.0);
            combine(&mut of_step, -1.0, &step, 1.0);
            self.remember(of_found, of_step, &step);
        }
        let mut mixed = found.clone();
        let along: Vec<f64> = self.differences.iter().map(|difference| difference.along).collect();
        take_off(&mut mixed, self.differences.iter().map(|difference| &difference.of_found), &along);
        self.last = Some((found, step));
        mixed
    }

    /// Adds a difference, and what it changed of the last step along the older ones: fields are many and long, and read as seldom as can be.
    fn remember(&mut self, mut of_found: FaceField, mut of_step: FaceField, step: &FaceField) {
        if self.differences.len() == REMEMBERED {
            self.differences.remove(0);
        }
        let whole = norm(&of_step);
        let changes: Vec<f64> = self.differences.iter().map(|older| product(&older.of_step, &of_step)).collect();
        self.differences.iter_mut().zip(&changes).for_each(|(older, change)| older.along += change);
        take_off(&mut of_step, self.differences.iter().map(|older| &older.of_step), &changes);
        take_off(&mut of_found, self.differences.iter().map(|older| &older.of_found), &changes);
        let size = norm(&of_step);
        if size > NEW * whole {
            of_step.component.iter_mut().chain(&mut of_found.component).flatten().for_each(|value| *value /= size);
            let along = product(&of_step, step);
            self.differences.push(Difference { of_found, of_step, along });
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::coupling::resolved::ghosts::Continuation;
    use crate::coupling::resolved::immersed::ImmersedBody;
    use crate::coupling::resolved::immersed::TOUCHING;
    use crate::coupling::resolved::steady::{SteadyProblem, solve};
    use crate::coupling::resolved::surface::Ball;
    use crate::coupling::resolved::unsteady::{Body, Settings, Unsteady};
    use crate::fluid::grid::Grid;
    use crate::fluid::operators::divergence;

    const PROBLEM: InertialProblem = InertialProblem {
        density: 1.3,
        viscosity: 0.06,
        mean_velocity: Vector::new(0.9, 0.1, 0.0),
        fringe: None,
        change: 1e-6,
        slip: 3e-7,
        most_iterations: 100,
    };

    /// A ball of unit diameter in a box of so many diameters at so many cells a diameter.
    fn ball(extent: [usize; 3], cells: usize) -> (PeriodicBox, ImmersedBody) {
        let grid = Grid::new(extent.map(|diameters| diameters * cells), 1.0 / cells as f64, Vector::zeros()).expect("enough cells");
        let middle = Vector::from(extent.map(|diameters| 0.5 * diameters as f64));
        let place = middle + Vector::new(0.22, 0.13, 0.37) / cells as f64;
        (PeriodicBox::new(grid), ImmersedBody::fixed(Arc::new(Ball { radius: 0.5 }), place))
    }

    fn ghosts(flow: &PeriodicBox, body: &ImmersedBody) -> Ghosts {
        Ghosts::new(flow.grid(), std::slice::from_ref(body), Continuation::Quadratic).expect("the grid holds the ball")
    }

    #[test]
    fn without_density_the_flow_creeps() {
        let (flow, body) = ball([2; 3], 6);
        let ghosts = ghosts(&flow, &body);
        let problem = InertialProblem { density: 0.0, ..PROBLEM };
        let found = solve_inertial(&flow, &ghosts, &problem, FaceField::zeros(flow.grid())).expect("it is linear");
        let creeping =
            SteadyProblem { viscosity: PROBLEM.viscosity, mean_velocity: PROBLEM.mean_velocity, tolerance: 1e-9, most_iterations: 300 };
        let exact = solve(&flow, &ghosts, &creeping);
        let load = ghosts.loads(&exact.forces, 1)[0].force;
        assert!((found.loads[0].force - load).norm() < 1e-4 * load.norm(), "{} {load}", found.loads[0].force);
    }

    /// Asserts that a flow which marches on from here stays, and its load with it: another way to the same discrete equations.
    fn assert_stays(flow: &PeriodicBox, body: ImmersedBody, problem: &InertialProblem, found: &InertialFlow, tolerance: f64) {
        let settings = Settings {
            density: problem.density,
            viscosity: problem.viscosity,
            advection: true,
            gravity: Vector::zeros(),
            driving: Driving::MeanVelocity(problem.mean_velocity),
            walls: [None; 3],
            fringe: problem.fringe,
            step: 0.05,
            stop: Stop { slip: problem.slip, most_iterations: 300 },
            deepest_overlap: TOUCHING,
        };
        let body = Body { immersed: body, matter: None };
        let mut marched = Unsteady::new(flow.clone(), settings, vec![body], found.velocity.clone()).expect("sound numbers");
        for _ in 0..60 {
            marched.step().expect("the step is short enough");
        }
        let mut change = marched.velocity().clone();
        combine(&mut change, 1.0, &found.velocity, -1.0);
        let (change, force, load) = (norm(&change) / norm(&found.velocity), marched.loads()[0].force, found.loads[0].force);
        assert!(change < tolerance, "{change:e}");
        assert!((load - force).norm() < tolerance * force.norm(), "{load} {force}");
    }

    /// A Reynolds number of 20 in a crowded box. Errors shrink by a few per cent to a half in an iteration, so that what is left is less than a hundred times the
    /// last change.
    #[test]
    fn it_is_the_flow_that_marching_ends_in() {
        let (flow, body) = ball([2; 3], 8);
        let start = FaceField::from_fn(flow.grid(), |component, _| PROBLEM.mean_velocity[component]);
        let found = solve_inertial(&flow, &ghosts(&flow, &body), &PROBLEM, start).expect("it is steady");
        assert!(found.iterations > 5 && found.slip < 2.0 * PROBLEM.slip);
        let largest = divergence(flow.grid(), &found.velocity).into_iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
        assert!(largest < 1e-11, "{largest:e}");
        assert_stays(&flow, body, &PROBLEM, &found, 100.0 * PROBLEM.change);
    }

    #[test]
    fn a_fringe_does_not_keep_it_from_its_end() {
        let (flow, body) = ball([6, 3, 3], 6);
        let fringe = Some(Fringe { between: [4.5, 6.0], rate: 8.0, velocity: Vector::x() });
        let problem = InertialProblem { mean_velocity: Vector::x(), viscosity: 0.065, fringe, change: 1e-5, slip: 3e-6, ..PROBLEM };
        let start = FaceField::from_fn(flow.grid(), |component, _| Vector::x()[component]);
        let found = solve_inertial(&flow, &ghosts(&flow, &body), &problem, start).expect("it is steady");
        assert_stays(&flow, body, &problem, &found, 100.0 * problem.change);
    }

    #[test]
    fn what_is_not_steady_in_time_is_said() {
        let (flow, body) = ball([2; 3], 6);
        let start = FaceField::from_fn(flow.grid(), |component, _| PROBLEM.mean_velocity[component]);
        let few = InertialProblem { most_iterations: 2, ..PROBLEM };
        let error = solve_inertial(&flow, &ghosts(&flow, &body), &few, start).expect_err("two are too few");
        assert_eq!(error.iterations, 2);
        assert!(error.change > error.wanted);
    }
}
