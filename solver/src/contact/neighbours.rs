//! From bodies that are near each other to the candidate pairs of every contact stage.
//!
//! Bodies fall into classes by what contacts tell apart: material and kind of shape. A table, made once, says for two classes which stage and which of its
//! laws they touch by, so that a new list costs one look-up a pair.

use super::pairs::Candidate;
use super::stage::ContactStage;
use crate::boundary::Plane;
use crate::broad_phase::neighbour_list::ListState;
use crate::broad_phase::{NearPair, NeighbourList, all_pairs};
use crate::{Bodies, Vector};

/// The stage and the laws within it by which two classes touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Assignment {
    /// Index of the stage.
    pub stage: usize,
    /// Index of the laws among those of the stage.
    pub laws: usize,
}

/// What touches what, and how.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pairing {
    /// Class of each shape of each material: shapes vary fastest. Bodies of one shape may have different moments of inertia; those with equal ones come in
    /// the second half of the table.
    class_of: Vec<u16>,
    shapes: usize,
    materials: usize,
    classes: usize,
    walls: usize,
    between: Vec<Option<Assignment>>,
    at_walls: Vec<Option<Assignment>>,
}

impl Pairing {
    /// Nothing touches yet.
    pub fn new(shapes: usize, materials: usize, classes: usize, walls: usize) -> Pairing {
        Pairing {
            class_of: vec![0; 2 * shapes * materials],
            shapes,
            materials,
            classes,
            walls,
            between: vec![None; classes * classes],
            at_walls: vec![None; classes * walls],
        }
    }

    fn entry(&self, bodies: &Bodies, index: usize) -> usize {
        let half = usize::from(bodies.is_isotropic(index)) * self.materials;
        (half + bodies.material(index)) * self.shapes + bodies.shape_index(index)
    }

    /// Says which class a body, and all that are alike, is of.
    pub fn set_class(&mut self, bodies: &Bodies, index: usize, class: usize) {
        let entry = self.entry(bodies, index);
        self.class_of[entry] = class as u16;
    }

    /// Lets two classes touch.
    pub fn set_between(&mut self, one: usize, other: usize, assignment: Assignment) {
        self.between[one * self.classes + other] = Some(assignment);
        self.between[other * self.classes + one] = Some(assignment);
    }

    /// Lets a class touch a wall.
    pub fn set_at_wall(&mut self, class: usize, wall: usize, assignment: Assignment) {
        self.at_walls[class * self.walls + wall] = Some(assignment);
    }

    /// How two classes touch.
    pub fn between(&self, one: usize, other: usize) -> Option<Assignment> {
        self.between[one * self.classes + other]
    }

    /// How a class touches a wall.
    pub fn at_wall(&self, class: usize, wall: usize) -> Option<Assignment> {
        self.at_walls[class * self.walls + wall]
    }

    fn classes_of(&self, bodies: &Bodies) -> Vec<usize> {
        (0..bodies.len()).map(|index| usize::from(self.class_of[self.entry(bodies, index)])).collect()
    }
}

/// How near pairs are found.
pub enum Search {
    /// Every pair is a candidate for the whole run.
    AllPairs {
        /// Whether the pairs have been made.
        is_done: bool,
    },
    /// Pairs within a skin.
    List(NeighbourList),
}

/// Keeps the candidates of all stages up to date.
pub struct Neighbours {
    search: Search,
    pairing: Pairing,
    walls: Vec<Plane>,
}

impl Neighbours {
    /// For given walls.
    pub fn new(search: Search, pairing: Pairing, walls: Vec<Plane>) -> Neighbours {
        Neighbours { search, pairing, walls }
    }

    /// The list, if there is one.
    pub(crate) fn list(&self) -> Option<&NeighbourList> {
        match &self.search {
            Search::AllPairs { .. } => None,
            Search::List(list) => Some(list),
        }
    }

    /// Takes note of a step in s during which nothing was faster than a speed in m/s.
    pub(crate) fn note_motion(&mut self, speed: f64, step: f64) {
        if let Search::List(list) = &mut self.search {
            list.note_motion(speed, step);
        }
    }

    /// Gives the stages new candidates if the bodies have moved too far for the last ones. Tells whether bodies have been sorted anew.
    pub(crate) fn update(&mut self, bodies: &mut Bodies, stages: &mut [Box<dyn ContactStage>]) -> bool {
        match &mut self.search {
            Search::AllPairs { is_done: true } => false,
            Search::AllPairs { is_done } => {
                *is_done = true;
                let near = all_pairs(bodies.len());
                self.give_candidates(bodies, near, None, stages);
                false
            }
            Search::List(list) => {
                if !list.is_stale(bodies) {
                    return false;
                }
                let order = list.prepare(bodies);
                let near = list.make(bodies);
                let new_place = order.map(|order| inverse(&order));
                self.give_candidates(bodies, near, new_place.as_deref(), stages);
                new_place.is_some()
            }
        }
    }

    /// The list as a checkpoint keeps it.
    pub(crate) fn state(&self) -> Option<ListState> {
        self.list().map(|list| list.state().clone())
    }

    /// The candidates that a checkpoint's list had.
    pub(crate) fn restore(&mut self, state: Option<ListState>, bodies: &Bodies, stages: &mut [Box<dyn ContactStage>]) {
        if let (Search::List(list), Some(state)) = (&mut self.search, state) {
            let near = list.restore(state, bodies);
            self.give_candidates(bodies, near, None, stages);
        }
    }

    fn give_candidates(&self, bodies: &Bodies, near: Vec<NearPair>, new_place: Option<&[u32]>, stages: &mut [Box<dyn ContactStage>]) {
        let classes = self.pairing.classes_of(bodies);
        let mut of_stages: Vec<Vec<Candidate>> = stages.iter().map(|stage| Vec::with_capacity(stage.candidates().len())).collect();
        let mut near = near.into_iter().peekable();
        for row in 0..bodies.len() {
            while let Some(pair) = near.next_if(|pair| pair.low as usize == row) {
                let other = pair.high as usize;
                let Some(Assignment { stage, laws }) = self.pairing.between(classes[row], classes[other]) else { continue };
                let is_in_order = bodies.id(row) <= bodies.id(other);
                of_stages[stage].push(match is_in_order {
                    true => Candidate::of_bodies(row, other, laws, pair.image),
                    false => Candidate::of_bodies(other, row, laws, pair.image.reversed()),
                });
            }
            for wall in self.walls_near(bodies, row) {
                let Some(Assignment { stage, laws }) = self.pairing.at_wall(classes[row], wall) else { continue };
                of_stages[stage].push(Candidate::at_wall(row, wall, laws));
            }
        }
        for (stage, candidates) in stages.iter_mut().zip(of_stages) {
            stage.set_candidates(bodies, candidates, new_place);
        }
    }

    fn walls_near(&self, bodies: &Bodies, index: usize) -> impl Iterator<Item = usize> {
        let (place, reach): (Vector, f64) = match &self.search {
            Search::AllPairs { .. } => (Vector::zeros(), f64::INFINITY),
            Search::List(list) => (list.reference()[index], bodies.state.motion[index].radius + 0.5 * list.skin()),
        };
        self.walls.iter().enumerate().filter(move |(_, wall)| reach.is_infinite() || wall.height(&place) < reach).map(|(wall, _)| wall)
    }
}

fn inverse(order: &[u32]) -> Vec<u32> {
    let mut places = vec![0; order.len()];
    for (place, old) in order.iter().enumerate() {
        places[*old as usize] = place as u32;
    }
    places
}
