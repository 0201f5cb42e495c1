//! Finds the contact points of two bodies, or of a body and a wall, part by part.
//!
//! Of two parts that are apart a look leaves a lower bound of the gap between them; until both bodies together have [travelled](Travel) as far, they are not
//! looked at again. A first look starts with balls and [boxes] round both, before it searches.

use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

use super::Touch;
use super::detect::{PlacedCore, PlacedSurface, Points, VertexSurface, core_pair, core_plane, core_vessel, vertex_pair, vertex_plane};
use super::pairs::{Candidate, Partner};
use super::rigid_motion::{RigidMotions, rotation_of};
use super::shaped::{DetectedPart, Surroundings};
use super::stage::Work;
use super::travel::Travel;
use crate::boundary::PlacedWall;
use crate::distance::{Guess, Pose, Relative, RoundedCore, boxes};
use crate::domain::Image;
use crate::{Bodies, Vector};

/// A contact point and the parts it lies between.
#[derive(Debug, Clone, Copy)]
pub(super) struct PointTouch {
    pub(super) touch: Touch,
    pub(super) parts: [u32; 2],
}

/// Room for the contact points of a pair, used again from pair to pair.
#[derive(Debug, Default)]
pub(super) struct Touches {
    pub(super) points: Vec<PointTouch>,
    /// Of the two parts that are looked at.
    of_parts: Vec<Touch>,
}

impl Touches {
    fn take(&mut self, parts: [u32; 2]) {
        self.points.extend(self.of_parts.drain(..).map(|touch| PointTouch { touch, parts }));
    }
}

/// How two bodies that are near stand to each other: of each two parts.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Standing {
    parts: SmallVec<[StandingOfParts; 1]>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
struct StandingOfParts {
    /// Where the next search begins, if there has been one.
    guess: Option<Guess>,
    /// Travel of both bodies in m before which these parts cannot touch.
    due: f64,
}

impl Standing {
    pub(super) fn is_used(&self) -> bool {
        !self.parts.is_empty()
    }
}

/// What is left of a gap for rounding, relative to the reach of both parts.
const ROUNDING: f64 = 1e-9;

/// Looks at all parts of a candidate pair.
pub(super) struct Detector<'a> {
    pub(super) bodies: &'a Bodies,
    pub(super) surroundings: &'a Surroundings,
    /// Where they are now.
    pub(super) walls: Vec<Option<PlacedWall<'a>>>,
    pub(super) points: Points,
    /// What is known of all bodies; without it every pair is looked at.
    pub(super) known: Option<KnownOfBodies<'a>>,
}

/// What a stage notes of its bodies before it looks at pairs.
#[derive(Clone, Copy)]
pub(super) struct KnownOfBodies<'a> {
    /// How far they have moved until now.
    pub(super) travel: &'a Travel,
    /// How they move now.
    pub(super) motions: &'a RigidMotions,
}

/// A body as its partner sees it, which may be an image of it.
struct BodyInPlace {
    position: Vector,
    /// From its frame to the world.
    rotation: Matrix3<f64>,
}

impl BodyInPlace {
    /// Centre of a part in the world, in m.
    #[inline(always)]
    fn centre(&self, part: &DetectedPart) -> Vector {
        self.position + self.rotation * part.position
    }

    #[inline(always)]
    fn part<'a>(&self, part: &DetectedPart, rounded: &'a RoundedCore) -> PlacedCore<'a> {
        let rotation = part.rotation.map_or(self.rotation, |rotation| self.rotation * rotation);
        PlacedCore { rounded, pose: Pose { position: self.centre(part), rotation }, centre_of_body: self.position }
    }
}

impl Detector<'_> {
    pub(super) fn parts(&self, index: usize) -> &[DetectedPart] {
        &self.surroundings.parts[self.bodies.shape_index(index)]
    }

    fn body(&self, index: usize, shift: &Vector) -> BodyInPlace {
        let rotation = self.known.map_or_else(|| rotation_of(self.bodies, index), |known| known.motions.of(index).rotation);
        BodyInPlace { position: self.bodies.position(index) + shift, rotation }
    }

    /// How far both bodies have moved, in m.
    #[inline]
    fn travelled(&self, first: usize, second: usize) -> f64 {
        self.known.map_or(f64::INFINITY, |known| known.travel.of_both(first, second))
    }

    /// Whether a candidate pair need not be looked at: it is apart until both bodies together have travelled as far as `due`, in m.
    #[inline]
    pub(super) fn are_apart(&self, candidate: &Candidate, due: f64) -> bool {
        candidate.second_body().is_some_and(|second| self.travelled(candidate.first(), second) < due)
    }

    /// Adds all contact points of a candidate pair to a list, in the order of their parts; returns the travel of both bodies in m before which no two parts can
    /// touch.
    pub(super) fn look(&self, candidate: &Candidate, standing: &mut Standing, found: &mut Touches, work: &mut Work) -> f64 {
        match candidate.second() {
            Partner::Wall(wall) => {
                if let Some(wall) = &self.walls[wall] {
                    self.look_at_wall(candidate.first(), wall, found, work);
                }
                0.0
            }
            Partner::Body(second) => self.look_at_bodies(candidate.first(), second, candidate.image, standing, found, work),
        }
    }

    fn look_at_wall(&self, index: usize, wall: &PlacedWall<'_>, found: &mut Touches, work: &mut Work) {
        if wall.distance(&self.bodies.position(index)) >= self.bodies.shape(index).bounding_radius() {
            return;
        }
        let (plane, vessel) = (wall.as_plane(), wall.as_vessel());
        let body = self.body(index, &Vector::zeros());
        for (place, part) in self.parts(index).iter().enumerate() {
            let core = body.part(part, &part.against_walls);
            work.pair_tests += 1;
            let touches = &mut found.of_parts;
            match (&plane, &part.vertices, &vessel) {
                (Some(plane), Some(surface), _) => vertex_plane(&on_surface(&core, surface), plane, touches),
                (Some(plane), None, _) => core_plane(&core, plane, self.points, touches),
                (None, _, Some(vessel)) => core_vessel(&core, vessel, self.points, touches),
                (None, _, None) => {
                    let core = PlacedCore { rounded: &part.against_bodies, ..core };
                    self.look_at_pieces(&core, part.bounding_radius, wall, touches, work);
                }
            }
            found.take([place as u32, 0]);
        }
    }

    /// Of a wall of convex pieces, which have edges and corners as bodies do.
    fn look_at_pieces(&self, core: &PlacedCore<'_>, reach: f64, wall: &PlacedWall<'_>, touches: &mut Vec<Touch>, work: &mut Work) {
        wall.each_piece_within(&core.pose.position, reach, |piece| {
            let piece = PlacedCore { rounded: &piece.rounded, pose: piece.pose, centre_of_body: piece.pose.position };
            work.corners += u64::from(core_pair(core, &piece, None, self.points, touches).corners);
        });
    }

    fn look_at_bodies(
        &self,
        first: usize,
        second: usize,
        image: Image,
        standing: &mut Standing,
        found: &mut Touches,
        work: &mut Work,
    ) -> f64 {
        let travelled = self.travelled(first, second);
        let shift = self.surroundings.shifts.shift(image);
        let between = self.bodies.position(second) + shift - self.bodies.position(first);
        let reach = self.bodies.shape(first).bounding_radius() + self.bodies.shape(second).bounding_radius();
        if between.norm_squared() >= reach * reach {
            standing.parts.clear();
            return after(travelled, between.norm() - reach, reach);
        }
        let (one, other) = (self.body(first, &Vector::zeros()), self.body(second, shift));
        let (parts_of_first, parts_of_second) = (self.parts(first), self.parts(second));
        let count = parts_of_first.len() * parts_of_second.len();
        if standing.parts.len() != count {
            standing.parts.resize(count, StandingOfParts::default());
        }
        let mut due = f64::INFINITY;
        for (place, part) in parts_of_first.iter().enumerate() {
            for (other_place, other_part) in parts_of_second.iter().enumerate() {
                let known = &mut standing.parts[place * parts_of_second.len() + other_place];
                if travelled >= known.due {
                    let parts = [place as u32, other_place as u32];
                    let gap = self.look_at_parts(&[(&one, part), (&other, other_part)], known, parts, found, work);
                    known.due = after(travelled, gap, part.bounding_radius);
                }
                due = due.min(known.due);
            }
        }
        due
    }

    /// Adds the contact points of two parts; returns how far they may come nearer, in m, before they are to be looked at again, zero if they touch.
    fn look_at_parts(
        &self,
        pair: &[(&BodyInPlace, &DetectedPart); 2],
        known: &mut StandingOfParts,
        parts: [u32; 2],
        found: &mut Touches,
        work: &mut Work,
    ) -> f64 {
        let [one, other] = pair.map(|(body, part)| body.centre(part));
        let [part, other_part] = pair.map(|(_, part)| part);
        let between_balls = (other - one).norm() - (part.bounding_radius + other_part.bounding_radius);
        if between_balls >= 0.0 {
            known.guess = None;
            return between_balls;
        }
        let [one, other] = pair.map(|(body, part)| body.part(part, &part.against_bodies));
        if known.guess.is_none() {
            let relative = Relative::new(&one.pose, &other.pose);
            let between_boxes =
                boxes::lower_bound(&one.rounded.core, &other.rounded.core, &relative) - one.rounded.radius - other.rounded.radius;
            if between_boxes > 0.0 {
                return between_boxes;
            }
        }
        work.pair_tests += 1;
        let touches = &mut found.of_parts;
        let look = match (&part.vertices, &other_part.vertices) {
            (Some(own), Some(others)) => vertex_pair(
                &on_surface(&one, own),
                &on_surface(&other, others),
                known.guess.map(|guess| guess.direction),
                self.surroundings.resolution.one_sided,
                touches,
            ),
            _ => core_pair(&one, &other, known.guess, self.points, touches),
        };
        known.guess = Some(look.guess);
        work.corners += u64::from(look.corners);
        found.take(parts);
        // A search begins anew once the balls have parted, whether or not the pair was listed meanwhile: so it must be seen that they have.
        look.gap.min(-between_balls)
    }
}

/// The travel at which parts that are apart by a gap are to be looked at again.
fn after(travelled: f64, gap: f64, reach: f64) -> f64 {
    if travelled.is_finite() && gap > 0.0 { travelled + gap - ROUNDING * reach } else { 0.0 }
}

/// A part seen as a surface of vertices.
fn on_surface<'a>(core: &PlacedCore<'_>, surface: &'a VertexSurface) -> PlacedSurface<'a> {
    PlacedSurface { surface, pose: core.pose, centre_of_body: core.centre_of_body }
}
