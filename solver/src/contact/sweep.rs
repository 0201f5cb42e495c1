//! One pass over the candidate pairs of a stage: forces in a fixed order, on any number of threads.
//!
//! Pairs are in rows by the body that is stored first. For each body the sum runs over the partners stored before it, then over its own row, then
//! over its walls. Rows are cut into parts for threads, each of which adds up the forces on its own bodies alone. A pair between two parts is evaluated in
//! both, with a memory in each that stays the same in both: so nobody waits for anybody, and the sums are the same to the bit for any number of parts.

use super::pairs::Candidate;
use super::stage::Work;
use crate::{Bodies, Vector};

/// What a contact of two bodies, or of a body and a wall, does to them.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct PairForce {
    /// On the first partner in N; the second feels the opposite.
    pub(super) force: Vector,
    /// In N m.
    pub(super) torque_on_first: Vector,
    /// In N m; of no meaning at a wall.
    pub(super) torque_on_second: Vector,
}

impl PairForce {
    /// A force at arms along a normal, from the moment in N of the force at an arm of one metre.
    #[inline(always)]
    pub(super) fn at_arms(force: Vector, moment: Vector, arms: [f64; 2]) -> PairForce {
        PairForce { force, torque_on_first: moment * arms[0], torque_on_second: moment * arms[1] }
    }
}

/// How the forces of pairs follow from their bodies and their memory.
pub(super) trait PairLaw: Sync {
    /// What a pair remembers from step to step.
    type Memory: Send;
    /// Whether there are torques.
    const TURNS: bool;

    /// Adds the forces of those of the pairs that touch, in their order.
    fn evaluate(&self, bodies: &Bodies, rows: &mut Rows<'_, Self::Memory>, sums: &mut Sums<'_>) -> Work;
}

/// Candidates of some rows and what they remember.
pub(super) struct Rows<'a, Memory> {
    pub(super) candidates: &'a mut [Candidate],
    /// As [`PairRows`](super::pair_rows::PairRows) packs it.
    pub(super) memory: &'a mut [Memory],
}

/// Forces and torques of bodies that are stored one after the other.
pub(super) struct Sums<'a> {
    /// Where the first of them is stored.
    pub(super) start: usize,
    pub(super) turns: bool,
    pub(super) force: &'a mut [Vector],
    pub(super) torque: &'a mut [Vector],
}

impl Sums<'_> {
    /// Adds the force of a pair to those of its bodies that are here.
    #[inline(always)]
    pub(super) fn add(&mut self, candidate: &Candidate, pair: &PairForce) {
        self.add_to(candidate.first(), pair.force, &pair.torque_on_first);
        if let Some(second) = candidate.second_body() {
            self.add_to(second, -pair.force, &pair.torque_on_second);
        }
    }

    #[inline(always)]
    fn add_to(&mut self, body: usize, force: Vector, torque: &Vector) {
        let place = body.wrapping_sub(self.start);
        if let (Some(force_on_body), Some(torque_on_body)) = (self.force.get_mut(place), self.torque.get_mut(place)) {
            *force_on_body += force;
            if self.turns {
                *torque_on_body += torque;
            }
        }
    }
}
