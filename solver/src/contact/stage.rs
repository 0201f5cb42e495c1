//! What a contact stage is: one contact law over candidate pairs of one kind of shapes, and the types that all stages share.
//!
//! Candidates are in the order of their ids, bodies before boundaries, and forces are added in that order: for each body the sum then
//! runs over its partners by increasing id, whatever the order of bodies in the scene.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::law::{LinearSpringDashpot, NoRolling, StepKind};

pub use super::law::TimeScales;
use crate::Bodies;

/// A contact law at work, whatever its type. What a [`Simulation`](crate::Simulation) holds.
pub trait ContactStage: Send + Sync {
    /// Detects all contacts and adds their forces and torques to the bodies.
    fn add_forces(&mut self, bodies: &mut Bodies, kind: &StepKind);
    /// What the springs hold at the current positions.
    fn observe(&self, bodies: &Bodies) -> Observation;
    /// Laws and shapes, for the ledger.
    fn name(&self) -> String;
    /// Whether contacts turn bodies.
    fn needs_rotation(&self) -> bool;
    /// The pairs of the stage.
    fn candidates(&self) -> &[Candidate];
    /// Whether orientations of bodies that look the same to their own inertia matter here.
    fn needs_orientation(&self) -> bool;
    /// Time scales of a candidate pair, from the laws between them.
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

/// A body and what it may touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// Storage index of the first body.
    pub first: usize,
    /// The other side.
    pub second: Partner,
    /// Index of the laws between them.
    pub laws: usize,
}

/// The second side of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Partner {
    /// A body, by storage index.
    Body(usize),
    /// A wall, by index.
    Wall(usize),
}

impl Candidate {
    /// The second body, if it is one.
    pub fn second_body(&self) -> Option<usize> {
        match self.second {
            Partner::Body(second) => Some(second),
            Partner::Wall(_) => None,
        }
    }

    /// Its bodies, by storage index.
    pub fn bodies(&self) -> impl Iterator<Item = usize> + use<> {
        std::iter::once(self.first).chain(self.second_body())
    }
}

/// Name of a contact that outlives any reordering: whether the partner is a wall, id of the first body, id or index of the partner.
type ContactKey = (bool, u32, u32);

/// The key of a candidate pair.
fn key_of(bodies: &Bodies, candidate: &Candidate) -> ContactKey {
    let first = bodies.id(candidate.first);
    match candidate.second {
        Partner::Body(second) => (false, first, bodies.id(second)),
        Partner::Wall(wall) => (true, first, wall as u32),
    }
}

/// Contact memory that is in use, and the work so far, as a checkpoint keeps them.
pub(super) fn save_memory<Memory: Serialize>(
    bodies: &Bodies,
    candidates: &[Candidate],
    memory: &[Memory],
    is_used: impl Fn(&Memory) -> bool,
    work: Work,
) -> Result<serde_json::Value, serde_json::Error> {
    let used = candidates.iter().zip(memory).filter(|(_, memory)| is_used(memory));
    let remembered: Vec<_> = used.map(|(candidate, memory)| (key_of(bodies, candidate), memory)).collect();
    serde_json::to_value((remembered, work))
}

/// Takes back what [`save_memory`] gave; returns the work.
pub(super) fn restore_memory<Memory: Clone + Default + DeserializeOwned>(
    bodies: &Bodies,
    candidates: &[Candidate],
    memory: &mut [Memory],
    saved: serde_json::Value,
) -> Result<Work, serde_json::Error> {
    let (remembered, work): (Vec<(ContactKey, Memory)>, Work) = serde_json::from_value(saved)?;
    memory.fill(Memory::default());
    for (key, remembered) in remembered {
        let Ok(place) = candidates.binary_search_by_key(&key, |candidate| key_of(bodies, candidate)) else {
            return Err(serde::de::Error::custom(format!("the checkpoint remembers a contact that cannot be: {key:?}")));
        };
        memory[place] = remembered;
    }
    Ok(work)
}
