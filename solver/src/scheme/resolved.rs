//! Bodies in a flow that is resolved around them: one step of the fluid while their contacts take as many as they need (R section 7.2).
//!
//! During a step of the fluid bodies move as granular bodies do, under their contacts and under a *pull*: what fluid and weight did to them in the last step. Then
//! flow and motions are found together at the places that they have come to, under the impulses that contacts have given ([`Unsteady::step_to`]); these motions replace
//! the granular ones. Nothing of the fluid is lagged in them: the pull only tells where bodies go and how hard they meet, to second order of the step.
//!
//! A body that is pushed takes fluid along. For contacts it therefore weighs what it weighs with the added mass of the ball inside it ([`virtual_mass`]), the least that it can
//! take along: of $r$ times its true inertia in the fluid, a body that lies on another loses all but $\sqrt{1 - r}$ of an error in each step, and from $r = 4/3$ on it would
//! grow. A contact shorter than a step of the fluid gives the impulse of the virtual mass to the true one, so its restitution is $r (1 + e) - 1$; one that lasts some steps
//! of the fluid is right. Below a spacing the film of fluid between two bodies is not resolved, and no force stands in for it.

#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

use crate::bodies::angular_momentum;
use crate::contact::law::StepKind;
use crate::coupling::resolved::balance::Driving;
use crate::coupling::resolved::constraint::Load;
use crate::coupling::resolved::immersed::ImmersedBody;
use crate::coupling::resolved::measures::pressure;
use crate::coupling::resolved::unsteady::{Arrival, Body, FlowState, Unsteady, UnsteadyError};
use crate::ledger::Ledger;
use crate::{Bodies, Orientation, Vector};

/// A flow and how the bodies of a run meet it.
pub(crate) struct ResolvedFlow {
    unsteady: Unsteady,
    /// Ids of bodies, in the order of the flow: increasing.
    ids: Vec<u32>,
    are_free: bool,
    /// Steps of contacts in one of the fluid.
    contact_steps: u64,
    state: CouplingState,
    stopped: Option<UnsteadyError>,
}

/// What changes with time besides flow and bodies.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct CouplingState {
    /// What fluid and weight did to each body in the last step of the fluid, with the body's virtual mass.
    pulls: Vec<Load>,
    /// Steps of the fluid.
    steps: u64,
    /// Flows that were solved for.
    flows: u64,
}

/// The whole state of a flow, as a checkpoint keeps it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SavedFlow {
    flow: FlowState,
    coupling: CouplingState,
}

/// Mass in kg of a body and of the fluid that the ball inside it takes along, in a fluid of a density in kg/m^3.
pub(crate) fn virtual_mass(mass: f64, body: &ImmersedBody, density: f64) -> f64 {
    let radius = (-body.foot(&Vector::zeros()).distance).max(0.0);
    mass + 0.5 * density * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3)
}

impl ResolvedFlow {
    /// A flow with bodies of given ids, which the fluid moves unless their motion is given.
    pub(crate) fn new(unsteady: Unsteady, ids: Vec<u32>, are_free: bool, contact_steps: u64) -> ResolvedFlow {
        let state = CouplingState { pulls: vec![Load::default(); ids.len()], ..CouplingState::default() };
        ResolvedFlow { unsteady, ids, are_free, contact_steps, state, stopped: None }
    }

    /// Whether a step of the fluid ends after so many steps of contacts.
    pub(crate) fn is_due(&self, steps_taken: u64) -> bool {
        steps_taken.is_multiple_of(self.contact_steps)
    }

    /// Why it cannot go on, if it cannot.
    pub(crate) fn stopped(&self) -> Option<&UnsteadyError> {
        self.stopped.as_ref()
    }

    /// Adds the pull of fluid and weight to the forces on bodies.
    pub(crate) fn add_pulls(&self, bodies: &mut Bodies) {
        for (id, pull) in self.ids.iter().zip(&self.state.pulls) {
            let Some(index) = bodies.index_of(*id) else { continue };
            bodies.state.force[index] += pull.force;
            bodies.state.torque[index] += pull.torque;
        }
    }

    /// The step of the fluid that ends now; forces on bodies are current.
    pub(crate) fn step(&mut self, bodies: &mut Bodies, kind: &StepKind) {
        let result = if self.are_free { self.step_free(bodies, kind) } else { self.step_given(bodies) };
        match result {
            Ok(flows) => {
                self.state.steps += 1;
                self.state.flows += flows as u64;
            }
            Err(error) => self.stopped = Some(error.renumbered(&self.ids)),
        }
    }

    /// Flow and motions together, where contacts have brought the bodies.
    fn step_free(&mut self, bodies: &mut Bodies, kind: &StepKind) -> Result<usize, UnsteadyError> {
        let length = self.unsteady.settings().step;
        let before = self.momenta_of_flow(bodies);
        let arrivals = self.arrivals(bodies, kind, &before);
        let taken = self.unsteady.step_to(&arrivals)?;
        self.take_motions(bodies);
        let after = self.momenta_of_flow(bodies);
        for (number, Arrival { impulse, .. }) in arrivals.iter().enumerate() {
            let (before, after, pull) = (&before[number], &after[number], &mut self.state.pulls[number]);
            let new = Load {
                force: (after.force - before.force - impulse.force) / length,
                torque: (after.torque - before.torque - impulse.torque) / length,
            };
            // Forces stay current: only the pull in them is another now.
            if let Some(index) = bodies.index_of(self.ids[number]) {
                bodies.state.force[index] += new.force - pull.force;
                bodies.state.torque[index] += new.torque - pull.torque;
            }
            *pull = new;
        }
        Ok(taken.flows)
    }

    /// A step past bodies that keep their velocities.
    fn step_given(&mut self, bodies: &mut Bodies) -> Result<usize, UnsteadyError> {
        let taken = self.unsteady.step()?;
        for (id, body) in self.ids.iter().zip(self.unsteady.bodies()) {
            let Some(index) = bodies.index_of(*id) else { continue };
            bodies.state.motion[index].position = body.immersed.position;
            bodies.state.orientation[index] = body.immersed.orientation;
        }
        self.take_motions(bodies);
        Ok(taken.flows)
    }

    /// Where bodies have come to, and the impulses of their contacts: what of their momentum since the last step of the fluid the pull has not changed.
    fn arrivals(&self, bodies: &Bodies, kind: &StepKind, before: &[Load]) -> Vec<Arrival> {
        let (length, later) = (self.unsteady.settings().step, kind.age_of_velocities());
        let of_body = |(number, id): (usize, &u32)| {
            let index = bodies.index_of(*id)?;
            let momentum = bodies.half_step_velocity(index) / bodies.inverse_mass(index) + bodies.force(index) * later;
            let spin = bodies.half_step_angular_momentum(index) + bodies.torque(index) * later;
            let (before, pull) = (&before[number], &self.state.pulls[number]);
            let impulse =
                Load { force: momentum - before.force - pull.force * length, torque: spin - before.torque - pull.torque * length };
            Some(Arrival { position: bodies.position(index), orientation: self.orientation(number, bodies, index), impulse })
        };
        self.ids.iter().enumerate().filter_map(of_body).collect()
    }

    /// That of a body; of a sphere always the same, because whether it is followed in the run depends on who looks at it.
    fn orientation(&self, number: usize, bodies: &Bodies, index: usize) -> Orientation {
        if bodies.shape(index).as_sphere().is_some() {
            self.unsteady.bodies()[number].immersed.orientation
        } else {
            bodies.orientation(index)
        }
    }

    /// Momenta of all bodies in kg m/s and kg m^2/s, with their virtual masses, that the last step of the fluid has left.
    fn momenta_of_flow(&self, bodies: &Bodies) -> Vec<Load> {
        let of_body = |(id, body): (&u32, &Body)| {
            let index = bodies.index_of(*id)?;
            let ImmersedBody { velocity, angular_velocity, orientation, .. } = &body.immersed;
            let torque = angular_momentum(orientation, angular_velocity, &bodies.inertia(index));
            Some(Load { force: velocity / bodies.inverse_mass(index), torque })
        };
        self.ids.iter().zip(self.unsteady.bodies()).filter_map(of_body).collect()
    }

    /// Gives bodies the motions that the flow has found.
    fn take_motions(&self, bodies: &mut Bodies) {
        for (id, body) in self.ids.iter().zip(self.unsteady.bodies()) {
            let Some(index) = bodies.index_of(*id) else { continue };
            bodies.set_velocities(index, body.immersed.velocity, body.immersed.angular_velocity);
        }
    }

    /// Whether it moves any body.
    pub(crate) fn moves_bodies(&self) -> bool {
        self.are_free && !self.ids.is_empty()
    }

    /// The flow.
    pub(crate) fn flow(&self) -> &Unsteady {
        &self.unsteady
    }

    /// Force and torque of the fluid on a body, without the hydrostatic part; nothing for a body that is not in it.
    pub(crate) fn load(&self, id: u32) -> Load {
        self.ids.binary_search(&id).map_or(Load::default(), |number| self.unsteady.fluid_load(number))
    }

    /// Mean pressure gradient in Pa/m, besides the hydrostatic one.
    pub(crate) fn mean_pressure_gradient(&self) -> Vector {
        match self.unsteady.settings().driving {
            Driving::Force(force) => -force,
            // A mean that stays takes as much force as bodies and walls take from it.
            Driving::MeanVelocity(_) => self.unsteady.force_densities().mean(),
        }
    }

    /// Pressure in Pa, without the hydrostatic one.
    pub(crate) fn pressure(&self) -> Vec<f64> {
        let mut forces = self.unsteady.force_densities();
        let excess = forces.mean() - self.mean_pressure_gradient();
        forces
            .component
            .iter_mut()
            .enumerate()
            .flat_map(|(component, values)| values.iter_mut().map(move |value| (component, value)))
            .for_each(|(component, value)| *value -= excess[component]);
        pressure(self.unsteady.flow(), &forces)
    }

    /// What was left out and how often the rest has worked.
    pub(crate) fn describe(&self, ledger: &mut Ledger) {
        let grid = self.unsteady.flow().grid();
        let [i, j, k] = grid.cells();
        let inertia = if self.unsteady.settings().advection { "with its inertia" } else { "creeping" };
        let kind = format!("{i} x {j} x {k} cells of {} m, {inertia}, steps of {} s", grid.spacing(), self.unsteady.settings().step);
        ledger.used("fluid", kind, [("fluid_steps", self.state.steps), ("flows", self.state.flows)]);
        if !self.ids.is_empty() {
            let continued = self.unsteady.ghosts().continued();
            let ghosts = continued.quadratic + continued.linear + continued.direct;
            let narrow = continued.linear + continued.direct;
            let motion = if self.are_free { "free bodies" } else { "bodies of given motion" };
            let remark = format!("{motion}, {ghosts} conditions at their surfaces, {narrow} of them in gaps too narrow for second order");
            ledger.used("resolved coupling", remark, []);
        }
    }

    /// The state of flow and coupling.
    pub(crate) fn save(&self) -> SavedFlow {
        SavedFlow { flow: self.unsteady.state(), coupling: self.state.clone() }
    }

    /// Takes back what [`ResolvedFlow::save`] gave; `None` if it belongs to another flow, or its bodies do not fit the grid.
    pub(crate) fn restore(&mut self, saved: SavedFlow) -> Option<()> {
        let is_restored = saved.coupling.pulls.len() == self.ids.len() && self.unsteady.restore(saved.flow).is_ok_and(|fits| fits);
        self.state = is_restored.then_some(saved.coupling)?;
        Some(())
    }
}
