//! One step of a granular scene: neighbours if they are due, contacts, then motion (R section 2.4).

use crate::contact::law::StepKind;
use crate::contact::neighbours::Neighbours;
use crate::contact::stage::ContactStage;
use crate::motion::leapfrog;
use crate::motion::rotation::RotationStage;
use crate::scheme::hard::HardStage;
use crate::{Bodies, Vector};

/// The stages that a scene needs. What it does not need is not here.
pub(crate) struct Stages {
    /// Absent if nothing can touch.
    pub(crate) neighbours: Option<Neighbours>,
    pub(crate) contacts: Vec<Box<dyn ContactStage>>,
    pub(crate) gravity: Option<Vector>,
    pub(crate) rotation: Vec<Box<dyn RotationStage>>,
    /// Takes the place of all others if bodies are hard.
    pub(crate) hard: Option<HardStage>,
}

impl Stages {
    /// Forces and torques at the time of the positions, in s.
    pub(crate) fn evaluate_forces(&mut self, bodies: &mut Bodies, kind: &StepKind, time: f64) {
        let Some(neighbours) = &mut self.neighbours else { return };
        if neighbours.update(bodies, &mut self.contacts, time) {
            for rotation in &mut self.rotation {
                rotation.find_members(bodies);
            }
        }
        bodies.state.force.fill(Vector::zeros());
        if !self.rotation.is_empty() {
            bodies.state.torque.fill(Vector::zeros());
        }
        for contacts in &mut self.contacts {
            contacts.set_time(time);
            contacts.add_forces(bodies, kind);
        }
    }

    /// Velocities and positions to the next step, under the forces just evaluated.
    pub(crate) fn advance(&mut self, bodies: &mut Bodies, kind: &StepKind) {
        let (step, synchronous) = (kind.step, kind.synchronous);
        let square_of_largest_speed = match self.rotation.as_mut_slice() {
            [spins] if spins.kicks_all_spins(bodies) => {
                spins.set_turns(spins.turns() + bodies.len() as u64);
                leapfrog::move_centres_and_spins(bodies, self.gravity, step, synchronous)
            }
            rotation => {
                let largest = leapfrog::move_centres(bodies, self.gravity, step, synchronous);
                rotation.iter_mut().for_each(|rotation| rotation.turn(bodies, step, synchronous));
                largest
            }
        };
        if let Some(neighbours) = &mut self.neighbours {
            neighbours.note_motion(square_of_largest_speed, step);
        }
    }
}
