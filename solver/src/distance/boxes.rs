//! Boxes round cores, in their own frames: a first bound of their distance that needs no search.
//!
//! Along any direction two boxes are as far apart as their centres less what either reaches, so each direction gives a lower bound of the distance
//! (separating axes, Gottschalk and others 1996). The six face normals and the nine directions across two edges are enough to see whether
//! boxes overlap. Balls round long or flat bodies overlap long before the bodies are near; their boxes seldom do.

use nalgebra::Matrix3;

use super::Relative;
use super::core::Core;
use crate::Vector;

/// Squared sine of two edges below which the direction across them is rounding.
const PARALLEL: f64 = 1e-12;

/// A lower bound in m of the distance of two cores, from the boxes round them; negative if those overlap.
pub fn lower_bound(first: &Core, second: &Core, relative: &Relative) -> f64 {
    let (own, other) = (first.half_extents(), second.half_extents());
    let (rotation, between) = (&relative.rotation, &relative.position);
    let cosines = rotation.abs();
    let along_own = between.abs() - own - cosines * other;
    let along_other = rotation.tr_mul(between).abs() - other - cosines.tr_mul(&own);
    along_own.max().max(along_other.max()).max(across_edges(&own, &other, rotation, between))
}

/// The same along the directions across an edge of either box.
fn across_edges(own: &Vector, other: &Vector, rotation: &Matrix3<f64>, between: &Vector) -> f64 {
    let mut best = f64::NEG_INFINITY;
    for axis in 0..3 {
        for edge in rotation.column_iter() {
            let direction = Vector::ith(axis, 1.0).cross(&edge);
            let squared = direction.norm_squared();
            if squared > PARALLEL {
                let reach = own.dot(&direction.abs()) + other.dot(&rotation.tr_mul(&direction).abs());
                best = best.max((between.dot(&direction).abs() - reach) / squared.sqrt());
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::{Pose, Query, separation};
    use super::*;
    use crate::Orientation;
    use crate::shape::{Polyhedron, Superellipsoid};

    fn cores() -> Vec<Core> {
        let slab = Polyhedron::hull(&[[0.0, 0.0, 0.0], [2.0, 0.1, 0.0], [0.1, 0.9, 0.0], [0.2, 0.1, 0.3]].map(Vector::from));
        vec![
            Core::Point,
            Core::Segment { half_length: 1.5 },
            Core::Box { half_lengths: Vector::new(0.1, 0.4, 1.2) },
            Core::Cylinder { radius: 0.2, half_length: 1.0 },
            Core::Polyhedron(Arc::new(slab.expect("four corners off a plane"))),
            Core::Superellipsoid(Arc::new(Superellipsoid::new(Vector::new(0.3, 0.2, 1.0), [0.4, 0.7]).expect("a shape"))),
        ]
    }

    fn relative(index: u32, distance: f64) -> Relative {
        let part = |stride: f64| (f64::from(index) * stride).fract() - 0.5;
        let direction = Vector::new(part(0.618_034), part(0.754_878), part(0.569_841)).normalize();
        let turn = Orientation::from_euler_angles(7.0 * part(0.324_718), 7.0 * part(0.220_744), 7.0 * part(0.856_675));
        Relative { rotation: *turn.to_rotation_matrix().matrix(), position: direction * distance }
    }

    /// No box is smaller than its core, and none larger than needed.
    #[test]
    fn boxes_hold_their_cores() {
        for core in cores() {
            let extents = core.half_extents();
            let mut reached = Vector::zeros();
            for index in 0..20_000 {
                let direction = relative(index, 1.0).position;
                let support = core.support(&direction);
                assert!((extents - support.abs()).min() >= -1e-12 * core.reach(), "{core:?}: {support}");
                reached = reached.sup(&support.abs());
            }
            assert!((extents - reached).max() <= 0.02 * core.reach(), "{core:?}: {extents} {reached}");
        }
    }

    /// The bound never exceeds the distance, and of slender bodies it sees most that are apart.
    #[test]
    fn the_bound_is_below_the_distance_and_tells_most_slender_bodies_apart() {
        let origin = Pose { position: Vector::zeros(), rotation: Matrix3::identity() };
        let (cores, mut apart, mut seen) = (cores(), 0, 0);
        for index in 0..6000_u32 {
            let (first, second) = (&cores[(index % 6) as usize], &cores[(index / 6 % 6) as usize]);
            let reach = first.reach() + second.reach();
            let relative = relative(index, reach * (0.1 + 0.15 * f64::from(index % 7)));
            let pose = Pose { position: relative.position, rotation: relative.rotation };
            let distance = separation((first, &origin), (second, &pose), &Query::cold()).distance;
            let bound = lower_bound(first, second, &relative);
            assert!(bound <= distance.max(0.0) + 1e-12 * reach, "{index}: {bound} {distance} {first:?} {second:?}");
            if distance > 0.0 && relative.position.norm() < reach {
                (apart, seen) = (apart + 1, seen + u32::from(bound > 0.0));
            }
        }
        assert!(apart > 2000 && 10 * seen > 7 * apart, "{seen} of {apart}");
    }

    /// Exact where a face looks at a face, or an edge across an edge.
    #[test]
    fn faces_and_edges_are_as_far_as_they_are() {
        let core = Core::Box { half_lengths: Vector::new(1.0, 2.0, 3.0) };
        let beside = Relative { rotation: Matrix3::identity(), position: Vector::new(2.5, 1.0, -1.0) };
        assert_eq!(lower_bound(&core, &core, &beside), 0.5);
        let cube = Core::Box { half_lengths: Vector::repeat(1.0) };
        let along = Vector::new(1.0, 0.0, 1.0).normalize();
        let turn = Orientation::from_axis_angle(&nalgebra::Unit::new_normalize(along), std::f64::consts::FRAC_PI_2);
        let crossed = Relative { rotation: *turn.to_rotation_matrix().matrix(), position: along * (2.0 * 2.0_f64.sqrt() + 0.3) };
        assert!((lower_bound(&cube, &cube, &crossed) - 0.3).abs() < 1e-14);
    }
}
