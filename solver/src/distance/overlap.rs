//! When even the cores overlap: a depth along a direction that separates, finite and defined for every pair, coincident ones included.
//!
//! The depth along a unit direction is the gap between the supporting planes, which needs no search. Tried are the direction between both sets
//! shrunk until they part, the last direction, and the normals of all faces; the least depth wins. This is exact for deep face contacts and an
//! upper bound of the depth otherwise. It stands for a step that was too large: whoever meets it must count it.

use super::core::Core;
use super::gjk::{Goal, Search, State};
use super::{Outcome, Relative, Separation};
use crate::Vector;

/// Halvings of the sets until they part.
const HALVINGS: i32 = 40;

/// Depth, normal and points of two sets that overlap, in the frame of the first.
pub fn separation(first: &Core, second: &Core, relative: &Relative, guess: Option<Vector>) -> Separation {
    let mut best: Option<(f64, Vector)> = None;
    let mut try_direction = |direction: Vector| {
        let Some(normal) = direction.try_normalize(f64::MIN_POSITIVE) else { return };
        let depth = first.support(&normal).dot(&normal) - relative.support(second, &-normal).dot(&normal);
        // A direction must win by more than rounding, so that equal ones do not change places.
        if best.is_none_or(|(least, _)| depth < least - 1e-12 * least.abs()) {
            best = Some((depth, normal));
        }
    };
    guess.map(&mut try_direction);
    parting_direction(first, second, relative).map(&mut try_direction);
    try_direction(relative.position);
    for direction in face_normals(first) {
        try_direction(direction);
        try_direction(-direction);
    }
    for direction in face_normals(second).map(|normal| relative.rotation * normal) {
        try_direction(direction);
        try_direction(-direction);
    }
    try_direction(Vector::x());
    let (depth, normal) = best.unwrap_or((0.0, Vector::x()));
    let (on_first, on_second) = (first.support(&normal), relative.support(second, &-normal));
    // Midway between both sets' farthest points across the normal, each on its own surface plane.
    let middle = 0.5 * (on_first + on_second);
    let across = middle - normal * middle.dot(&normal);
    let place = |on_surface: &Vector| across + normal * on_surface.dot(&normal);
    Separation {
        distance: -depth,
        normal,
        on_first: place(&on_first),
        on_second: place(&on_second) - relative.position,
        gap: 0.0,
        outcome: Outcome::Overlapping,
        corners: 0,
    }
}

/// Direction between both sets, shrunk about their centres until they part. `None` for coincident centres.
fn parting_direction(first: &Core, second: &Core, relative: &Relative) -> Option<Vector> {
    let size = first.reach() + second.reach();
    for halving in 1..=HALVINGS {
        // Shrinking both sets is moving them apart and shrinking the picture.
        let apart = Relative { position: relative.position * 2.0_f64.powi(halving), ..*relative };
        let start = apart.position.try_normalize(0.0)?;
        let rounding = super::ROUNDING * (size + apart.position.norm());
        let mut search = Search::start(&start, first, second, &apart);
        search.go_on(first, second, &apart, &Goal { gap: 1e-3 * size, cutoff: f64::INFINITY, rounding });
        if search.state == State::Converged {
            return Some(search.vector);
        }
    }
    None
}

/// Normals of the faces of a set, one of each opposite pair where it has such.
fn face_normals(core: &Core) -> Box<dyn Iterator<Item = Vector> + '_> {
    match core {
        Core::Point => Box::new(std::iter::empty()),
        Core::Segment { .. } | Core::Cylinder { .. } => Box::new([Vector::z()].into_iter()),
        Core::Box { .. } => Box::new([Vector::x(), Vector::y(), Vector::z()].into_iter()),
        Core::Polyhedron(polyhedron) => Box::new(polyhedron.face_normals().iter().copied()),
    }
}
