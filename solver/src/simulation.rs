//! A scene at work: the stages it needs, a clock, and the ledger of what was left out.

use crate::contact::law::StepKind;
use crate::contact::neighbours::Neighbours;
use crate::ledger::Ledger;
use crate::measure::rest::RestWatch;
use crate::openings::{Departure, Openings};
use crate::scheme::granular::Stages;
use crate::scheme::hard::HardStage;
use crate::scheme::resolved::ResolvedFlow;
use crate::{Bodies, Scene, parallel};

/// A resolved scene. Made by [`Scene::build`](crate::build).
pub struct Simulation {
    pub(crate) scene: Scene,
    pub(crate) bodies: Bodies,
    /// Ids of all bodies that are there at any time of the run, by number.
    pub(crate) ids: Vec<u32>,
    /// Names that the scene gives the shapes of the bodies, by their index; spheres of sizes of their own have none.
    pub(crate) shape_names: Vec<Option<String>>,
    pub(crate) stages: Stages,
    /// Absent if bodies neither come nor leave.
    pub(crate) openings: Option<Openings>,
    /// Absent if the run does not end when bodies are at rest.
    pub(crate) rest: Option<RestWatch>,
    pub(crate) kind: StepKind,
    pub(crate) steps_taken: u64,
    /// Steps of all bodies together.
    pub(crate) body_steps: u64,
    /// Forces belong to the current positions.
    pub(crate) forces_are_current: bool,
    /// What should be said of shapes and the time step: entry of the ledger and remark.
    pub(crate) remarks: Vec<(String, String)>,
    /// What the scene does not need, and why; fixed when it is built.
    pub(crate) left_out: Vec<(&'static str, String)>,
}

/// Why a run was stopped by a guard.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RunError {
    /// A position, velocity or spin is no longer a finite number, or its square is not: the run has blown up.
    #[error("body {body} has left the finite numbers at t = {time} s: the run has blown up; take a smaller step")]
    NotFinite {
        /// Id of the body.
        body: u32,
        /// Time in s.
        time: f64,
    },
    /// Hard bodies cannot go on.
    #[error(transparent)]
    Hard(#[from] crate::scheme::hard::Stop),
    /// The flow cannot go on.
    #[error(transparent)]
    Flow(#[from] crate::coupling::resolved::unsteady::UnsteadyError),
    /// A body that should come in found no room for too long.
    #[error(transparent)]
    Waited(#[from] crate::openings::Waited),
}

/// Steps between two looks at whether all positions are finite.
const GUARD_INTERVAL: u64 = 1000;

impl Simulation {
    /// Takes one step.
    pub fn step(&mut self) {
        let start = self.time();
        if let Some(hard) = &mut self.stages.hard {
            hard.step(&mut self.bodies, self.stages.gravity, self.kind.step, start);
        } else {
            self.evaluate_forces();
            self.stages.advance(&mut self.bodies, &self.kind);
            self.kind.synchronous = false;
            self.forces_are_current = false;
        }
        self.steps_taken += 1;
        self.body_steps += self.bodies.len() as u64;
        if self.stages.flow.as_ref().is_some_and(|flow| flow.is_due(self.steps_taken)) {
            self.step_flow();
        }
        self.end_step();
    }

    /// The step of the fluid that ends with the step just taken. The motions that it gives live at the time of the positions.
    fn step_flow(&mut self) {
        self.evaluate_forces();
        if let Some(flow) = &mut self.stages.flow {
            flow.step(&mut self.bodies, &self.kind);
            self.kind.synchronous = true;
        }
    }

    /// Lets bodies pass the openings, and looks whether those that are there have come to rest.
    pub(crate) fn end_step(&mut self) {
        let (time, gravity) = (self.time(), self.stages.gravity.unwrap_or_default());
        if let Some(moved) = self.openings.as_mut().and_then(|openings| openings.pass(&mut self.bodies, &self.kind, gravity, time)) {
            self.stages.take_new_bodies(&mut self.bodies, moved, time);
        }
        if self.rest.as_ref().is_some_and(|rest| rest.is_due(self.steps_taken)) {
            let speed = self.now().root_mean_square_speed();
            let are_all_in = self.openings.as_ref().is_none_or(|openings| openings.still_out() == 0);
            if let Some(rest) = &mut self.rest {
                rest.note(self.steps_taken, speed, are_all_in);
            }
        }
    }

    /// Steps until a time in s is reached, or bodies have settled if the scene asks for it.
    ///
    /// # Errors
    ///
    /// [`RunError`] if a guard stops the run.
    pub fn run_until(&mut self, time: f64) -> Result<(), RunError> {
        parallel::inside(|| self.take_steps_until(time))
    }

    fn take_steps_until(&mut self, time: f64) -> Result<(), RunError> {
        let last = self.steps_to(time);
        while self.steps_taken < last && !self.has_settled() {
            self.step();
            self.stages.hard.as_ref().and_then(HardStage::stopped).map_or(Ok(()), Err)?;
            self.stages.flow.as_ref().and_then(ResolvedFlow::stopped).map_or(Ok(()), |error| Err(error.clone()))?;
            self.openings.as_ref().and_then(Openings::stopped).map_or(Ok(()), |waited| Err(waited.clone()))?;
            if self.steps_taken.is_multiple_of(GUARD_INTERVAL) || self.steps_taken == last {
                self.check_guards()?;
            }
        }
        Ok(())
    }

    /// Whether bodies have come to rest as `scene.settled` asks; never without it.
    pub fn has_settled(&self) -> bool {
        self.rest.as_ref().is_some_and(|rest| rest.has_settled(self.steps_taken))
    }

    /// Bodies that have left, by time.
    pub fn departures(&self) -> &[Departure] {
        self.openings.as_ref().map_or(&[], |openings| &openings.record().departures)
    }

    /// Ids of all bodies that are there at any time of the run, by number.
    pub fn ids(&self) -> &[u32] {
        &self.ids
    }

    /// Steps taken by all bodies together.
    pub fn body_steps(&self) -> u64 {
        self.body_steps
    }

    /// Steps from the start that reach a time in s: the first at or after it, with round-off of the quotient forgiven.
    pub fn steps_to(&self, time: f64) -> u64 {
        let steps = time / self.kind.step;
        (steps - 4.0 * f64::EPSILON * steps.abs()).ceil().max(0.0) as u64
    }

    /// Looks for a blown-up run.
    ///
    /// # Errors
    ///
    /// [`RunError`] if a guard stops the run.
    pub fn check_guards(&self) -> Result<(), RunError> {
        for index in 0..self.bodies.len() {
            let (position, velocity) = (self.bodies.position(index), self.bodies.half_step_velocity(index));
            // The square, because energies are made of it.
            let spin = self.bodies.half_step_angular_velocity(index);
            if !(position.norm_squared() + velocity.norm_squared() + spin.norm_squared()).is_finite() {
                return Err(RunError::NotFinite { body: self.bodies.id(index), time: self.time() });
            }
        }
        Ok(())
    }

    /// Lists neighbours for the first time.
    pub(crate) fn list_neighbours(&mut self) {
        self.stages.update_neighbours(&mut self.bodies, 0.0);
        self.stages.find_bodies_that_turn(&self.bodies);
    }

    /// Brings the forces to the time of the positions, once.
    pub(crate) fn evaluate_forces(&mut self) {
        if !self.forces_are_current {
            let time = self.time();
            self.stages.evaluate_forces(&mut self.bodies, &self.kind, time);
            self.forces_are_current = true;
        }
    }

    /// Current time in s.
    pub fn time(&self) -> f64 {
        self.steps_taken as f64 * self.kind.step
    }

    /// Time step in s.
    pub fn time_step(&self) -> f64 {
        self.kind.step
    }

    /// Steps taken since the start of the run.
    pub fn steps_taken(&self) -> u64 {
        self.steps_taken
    }

    /// The bodies. Positions are current; see [`Bodies`] for the time levels of the rest.
    pub fn bodies(&self) -> &Bodies {
        &self.bodies
    }

    /// The scene it was built from.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What the scene uses and leaves out, with work counts so far.
    pub fn ledger(&self) -> Ledger {
        let mut ledger = Ledger::default();
        for (entry, remark) in &self.remarks {
            ledger.used(entry, remark.clone(), []);
        }
        self.openings.iter().for_each(|openings| openings.describe(&mut ledger));
        if let Some(settled) = &self.scene.scene.settled {
            let reason = format!("root mean square speed below {} m/s for {} s ends the run", settled.speed, settled.hold);
            ledger.used("rest", reason, []);
        }
        for contacts in &self.stages.contacts {
            let work = contacts.work();
            let counts = [("pair_tests", work.pair_tests), ("contacts", work.contacts), ("deep", work.deep), ("corners", work.corners)];
            ledger.used("contacts", contacts.name(), counts);
        }
        if let Some(list) = self.stages.neighbours.as_ref().and_then(Neighbours::list) {
            ledger.used("neighbours", list.name(), [("lists", list.lists())]);
        }
        if self.stages.gravity.is_some() {
            ledger.used("gravity", "uniform", []);
        }
        if let Some(flow) = &self.stages.flow {
            flow.describe(&mut ledger);
            if self.scene.scene.gravity.is_some() && flow.moves_bodies() {
                ledger.used("gravity", "uniform; in the fluid, bodies feel their weight less that of the fluid they displace", []);
            }
        }
        if let Some(hard) = &self.stages.hard {
            hard.describe(self.bodies.len(), self.steps_taken, &mut ledger);
        } else {
            ledger.used("translation", "leapfrog", [("steps", self.steps_taken), ("body_steps", self.body_steps)]);
        }
        for rotation in &self.stages.rotation {
            ledger.used("rotation", rotation.name(), [("turns", rotation.turns())]);
        }
        for (stage, reason) in &self.left_out {
            ledger.left_out(stage, reason.clone());
        }
        ledger
    }
}
