//! Finds the contact points of two bodies, or of a body and a wall, part by part.
//!
//! Of two parts that are apart a look leaves a lower bound of the gap between them; until both bodies together have [travelled](Travel) as far, they are not
//! looked at again. A first look starts with balls and [boxes] round both, before it searches.

use serde::{Deserialize, Serialize};

use super::Touch;
use super::detect::{PlacedCore, PlacedSurface, Points, VertexSurface, core_pair, core_plane, core_vessel, vertex_pair, vertex_plane};
use super::pairs::{Candidate, Partner};
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

/// How two bodies stand to each other.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Standing {
    /// Of each two parts; empty while the bodies are far apart.
    parts: Vec<StandingOfParts>,
    /// Travel of both bodies in m before which no two parts can touch. What is forgotten of it costs a look and changes nothing.
    #[serde(skip)]
    due: f64,
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
    /// How far bodies have moved until now; without it every pair is looked at.
    pub(super) travel: Option<&'a Travel>,
}

impl Detector<'_> {
    pub(super) fn parts(&self, index: usize) -> &[DetectedPart] {
        &self.surroundings.parts[self.bodies.shape_index(index)]
    }

    /// Centre of a part in the world, in m, for a body that is seen shifted.
    fn centre(&self, index: usize, shift: &Vector, part: &DetectedPart) -> Vector {
        self.bodies.position(index) + shift + self.bodies.orientation(index) * part.position
    }

    fn placed<'b>(&self, index: usize, shift: &Vector, part: &DetectedPart, rounded: &'b RoundedCore) -> PlacedCore<'b> {
        let rotation = *(self.bodies.orientation(index) * part.orientation).to_rotation_matrix().matrix();
        let pose = Pose { position: self.centre(index, shift, part), rotation };
        PlacedCore { rounded, pose, centre_of_body: self.bodies.position(index) + shift }
    }

    /// Adds all contact points of a candidate pair to a list, in the order of their parts.
    pub(super) fn look(&self, candidate: &Candidate, standing: &mut Standing, found: &mut Touches, work: &mut Work) {
        match candidate.second() {
            Partner::Wall(wall) => {
                if let Some(wall) = &self.walls[wall] {
                    self.look_at_wall(candidate.first(), wall, found, work);
                }
            }
            Partner::Body(second) => self.look_at_bodies(candidate.first(), second, candidate.image, standing, found, work),
        }
    }

    fn look_at_wall(&self, index: usize, wall: &PlacedWall<'_>, found: &mut Touches, work: &mut Work) {
        if wall.distance(&self.bodies.position(index)) >= self.bodies.shape(index).bounding_radius() {
            return;
        }
        let (plane, vessel) = (wall.as_plane(), wall.as_vessel());
        for (place, part) in self.parts(index).iter().enumerate() {
            let core = self.placed(index, &Vector::zeros(), part, &part.against_walls);
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

    fn look_at_bodies(&self, first: usize, second: usize, image: Image, standing: &mut Standing, found: &mut Touches, work: &mut Work) {
        let travelled = self.travel.map_or(f64::INFINITY, |travel| travel.of_both(first, second));
        if travelled < standing.due {
            return;
        }
        let shift = self.surroundings.shifts.shift(image);
        let between = self.bodies.position(second) + shift - self.bodies.position(first);
        let reach = self.bodies.shape(first).bounding_radius() + self.bodies.shape(second).bounding_radius();
        if between.norm_squared() >= reach * reach {
            standing.parts.clear();
            standing.due = after(travelled, between.norm() - reach, reach);
            return;
        }
        let (parts_of_first, parts_of_second) = (self.parts(first), self.parts(second));
        standing.parts.resize(parts_of_first.len() * parts_of_second.len(), StandingOfParts::default());
        standing.due = f64::INFINITY;
        for (place, part) in parts_of_first.iter().enumerate() {
            for (other_place, other_part) in parts_of_second.iter().enumerate() {
                let known = &mut standing.parts[place * parts_of_second.len() + other_place];
                if travelled >= known.due {
                    let (pair, parts) =
                        ([(first, Vector::zeros(), part), (second, *shift, other_part)], [place as u32, other_place as u32]);
                    known.due = after(travelled, self.look_at_parts(&pair, known, parts, found, work), part.bounding_radius);
                }
                standing.due = standing.due.min(known.due);
            }
        }
    }

    /// Adds the contact points of two parts; returns a lower bound in m of the gap between them, zero if there is none.
    fn look_at_parts(
        &self,
        pair: &[(usize, Vector, &DetectedPart); 2],
        known: &mut StandingOfParts,
        parts: [u32; 2],
        found: &mut Touches,
        work: &mut Work,
    ) -> f64 {
        let [one, other] = pair.map(|(index, shift, part)| self.centre(index, &shift, part));
        let [part, other_part] = pair.map(|(.., part)| part);
        let between_balls = (other - one).norm() - (part.bounding_radius + other_part.bounding_radius);
        if between_balls >= 0.0 {
            known.guess = None;
            return between_balls;
        }
        let [one, other] = pair.map(|(index, shift, part)| self.placed(index, &shift, part, &part.against_bodies));
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
        look.gap
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
