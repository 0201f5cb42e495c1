//! Flow of any Reynolds number past bodies that are held, moved, or free (R eq. 7.1 to 7.4 and 7.8 to 7.13), step by step.
//!
//! Time is stepped by differences backwards over two steps (friction and constraint implicit, so that nothing rings when forces change at once) with advection and the
//! places of bodies extrapolated: of second order. Each step is solved exactly for velocity, forces and motions together ([`super::balance`]), where R splits
//! it in a step without bodies and one that makes them rigid.

mod state;
#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

pub use state::FlowState;

use super::balance::{Balance, Driving, FreeBody, Implicit, Motion, Stop};
use super::constraint::{Constraint, Load};
use super::fringe::{Fringe, explicit_rates};
use super::ghosts::{Continuation, Ghosts};
use super::immersed::{ImmersedBody, ImmersionError};
use super::matter::{FluidInside, Matter};
use super::walls::{Wall, WallError, Walls};
use crate::fluid::grid::{FaceField, Grid};
use crate::fluid::periodic::PeriodicBox;
use crate::fluid::sheet::Sheet;
use crate::{Orientation, Vector};

/// What does not change during a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Of the fluid in kg/m^3.
    pub density: f64,
    /// In Pa s.
    pub viscosity: f64,
    /// Whether the fluid carries its momentum along; without it the flow creeps but takes its time.
    pub advection: bool,
    /// In m/s^2. The weight of the fluid is held by a hydrostatic pressure, which is left out: free bodies feel theirs less that of the fluid they displace.
    pub gravity: Vector,
    /// What drives the flow as a whole.
    pub driving: Driving,
    /// Walls across each direction.
    pub walls: [Option<Wall>; 3],
    /// Where the flow is made uniform.
    pub fringe: Option<Fringe>,
    /// In s.
    pub step: f64,
    /// When the iteration of a step stops.
    pub stop: Stop,
    /// How deep a value may lie in two bodies at once, or in a body and a wall, in spacings: bodies that touch in a granular run press into each other.
    pub deepest_overlap: f64,
}

/// A body in the flow.
#[derive(Clone)]
pub struct Body {
    /// Where and what it is. Without matter it moves on for ever with these velocities.
    pub immersed: ImmersedBody,
    /// What it is made of, if it moves freely.
    pub matter: Option<Matter>,
}

/// Why a flow cannot be made or cannot go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum UnsteadyError {
    /// Bodies do not fit the grid, or each other.
    #[error("at {time} s: {cause}")]
    Immersion {
        /// In s.
        time: f64,
        /// Why.
        cause: ImmersionError,
    },
    /// A wall that cannot be.
    #[error(transparent)]
    Wall(#[from] WallError),
    /// A number that is none, or has the wrong sign.
    #[error("a {name} of {value}; it must be a positive number")]
    Number {
        /// What it is.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// A solid without mass or volume.
    #[error("body {0} is of no sound matter: density, volume and moments of inertia must be positive numbers")]
    Matter(usize),
    /// The iteration of a step did not end.
    #[error(
        "at {time} s a slip of {slip:e} m/s was left after {flows} flows; {wanted:e} was asked for. The fluid moved by up to {courant:.2} spacings in a step: above about a half, take a shorter one"
    )]
    NotConverged {
        /// In s.
        time: f64,
        /// In m/s.
        slip: f64,
        /// In m/s.
        wanted: f64,
        /// Flows solved for.
        flows: usize,
        /// Largest velocity times the step over the spacing, before the step.
        courant: f64,
    },
    /// Velocities are no longer finite.
    #[error("the flow blew up at {0} s: the step was too long")]
    BlewUp(f64),
}

impl UnsteadyError {
    /// The same with ids in place of the numbers of bodies.
    pub(crate) fn renumbered(self, ids: &[u32]) -> UnsteadyError {
        match self {
            UnsteadyError::Immersion { time, cause } => UnsteadyError::Immersion { time, cause: cause.renumbered(ids) },
            UnsteadyError::Matter(number) => UnsteadyError::Matter(ids.get(number).map_or(number, |id| *id as usize)),
            other => other,
        }
    }
}

/// Where a body is at the end of a step, and what pushed it on the way besides the fluid and its weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrival {
    /// In m.
    pub position: Vector,
    /// Body to world.
    pub orientation: Orientation,
    /// Time integral of the forces of contacts over the step in N s, and of their torques in N m s.
    pub impulse: Load,
}

/// Values of the last two steps, the newer first.
type Two<Value> = [Value; 2];

/// What a free body remembers: momenta over two steps.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
struct Memory {
    velocity: Two<Vector>,
    /// Of the body less that of the fluid inside.
    angular_momentum: Two<Vector>,
    /// What pushed it in the last step.
    impulse: Load,
    /// Rate of change of its velocity in the last step, in m/s^2.
    acceleration: Vector,
}

/// What a step took and left.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Step {
    /// Flows solved for.
    pub flows: usize,
    /// Root mean square slip in m/s that the iteration left.
    pub slip: f64,
    /// The same with what no flow without divergence can meet.
    pub full_slip: f64,
}

/// A flow with bodies on its way through time.
pub struct Unsteady {
    flow: PeriodicBox,
    settings: Settings,
    bodies: Vec<Body>,
    ghosts: Ghosts,
    walls: Walls,
    /// Inverses on the walls for one length of the implicit step, the other ones being those of the first step.
    sheets: Option<(f64, Vec<Sheet>)>,
    velocity: Two<FaceField>,
    /// Explicit rates in m/s^2 of the step before.
    rates: Option<FaceField>,
    /// Force densities of the constraint on the fluid in N/m^3.
    forces: FaceField,
    loads: Vec<Load>,
    memory: Vec<Memory>,
    /// Velocities of the step before: they and the present ones tell where bodies go.
    motions: Vec<Motion>,
    time: f64,
}

/// Weights of the new, the present and the last value in a rate of change, times the step; and of the present and the last explicit rate.
struct Weights {
    new: f64,
    old: [f64; 2],
    explicit: [f64; 2],
}

/// The first step knows no last one.
const FIRST: Weights = Weights { new: 1.0, old: [1.0, 0.0], explicit: [1.0, 0.0] };
/// Differences backwards over two steps.
const LATER: Weights = Weights { new: 1.5, old: [2.0, -0.5], explicit: [2.0, -1.0] };

impl Unsteady {
    /// A flow of an initial velocity without divergence.
    ///
    /// # Errors
    ///
    /// [`UnsteadyError`] for numbers that are none, and for bodies that the grid cannot hold.
    pub fn new(flow: PeriodicBox, settings: Settings, bodies: Vec<Body>, velocity: FaceField) -> Result<Unsteady, UnsteadyError> {
        let Settings { density, viscosity, step, stop, .. } = settings;
        for (name, value) in [("density", density), ("viscosity", viscosity), ("step", step), ("slip at which to stop", stop.slip)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(UnsteadyError::Number { name, value });
            }
        }
        if let Some(number) = bodies.iter().position(|body| body.matter.is_some_and(|matter| !matter.is_sound())) {
            return Err(UnsteadyError::Matter(number));
        }
        let grid = flow.grid();
        let walls = Walls::new(grid, settings.walls)?;
        if let Driving::MeanVelocity(mean) = settings.driving {
            walls.check_mean(&mean)?;
        }
        let ghosts = ghosts(grid, &bodies, &walls, &settings, 0.0)?;
        let motions = bodies.iter().map(motion).collect();
        let memory = bodies.iter().map(|body| remember(grid, &settings, body, &velocity)).collect();
        let (forces, loads) = (FaceField::zeros(grid), vec![Load::default(); bodies.len() + walls.velocities().len()]);
        Ok(Unsteady {
            flow,
            settings,
            bodies,
            ghosts,
            walls,
            sheets: None,
            velocity: [velocity.clone(), velocity],
            rates: None,
            forces,
            loads,
            memory,
            motions,
            time: 0.0,
        })
    }

    /// One step in which nothing but the fluid and their weight acts on bodies.
    ///
    /// # Errors
    ///
    /// As [`Unsteady::step_to`].
    pub fn step(&mut self) -> Result<Step, UnsteadyError> {
        let arrivals = self.extrapolated();
        self.step_to(&arrivals)
    }

    /// One step in which bodies come to given places, one for each, under given impulses: those of contacts (the force $F_c$ of R eq. 7.2).
    ///
    /// An impulse jumps into the momentum. So differences backwards are taken of the momentum less the sum of all impulses so far, and a body that bounces has its new
    /// velocity at the end of this very step.
    ///
    /// # Errors
    ///
    /// [`UnsteadyError`] if bodies meet, the iteration does not end, or the flow blows up. The state is then that before the step, but for the places of bodies.
    pub fn step_to(&mut self, arrivals: &[Arrival]) -> Result<Step, UnsteadyError> {
        let weights = self.weights();
        let rates = self.explicit_rates();
        let right = self.right_side(&rates, &weights);
        let guesses = self.guess_motions();
        self.move_bodies(arrivals)?;
        let Settings { density, viscosity, step, driving, stop, .. } = self.settings;
        let free = self.free_bodies(&weights, arrivals);
        let implicit = Implicit { viscosity, inertia: weights.new * density / step, driving };
        let sheets = match self.sheets.take() {
            Some((new, sheets)) if new == weights.new => sheets,
            _ => self.walls.inverse(&self.flow, &implicit.response()),
        };
        let (_, sheets) = self.sheets.insert((weights.new, sheets));
        let balance = Balance { flow: &self.flow, ghosts: &self.ghosts, walls: &self.walls, sheets, implicit, free: &free };
        let balanced = balance.solve(&right, &self.ghosts.collect(&self.forces), &guesses, &stop);
        let time = self.time + step;
        if !(balanced.full_slip.is_finite() && balanced.velocity.mean().iter().all(|value| value.is_finite())) {
            return Err(UnsteadyError::BlewUp(time));
        }
        if balanced.slip > 2.0 * stop.slip && balanced.flows > stop.most_iterations {
            let fastest = self.velocity[0].component.iter().flatten().fold(0.0_f64, |fastest, value| fastest.max(value.abs()));
            let courant = fastest * step / self.flow.grid().spacing();
            return Err(UnsteadyError::NotConverged { time, slip: balanced.slip, wanted: stop.slip, flows: balanced.flows, courant });
        }
        self.forces.component.iter_mut().for_each(|values| values.fill(0.0));
        self.ghosts.spread(&balanced.forces, &mut self.forces);
        self.time = time;
        self.rates = Some(rates);
        self.velocity.swap(0, 1);
        self.velocity[0] = balanced.velocity;
        self.update_bodies(&balanced.motions, &balanced.forces, &free, (arrivals, &weights));
        Ok(Step { flows: balanced.flows, slip: balanced.slip, full_slip: balanced.full_slip })
    }

    /// Advection and fringe, in m/s^2.
    fn explicit_rates(&self) -> FaceField {
        self.rates_of(&self.velocity[0])
    }

    fn rates_of(&self, velocity: &FaceField) -> FaceField {
        explicit_rates(self.flow.grid(), velocity, self.settings.advection, self.settings.fringe.as_ref())
    }

    /// Everything that is known of a step, as a force density in N/m^3.
    fn right_side(&self, rates: &FaceField, weights: &Weights) -> FaceField {
        let Settings { density, step, .. } = self.settings;
        let last_rates = self.rates.as_ref().unwrap_or(rates);
        let of_component = |component: usize| {
            let [present, last] = self.velocity.each_ref().map(|field| &field.component[component]);
            let of_rates = rates.component[component].iter().zip(&last_rates.component[component]);
            let of_face = |((present, last), (rate, last_rate)): ((&f64, &f64), (&f64, &f64))| {
                let old = (weights.old[0] * present + weights.old[1] * last) / step;
                density * (old + weights.explicit[0] * rate + weights.explicit[1] * last_rate)
            };
            present.iter().zip(last).zip(of_rates).map(of_face).collect()
        };
        FaceField { component: std::array::from_fn(of_component) }
    }

    /// Motions at the end of the step as the last two tell, and those of the sides of walls.
    fn guess_motions(&self) -> Vec<Motion> {
        let guess = |(body, last): (&Body, &Motion)| match body.matter {
            None => motion(body),
            Some(_) => Motion {
                velocity: 2.0 * body.immersed.velocity - last.velocity,
                angular_velocity: 2.0 * body.immersed.angular_velocity - last.angular_velocity,
            },
        };
        let of_wall = |velocity: &Vector| Motion { velocity: *velocity, angular_velocity: Vector::zeros() };
        self.bodies.iter().zip(&self.motions).map(guess).chain(self.walls.velocities().iter().map(of_wall)).collect()
    }

    fn weights(&self) -> Weights {
        if self.rates.is_none() { FIRST } else { LATER }
    }

    /// Where velocities extrapolated to the middle of the step bring bodies that nothing pushes.
    fn extrapolated(&self) -> Vec<Arrival> {
        let step = self.settings.step;
        let is_first = self.rates.is_none();
        let middle = |present: Vector, last: Vector| if is_first { present } else { 1.5 * present - 0.5 * last };
        let arrival = |(body, last): (&Body, &Motion)| {
            let immersed = &body.immersed;
            let along = step * middle(immersed.velocity, last.velocity);
            let around = step * middle(immersed.angular_velocity, last.angular_velocity);
            let turned = Orientation::from_scaled_axis(around) * immersed.orientation;
            let orientation = if around == Vector::zeros() { immersed.orientation } else { turned };
            Arrival { position: immersed.position + along, orientation, impulse: Load::default() }
        };
        self.bodies.iter().zip(&self.motions).map(arrival).collect()
    }

    /// Brings bodies to their places, and finds their ghosts anew.
    fn move_bodies(&mut self, arrivals: &[Arrival]) -> Result<(), UnsteadyError> {
        let mut has_moved = false;
        for (Body { immersed, .. }, arrival) in self.bodies.iter_mut().zip(arrivals) {
            has_moved |= (immersed.position, immersed.orientation) != (arrival.position, arrival.orientation);
            (immersed.position, immersed.orientation) = (arrival.position, arrival.orientation);
        }
        if has_moved {
            self.ghosts = ghosts(self.flow.grid(), &self.bodies, &self.walls, &self.settings, self.time + self.settings.step)?;
        }
        Ok(())
    }

    /// The balance of each body that moves freely, at its new place.
    fn free_bodies(&self, weights: &Weights, arrivals: &[Arrival]) -> Vec<FreeBody> {
        let Settings { density, viscosity, gravity, step, .. } = self.settings;
        let rate = weights.new / step;
        let of_body = |(number, ((body, memory), arrival)): (usize, ((&Body, &Memory), &Arrival))| {
            let matter = body.matter?;
            let excess_mass = (matter.density - density) * matter.volume;
            let radius = body.immersed.surface.bounding_radius();
            let inertia = matter.inertia(&body.immersed);
            let old = |values: &Two<Vector>| (values[0] * weights.old[0] + values[1] * weights.old[1]) / step;
            let pushed = |new: Vector, last: Vector| (new * weights.new + last * weights.old[1]) / step;
            let added_mass = 0.5 * density * matter.volume;
            let friction = 6.0 * std::f64::consts::PI * viscosity * radius;
            Some(FreeBody {
                number,
                excess_mass_rate: excess_mass * rate,
                inertia_rate: inertia * rate,
                rate,
                fluid: FluidInside::new(self.flow.grid(), &body.immersed, density),
                force: excess_mass * (gravity + old(&memory.velocity)) + pushed(arrival.impulse.force, memory.impulse.force),
                torque: old(&memory.angular_momentum) + pushed(arrival.impulse.torque, memory.impulse.torque),
                mobility: (matter.density * matter.volume + added_mass) * rate + friction,
                turning_mobility: inertia.diagonal().mean() * rate / radius + 4.0 / 3.0 * friction * radius,
                radius,
            })
        };
        self.bodies.iter().zip(&self.memory).zip(arrivals).enumerate().filter_map(of_body).collect()
    }

    /// Takes over new motions and what they mean for loads and momenta.
    fn update_bodies(&mut self, motions: &[Motion], forces: &[f64], free: &[FreeBody], (arrivals, weights): (&[Arrival], &Weights)) {
        self.loads = self.ghosts.loads(forces, motions.len());
        for (number, (body, new)) in self.bodies.iter_mut().zip(motions).enumerate() {
            self.motions[number] = motion(body);
            body.immersed.velocity = new.velocity;
            body.immersed.angular_velocity = new.angular_velocity;
        }
        for FreeBody { number, fluid, .. } in free {
            let (body, memory) = (&self.bodies[*number], &mut self.memory[*number]);
            let [present, last] = memory.velocity;
            memory.acceleration =
                (body.immersed.velocity * weights.new - present * weights.old[0] - last * weights.old[1]) / self.settings.step;
            memory.velocity = [body.immersed.velocity, present];
            memory.impulse = arrivals[*number].impulse;
            memory.angular_momentum = [excess_angular_momentum(body, fluid, &self.velocity[0]), memory.angular_momentum[0]];
        }
    }

    /// Velocity in m/s.
    pub fn velocity(&self) -> &FaceField {
        &self.velocity[0]
    }

    /// Force densities in N/m^3 on the fluid now but for friction: of the constraint, of the momentum that the flow carries, of the fringe. Pressure follows from
    /// them ([`super::measures::pressure`]).
    pub fn force_densities(&self) -> FaceField {
        let mut forces = self.explicit_rates();
        for (forces, of_constraint) in forces.component.iter_mut().zip(&self.forces.component) {
            forces.iter_mut().zip(of_constraint).for_each(|(rate, force)| *rate = self.settings.density * *rate + force);
        }
        forces
    }

    /// The bodies where they are now.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// What the forces of the constraint do to each body: all that the fluid does, but for the rate of change of the momentum of the fluid inside.
    pub fn loads(&self) -> &[Load] {
        &self.loads[..self.bodies.len()]
    }

    /// All that the fluid does to a body: the load of the constraint's forces, and for a free one the rate of change of the momentum of the fluid inside. Of its
    /// torque only the former.
    pub fn fluid_load(&self, number: usize) -> Load {
        let Load { force, torque } = self.loads[number];
        let displaced = self.bodies[number].matter.map_or(0.0, |matter| self.settings.density * matter.volume);
        Load { force: force + self.memory[number].acceleration * displaced, torque }
    }

    /// What does not change during the run.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The box and its inverses.
    pub fn flow(&self) -> &PeriodicBox {
        &self.flow
    }

    /// What the fluid does to each side of each wall, in the order of [`Walls::velocities`], without a torque. A load through a wall is all counted in its first
    /// side. The fluid within a wall one spacing thick has its part: it is sheared by both sides.
    pub fn wall_loads(&self) -> &[Load] {
        &self.loads[self.bodies.len()..]
    }

    /// The constraint at the places of now.
    pub fn ghosts(&self) -> &Ghosts {
        &self.ghosts
    }

    /// In s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Momentum of the fluid in the whole box and of what free bodies weigh more than the fluid inside them, in kg m/s.
    pub fn momentum(&self) -> Vector {
        let of_fluid = self.velocity[0].mean() * self.flow.grid().volume() * self.settings.density;
        let of_body = |body: &Body| {
            body.matter
                .map_or(Vector::zeros(), |matter| body.immersed.velocity * ((matter.density - self.settings.density) * matter.volume))
        };
        of_fluid + self.bodies.iter().map(of_body).sum::<Vector>()
    }
}

fn motion(body: &Body) -> Motion {
    Motion { velocity: body.immersed.velocity, angular_velocity: body.immersed.angular_velocity }
}

fn ghosts(grid: &Grid, bodies: &[Body], walls: &Walls, settings: &Settings, time: f64) -> Result<Ghosts, UnsteadyError> {
    let immersed: Vec<ImmersedBody> = bodies.iter().map(|body| body.immersed.clone()).collect();
    Ghosts::between(grid, &immersed, walls, Continuation::Quadratic, settings.deepest_overlap)
        .map_err(|cause| UnsteadyError::Immersion { time, cause })
}

/// Momenta of now, twice; those of a body that is not free are of no meaning.
fn remember(grid: &Grid, settings: &Settings, body: &Body, velocity: &FaceField) -> Memory {
    let inside = FluidInside::new(grid, &body.immersed, settings.density);
    Memory {
        velocity: [body.immersed.velocity; 2],
        angular_momentum: [excess_angular_momentum(body, &inside, velocity); 2],
        ..Memory::default()
    }
}

/// Angular momentum of a free body less that of the fluid inside, in kg m^2/s.
fn excess_angular_momentum(body: &Body, inside: &FluidInside, velocity: &FaceField) -> Vector {
    let of_body = body.matter.map_or(Vector::zeros(), |matter| matter.inertia(&body.immersed) * body.immersed.angular_velocity);
    of_body - inside.angular_momentum(velocity)
}
