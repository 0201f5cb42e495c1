//! One step of a granular scene: neighbours if they are due, contacts, then motion (R section 2.4).

use crate::contact::law::StepKind;
use crate::contact::neighbours::Neighbours;
use crate::contact::stage::ContactStage;
use crate::motion::leapfrog;
use crate::motion::rotation::RotationStage;
use crate::relocation::Relocation;
use crate::scheme::hard::HardStage;
use crate::scheme::resolved::ResolvedFlow;
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
    /// Absent without a fluid. It brings its own gravity.
    pub(crate) flow: Option<ResolvedFlow>,
}

impl Stages {
    /// Forces and torques at the time of the positions, in s.
    pub(crate) fn evaluate_forces(&mut self, bodies: &mut Bodies, kind: &StepKind, time: f64) {
        if self.neighbours.is_none() && self.flow.is_none() {
            return;
        }
        self.update_neighbours(bodies, time);
        bodies.state.clear_forces(!self.rotation.is_empty());
        for contacts in &mut self.contacts {
            contacts.set_time(time);
            contacts.add_forces(bodies, kind);
        }
        if let Some(flow) = &self.flow {
            flow.add_pulls(bodies);
        }
    }

    /// Looks whether neighbours are due at a time in s.
    pub(crate) fn update_neighbours(&mut self, bodies: &mut Bodies, time: f64) {
        if self.neighbours.as_mut().is_some_and(|neighbours| neighbours.update(bodies, &mut self.contacts, time)) {
            self.find_bodies_that_turn(bodies);
        }
    }

    /// Takes note at a time in s that bodies have come or gone; `moved` tells where those that stayed are stored.
    pub(crate) fn take_new_bodies(&mut self, bodies: &mut Bodies, moved: Relocation, time: f64) {
        if let Some(neighbours) = &mut self.neighbours {
            if moved.stayed() == bodies.len() {
                neighbours.forget_gone(bodies, &mut self.contacts, &moved);
            } else {
                neighbours.renew(bodies, &mut self.contacts, time, Some(moved));
            }
        }
        self.find_bodies_that_turn(bodies);
    }

    /// Lets the stages of rotation find their bodies, which have been stored elsewhere.
    pub(crate) fn find_bodies_that_turn(&mut self, bodies: &Bodies) {
        self.rotation.iter_mut().for_each(|rotation| rotation.find_members(bodies));
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
