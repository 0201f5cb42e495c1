//! Pairs that may touch: who, by which laws, across which side of a periodic box; and their names that outlive every sorting.

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::stage::Work;
use crate::Bodies;
use crate::domain::Image;
use crate::relocation::Relocation;

/// A body and what it may touch.
///
/// The first body is the one with the lower id, wherever the two are stored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    first: u32,
    second: PackedPartner,
    /// Index of the laws between them.
    laws: u16,
    /// Whether there is something to remember of it.
    pub(super) is_remembered: bool,
    /// Where the second body is seen from the first in a periodic box.
    pub image: Image,
}

/// The second side of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Partner {
    /// A body, by storage index.
    Body(usize),
    /// A wall, by index.
    Wall(usize),
}

/// A partner in four bytes: walls have the highest bit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct PackedPartner(u32);

const IS_WALL: u32 = 1 << 31;

impl Candidate {
    /// Two bodies, by storage index, the one with the lower id first.
    pub fn of_bodies(first: usize, second: usize, laws: usize, image: Image) -> Candidate {
        Candidate { first: first as u32, second: PackedPartner(second as u32), laws: laws as u16, is_remembered: false, image }
    }

    /// A body, by storage index, and a wall.
    pub fn at_wall(first: usize, wall: usize, laws: usize) -> Candidate {
        Candidate {
            first: first as u32,
            second: PackedPartner(wall as u32 | IS_WALL),
            laws: laws as u16,
            is_remembered: false,
            image: Image::SAME,
        }
    }

    /// Storage index of the first body.
    #[inline]
    pub fn first(&self) -> usize {
        self.first as usize
    }

    /// The other side.
    #[inline]
    pub fn second(&self) -> Partner {
        if self.second.0 & IS_WALL == 0 {
            Partner::Body(self.second.0 as usize)
        } else {
            Partner::Wall((self.second.0 & !IS_WALL) as usize)
        }
    }

    /// Index of the laws between them.
    #[inline]
    pub fn laws(&self) -> usize {
        usize::from(self.laws)
    }

    /// The second body, if it is one.
    #[inline]
    pub fn second_body(&self) -> Option<usize> {
        match self.second() {
            Partner::Body(second) => Some(second),
            Partner::Wall(_) => None,
        }
    }

    /// Its bodies, by storage index.
    pub fn bodies(&self) -> impl Iterator<Item = usize> + use<> {
        std::iter::once(self.first()).chain(self.second_body())
    }

    /// The place in storage order in which forces are added up: the body that is stored first, bodies before walls, the other body, its image as the body of the row sees it.
    #[inline]
    pub fn rank(&self) -> (u32, u32, Image) {
        match self.second() {
            Partner::Body(second) if second < self.first() => (second as u32, self.first, self.image.reversed()),
            Partner::Body(second) => (self.first, second as u32, self.image),
            Partner::Wall(_) => (self.first, self.second.0, self.image),
        }
    }

    /// The body that is stored first: whose row of candidates this one is in.
    #[inline]
    pub fn row(&self) -> usize {
        match self.second() {
            Partner::Body(second) => self.first().min(second),
            Partner::Wall(_) => self.first(),
        }
    }

    /// The body that is stored last; at a wall, the only one.
    #[inline]
    pub(super) fn end(&self) -> usize {
        self.second_body().map_or(self.first(), |second| second.max(self.first()))
    }

    /// The candidate after its bodies have been stored elsewhere; `None` if one of them is gone.
    pub(super) fn moved(&self, moved: &Relocation) -> Option<Candidate> {
        let first = moved.place(self.first())?;
        Some(match self.second() {
            Partner::Body(second) => Candidate { first, second: PackedPartner(moved.place(second)?), ..*self },
            Partner::Wall(_) => Candidate { first, ..*self },
        })
    }

    /// Name that outlives any sorting.
    fn key(&self, bodies: &Bodies) -> ContactKey {
        let first = bodies.id(self.first());
        match self.second() {
            Partner::Body(second) => (false, first, bodies.id(second), self.image),
            Partner::Wall(wall) => (true, first, wall as u32, self.image),
        }
    }
}

/// Name of a contact: whether the partner is a wall, id of the first body, id or index of the partner, image.
type ContactKey = (bool, u32, u32, Image);

/// The memory of new candidates: that of the old ones, as far as they are the same pairs. `moved` tells where bodies are stored now that were stored
/// elsewhere when the old candidates were made; what is remembered of those that are gone is dropped.
pub(super) fn carry_over<Memory: Default>(
    old: &[Candidate],
    memory: Vec<Memory>,
    new: &mut [Candidate],
    moved: Option<&Relocation>,
) -> Vec<Memory> {
    let remembered = old.iter().zip(memory).filter(|(candidate, _)| candidate.is_remembered);
    let place = |candidate: &Candidate| moved.map_or(Some(*candidate), |moved| candidate.moved(moved));
    let mut old: Vec<_> = remembered.filter_map(|(candidate, memory)| Some((place(candidate)?, memory))).collect();
    if !old.is_sorted_by_key(|(candidate, _)| candidate.rank()) {
        old.sort_by_key(|(candidate, _)| candidate.rank());
    }
    let mut carried = Vec::with_capacity(new.len());
    let mut remaining = old.into_iter().peekable();
    for candidate in new {
        let rank = candidate.rank();
        while remaining.next_if(|(known, _)| known.rank() < rank).is_some() {}
        let known = remaining.next_if(|(known, _)| known.rank() == rank);
        candidate.is_remembered = known.is_some();
        carried.push(known.map_or_else(Memory::default, |(_, memory)| memory));
    }
    carried
}

/// Contact memory that is in use, and the work so far, as a checkpoint keeps them.
pub(super) fn save_memory<Memory: Serialize>(
    bodies: &Bodies,
    candidates: &[Candidate],
    memory: &[Memory],
    work: Work,
) -> Result<serde_json::Value, serde_json::Error> {
    let used = candidates.iter().zip(memory).filter(|(candidate, _)| candidate.is_remembered);
    let remembered: Vec<_> = used.map(|(candidate, memory)| (candidate.key(bodies), memory)).collect();
    serde_json::to_value((remembered, work))
}

/// Takes back what [`save_memory`] gave; returns the work.
pub(super) fn restore_memory<Memory: DeserializeOwned + Default>(
    bodies: &Bodies,
    candidates: &mut [Candidate],
    memory: &mut [Memory],
    saved: serde_json::Value,
) -> Result<Work, serde_json::Error> {
    let (remembered, work): (Vec<(ContactKey, Memory)>, Work) = serde_json::from_value(saved)?;
    let place_of = |key: &ContactKey| {
        let (is_wall, first, second, image) = *key;
        let first = bodies.index_of(first)?;
        let wanted = if is_wall {
            Candidate::at_wall(first, second as usize, 0)
        } else {
            Candidate::of_bodies(first, bodies.index_of(second)?, 0, image)
        };
        candidates.binary_search_by_key(&wanted.rank(), Candidate::rank).ok()
    };
    let mut placed = Vec::with_capacity(remembered.len());
    for (key, remembered) in remembered {
        let message = || serde::de::Error::custom(format!("the checkpoint remembers a contact that cannot be: {key:?}"));
        placed.push((place_of(&key).ok_or_else(message)?, remembered));
    }
    candidates.iter_mut().for_each(|candidate| candidate.is_remembered = false);
    memory.fill_with(Memory::default);
    for (place, remembered) in placed {
        (memory[place], candidates[place].is_remembered) = (remembered, true);
    }
    Ok(work)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_candidate_is_small_and_gives_back_what_it_was_made_of() {
        assert_eq!(size_of::<Candidate>(), 12);
        let wall = Candidate::at_wall(7, 3, 2);
        assert_eq!((wall.first(), wall.second(), wall.laws(), wall.row()), (7, Partner::Wall(3), 2, 7));
        let pair = Candidate::of_bodies(9, 4, 1, Image::SAME);
        assert_eq!((pair.first(), pair.second(), pair.row()), (9, Partner::Body(4), 4));
        assert!(pair.rank() < wall.rank() && Candidate::of_bodies(7, 1000, 0, Image::SAME).rank() > pair.rank());
    }

    /// Bodies come before walls in a row, whatever their numbers.
    #[test]
    fn memory_follows_its_pair_through_new_lists_and_sorting() {
        let same = Image::SAME;
        let mut old = [
            Candidate::of_bodies(0, 2, 0, same),
            Candidate::at_wall(0, 0, 0),
            Candidate::of_bodies(1, 2, 0, same),
            Candidate::at_wall(1, 0, 0),
        ];
        old[..3].iter_mut().for_each(|candidate| candidate.is_remembered = true);
        let mut new = [
            Candidate::of_bodies(0, 1, 0, same),
            Candidate::of_bodies(2, 0, 0, same),
            Candidate::of_bodies(2, 1, 0, same),
            Candidate::at_wall(2, 0, 0),
        ];
        assert!(new.is_sorted_by_key(Candidate::rank));
        // Bodies 0, 1, 2 are stored at 2, 0, 1 now.
        assert_eq!(carry_over(&old, vec!['a', 'w', 'b', 'x'], &mut new, Some(&Relocation::of_order(&[1, 2, 0], 3))), ['b', '\0', 'a', 'w']);
        assert_eq!(new.map(|candidate| candidate.is_remembered), [true, false, true, true]);
    }

    /// Body 1 goes: what was remembered of it is dropped, and nobody else takes it.
    #[test]
    fn memory_of_bodies_that_are_gone_is_dropped() {
        let same = Image::SAME;
        let mut old = [
            Candidate::of_bodies(0, 1, 0, same),
            Candidate::of_bodies(0, 2, 0, same),
            Candidate::at_wall(1, 0, 0),
            Candidate::at_wall(2, 0, 0),
        ];
        old.iter_mut().for_each(|candidate| candidate.is_remembered = true);
        let mut new = [Candidate::of_bodies(0, 1, 0, same), Candidate::at_wall(0, 0, 0), Candidate::at_wall(1, 0, 0)];
        assert_eq!(carry_over(&old, vec!['a', 'b', 'c', 'd'], &mut new, Some(&Relocation::of_order(&[0, 2], 3))), ['b', '\0', 'd']);
    }
}
