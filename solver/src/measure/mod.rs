//! Named observables at one instant.

pub(crate) mod rest;

use crate::bodies::angular_velocity;
use crate::contact::stage::Observation;
use crate::coupling::resolved::constraint::Load;
use crate::openings::Departure;
use crate::scheme::resolved::ResolvedFlow;
use crate::{Bodies, Orientation, Simulation, Vector};

/// The state of a simulation at one instant: velocities brought to the time of the positions by half of the coming kick.
pub struct Now<'a> {
    simulation: &'a Simulation,
    half_kick: f64,
}

impl Simulation {
    /// The state at the current time, all quantities at the same instant.
    pub fn now(&mut self) -> Now<'_> {
        self.evaluate_forces();
        Now::new(self)
    }
}

impl<'a> Now<'a> {
    /// Forces must be current.
    fn new(simulation: &'a Simulation) -> Now<'a> {
        Now { simulation, half_kick: simulation.kind.age_of_velocities() }
    }

    /// The bodies: ids, shapes, masses.
    pub fn bodies(&self) -> &'a Bodies {
        &self.simulation.bodies
    }

    /// Time in s.
    pub fn time(&self) -> f64 {
        self.simulation.time()
    }

    /// Centre of mass in m.
    pub fn position(&self, index: usize) -> Vector {
        self.bodies().position(index)
    }

    /// Orientation, from the axes in which the shape was given to the world.
    pub fn orientation(&self, index: usize) -> Orientation {
        self.bodies().orientation(index) * self.bodies().shape(index).axes().inverse()
    }

    /// Velocity in m/s.
    pub fn velocity(&self, index: usize) -> Vector {
        let bodies = self.bodies();
        let gravity = self.simulation.stages.gravity.unwrap_or_default();
        let acceleration = bodies.force(index) * bodies.inverse_mass(index) + gravity;
        bodies.half_step_velocity(index) + acceleration * self.half_kick
    }

    /// Angular momentum about the centre of mass in kg m^2/s.
    pub fn spin_momentum(&self, index: usize) -> Vector {
        self.bodies().half_step_angular_momentum(index) + self.bodies().torque(index) * self.half_kick
    }

    /// Angular velocity in rad/s, world frame.
    pub fn angular_velocity(&self, index: usize) -> Vector {
        let (bodies, inertia) = (self.bodies(), self.bodies().inertia(index));
        if bodies.is_isotropic(index) {
            return bodies.half_step_angular_velocity(index) + bodies.torque(index) * (self.half_kick / inertia.x);
        }
        angular_velocity(&bodies.orientation(index), &self.spin_momentum(index), &inertia)
    }

    /// Kinetic energy of all bodies in J.
    pub fn kinetic_energy(&self) -> f64 {
        let energy_of = |index| {
            let translation = self.bodies().mass(index) * self.velocity(index).norm_squared();
            0.5 * (translation + self.spin_momentum(index).dot(&self.angular_velocity(index)))
        };
        self.sum(energy_of)
    }

    /// Root mean square speed in m/s, of turning too: that of the kinetic energy and the mass of all bodies together. Zero without bodies.
    pub fn root_mean_square_speed(&self) -> f64 {
        if self.bodies().is_empty() { 0.0 } else { (2.0 * self.kinetic_energy() / self.sum(|index| self.bodies().mass(index))).sqrt() }
    }

    /// Bodies that have left, by time.
    pub fn departures(&self) -> &'a [Departure] {
        self.simulation.departures()
    }

    /// Energy of all bodies in the gravity field in J, zero at the origin.
    pub fn gravitational_energy(&self) -> f64 {
        let Some(gravity) = self.simulation.scene.scene.gravity.map(Vector::from) else { return 0.0 };
        self.sum(|index| -self.bodies().mass(index) * gravity.dot(&self.position(index)))
    }

    /// What can be seen of all contacts.
    pub fn contacts(&self) -> Observation {
        let mut total = Observation::default();
        for stage in &self.simulation.stages.contacts {
            let seen = stage.observe(self.bodies());
            total.contacts += seen.contacts;
            total.largest_overlap = total.largest_overlap.max(seen.largest_overlap);
            total.elastic_energy += seen.elastic_energy;
        }
        total
    }

    /// Kinetic, gravitational and elastic energy in J.
    pub fn total_energy(&self) -> f64 {
        self.kinetic_energy() + self.gravitational_energy() + self.contacts().elastic_energy
    }

    /// Linear momentum in kg m/s.
    pub fn momentum(&self) -> Vector {
        self.bodies().by_id().map(|index| self.bodies().mass(index) * self.velocity(index)).sum()
    }

    /// Angular momentum about the origin in kg m^2/s.
    pub fn angular_momentum(&self) -> Vector {
        let of_body = |index| self.position(index).cross(&(self.bodies().mass(index) * self.velocity(index))) + self.spin_momentum(index);
        self.bodies().by_id().map(of_body).sum()
    }

    /// What the fluid does to a body, besides the hydrostatic pressure: force in N and torque in N m about its centre. A torque of a free body lacks the rate of
    /// change of the angular momentum of the fluid inside. Nothing without a fluid.
    pub fn fluid_load(&self, id: u32) -> Load {
        self.simulation.stages.flow.as_ref().map_or(Load::default(), |flow| flow.load(id))
    }

    /// Mean velocity in m/s of all that fills the box of the fluid.
    pub fn mean_flow(&self) -> Vector {
        self.simulation.stages.flow.as_ref().map_or(Vector::zeros(), |flow| flow.flow().velocity().mean())
    }

    /// Mean pressure gradient in Pa/m, besides the hydrostatic one.
    pub fn mean_pressure_gradient(&self) -> Vector {
        self.simulation.stages.flow.as_ref().map_or(Vector::zeros(), ResolvedFlow::mean_pressure_gradient)
    }

    fn sum(&self, of_body: impl Fn(usize) -> f64) -> f64 {
        self.bodies().by_id().map(of_body).sum()
    }
}
