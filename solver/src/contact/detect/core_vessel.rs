//! A rounded core and the inside of an infinite cylinder. The distance from the axis is a convex function, so its maxima over a convex core lie at corners,
//! on rims or on a curved surface: each is a contact point where it lies outside. Exact, with or without a crust.

use super::core_pair::{PlacedCore, Points};
use super::core_plane::keep_deepest;
use super::feature::each_corner;
use crate::Vector;
use crate::boundary::Cylinder;
use crate::contact::Touch;
use crate::distance::Core;

/// Steps of an ascent that ends much earlier unless a body nearly fills the vessel.
const LARGEST_NUMBER_OF_STEPS: usize = 100;
/// Maxima nearer to each other than this part of the reach of a core are one.
const SAME_PLACE: f64 = 1e-6;

/// Adds the contact points of a rounded core and the inside of a cylinder, however long it is said to be, to a list.
pub fn core_vessel(core: &PlacedCore<'_>, vessel: &Cylinder, points: Points, touches: &mut Vec<Touch>) {
    let rounded = core.rounded;
    let centre = core.pose.position;
    let (outwards, from_axis) = vessel.radial(&centre);
    if from_axis + rounded.core.reach() + rounded.radius <= vessel.radius {
        return;
    }
    let before = touches.len();
    let mut add = |corner: Vector| {
        let from_centre = core.pose.rotation * corner;
        let (radial, distance) = vessel.radial(&(centre + from_centre));
        let overlap = distance + rounded.radius - vessel.radius;
        if overlap > 0.0 && distance > 0.0 {
            let normal = radial / distance;
            let arm_of_first = centre - core.centre_of_body + from_centre + normal * (rounded.radius - 0.5 * overlap);
            touches.push(Touch { overlap, normal, arm_of_first, arm_of_second: Vector::zeros(), is_deep: false });
        }
    };
    let local = |direction: &Vector| core.pose.rotation.tr_mul(direction);
    match &rounded.core {
        Core::Cylinder { radius, half_length } => {
            let axis = local(&vessel.axis);
            for end in [-half_length, *half_length] {
                let on_rim = |direction: &Vector| {
                    let across = direction.x.hypot(direction.y);
                    let (x, y) = if across > 0.0 { (direction.x / across, direction.y / across) } else { (1.0, 0.0) };
                    Vector::new(radius * x, radius * y, end)
                };
                let mut found: Vec<Vector> = Vec::new();
                for start in rim_starts(&axis, &local(&outwards)) {
                    let place = ascend(on_rim(&start), &on_rim, |corner| local(&vessel.radial(&(centre + core.pose.rotation * corner)).0));
                    if found.iter().all(|other| (other - place).norm() > SAME_PLACE * rounded.core.reach()) {
                        found.push(place);
                    }
                }
                found.into_iter().for_each(&mut add);
            }
        }
        Core::Superellipsoid(shape) => {
            let support = |direction: &Vector| shape.support(direction);
            add(ascend(support(&local(&outwards)), &support, |corner| local(&vessel.radial(&(centre + core.pose.rotation * corner)).0)));
        }
        other => each_corner(other, &local(&outwards), &mut add),
    }
    if points == Points::Deepest {
        keep_deepest(touches, before);
    }
}

/// Where to begin on a rim about z: away from the vessel's axis and back, and at right angles to both axes, either way. From there no maximum is missed: a
/// rim across the vessel has two of them, one that is not has one, or one at either side.
fn rim_starts(axis: &Vector, outwards: &Vector) -> [Vector; 4] {
    let flat = |direction: Vector| Vector::new(direction.x, direction.y, 0.0);
    let across = flat(Vector::z().cross(axis)).try_normalize(1e-12).unwrap_or_else(Vector::x);
    // A little aside, so that a start is not caught where the distance has a minimum.
    let out = flat(*outwards).try_normalize(0.0).unwrap_or_else(Vector::y) + across * 0.1;
    [out, -out, across, -across]
}

/// From a point of a surface to the one that is farthest the way it lies from the axis, until it stays: the distance from the axis, being convex, never
/// becomes less on the way.
fn ascend(start: Vector, support: &impl Fn(&Vector) -> Vector, away_from_axis: impl Fn(&Vector) -> Vector) -> Vector {
    let mut place = start;
    for _ in 0..LARGEST_NUMBER_OF_STEPS {
        let next = support(&away_from_axis(&place));
        let has_stayed = (next - place).norm() <= 1e-15 * next.norm();
        place = next;
        if has_stayed {
            break;
        }
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Orientation;
    use crate::boundary::Side;
    use crate::distance::{Pose, RoundedCore};
    use crate::shape::{Convex, Cuboid, Cylinder as Rod, Sphere, Superellipsoid};

    /// Upright, of radius 1 m.
    fn vessel() -> Cylinder {
        Cylinder { centre: Vector::new(3.0, 4.0, 5.0), axis: Vector::z(), radius: 1.0, half_length: f64::INFINITY, side: Side::Inside }
    }

    /// Contacts of a body at a place from the axis.
    fn touches(rounded: &RoundedCore, place: Vector, turn: Orientation, points: Points) -> Vec<Touch> {
        let pose = Pose { position: vessel().centre + place, rotation: *turn.to_rotation_matrix().matrix() };
        let mut found = Vec::new();
        core_vessel(&PlacedCore { rounded, pose, centre_of_body: pose.position }, &vessel(), points, &mut found);
        found
    }

    fn quarter(axis: Vector) -> Orientation {
        Orientation::from_scaled_axis(axis * std::f64::consts::FRAC_PI_2)
    }

    const ROUNDING: f64 = 32.0 * f64::EPSILON;

    #[test]
    fn a_ball_is_the_ball_of_the_closed_form() {
        let ball = RoundedCore::sharp(&Convex::Sphere(Sphere { radius: 0.3 }));
        let place = Vector::new(0.6, 0.48, 7.0);
        let found = touches(&ball, place, Orientation::from_euler_angles(0.1, 0.2, 0.3), Points::All);
        let expected = vessel().touch_sphere(&(vessel().centre + place), 0.3).unwrap();
        assert_eq!(found.len(), 1);
        assert!((found[0].overlap - expected.overlap).abs() < ROUNDING && (found[0].normal - expected.normal).norm() < ROUNDING);
        assert!((found[0].arm_of_first - expected.arm).norm() < ROUNDING);
    }

    /// Standing, a rod touches along a line: its ends; across the middle, with four points of its rims; leaning, with one.
    #[test]
    fn rods_touch_with_their_rims() {
        let rod = RoundedCore::sharp(&Convex::Cylinder(Rod { radius: 0.2, length: 1.0 }));
        let standing = touches(&rod, Vector::x() * 0.81, Orientation::identity(), Points::All);
        assert_eq!(standing.len(), 2);
        for touch in &standing {
            assert!((touch.overlap - 0.01).abs() < ROUNDING && (touch.normal - Vector::x()).norm() < 1e-14);
            assert!((touch.arm_of_first.xy() - nalgebra::Vector2::new(0.195, 0.0)).norm() < 1e-14 && touch.arm_of_first.z.abs() == 0.5);
        }
        let long = RoundedCore::sharp(&Convex::Cylinder(Rod { radius: 0.2, length: 1.96 }));
        let across = touches(&long, Vector::zeros(), quarter(Vector::y()), Points::All);
        let overlap = 0.98_f64.hypot(0.2) - 1.0;
        assert!(across.len() == 4 && across.iter().all(|touch| (touch.overlap - overlap).abs() < 1e-14), "{across:?}");
        let short = RoundedCore::sharp(&Convex::Cylinder(Rod { radius: 0.2, length: 1.0 }));
        let radial = touches(&short, Vector::x() * 0.5, quarter(Vector::y()), Points::All);
        let overlap = 1.0_f64.hypot(0.2) - 1.0;
        assert!(radial.len() == 2 && radial.iter().all(|touch| (touch.overlap - overlap).abs() < 1e-14), "{radial:?}");
        let tilt = Orientation::from_scaled_axis(Vector::y() * 0.3);
        let reach = 0.5 * 0.3_f64.sin() + 0.2 * 0.3_f64.cos();
        let leaning = touches(&rod, Vector::x() * (1.01 - reach), tilt, Points::All);
        assert!(leaning.len() == 1 && (leaning[0].overlap - 0.01).abs() < 1e-14, "{leaning:?}");
        assert!(touches(&rod, Vector::x() * 0.79, Orientation::identity(), Points::All).is_empty());
    }

    /// Every corner of a box outside the vessel is a contact, whatever its crust; the deepest is the farthest of all points of the box.
    #[test]
    fn boxes_touch_with_their_corners() {
        let brick = Convex::Cuboid(Cuboid { lengths: Vector::new(0.6, 0.8, 1.0) });
        let sharp = RoundedCore::sharp(&brick);
        // Corners at 0.3 + 0.5 = 0.8 across and 0.4 along: 2 sqrt(0.2) from the axis.
        let level = touches(&sharp, Vector::x() * 0.65, Orientation::identity(), Points::All);
        let overlap = 0.95_f64.hypot(0.4) - 1.0;
        assert!(level.len() == 4 && level.iter().all(|touch| (touch.overlap - overlap).abs() < ROUNDING), "{level:?}");
        assert_eq!(touches(&sharp, Vector::x() * 0.65, Orientation::identity(), Points::Deepest).len(), 1);
        let rounded = RoundedCore::with_crust(&brick, 0.02).unwrap();
        let overlap = 0.93_f64.hypot(0.38) + 0.02 - 1.0;
        let level = touches(&rounded, Vector::x() * 0.65, Orientation::identity(), Points::All);
        assert!(level.len() == 4 && level.iter().all(|touch| (touch.overlap - overlap).abs() < ROUNDING), "{level:?}");
    }

    /// The deepest contact of a turned body is its farthest point from the axis, which a fine net over its surface does not beat.
    #[test]
    fn no_point_of_a_body_lies_farther_out() {
        let superellipsoid = Superellipsoid::new(Vector::new(0.3, 0.4, 0.5), [0.6, 1.4]).unwrap();
        let bodies = [
            Convex::Cylinder(Rod { radius: 0.25, length: 0.9 }),
            Convex::Cuboid(Cuboid { lengths: Vector::new(0.3, 0.5, 0.9) }),
            Convex::Superellipsoid(std::sync::Arc::new(superellipsoid)),
        ];
        for (index, convex) in bodies.iter().cycle().take(60).enumerate() {
            let part = |stride: f64| (index as f64 * stride).fract() - 0.5;
            let turn = Orientation::from_euler_angles(7.0 * part(0.618_034), 7.0 * part(0.754_878), 7.0 * part(0.569_841));
            let rounded = RoundedCore::sharp(convex);
            let place = Vector::new(0.75, 0.1 * part(0.3247), 2.0);
            let mut farthest = 0.0_f64;
            for sample in 0..40_000 {
                let (height, angle) = (-1.0 + (f64::from(sample) + 0.5) / 20_000.0, 2.399_963_229_728_653 * f64::from(sample));
                let across = (1.0 - height * height).sqrt();
                let direction = Vector::new(across * angle.cos(), across * angle.sin(), height);
                farthest = farthest.max((place + turn * rounded.core.support(&direction)).xy().norm());
            }
            let found = touches(&rounded, place, turn, Points::Deepest);
            let overlap = found.first().map_or(0.0, |touch| touch.overlap);
            // Neighbours of the net are a hundredth of a radian apart: second order in it, times the size.
            assert!(
                overlap > farthest - 1.0 - 1e-12 && overlap < (farthest - 1.0).max(0.0) + 1e-3,
                "{index} {convex:?}: {overlap} {farthest}"
            );
        }
    }
}
