//! One implicit step of a flow and of the bodies in it, found together: no divergence, rigid bodies, and the balance of loads on those that move freely.
//!
//! With forces $\lambda$ and velocities $q$ of free bodies, and $S^{-1}$ the exact inverse of the unsteady flow without bodies (R eq. 7.1 to 7.4 in one):
//! $J S^{-1} E \lambda - P q = b$ and $T \lambda + D q = c$. A force that is lagged by a step or an iteration, which fails for light bodies, does not occur.

use std::cell::RefCell;

use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};

use super::constraint::{Constraint, Load};
use super::ghosts::Ghosts;
use super::krylov::{Solved, gmres};
use super::matter::FluidInside;
use super::walls::Walls;
use crate::Vector;
use crate::fluid::grid::FaceField;
use crate::fluid::operators::dot;
use crate::fluid::periodic::PeriodicBox;
use crate::fluid::sheet::{Response, Sheet};

/// What drives the flow as a whole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Driving {
    /// Mean of the velocity over the whole box, bodies included, in m/s; the mean pressure gradient is whatever that takes. Zero: a closed vessel.
    MeanVelocity(Vector),
    /// Minus the mean pressure gradient in N/m^3; momentum of fluid and bodies together changes by nothing else, besides weight.
    Force(Vector),
}

/// The unsteady flow of one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Implicit {
    /// In Pa s.
    pub viscosity: f64,
    /// Density over the implicit part of the step in kg/(m^3 s).
    pub inertia: f64,
    /// The mean flow.
    pub driving: Driving,
}

impl Implicit {
    /// Replaces a force density in N/m^3 by the velocity in m/s.
    fn solve(&self, flow: &PeriodicBox, field: &mut FaceField) {
        let mean = match self.driving {
            Driving::MeanVelocity(mean) => mean,
            Driving::Force(force) => (field.mean() + force) / self.inertia,
        };
        flow.solve_stokes(field, self.viscosity, self.inertia, mean);
    }

    /// What forces on planes do.
    pub fn response(&self) -> Response {
        let mean_mobility = match self.driving {
            Driving::MeanVelocity(_) => 0.0,
            Driving::Force(_) => 1.0 / self.inertia,
        };
        Response { viscosity: self.viscosity, inertia: self.inertia, mean_mobility }
    }

    /// The same flow with nothing that drives it.
    fn homogeneous(&self) -> Implicit {
        let driving = match self.driving {
            Driving::MeanVelocity(_) => Driving::MeanVelocity(Vector::zeros()),
            Driving::Force(_) => Driving::Force(Vector::zeros()),
        };
        Implicit { driving, ..*self }
    }
}

/// Velocities of a body.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Of its centre in m/s.
    pub velocity: Vector,
    /// In rad/s.
    pub angular_velocity: Vector,
}

impl Motion {
    /// In m/s at an arm in m.
    fn at(&self, arm: &Vector) -> Vector {
        self.velocity + self.angular_velocity.cross(arm)
    }
}

/// A body that moves freely: rates of change of its momentum, less that of the fluid inside, against what acts on it.
pub struct FreeBody {
    /// Its number among all bodies.
    pub number: usize,
    /// Mass of the body less that of the fluid it displaces, over the implicit part of the step, in kg/s.
    pub excess_mass_rate: f64,
    /// Tensor of inertia of the body over the implicit part of the step in kg m^2/s.
    pub inertia_rate: Matrix3<f64>,
    /// One over the implicit part of the step in 1/s.
    pub rate: f64,
    /// The fluid inside.
    pub fluid: FluidInside,
    /// Net weight, and old momenta over the step; in N.
    pub force: Vector,
    /// Old angular momenta over the step in N m.
    pub torque: Vector,
    /// What turns a missing force into a velocity in kg/s: about the body's and its added mass over the step, and its friction.
    pub mobility: f64,
    /// What turns a missing torque into a velocity of its surface in kg m/s.
    pub turning_mobility: f64,
    /// Of a ball that holds it, in m.
    pub radius: f64,
}

impl FreeBody {
    /// What is missing in the balance of a motion, a flow and the forces of the constraint.
    fn missing(&self, motion: &Motion, velocity: &FaceField, load: &Load) -> Load {
        let turning = self.inertia_rate * motion.angular_velocity - self.fluid.angular_momentum(velocity) * self.rate;
        Load { force: self.force + load.force - motion.velocity * self.excess_mass_rate, torque: self.torque + load.torque - turning }
    }

    /// As velocities in m/s times a weight, so that it can be held against slip.
    fn scaled(&self, load: &Load, weight: f64) -> [f64; 6] {
        let (force, torque) = (load.force * (weight / self.mobility), load.torque * (weight / self.turning_mobility));
        [force.x, force.y, force.z, torque.x, torque.y, torque.z]
    }

    /// A motion from its unknowns, all in m/s times a weight.
    fn motion(&self, unknowns: &[f64], weight: f64) -> Motion {
        let vector = |from: usize| Vector::new(unknowns[from], unknowns[from + 1], unknowns[from + 2]) / weight;
        Motion { velocity: vector(0), angular_velocity: vector(3) / self.radius }
    }

    /// The same body with nothing that acts on it but the constraint.
    fn homogeneous(&self) -> FreeBody {
        FreeBody { force: Vector::zeros(), torque: Vector::zeros(), fluid: self.fluid.clone(), ..*self }
    }
}

/// When an iteration stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Root mean square in m/s of what is left of the conditions that can be met.
    pub slip: f64,
    /// Most flows to solve for.
    pub most_iterations: usize,
}

/// A flow, what holds it, and how bodies move in it.
#[derive(Debug, Clone)]
pub struct Balanced {
    /// In m/s.
    pub velocity: FaceField,
    /// Force densities of the constraint on the fluid in N/m^3.
    pub forces: Vec<f64>,
    /// Of all bodies and sides of walls.
    pub motions: Vec<Motion>,
    /// Flows solved for.
    pub flows: usize,
    /// Root mean square in m/s of what is left of the conditions that can be met.
    pub slip: f64,
    /// The same of all conditions.
    pub full_slip: f64,
}

/// The problem of one step.
pub struct Balance<'a> {
    /// The box.
    pub flow: &'a PeriodicBox,
    /// Conditions and forces of bodies and walls.
    pub ghosts: &'a Ghosts,
    /// The walls among them.
    pub walls: &'a Walls,
    /// Inverses of the flow on each wall.
    pub sheets: &'a [Sheet],
    /// The flow without bodies.
    pub implicit: Implicit,
    /// Bodies that move freely.
    pub free: &'a [FreeBody],
}

impl Balance<'_> {
    /// Solves for a right side in N/m^3, from guesses of the forces and of the motions of all bodies and sides of walls. Those that are not free are kept.
    pub fn solve(&self, right: &FaceField, guess: &[f64], motions: &[Motion], stop: &Stop) -> Balanced {
        let mut forces = guess.to_vec();
        // The pressure of a pocket between bodies that touch is free. One that a former step has left there would push them for ever.
        self.ghosts.project(&mut forces);
        let mut field = right.clone();
        self.ghosts.spread(&forces, &mut field);
        self.implicit.solve(self.flow, &mut field);
        let missing = self.missing(&field, &forces, motions, self.free);
        let solved = self.correct(&missing, stop);
        let mut motions = motions.to_vec();
        let (of_forces, of_motions) = solved.solution.split_at(forces.len());
        forces.iter_mut().zip(of_forces).for_each(|(force, change)| *force += change);
        for (free, unknowns) in self.free.iter().zip(of_motions.chunks_exact(6)) {
            let (motion, change) = (&mut motions[free.number], free.motion(unknowns, self.weight()));
            motion.velocity += change.velocity;
            motion.angular_velocity += change.angular_velocity;
        }
        self.balance_momentum(&mut forces, &motions);
        field.clone_from(right);
        self.ghosts.spread(&forces, &mut field);
        self.implicit.solve(self.flow, &mut field);
        let mut left = self.slip(&field, &motions);
        let full_slip = root_mean_square(&left);
        self.ghosts.project(&mut left);
        Balanced { velocity: field, forces, motions, flows: solved.iterations + 2, slip: root_mean_square(&left), full_slip }
    }

    /// What a body's balance weighs: as much as all conditions together, among which it would be lost in a mean.
    fn weight(&self) -> f64 {
        (self.ghosts.len().max(1) as f64).sqrt()
    }

    /// What is missing in all conditions that can be met, and in the balance of all free bodies; in m/s.
    fn missing(&self, field: &FaceField, forces: &[f64], motions: &[Motion], free: &[FreeBody]) -> Vec<f64> {
        let mut missing = self.slip(field, motions);
        self.ghosts.project(&mut missing);
        if !free.is_empty() {
            let loads = self.ghosts.loads(forces, motions.len());
            missing.extend(
                free.iter().flat_map(|free| free.scaled(&free.missing(&motions[free.number], field, &loads[free.number]), self.weight())),
            );
        }
        missing
    }

    /// Velocity of the bodies less that of the fluid where conditions are asked for, in m/s.
    fn slip(&self, field: &FaceField, motions: &[Motion]) -> Vec<f64> {
        let wanted = self.ghosts.at_surface(|body, arm| motions[body].at(arm));
        wanted.iter().zip(self.ghosts.sample(field)).map(|(wanted, value)| wanted - value).collect()
    }

    /// Solves for the changes of forces and motions that supply what is missing.
    fn correct(&self, missing: &[f64], stop: &Stop) -> Solved {
        let conditions = self.ghosts.len();
        let bodies = self.free.iter().map(|free| free.number + 1).max().unwrap_or(0);
        let bodies = bodies.max(self.ghosts.bodies());
        let implicit = self.implicit.homogeneous();
        let free: Vec<FreeBody> = self.free.iter().map(FreeBody::homogeneous).collect();
        let motions = |unknowns: &[f64]| {
            let mut motions = vec![Motion::default(); bodies];
            for (free, unknowns) in free.iter().zip(unknowns.chunks_exact(6)) {
                motions[free.number] = free.motion(unknowns, self.weight());
            }
            motions
        };
        let field = RefCell::new(FaceField::zeros(self.flow.grid()));
        let operator = |unknowns: &[f64]| {
            let (forces, of_motions) = unknowns.split_at(conditions);
            let field = &mut *field.borrow_mut();
            field.component.iter_mut().for_each(|values| values.fill(0.0));
            self.ghosts.spread(forces, field);
            implicit.solve(self.flow, field);
            let mut supplied = self.missing(field, forces, &motions(of_motions), &free);
            supplied.iter_mut().for_each(|value| *value = -*value);
            supplied
        };
        // Bodies first, each as if it had its mass, its added mass and its friction; then the forces among ghosts that give them that motion.
        let precondition = |residual: &[f64]| {
            let (conditions, of_bodies) = residual.split_at(conditions);
            let motions = motions(of_bodies);
            let moved = self.ghosts.at_surface(|body, arm| motions[body].at(arm));
            let mut wanted: Vec<f64> = conditions.iter().zip(moved).map(|(value, moved)| value + moved).collect();
            self.ghosts.project(&mut wanted);
            let mut forces = self.ghosts.precondition(&wanted);
            forces
                .iter_mut()
                .zip(&wanted)
                .for_each(|(force, value)| *force = self.implicit.viscosity * *force + self.implicit.inertia * value);
            let first_of_walls = self.ghosts.of_bodies();
            forces[first_of_walls..].copy_from_slice(&self.walls.solve(self.sheets, &wanted[first_of_walls..]));
            self.ghosts.project(&mut forces);
            forces.extend(of_bodies);
            forces
        };
        let tolerance = stop.slip * (missing.len() as f64).sqrt() / dot(missing, missing).sqrt();
        gmres(operator, precondition, missing, tolerance, stop.most_iterations)
    }

    /// Spreads what the iteration left of the balance of forces over the ghosts of each free body, so that momentum is kept to rounding. Walls take momentum
    /// anyway, and in a creeping flow between them what is left of a force would be much of a flow.
    fn balance_momentum(&self, forces: &mut [f64], motions: &[Motion]) {
        if self.free.is_empty() || !self.walls.held().is_empty() {
            return;
        }
        let loads = self.ghosts.loads(forces, motions.len());
        let ones = self.ghosts.loads(&vec![1.0; forces.len()], motions.len());
        let mut left = vec![Vector::zeros(); motions.len()];
        for free in self.free {
            let force = free.force + loads[free.number].force - motions[free.number].velocity * free.excess_mass_rate;
            left[free.number] = -force.component_div(&ones[free.number].force);
        }
        let changes = self.ghosts.at_surface(|body, _| left[body]);
        forces.iter_mut().zip(changes).for_each(|(force, change)| *force += change);
    }
}

fn root_mean_square(values: &[f64]) -> f64 {
    (dot(values, values) / values.len().max(1) as f64).sqrt()
}
