//! When even the cores overlap: a depth along a direction that separates, finite and defined for every pair, coincident ones included.
//!
//! The depth along a unit direction is the gap between the supporting planes, which needs no search. Tried are the direction between both sets
//! moved apart until they part, the last direction, and the normals of all faces. From the least depth it goes downhill: moved apart along the
//! best direction by its depth and a little more, the sets have nearest points, and the depth along their direction is never larger. The result is
//! exact where sets touch and for deep face contacts, a local minimum of the depth otherwise. It stands for a step that was too large:
//! whoever meets it must count it.

use super::core::Core;
use super::gjk::{Goal, Search, State};
use super::{Outcome, Relative, Separation};
use crate::Vector;

/// How far the sets are moved apart about their centres until they part, in distances of the centres: a touch needs little.
const FACTORS: [f64; 14] = [1.0 + 1e-6, 1.001, 1.1, 1.5, 2.0, 4.0, 8.0, 32.0, 128.0, 1e3, 1e4, 1e6, 1e9, 1e12];
/// Steps downhill.
const LARGEST_NUMBER_OF_STEPS: usize = 12;
/// Distance, relative to size, that is left between the sets when they are moved apart.
const MARGIN: f64 = 1e-2;

/// Depth, normal and points of two sets that overlap, in the frame of the first.
pub fn separation(first: &Core, second: &Core, relative: &Relative, guess: Option<Vector>) -> Separation {
    let (depth, normal) = best_of_candidates(first, second, relative, guess);
    let (on_first, on_second) = (first.support(&normal), relative.support(second, &-normal));
    // Midway between both sets' farthest points across the normal, each on its own surface plane.
    let middle = 0.5 * (on_first + on_second);
    let across = middle - normal * middle.dot(&normal);
    let place = |on_surface: &Vector| across + normal * on_surface.dot(&normal);
    let start = Separation {
        distance: -depth,
        normal,
        on_first: place(&on_first),
        on_second: place(&on_second) - relative.position,
        gap: 0.0,
        outcome: Outcome::Overlapping,
        corners: 0,
    };
    let found = downhill(first, second, relative, start);
    // A search that has lost its way also comes here.
    Separation { outcome: if found.distance > 0.0 { Outcome::Searched } else { Outcome::Overlapping }, ..found }
}

/// Follows the depth down to a local minimum.
fn downhill(first: &Core, second: &Core, relative: &Relative, mut best: Separation) -> Separation {
    let size = first.reach() + second.reach();
    let margin = MARGIN * size;
    for _ in 0..LARGEST_NUMBER_OF_STEPS {
        let shift = best.normal * (margin - best.distance);
        let apart = Relative { position: relative.position + shift, ..*relative };
        let Some(found) = super::apart(first, second, &apart, Some(best.normal), f64::INFINITY) else { return best };
        best.corners += found.corners;
        let distance = found.distance - shift.dot(&found.normal);
        // A direction must win by more than rounding, so that equal ones do not change places.
        if distance <= best.distance + 1e-13 * size {
            return best;
        }
        let on_second = found.on_first + found.normal * distance - relative.position;
        best = Separation { distance, normal: found.normal, on_first: found.on_first, on_second, ..best };
    }
    best
}

/// Least depth and its direction among the last direction, that of parting, that of the centres and the normals of all faces.
fn best_of_candidates(first: &Core, second: &Core, relative: &Relative, guess: Option<Vector>) -> (f64, Vector) {
    let mut best: Option<(f64, Vector)> = None;
    let mut try_direction = |direction: Vector| {
        let Some(normal) = direction.try_normalize(f64::MIN_POSITIVE) else { return };
        let depth = first.support(&normal).dot(&normal) - relative.support(second, &-normal).dot(&normal);
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
    best.unwrap_or((0.0, Vector::x()))
}

/// Direction between both sets, moved apart about their centres until they part. `None` for coincident centres.
fn parting_direction(first: &Core, second: &Core, relative: &Relative) -> Option<Vector> {
    let size = first.reach() + second.reach();
    for factor in FACTORS {
        let apart = Relative { position: relative.position * factor, ..*relative };
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
