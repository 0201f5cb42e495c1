//! One step of a granular scene: contacts, then motion (R section 2.4).

use crate::contact::law::StepKind;
use crate::contact::stage::ContactStage;
use crate::motion::leapfrog;
use crate::motion::rotation::RotationStage;
use crate::scheme::hard::HardStage;
use crate::{Bodies, Vector};

/// The stages that a scene needs. What it does not need is not here.
pub(crate) struct Stages {
    pub(crate) contacts: Vec<Box<dyn ContactStage>>,
    pub(crate) gravity: Option<Vector>,
    pub(crate) rotation: Vec<Box<dyn RotationStage>>,
    /// Takes the place of all others if bodies are hard.
    pub(crate) hard: Option<HardStage>,
}

impl Stages {
    /// Forces and torques at the time of the positions.
    pub(crate) fn evaluate_forces(&mut self, bodies: &mut Bodies, kind: &StepKind) {
        if self.contacts.is_empty() {
            return;
        }
        bodies.motion.force.fill(Vector::zeros());
        if !self.rotation.is_empty() {
            bodies.motion.torque.fill(Vector::zeros());
        }
        for contacts in &mut self.contacts {
            contacts.add_forces(bodies, kind);
        }
    }

    /// Velocities and positions to the next step, under the forces just evaluated.
    pub(crate) fn advance(&mut self, bodies: &mut Bodies, kind: &StepKind) {
        leapfrog::move_centres(bodies, self.gravity, kind.step, kind.synchronous);
        for rotation in &mut self.rotation {
            rotation.turn(bodies, kind.step, kind.synchronous);
        }
    }
}
