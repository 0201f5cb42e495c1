//! The candidate pairs of a stage with what they remember, in rows that are cut into parts for threads.

use std::ops::Range;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::pairs::{Candidate, carry_over, restore_memory, save_memory};
use super::stage::Work;
use super::sweep::{PairLaw, Rows, Sums};
use crate::relocation::Relocation;
use crate::{Bodies, Vector, parallel};

/// Candidates that are worth a thread of their own.
const CANDIDATES_OF_A_PART: usize = 2000;

/// Candidates by rank, and what each of them remembers.
///
/// A law that remembers touching pairs alone looks at blocks of pairs. Each block has room for what all of its pairs remember, and those that are
/// remembered come first: so what is in use lies together. With blocks of one pair every candidate has its own place.
pub(super) struct PairRows<Memory> {
    candidates: Vec<Candidate>,
    memory: Vec<Memory>,
    block: usize,
    parts: Vec<Part<Memory>>,
}

/// What one thread works on.
struct Part<Memory> {
    /// Bodies whose rows these are.
    bodies: Range<usize>,
    candidates: Range<usize>,
    /// Pairs in rows of earlier parts with a body of this one, in their order.
    copies: Vec<Candidate>,
    memory_of_copies: Vec<Memory>,
}

/// A part at work: its own piece of all arrays that it changes.
struct Worker<'a, Memory> {
    copies: Rows<'a, Memory>,
    own: Rows<'a, Memory>,
    sums: Sums<'a>,
}

impl<Memory: Clone + Default + Send> PairRows<Memory> {
    /// None yet.
    pub(super) fn new(block: usize) -> PairRows<Memory> {
        PairRows { candidates: Vec::new(), memory: Vec::new(), block, parts: Vec::new() }
    }

    /// All of them.
    pub(super) fn candidates(&self) -> &[Candidate] {
        &self.candidates
    }

    /// Each with what it remembers, if there is anything.
    pub(super) fn pairs(&self) -> impl Iterator<Item = (&Candidate, Option<&Memory>)> {
        let slots = self.slots();
        self.candidates.iter().zip(slots).map(|(candidate, slot)| (candidate, candidate.is_remembered.then(|| &self.memory[slot])))
    }

    /// Where the memory of each candidate is; of no meaning for those that are not remembered.
    fn slots(&self) -> Vec<usize> {
        let mut slots = Vec::with_capacity(self.candidates.len());
        for part in &self.parts {
            slots.extend(slots_of(&self.candidates[part.candidates.clone()], self.block).map(|slot| part.candidates.start + slot));
        }
        slots
    }

    /// What each candidate remembers.
    fn memory_of_candidates(&self) -> Vec<Memory> {
        self.pairs().map(|(_, memory)| memory.cloned().unwrap_or_default()).collect()
    }

    /// Takes new pairs, by rank; those that were there before keep their memory. `moved` tells where bodies are stored that were stored elsewhere.
    pub(super) fn set_candidates(&mut self, bodies: &Bodies, mut candidates: Vec<Candidate>, moved: Option<&Relocation>) {
        let slots = self.slots();
        let remembered = |(slot, candidate): (usize, &Candidate)| {
            if candidate.is_remembered { std::mem::take(&mut self.memory[slot]) } else { Memory::default() }
        };
        let memory = slots.into_iter().zip(&self.candidates).map(remembered).collect();
        let memory = carry_over(&self.candidates, memory, &mut candidates, moved);
        let wanted = parallel::threads().min(candidates.len() / CANDIDATES_OF_A_PART).max(1);
        self.candidates = candidates;
        self.cut(memory, bodies.len(), wanted);
    }

    /// Cuts the rows into at most so many parts of about as many candidates each.
    fn cut(&mut self, memory: Vec<Memory>, bodies: usize, wanted: usize) {
        let candidates = &self.candidates;
        let mut parts: Vec<Part<Memory>> = Vec::with_capacity(wanted);
        let (mut first_body, mut first_candidate) = (0, 0);
        for part in 1..=wanted {
            let aim = candidates.len() * part / wanted;
            let end_body = if part == wanted { bodies } else { candidates.get(aim).map_or(bodies, Candidate::row) };
            let end = candidates.partition_point(|candidate| candidate.row() < end_body);
            let bodies = first_body..end_body;
            let reaches_here = |place: &usize| candidates[*place].second_body().is_some_and(|_| bodies.contains(&candidates[*place].end()));
            let from_before: Vec<usize> = (0..first_candidate).filter(reaches_here).collect();
            let copies: Vec<Candidate> = from_before.iter().map(|place| candidates[*place]).collect();
            let memory_of_copies = packed(&copies, from_before.iter().map(|place| memory[*place].clone()), self.block);
            parts.push(Part { bodies, candidates: first_candidate..end, copies, memory_of_copies });
            (first_body, first_candidate) = (end_body, end);
        }
        let mut memory = memory.into_iter();
        let of_parts = parts.iter().map(|part| &candidates[part.candidates.clone()]);
        let packed_parts = of_parts.flat_map(|own| packed(own, memory.by_ref().take(own.len()), self.block));
        self.memory = packed_parts.collect();
        self.parts = parts;
    }

    /// Adds the forces of all candidates to the bodies; returns the work done, in which pairs of two parts count once.
    pub(super) fn add_forces<Law: PairLaw<Memory = Memory>>(&mut self, law: &Law, bodies: &mut Bodies) -> Work {
        let mut force = std::mem::take(&mut bodies.state.force);
        let mut torque = std::mem::take(&mut bodies.state.torque);
        let all_bodies = &*bodies;
        let mut workers = self.workers::<Law>(&mut force, &mut torque);
        let works = parallel::map(&mut workers, |_, worker| {
            law.evaluate(all_bodies, &mut worker.copies, &mut worker.sums);
            law.evaluate(all_bodies, &mut worker.own, &mut worker.sums)
        });
        (bodies.state.force, bodies.state.torque) = (force, torque);
        works.iter().fold(Work::default(), |sum, work| sum.plus(work))
    }

    fn workers<'a, Law: PairLaw>(&'a mut self, force: &'a mut [Vector], torque: &'a mut [Vector]) -> Vec<Worker<'a, Memory>> {
        let (mut candidates, mut memory) = (self.candidates.as_mut_slice(), self.memory.as_mut_slice());
        let (mut forces, mut torques) = (force, torque);
        let mut workers = Vec::with_capacity(self.parts.len());
        for part in &mut self.parts {
            let (own_candidates, own_memory, own_forces, own_torques);
            (own_candidates, candidates) = candidates.split_at_mut(part.candidates.len());
            (own_memory, memory) = memory.split_at_mut(part.candidates.len());
            (own_forces, forces) = forces.split_at_mut(part.bodies.len());
            (own_torques, torques) = torques.split_at_mut(part.bodies.len());
            workers.push(Worker {
                copies: Rows { candidates: &mut part.copies, memory: &mut part.memory_of_copies },
                own: Rows { candidates: own_candidates, memory: own_memory },
                sums: Sums { start: part.bodies.start, turns: Law::TURNS, force: own_forces, torque: own_torques },
            });
        }
        workers
    }
}

impl<Memory: Clone + Default + Send + Serialize + DeserializeOwned> PairRows<Memory> {
    /// Memory that is in use, and the work so far, as a checkpoint keeps them.
    pub(super) fn save(&self, bodies: &Bodies, work: Work) -> Result<serde_json::Value, serde_json::Error> {
        save_memory(bodies, &self.candidates, &self.memory_of_candidates(), work)
    }

    /// Takes back what [`PairRows::save`] gave; returns the work.
    pub(super) fn restore(&mut self, bodies: &Bodies, saved: serde_json::Value) -> Result<Work, serde_json::Error> {
        let mut memory = vec![Memory::default(); self.candidates.len()];
        let work = restore_memory(bodies, &mut self.candidates, &mut memory, saved)?;
        self.cut(memory, bodies.len(), self.parts.len().max(1));
        Ok(work)
    }
}

/// Places in their packed memory of candidates in blocks.
fn slots_of(candidates: &[Candidate], block: usize) -> impl Iterator<Item = usize> {
    candidates.chunks(block).enumerate().flat_map(move |(number, candidates)| {
        let mut next = number * block;
        candidates.iter().map(move |candidate| {
            let slot = next;
            next += usize::from(candidate.is_remembered);
            slot
        })
    })
}

/// Packs what candidates remember.
fn packed<Memory: Default>(candidates: &[Candidate], memory: impl Iterator<Item = Memory>, block: usize) -> Vec<Memory> {
    let mut packed = Vec::new();
    packed.resize_with(candidates.len(), Memory::default);
    for ((candidate, slot), memory) in candidates.iter().zip(slots_of(candidates, block)).zip(memory) {
        if candidate.is_remembered {
            packed[slot] = memory;
        }
    }
    packed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Image;

    /// Rows of a chain of bodies, each near the two stored after it; every third is remembered, and remembers its place.
    fn chain(bodies: usize, parts: usize, block: usize) -> PairRows<usize> {
        let near = |row: usize| (row + 1..bodies.min(row + 3)).map(move |other| Candidate::of_bodies(row, other, 0, Image::SAME));
        let mut rows = PairRows::new(block);
        rows.candidates = (0..bodies).flat_map(|row| near(row).chain([Candidate::at_wall(row, 0, 0)])).collect();
        rows.candidates.iter_mut().step_by(3).for_each(|candidate| candidate.is_remembered = true);
        rows.cut((0..rows.candidates.len()).collect(), bodies, parts);
        rows
    }

    #[test]
    fn parts_hold_every_row_once_and_a_copy_of_each_pair_that_comes_in() {
        for wanted in [1, 2, 3, 7, 49] {
            let rows = chain(50, wanted, 8);
            assert_eq!(rows.parts.iter().map(|part| part.bodies.len()).sum::<usize>(), 50);
            assert_eq!(rows.parts.iter().map(|part| part.candidates.len()).sum::<usize>(), rows.candidates.len());
            for part in &rows.parts {
                assert!(rows.candidates[part.candidates.clone()].iter().all(|candidate| part.bodies.contains(&candidate.row())));
                let comes_in = |candidate: &&Candidate| {
                    !part.bodies.contains(&candidate.row()) && candidate.bodies().any(|body| part.bodies.contains(&body))
                };
                let wanted: Vec<Candidate> = rows.candidates.iter().filter(comes_in).copied().collect();
                assert_eq!(part.copies, wanted);
            }
        }
    }

    #[test]
    fn memory_is_packed_by_blocks_and_found_again() {
        for (parts, block) in [(1, 1), (1, 8), (3, 8), (3, 128)] {
            let rows = chain(50, parts, block);
            for (place, (_, memory)) in rows.pairs().enumerate() {
                assert_eq!(memory.copied(), (place % 3 == 0).then_some(place));
            }
            for part in &rows.parts {
                for (candidate, slot) in part.copies.iter().zip(slots_of(&part.copies, block)).filter(|(copy, _)| copy.is_remembered) {
                    assert_eq!(rows.candidates[part.memory_of_copies[slot]], *candidate);
                }
            }
        }
        // Two blocks of four: those that are remembered come first in each.
        let rows = chain(4, 1, 4);
        assert_eq!(rows.candidates.len(), 9);
        assert_eq!(rows.memory, [0, 3, 0, 0, 6, 0, 0, 0, 0]);
    }
}
