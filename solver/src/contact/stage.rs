//! What a contact stage is: one contact law over candidate pairs of one kind of shapes, and the types that all stages share.
//!
//! Candidates are in rows by the body that is stored first, bodies before boundaries, and forces are added in that order, whatever the order of bodies in
//! the scene or the number of threads (see `contact/sweep.rs`).

use serde::{Deserialize, Serialize};

use super::law::{LinearSpringDashpot, NoRolling, StepKind};

pub use super::law::TimeScales;
pub use super::pairs::{Candidate, Partner};
use crate::Bodies;
use crate::relocation::Relocation;

/// A contact law at work, whatever its type. What a [`Simulation`](crate::Simulation) holds.
pub trait ContactStage: Send + Sync {
    /// Detects all contacts and adds their forces and torques to the bodies.
    fn add_forces(&mut self, bodies: &mut Bodies, kind: &StepKind);
    /// Puts walls that move where they are at a time in s, the time of the positions.
    fn set_time(&mut self, _time: f64) {}
    /// What the springs hold at the current positions.
    fn observe(&self, bodies: &Bodies) -> Observation;
    /// Laws and shapes, for the ledger.
    fn name(&self) -> String;
    /// Whether contacts turn bodies.
    fn needs_rotation(&self) -> bool;
    /// The pairs of the stage.
    fn candidates(&self) -> &[Candidate];
    /// Takes new pairs, in order of their rank; pairs that were there before keep their memory. `moved` tells where each body is stored now if bodies
    /// have been sorted, or have come or gone, since the last pairs.
    fn set_candidates(&mut self, bodies: &Bodies, candidates: Vec<Candidate>, moved: Option<&Relocation>);
    /// Whether orientations of bodies that look the same to their own inertia matter here.
    fn needs_orientation(&self) -> bool;
    /// Time scales of two bodies, or a body and a wall, from the laws between them, wherever they are.
    fn time_scales(&self, bodies: &Bodies, candidate: &Candidate, lagged_damping: bool) -> TimeScales;
    /// Overlap of a candidate pair in m, if it touches.
    fn overlap(&mut self, bodies: &Bodies, candidate: &Candidate) -> Option<f64>;
    /// Work done since the start.
    fn work(&self) -> Work;
    /// Contact memory and counters, for a checkpoint.
    fn save(&self, bodies: &Bodies) -> Result<serde_json::Value, serde_json::Error>;
    /// Takes back what [`ContactStage::save`] gave.
    fn restore(&mut self, bodies: &Bodies, saved: serde_json::Value) -> Result<(), serde_json::Error>;
}

/// Work counts of a contact stage.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Work {
    /// Pairs tested for overlap.
    pub pair_tests: u64,
    /// Contacts whose force was evaluated.
    pub contacts: u64,
    /// Contacts so deep that their normal is a choice: concentric spheres, overlapping cores.
    pub deep: u64,
    /// Corners looked up in searches for distances.
    pub corners: u64,
}

impl Work {
    /// Both together.
    pub(super) fn plus(&self, other: &Work) -> Work {
        Work {
            pair_tests: self.pair_tests + other.pair_tests,
            contacts: self.contacts + other.contacts,
            deep: self.deep + other.deep,
            corners: self.corners + other.corners,
        }
    }
}

/// What can be seen of the contacts of a stage at one time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Observation {
    /// Touching contacts.
    pub contacts: u64,
    /// Largest overlap in m.
    pub largest_overlap: f64,
    /// Energy stored in normal and tangential springs in J.
    pub elastic_energy: f64,
}

/// A pair of materials and the laws between them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Laws<Tangential, Normal = LinearSpringDashpot, Rolling = NoRolling> {
    /// Normal law.
    pub normal: Normal,
    /// Tangential law.
    pub tangential: Tangential,
    /// Resistance to rolling.
    pub rolling: Rolling,
}
