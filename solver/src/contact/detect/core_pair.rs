//! Two rounded cores: overlap and normal from their distance, contact points from the pieces that face each other.

use super::feature::{Across, common_piece, facing_piece};
use crate::Vector;
use crate::contact::Touch;
use crate::distance::{Outcome, Pose, Query, Relative, RoundedCore, Separation, separation};

/// A rounded core in its place.
#[derive(Debug, Clone, Copy)]
pub struct PlacedCore<'a> {
    /// The core and its ball.
    pub rounded: &'a RoundedCore,
    /// Place and turn in the world.
    pub pose: Pose,
    /// Centre of mass of the body it belongs to, in m.
    pub centre_of_body: Vector,
}

/// How many points of a contact are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Points {
    /// All corners of the common piece of two faces or edges.
    All,
    /// The deepest only, wherever on a common face it comes to lie.
    Deepest,
}

/// What a look at a pair found besides contact points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// Direction from the first to the second: a good guess for the next look.
    pub axis: Vector,
    /// Corners looked up in the search.
    pub corners: u32,
    /// Whether even the cores overlap: the step is too large or the contact too soft.
    pub is_deep: bool,
}

/// Adds the contact points of two rounded cores to a list, from the last axis between them if there is one.
pub fn core_pair(first: &PlacedCore<'_>, second: &PlacedCore<'_>, axis: Option<Vector>, points: Points, touches: &mut Vec<Touch>) -> Look {
    let reach = first.rounded.radius + second.rounded.radius;
    // The distance vanishes where sharp cores touch: a cutoff of zero still lets that through.
    let query = Query { guess: axis, cutoff: reach };
    let found = separation((&first.rounded.core, &first.pose), (&second.rounded.core, &second.pose), &query);
    let is_deep = found.outcome == Outcome::Overlapping;
    let look = Look { axis: found.normal, corners: found.corners, is_deep };
    let overlap = reach - found.distance;
    if found.outcome == Outcome::BeyondCutoff || overlap <= 0.0 {
        return look;
    }
    let before = touches.len();
    if points == Points::All {
        add_common_piece(first, second, &found, overlap, touches);
    }
    if touches.len() == before {
        let on_surface = found.on_first + found.normal * (first.rounded.radius - 0.5 * overlap);
        touches.push(touch_at(first, second, &found, overlap, on_surface));
    }
    look
}

/// The contact at a point given from the centre of the first core.
fn touch_at(first: &PlacedCore<'_>, second: &PlacedCore<'_>, found: &Separation, overlap: f64, point: Vector) -> Touch {
    let arm_of_first = first.pose.position - first.centre_of_body + point;
    Touch {
        overlap,
        normal: found.normal,
        arm_of_first,
        arm_of_second: arm_of_first - (second.centre_of_body - first.centre_of_body),
        is_deep: found.outcome == Outcome::Overlapping,
    }
}

/// Contact points of two pieces that face each other, if they meet in more than a point.
fn add_common_piece(first: &PlacedCore<'_>, second: &PlacedCore<'_>, found: &Separation, overlap: f64, touches: &mut Vec<Touch>) {
    let normal = found.normal;
    let across = Across::of(&normal);
    let own = Relative { rotation: first.pose.rotation, position: Vector::zeros() };
    let other = Relative { rotation: second.pose.rotation, position: second.pose.position - first.pose.position };
    let piece_of_first = facing_piece(&first.rounded.core, &own, &normal, 1.0, overlap, &across);
    if piece_of_first.len() < 2 {
        return;
    }
    let piece_of_second = facing_piece(&second.rounded.core, &other, &normal, -1.0, overlap, &across);
    let height = found.on_first.dot(&normal) + first.rounded.radius;
    for (place, below_first) in common_piece(&piece_of_first, &piece_of_second) {
        let overlap_here = overlap - place.depth;
        if overlap_here > 0.0 {
            let along = height - below_first - 0.5 * overlap_here;
            let point = across.x * place.x + across.y * place.y + normal * along;
            touches.push(touch_at(first, second, found, overlap_here, point));
        }
    }
}
