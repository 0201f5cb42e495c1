//! One pass over the candidate pairs of a stage: forces in a fixed order, on any number of threads.
//!
//! Pairs are in rows by the body that is stored first. For each body the sum runs over the partners stored before it, then over its own row, then
//! over its walls. That order is kept when rows are cut into parts for threads: pairs between two parts are evaluated first and kept, then every part
//! adds up what it was given by the parts before it, its own pairs, and at their places in its rows the kept ones. So the sums are the same to the bit
//! for any number of parts.

use std::ops::Range;

use super::pairs::{Candidate, Partner};
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

/// How the forces of pairs follow from their bodies and their memory.
pub(super) trait PairLaw: Sync {
    /// What a pair remembers from step to step.
    type Memory: Send;
    /// Whether there are torques.
    const TURNS: bool;

    /// Adds the forces of those pairs at given places that touch to `found`, in the same order.
    fn evaluate(&self, bodies: &Bodies, rows: &mut Rows<'_, Self::Memory>, places: &[u32], found: &mut Vec<Found>) -> Work;
}

/// Candidates and what they remember.
pub(super) struct Rows<'a, Memory> {
    pub(super) candidates: &'a mut [Candidate],
    pub(super) memory: &'a mut [Memory],
}

/// A touching pair: its place among the candidates, and the force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Found {
    pub(super) place: u32,
    pub(super) candidate: Candidate,
    pub(super) force: PairForce,
}

/// Candidates that are worth a thread of their own.
const CANDIDATES_OF_A_PART: usize = 2000;

/// How many parts are worth it.
pub(super) fn parts_wanted(candidates: &[Candidate]) -> usize {
    crate::parallel::threads().min(candidates.len() / CANDIDATES_OF_A_PART).max(1)
}

/// Candidates cut into parts of whole rows.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Parts {
    parts: Vec<Part>,
}

#[derive(Debug, Clone, PartialEq)]
struct Part {
    /// Bodies whose rows these are.
    bodies: Range<usize>,
    candidates: Range<usize>,
    /// Places, counted within the part, of pairs both of whose bodies belong to it, or that are at a wall.
    own: Vec<u32>,
    /// Places of pairs whose other body belongs to a later part.
    crossing: Vec<u32>,
}

impl Parts {
    /// At most so many parts of about as many candidates each; candidates are in order of their rank.
    pub(super) fn new(candidates: &[Candidate], bodies: usize, wanted: usize) -> Parts {
        let mut parts = Vec::new();
        let (mut first_body, mut first_candidate) = (0, 0);
        for part in 1..=wanted.max(1) {
            let aim = candidates.len() * part / wanted.max(1);
            let end_body = if part >= wanted { bodies } else { candidates.get(aim).map_or(bodies, Candidate::row) };
            let end = candidates.partition_point(|candidate| candidate.row() < end_body);
            let leaves = |candidate: &Candidate| candidate.second_body().is_some_and(|second| second.max(candidate.first()) >= end_body);
            let places = (0..(end - first_candidate) as u32).collect::<Vec<_>>();
            let (crossing, own) = places.into_iter().partition(|place| leaves(&candidates[first_candidate + *place as usize]));
            parts.push(Part { bodies: first_body..end_body, candidates: first_candidate..end, own, crossing });
            (first_body, first_candidate) = (end_body, end);
        }
        Parts { parts }
    }
}

/// Pairs that are evaluated before their forces are added up: few enough for the nearest cache.
const BLOCK: usize = 256;

/// A part at work: its own piece of all arrays that it changes.
struct Worker<'a, Memory> {
    part: &'a Part,
    rows: Rows<'a, Memory>,
    sums: Sums<'a>,
    work: Work,
}

/// Forces and torques of the bodies of a part.
struct Sums<'a> {
    bodies: Range<usize>,
    turns: bool,
    force: &'a mut [Vector],
    torque: &'a mut [Vector],
}

/// Adds the forces of all candidates to the bodies; returns the work done. `block` is room for a few pairs, kept from step to step.
pub(super) fn add_pair_forces<Law: PairLaw>(
    law: &Law,
    bodies: &mut Bodies,
    rows: Rows<'_, Law::Memory>,
    parts: &Parts,
    block: &mut Vec<Found>,
) -> Work {
    let mut force = std::mem::take(&mut bodies.state.force);
    let mut torque = std::mem::take(&mut bodies.state.torque);
    let work = match parts.parts.as_slice() {
        [part] => {
            let sums = Sums { bodies: part.bodies.clone(), turns: Law::TURNS, force: &mut force, torque: &mut torque };
            let mut alone = Worker { part, rows, sums, work: Work::default() };
            alone.add_own(law, bodies, &[], block);
            alone.work
        }
        several => {
            let mut workers = workers_of::<Law>(several, rows, &mut force, &mut torque);
            add_in_parts(law, bodies, &mut workers);
            workers.iter().fold(Work::default(), |sum, worker| sum.plus(&worker.work))
        }
    };
    (bodies.state.force, bodies.state.torque) = (force, torque);
    work
}

/// One worker a part, each with its own piece of all arrays.
fn workers_of<'a, Law: PairLaw>(
    parts: &'a [Part],
    rows: Rows<'a, Law::Memory>,
    force: &'a mut [Vector],
    torque: &'a mut [Vector],
) -> Vec<Worker<'a, Law::Memory>> {
    let (mut candidates, mut memory, mut forces, mut torques) = (rows.candidates, rows.memory, force, torque);
    let mut workers = Vec::with_capacity(parts.len());
    for part in parts {
        let own_candidates;
        (own_candidates, candidates) = candidates.split_at_mut(part.candidates.len());
        let own_memory;
        (own_memory, memory) = memory.split_at_mut(part.candidates.len());
        let own_forces;
        (own_forces, forces) = forces.split_at_mut(part.bodies.len());
        let own_torques;
        (own_torques, torques) = torques.split_at_mut(part.bodies.len());
        let rows = Rows { candidates: own_candidates, memory: own_memory };
        let sums = Sums { bodies: part.bodies.clone(), turns: Law::TURNS, force: own_forces, torque: own_torques };
        workers.push(Worker { part, rows, sums, work: Work::default() });
    }
    workers
}

fn add_in_parts<Law: PairLaw>(law: &Law, bodies: &Bodies, workers: &mut [Worker<'_, Law::Memory>]) {
    let crossings = crate::parallel::map(workers, |_, worker| {
        let mut crossing = Vec::with_capacity(worker.part.crossing.len());
        worker.evaluate(law, bodies, &worker.part.crossing, &mut crossing);
        crossing
    });
    crate::parallel::map(workers, |index, worker| {
        for found in crossings[..index].iter().flatten() {
            worker.sums.add_if_here(found);
        }
        worker.add_own(law, bodies, &crossings[index], &mut Vec::with_capacity(BLOCK));
    });
}

impl<Memory> Worker<'_, Memory> {
    fn evaluate<Law: PairLaw<Memory = Memory>>(&mut self, law: &Law, bodies: &Bodies, places: &[u32], found: &mut Vec<Found>) {
        let work = law.evaluate(bodies, &mut self.rows, places, found);
        self.work = self.work.plus(&work);
    }

    /// Adds the rows of the part, with the pairs that leave it at their places.
    fn add_own<Law: PairLaw<Memory = Memory>>(&mut self, law: &Law, bodies: &Bodies, crossings: &[Found], block: &mut Vec<Found>) {
        let mut crossings = crossings.iter().peekable();
        for places in self.part.own.chunks(BLOCK) {
            block.clear();
            self.evaluate(law, bodies, places, block);
            for found in &*block {
                while let Some(crossing) = crossings.next_if(|crossing| crossing.place < found.place) {
                    self.sums.add_if_here(crossing);
                }
                self.sums.add(found);
            }
        }
        for crossing in crossings {
            self.sums.add_if_here(crossing);
        }
    }
}

impl Sums<'_> {
    /// Adds the force of a pair to its bodies, which all belong to the part.
    #[inline]
    fn add(&mut self, found: &Found) {
        self.add_to_first(found.candidate.first(), &found.force);
        if let Partner::Body(second) = found.candidate.second() {
            self.add_to_second(second, &found.force);
        }
    }

    /// Adds the force of a pair to the one of its bodies that belongs to the part, if any does.
    fn add_if_here(&mut self, found: &Found) {
        let first = found.candidate.first();
        if self.bodies.contains(&first) {
            self.add_to_first(first, &found.force);
        }
        if let Some(second) = found.candidate.second_body().filter(|second| self.bodies.contains(second)) {
            self.add_to_second(second, &found.force);
        }
    }

    #[inline]
    fn add_to_first(&mut self, first: usize, force: &PairForce) {
        let place = first - self.bodies.start;
        self.force[place] += force.force;
        if self.turns {
            self.torque[place] += force.torque_on_first;
        }
    }

    #[inline]
    fn add_to_second(&mut self, second: usize, force: &PairForce) {
        let place = second - self.bodies.start;
        self.force[place] -= force.force;
        if self.turns {
            self.torque[place] += force.torque_on_second;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Image;

    /// Rows of a chain of bodies, each near the two stored after it.
    fn chain(bodies: usize) -> Vec<Candidate> {
        let near = |row: usize| (row + 1..bodies.min(row + 3)).map(move |other| Candidate::of_bodies(row, other, 0, Image::SAME));
        (0..bodies).flat_map(|row| near(row).chain([Candidate::at_wall(row, 0, 0)])).collect()
    }

    #[test]
    fn parts_hold_every_row_once_and_know_which_pairs_leave_them() {
        let candidates = chain(50);
        for wanted in [1, 2, 3, 7, 49, 200] {
            let Parts { parts } = Parts::new(&candidates, 50, wanted);
            assert_eq!(parts.iter().map(|part| part.bodies.len()).sum::<usize>(), 50);
            assert_eq!(parts.iter().map(|part| part.candidates.len()).sum::<usize>(), candidates.len());
            for part in &parts {
                let mut places: Vec<u32> = part.own.iter().chain(&part.crossing).copied().collect();
                places.sort_unstable();
                assert!(places.into_iter().eq(0..part.candidates.len() as u32));
                for (place, candidate) in candidates[part.candidates.clone()].iter().enumerate() {
                    assert!(part.bodies.contains(&candidate.row()));
                    let leaves = candidate.bodies().any(|body| !part.bodies.contains(&body));
                    assert_eq!(leaves, part.crossing.contains(&(place as u32)));
                }
            }
        }
    }
}
