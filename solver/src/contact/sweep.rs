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

    /// Gives the forces of those of the pairs that touch to `found`, in their order.
    fn evaluate(&self, bodies: &Bodies, rows: &mut Rows<'_, Self::Memory>, pairs: &Pairs<'_>, found: &mut Forces<'_, '_>) -> Work;
}

/// Candidates and what they remember.
pub(super) struct Rows<'a, Memory> {
    pub(super) candidates: &'a mut [Candidate],
    pub(super) memory: &'a mut [Memory],
}

/// Pairs that are evaluated one after the other.
pub(super) struct Pairs<'a> {
    /// Their places among the candidates of the part, in increasing order.
    pub(super) places: &'a [u32],
    /// How many pairs of the part come before them, in whatever order.
    pub(super) start: usize,
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

    /// Where a law that remembers touching pairs alone keeps each remembered candidate: pairs are evaluated in blocks of at most so many, each block has
    /// room for all of its pairs, and those that are remembered come first. Of no meaning for the others.
    pub(super) fn slots(&self, candidates: &[Candidate], block: usize) -> Vec<usize> {
        let mut slots = vec![0; candidates.len()];
        for part in &self.parts {
            let start = part.candidates.start;
            for (first_slot, places) in [(start, &part.own), (start + part.own.len(), &part.crossing)] {
                for (number, places) in places.chunks(block).enumerate() {
                    let remembered = places.iter().map(|place| start + *place as usize).filter(|place| candidates[*place].is_remembered);
                    for (slot, place) in (first_slot + number * block..).zip(remembered) {
                        slots[place] = slot;
                    }
                }
            }
        }
        slots
    }
}

/// A part at work: its own piece of all arrays that it changes.
struct Worker<'a, Memory> {
    part: &'a Part,
    rows: Rows<'a, Memory>,
    sums: Sums<'a>,
    work: Work,
}

/// Forces and torques of the bodies of a part.
pub(super) struct Sums<'a> {
    bodies: Range<usize>,
    turns: bool,
    force: &'a mut [Vector],
    torque: &'a mut [Vector],
}

/// Adds the forces of all candidates to the bodies; returns the work done.
pub(super) fn add_pair_forces<Law: PairLaw>(law: &Law, bodies: &mut Bodies, rows: Rows<'_, Law::Memory>, parts: &Parts) -> Work {
    let mut force = std::mem::take(&mut bodies.state.force);
    let mut torque = std::mem::take(&mut bodies.state.torque);
    let work = match parts.parts.as_slice() {
        [part] => {
            let sums = Sums { bodies: part.bodies.clone(), turns: Law::TURNS, force: &mut force, torque: &mut torque };
            let mut alone = Worker { part, rows, sums, work: Work::default() };
            alone.add_own(law, bodies, &[]);
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
        let pairs = Pairs { places: &worker.part.crossing, start: worker.part.own.len() };
        let work = law.evaluate(bodies, &mut worker.rows, &pairs, &mut Forces::Kept(&mut crossing));
        worker.work = worker.work.plus(&work);
        crossing
    });
    crate::parallel::map(workers, |index, worker| {
        for found in crossings[..index].iter().flatten() {
            worker.sums.add_if_here(found);
        }
        worker.add_own(law, bodies, &crossings[index]);
    });
}

impl<Memory> Worker<'_, Memory> {
    /// Adds the rows of the part, with the pairs that leave it at their places.
    fn add_own<Law: PairLaw<Memory = Memory>>(&mut self, law: &Law, bodies: &Bodies, crossings: &[Found]) {
        let mut found = Forces::Added { sums: &mut self.sums, crossings };
        let pairs = Pairs { places: &self.part.own, start: 0 };
        let work = law.evaluate(bodies, &mut self.rows, &pairs, &mut found);
        found.add_crossings_before(u32::MAX);
        self.work = self.work.plus(&work);
    }
}

/// Where the forces of touching pairs go.
pub(super) enum Forces<'a, 'b> {
    /// Into a list, to be added later.
    Kept(&'a mut Vec<Found>),
    /// To the bodies at once, with pairs that leave the part at their places.
    Added { sums: &'a mut Sums<'b>, crossings: &'a [Found] },
}

impl Forces<'_, '_> {
    /// Takes the force of the next touching pair.
    #[inline(always)]
    pub(super) fn push(&mut self, found: &Found) {
        match self {
            Forces::Kept(kept) => kept.push(*found),
            Forces::Added { crossings, .. } => {
                if crossings.first().is_some_and(|crossing| crossing.place < found.place) {
                    self.add_crossings_before(found.place);
                }
                if let Forces::Added { sums, .. } = self {
                    sums.add(found);
                }
            }
        }
    }

    fn add_crossings_before(&mut self, place: u32) {
        let Forces::Added { sums, crossings } = self else { return };
        while let Some((crossing, rest)) = crossings.split_first().filter(|(crossing, _)| crossing.place < place) {
            sums.add_if_here(crossing);
            *crossings = rest;
        }
    }
}

impl Sums<'_> {
    /// Adds the force of a pair to its bodies, which all belong to the part.
    #[inline(always)]
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

    #[inline(always)]
    fn add_to_first(&mut self, first: usize, force: &PairForce) {
        let place = first - self.bodies.start;
        self.force[place] += force.force;
        if self.turns {
            self.torque[place] += force.torque_on_first;
        }
    }

    #[inline(always)]
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
