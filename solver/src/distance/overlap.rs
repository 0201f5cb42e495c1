//! When even the cores overlap: a depth along a direction that separates, finite and defined for every pair, coincident ones included.
//!
//! The depth along a unit direction is the gap between the supporting planes, which needs no search. Tried are the direction between both sets
//! moved apart until they part, the last direction, and the normals of all faces. From the least depth it goes downhill: moved apart along the
//! best direction by its depth and a little more, the sets have nearest points, and the depth along their direction is never larger. The result is
//! exact where sets touch and for deep face contacts, a local minimum of the depth otherwise; of smooth sets it is polished to their common normal, and
//! `least_depth` goes on from there. It stands for a step that was too large: whoever meets it must count it.

use super::common_normal::Start;
use super::core::Core;
use super::gjk::{Goal, Search, State};
use super::{CERTIFIED_GAP, Known, Outcome, Relative, Separation};
use crate::Vector;

/// How far the sets are moved apart about their centres until they part, in distances of the centres: a touch needs little.
const FACTORS: [f64; 14] = [1.0 + 1e-6, 1.001, 1.1, 1.5, 2.0, 4.0, 8.0, 32.0, 128.0, 1e3, 1e4, 1e6, 1e9, 1e12];
/// Steps downhill.
const LARGEST_NUMBER_OF_STEPS: usize = 12;
/// Distance, relative to size, that is left between the sets when they are moved apart.
const MARGIN: f64 = 1e-2;

/// Depth, normal and points of two sets that overlap, in the frame of the first.
#[cold]
pub fn separation(first: &Core, second: &Core, relative: &Relative, guess: Option<Vector>) -> Separation {
    let (depth, normal) = best_of_candidates(first, second, relative, guess);
    let (on_first, on_second) = (first.support(&normal), relative.support(second, &-normal));
    // Midway between both sets' farthest points across the normal, each on its own surface plane. Of a piece of a wall, which may be much larger than what it
    // meets, any corner may be the farthest: then at the point of the other set.
    let middle = match (first, second) {
        (Core::Polygon(_), _) => on_second,
        (_, Core::Polygon(_)) => on_first,
        _ => 0.5 * (on_first + on_second),
    };
    let across = middle - normal * middle.dot(&normal);
    let place = |on_surface: &Vector| across + normal * on_surface.dot(&normal);
    let start = Separation {
        distance: -depth,
        normal,
        on_first: place(&on_first),
        on_second: place(&on_second) - relative.position,
        gap: 0.0,
        outcome: Outcome::Overlapping,
        known: Known::Nothing,
        corners: 0,
    };
    let found = downhill(first, second, relative, start);
    let certified = CERTIFIED_GAP * (first.reach() + second.reach());
    let from = Start::Points(found.normal, [found.on_first, found.on_second]);
    let smooth = super::common_normal::separation(first, second, relative, &from, certified);
    if let Some(smooth) = smooth.filter(|smooth| smooth.distance >= found.distance - certified) {
        return Separation { corners: found.corners, ..smooth };
    }
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
        let Some(found) = super::apart(first, second, &apart, Some(best.normal.into()), f64::INFINITY) else { return best };
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
        Core::Box { .. } | Core::Superellipsoid(_) => Box::new([Vector::x(), Vector::y(), Vector::z()].into_iter()),
        Core::Polyhedron(polyhedron) => Box::new(polyhedron.face_normals().iter().copied()),
        Core::Polygon(polygon) => Box::new([*polygon.normal()].into_iter()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Outcome, Pose, Query, separation};
    use super::*;
    use crate::Orientation;

    fn pose(position: Vector, axis: Vector, angle: f64) -> Pose {
        let turn = Orientation::from_axis_angle(&nalgebra::Unit::new_normalize(axis), angle);
        Pose { position, rotation: *turn.to_rotation_matrix().matrix() }
    }

    fn found(first: &Core, second: &Core, pose_of_second: &Pose) -> Separation {
        separation((first, &pose(Vector::zeros(), Vector::x(), 0.0)), (second, pose_of_second), &Query::cold())
    }

    const CUBE: Core = Core::Box { half_lengths: Vector::new(0.5, 0.5, 0.5) };
    const CYLINDER: Core = Core::Cylinder { radius: 0.5, half_length: 0.5 };

    #[test]
    fn depths_of_faces_edges_and_sides_are_those_of_their_places() {
        let edges = Vector::new(1.0, 0.0, 1.0);
        let cases = [
            (CUBE, Vector::z(), Vector::z(), 0.3, 1.0),
            (CUBE, edges, edges, std::f64::consts::FRAC_PI_2, 2.0_f64.sqrt()),
            (CYLINDER, Vector::x(), Vector::x(), std::f64::consts::FRAC_PI_2, 1.0),
        ];
        for (core, direction, axis, angle, touching) in cases {
            for depth in [1e-9, 1e-4, 1e-3] {
                let normal = direction.normalize();
                let found = found(&core, &core, &pose(normal * (touching - depth), axis, angle));
                assert!((found.distance + depth).abs() < 1e-12, "{core:?} {depth}: {found:?}");
                assert!((found.normal - normal).norm() < 1e-5, "{core:?} {depth}: {found:?}");
                assert_eq!(found.outcome, if depth > 1e-11 { Outcome::Overlapping } else { found.outcome });
            }
        }
    }

    #[test]
    fn coincident_centres_have_a_depth() {
        for core in [CUBE, CYLINDER] {
            let found = found(&core, &core, &pose(Vector::zeros(), Vector::z(), 0.0));
            assert!((found.distance + 1.0).abs() < 1e-14 && (found.normal.norm() - 1.0).abs() < 1e-15, "{found:?}");
        }
        let points = found(&Core::Point, &Core::Point, &pose(Vector::zeros(), Vector::z(), 0.0));
        assert!(points.distance == 0.0 && points.normal.norm() == 1.0, "{points:?}");
    }

    #[test]
    fn going_downhill_never_ends_deeper_than_the_best_candidate() {
        for index in 0..200 {
            let turn = f64::from(index);
            let place = Vector::new((0.7 * turn).sin(), (1.3 * turn).cos(), (0.3 * turn).sin()) * 0.4;
            let second = pose(place, Vector::new(1.0, turn.sin(), 0.5), turn);
            let relative = Relative { rotation: second.rotation, position: second.position };
            let (depth, _) = best_of_candidates(&CUBE, &CYLINDER, &relative, None);
            let found = separation((&CUBE, &pose(Vector::zeros(), Vector::x(), 0.0)), (&CYLINDER, &second), &Query::cold());
            assert!(found.distance >= -depth - 1e-15, "{index}: {found:?} {depth}");
        }
    }
}
