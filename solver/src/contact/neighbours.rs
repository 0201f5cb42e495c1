//! From bodies that are near each other to the candidate pairs of every contact stage.
//!
//! Bodies fall into classes by what contacts tell apart: material and kind of shape. A table, made once, says for two classes which stage and which of its
//! laws they touch by, so that a new list costs one look-up a pair.

use std::sync::Arc;

use super::pairs::Candidate;
use super::stage::ContactStage;
use crate::Bodies;
use crate::boundary::{MovingWall, PlacedWall, placed};
use crate::broad_phase::neighbour_list::ListState;
use crate::broad_phase::{NearPair, NeighbourList, all_pairs};
use crate::relocation::Relocation;

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
    walls: Arc<[MovingWall]>,
    /// No wall is faster than this, in m/s, where bodies may meet it before the next list.
    speed_of_walls: f64,
}

impl Neighbours {
    /// For given walls.
    pub fn new(search: Search, pairing: Pairing, walls: Arc<[MovingWall]>) -> Neighbours {
        Neighbours { search, pairing, walls, speed_of_walls: 0.0 }
    }

    /// The list, if there is one.
    pub(crate) fn list(&self) -> Option<&NeighbourList> {
        match &self.search {
            Search::AllPairs { .. } => None,
            Search::List(list) => Some(list),
        }
    }

    /// Takes note of a step in s during which no body was faster than a speed in m/s.
    pub(crate) fn note_motion(&mut self, square_of_speed: f64, step: f64) {
        if let Search::List(list) = &mut self.search {
            list.note_motion(square_of_speed.sqrt(), self.speed_of_walls, step);
        }
    }

    /// Gives the stages new candidates if bodies or walls have moved too far for the last ones by a time in s. Tells whether bodies have been sorted anew.
    pub(crate) fn update(&mut self, bodies: &mut Bodies, stages: &mut [Box<dyn ContactStage>], time: f64) -> bool {
        let is_due = match &mut self.search {
            Search::AllPairs { is_done } => !*is_done,
            Search::List(list) => list.is_stale(bodies),
        };
        is_due && self.renew(bodies, stages, time, None)
    }

    /// Gives the stages new candidates at a time in s, because it is time or because bodies have come or gone: `moved` tells where those that stayed are
    /// stored now. Tells whether bodies have been sorted anew.
    pub(crate) fn renew(
        &mut self,
        bodies: &mut Bodies,
        stages: &mut [Box<dyn ContactStage>],
        time: f64,
        moved: Option<Relocation>,
    ) -> bool {
        let (near, order) = match &mut self.search {
            Search::AllPairs { is_done } => {
                *is_done = true;
                (all_pairs(bodies.len()), None)
            }
            Search::List(list) => {
                let order = list.prepare(bodies);
                (list.make(bodies, time), order)
            }
        };
        let sorted = order.map(|order| Relocation::of_order(&order, order.len()));
        let is_sorted = sorted.is_some();
        let moved = match (moved, sorted) {
            (Some(moved), Some(sorted)) => Some(moved.then(&sorted)),
            (moved, sorted) => moved.or(sorted),
        };
        self.give_candidates(bodies, near, moved.as_ref(), stages);
        is_sorted
    }

    /// Drops the pairs of bodies that are gone, when nobody has come: those of the others are as near as they were. `moved` tells where they are stored, in
    /// the order they had.
    pub(crate) fn forget_gone(&mut self, bodies: &Bodies, stages: &mut [Box<dyn ContactStage>], moved: &Relocation) {
        if let Search::List(list) = &mut self.search {
            list.forget_gone(moved);
        }
        for stage in stages {
            let left = stage.candidates().iter().filter_map(|candidate| candidate.moved(moved)).collect();
            stage.set_candidates(bodies, left, Some(moved));
        }
    }

    /// The list as a checkpoint keeps it.
    pub(crate) fn state(&self) -> Option<ListState> {
        self.list().map(|list| list.state().clone())
    }

    /// The candidates that a checkpoint's list had.
    pub(crate) fn restore(&mut self, state: Option<ListState>, bodies: &Bodies, stages: &mut [Box<dyn ContactStage>]) {
        let near = match (&mut self.search, state) {
            (Search::List(list), Some(state)) => list.restore(state, bodies),
            (Search::AllPairs { .. }, None) => all_pairs(bodies.len()),
            _ => return,
        };
        self.give_candidates(bodies, near, None, stages);
    }

    fn give_candidates(&mut self, bodies: &Bodies, near: Vec<NearPair>, moved: Option<&Relocation>, stages: &mut [Box<dyn ContactStage>]) {
        self.speed_of_walls = self.largest_speed_of_walls(bodies);
        let classes = self.pairing.classes_of(bodies);
        let walls = self.walls_of_list();
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
            for (wall, placed) in &walls {
                let Some(Assignment { stage, laws }) = self.pairing.at_wall(classes[row], *wall) else { continue };
                if self.is_near(bodies, row, placed) {
                    of_stages[stage].push(Candidate::at_wall(row, *wall, laws));
                }
            }
        }
        for (stage, candidates) in stages.iter_mut().zip(of_stages) {
            stage.set_candidates(bodies, candidates, moved);
        }
    }

    /// Walls that are not gone by now, by index, where they are when the list is made.
    fn walls_of_list(&self) -> Vec<(usize, PlacedWall<'_>)> {
        let time = self.list().map_or(0.0, NeighbourList::time);
        placed(&self.walls, time).into_iter().enumerate().filter_map(|(index, wall)| Some((index, wall?))).collect()
    }

    /// Whether a body may touch a wall before the next list.
    fn is_near(&self, bodies: &Bodies, index: usize, wall: &PlacedWall<'_>) -> bool {
        match &self.search {
            Search::AllPairs { .. } => true,
            Search::List(list) => wall.distance(&list.reference()[index]) < bodies.state.motion[index].radius + 0.5 * list.skin(),
        }
    }

    /// An upper bound in m/s of the speed of all walls where they may be met before the next list: of walls that turn, as far from the axis as bodies are.
    fn largest_speed_of_walls(&self, bodies: &Bodies) -> f64 {
        let Some(list) = self.list() else { return 0.0 };
        let speed = |wall: &MovingWall| {
            let far = wall.motion.point_of_axis(list.time()).map_or(0.0, |axis| {
                let places = list.reference().iter().zip(&bodies.state.motion);
                // Body and axis come nearer or part by a skin at most.
                places.map(|(place, body)| (place - axis).norm() + body.radius).fold(0.0, f64::max) + 2.0 * list.skin()
            });
            wall.motion.largest_speed(far)
        };
        self.walls.iter().map(speed).fold(0.0, f64::max)
    }
}
