//! Collects contact stages and notes which classes of bodies touch by which of them.

use std::sync::Arc;

use super::SceneWall;
use super::classes::{Class, classes_of};
use crate::Bodies;
use crate::boundary::{MovingWall, Plane};
use crate::contact::neighbours::{Assignment, Pairing};
use crate::contact::pairs::Candidate;
use crate::contact::stage::ContactStage;
use crate::scene::Scene;

/// Two classes that touch, or a class and a wall, by laws of one kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Meeting {
    pub(super) first: usize,
    pub(super) second: Meets,
    pub(super) laws: usize,
}

/// The second side of a meeting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Meets {
    Class(usize),
    Wall(usize),
}

impl Meeting {
    /// Its classes.
    pub(super) fn classes(&self) -> impl Iterator<Item = usize> + use<> {
        let second = match self.second {
            Meets::Class(second) => Some(second),
            Meets::Wall(_) => None,
        };
        std::iter::once(self.first).chain(second)
    }
}

/// Stages in the making.
pub(super) struct StageBuilder {
    pub(super) stages: Vec<Box<dyn ContactStage>>,
    pub(super) classes: Vec<Class>,
    pub(super) pairing: Pairing,
    /// Those at rest that are planes come first, so that a stage of planes numbers them in the same way.
    pub(super) walls: Arc<[MovingWall]>,
    /// Index of the material of each wall.
    materials_of_walls: Vec<usize>,
    is_periodic: bool,
    /// Meetings of every stage.
    meetings: Vec<Vec<Meeting>>,
}

impl StageBuilder {
    pub(super) fn new(scene: &Scene, bodies: &Bodies, walls: &[SceneWall]) -> StageBuilder {
        let (classes, class_of_bodies) = classes_of(bodies);
        let mut pairing = Pairing::new(bodies.shapes().len(), scene.materials.len(), classes.len(), walls.len());
        for (index, class) in class_of_bodies.into_iter().enumerate() {
            pairing.set_class(bodies, index, class);
        }
        let is_periodic = scene.periodic_domain().is_some();
        let materials_of_walls = walls.iter().map(|wall| scene.material_index(&scene.boundaries[wall.boundary].material)).collect();
        let walls = walls.iter().map(|wall| wall.wall.clone()).collect();
        StageBuilder { stages: Vec::new(), classes, pairing, walls, materials_of_walls, is_periodic, meetings: Vec::new() }
    }

    /// What can meet by laws of one kind, whose index is known for two materials.
    pub(super) fn meetings(&self, laws_of: impl Fn(usize, usize) -> Option<usize>) -> Vec<Meeting> {
        let mut found = Vec::new();
        for (first, class) in self.classes.iter().enumerate() {
            for (second, other) in self.classes.iter().enumerate().skip(first) {
                if first != second || class.meets_itself(self.is_periodic) {
                    let laws = laws_of(class.material, other.material);
                    found.extend(laws.map(|laws| Meeting { first, second: Meets::Class(second), laws }));
                }
            }
        }
        for (wall, material) in self.materials_of_walls.iter().copied().enumerate() {
            for (first, class) in self.classes.iter().enumerate() {
                let laws = laws_of(class.material, material);
                found.extend(laws.map(|laws| Meeting { first, second: Meets::Wall(wall), laws }));
            }
        }
        found
    }

    /// Planes at rest, by their index among all walls.
    pub(super) fn planes(&self) -> Vec<Plane> {
        self.walls.iter().map_while(MovingWall::plane_at_rest).cloned().collect()
    }

    /// Whether a meeting is at a wall that is not a plane at rest.
    pub(super) fn is_at_other_wall(&self, meeting: &Meeting) -> bool {
        matches!(meeting.second, Meets::Wall(wall) if self.walls[wall].plane_at_rest().is_none())
    }

    /// Adds a stage by which the given classes meet.
    pub(super) fn add(&mut self, stage: Box<dyn ContactStage>, meetings: &[Meeting]) {
        for meeting in meetings {
            let assignment = Assignment { stage: self.stages.len(), laws: meeting.laws };
            match meeting.second {
                Meets::Class(second) => self.pairing.set_between(meeting.first, second, assignment),
                Meets::Wall(wall) => self.pairing.set_at_wall(meeting.first, wall, assignment),
            }
        }
        self.stages.push(stage);
        self.meetings.push(meetings.to_vec());
    }

    /// Bodies of each two sizes that a meeting is of.
    fn examples<'a>(&'a self, bodies: &'a Bodies, meeting: &Meeting) -> Box<dyn Iterator<Item = Candidate> + 'a> {
        let first = &self.classes[meeting.first];
        match meeting.second {
            Meets::Class(second) => Box::new(first.pairs_with(&self.classes[second], bodies, meeting.laws)),
            Meets::Wall(wall) => Box::new(first.at_wall(wall, meeting.laws)),
        }
    }

    /// Bodies that a meeting is of.
    pub(super) fn example(&self, bodies: &Bodies, meeting: &Meeting) -> Option<Candidate> {
        self.examples(bodies, meeting).next()
    }

    /// A pair of every two sizes that can touch, with its stage: enough to know all time scales from.
    pub(super) fn all_examples(&self, bodies: &Bodies) -> Vec<(usize, Candidate)> {
        let of_stage = |(stage, meetings): (usize, &Vec<Meeting>)| {
            meetings.iter().flat_map(|meeting| self.examples(bodies, meeting)).map(|candidate| (stage, candidate)).collect::<Vec<_>>()
        };
        self.meetings.iter().enumerate().flat_map(of_stage).collect()
    }
}
