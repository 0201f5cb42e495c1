//! A rounded core and a flat wall: every corner below the wall is a contact point. Exact, with or without a crust.

use super::core_pair::{PlacedCore, Points};
use super::feature::{each_corner, rim_directions};
use crate::Vector;
use crate::boundary::Plane;
use crate::contact::Touch;
use crate::distance::Core;

/// Points of a rim that can touch a flat wall: the lowest, the highest and those between.
const RIM_POINTS: usize = 4;

/// Adds the contact points of a rounded core and a flat wall to a list.
pub fn core_plane(core: &PlacedCore<'_>, plane: &Plane, points: Points, touches: &mut Vec<Touch>) {
    let height_of_centre = plane.height(&core.pose.position);
    let rounded = core.rounded;
    if height_of_centre >= rounded.core.reach() + rounded.radius {
        return;
    }
    let downwards = core.pose.rotation.tr_mul(&-plane.normal);
    let start = touches.len();
    let touch = |corner: Vector| {
        // Heights are told from the body's own frame, so that turning the world does not change them by more than rounding.
        let overlap = rounded.radius + corner.dot(&downwards) - height_of_centre;
        (overlap > 0.0).then(|| {
            let from_centre = core.pose.rotation * corner + plane.normal * (0.5 * overlap - rounded.radius);
            let arm_of_first = core.pose.position - core.centre_of_body + from_centre;
            Touch { overlap, normal: -plane.normal, arm_of_first, arm_of_second: Vector::zeros(), is_deep: false }
        })
    };
    match &rounded.core {
        Core::Cylinder { radius, half_length } => {
            for direction in rim_directions::<RIM_POINTS>(&downwards) {
                for z in [-half_length, *half_length] {
                    touches.extend(touch(Vector::new(radius * direction[0], radius * direction[1], z)));
                }
            }
        }
        other => each_corner(other, &downwards, |corner| touches.extend(touch(corner))),
    }
    if points == Points::Deepest {
        keep_deepest(touches, start);
    }
}

/// Keeps the deepest of the contact points from a place on; the first of equal ones.
pub(super) fn keep_deepest(touches: &mut Vec<Touch>, start: usize) {
    let deeper = |best: Touch, touch: &Touch| if touch.overlap > best.overlap { *touch } else { best };
    if let Some((first, others)) = touches[start..].split_first() {
        let deepest = others.iter().fold(*first, deeper);
        touches.truncate(start);
        touches.push(deepest);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Orientation;
    use crate::distance::{Pose, RoundedCore};
    use crate::shape::{Convex, Cuboid, Cylinder, Sphere, Spherocylinder};

    const GROUND: fn() -> Plane = || Plane { point: Vector::new(3.0, -2.0, 0.5), normal: Vector::z() };

    fn touches(convex: &Convex, height: f64, turn: Orientation, points: Points) -> Vec<Touch> {
        let rounded = RoundedCore::sharp(convex);
        let pose = Pose { position: Vector::new(1.0, 2.0, height), rotation: *turn.to_rotation_matrix().matrix() };
        let mut found = Vec::new();
        core_plane(&PlacedCore { rounded: &rounded, pose, centre_of_body: pose.position }, &GROUND(), points, &mut found);
        found
    }

    #[test]
    fn a_ball_is_the_ball_of_the_closed_form() {
        let found = touches(&Convex::Sphere(Sphere { radius: 1.0 }), 1.4, Orientation::from_euler_angles(0.1, 0.2, 0.3), Points::All);
        let expected = super::super::sphere_plane(&Vector::new(1.0, 2.0, 1.4), 1.0, &GROUND()).expect("the ball is 0.1 deep");
        assert_eq!(found.len(), 1);
        assert!((found[0].overlap - expected.overlap).abs() < 4.0 * f64::EPSILON);
        assert!((found[0].arm_of_first - expected.arm_of_first).norm() < 4.0 * f64::EPSILON);
    }

    #[test]
    fn faces_lines_and_rims_have_their_points() {
        let cylinder = Convex::Cylinder(Cylinder { radius: 0.5, length: 2.0 });
        let level = Orientation::identity();
        let lying = Orientation::from_scaled_axis(Vector::x() * std::f64::consts::FRAC_PI_2);
        assert_eq!(touches(&cylinder, 1.49, level, Points::All).len(), 4);
        assert_eq!(touches(&cylinder, 0.99, lying, Points::All).len(), 2);
        assert_eq!(touches(&cylinder, 0.99, lying, Points::Deepest).len(), 1);
        let tilt = Orientation::from_scaled_axis(Vector::y() * 0.6);
        let lowest = 1.0 * 0.6_f64.cos() + 0.5 * 0.6_f64.sin();
        let found = touches(&cylinder, 0.5 + lowest - 0.01, tilt, Points::All);
        assert!(found.len() == 1 && (found[0].overlap - 0.01).abs() < 8.0 * f64::EPSILON);
        let cube = Convex::Cuboid(Cuboid { lengths: Vector::repeat(1.0) });
        assert_eq!(touches(&cube, 0.99, level, Points::All).len(), 4);
        assert_eq!(touches(&cube, 1.01, level, Points::All).len(), 0);
        let capsule = Convex::Spherocylinder(Spherocylinder { radius: 0.5, length: 2.0 });
        assert_eq!(touches(&capsule, 0.99, lying, Points::All).len(), 2);
    }
}
