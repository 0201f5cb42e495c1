use super::*;
use crate::bodies::BodySpecification;
use crate::shape::{Convex, Cuboid, Cylinder, Sphere, Spherocylinder};
use crate::{Bodies, Orientation, test_bodies};

/// Evenly spread numbers in [-0.5, 0.5).
fn part(index: u32, stride: f64) -> f64 {
    (f64::from(index) * stride).fract() - 0.5
}

fn thrown(index: u32, convex: &Convex, position: Vector, velocity: Vector, spin: f64) -> (Flight, Vec<DetectedPart>, f64) {
    let bounding_radius = convex.bounding_radius();
    let parts = vec![DetectedPart {
        against_bodies: RoundedCore::with_crust(convex, 0.01).unwrap(),
        against_walls: RoundedCore::sharp(convex),
        vertices: None,
        position: Vector::zeros(),
        orientation: Orientation::identity(),
        rotation: None,
        bounding_radius,
    }];
    let turn = Orientation::from_euler_angles(7.0 * part(index, 0.324_718), 7.0 * part(index, 0.220_744), 7.0 * part(index, 0.856_675));
    let bodies = Bodies::new(vec![BodySpecification {
        position,
        velocity,
        orientation: turn,
        angular_velocity: Vector::new(part(index, 0.618_034), part(index, 0.754_878), part(index, 0.569_841)) * spin,
        ..test_bodies::at_rest(convex.clone(), 1.0)
    }]);
    (Flight::of(&bodies, 0, None, true), parts, bounding_radius)
}

fn shapes() -> [Convex; 4] {
    [
        Convex::Cylinder(Cylinder { radius: 0.4, length: 0.6 }),
        Convex::Cuboid(Cuboid { lengths: Vector::new(0.5, 0.7, 1.0) }),
        Convex::Spherocylinder(Spherocylinder { radius: 0.2, length: 1.0 }),
        Convex::Sphere(Sphere { radius: 0.5 }),
    ]
}

fn gap(first: &Side<'_>, second: &Side<'_>) -> f64 {
    let placed =
        |side: &Side<'_>| Pose { position: side.flight.position, rotation: *side.flight.orientation.to_rotation_matrix().matrix() };
    let (one, other) = (&first.parts[0].against_bodies, &second.parts[0].against_bodies);
    separation((&one.core, &placed(first)), (&other.core, &placed(second)), &Query::cold()).distance - one.radius - other.radius
}

/// Two bodies thrown at each other, spinning so fast that rims move five times faster than centres: sampled far finer than the steps, they never touch before the search says so; and the
/// search needs few looks, because the gap falls with its square.
#[test]
fn the_search_never_misses_a_touch_and_ends_soon() {
    let (mut looks, mut touches) = (0, 0);
    for index in 1..=100_u32 {
        let (one, other) = (&shapes()[index as usize % 4], &shapes()[index as usize / 4 % 4]);
        let aim = Vector::new(1.5, part(index, 0.414), part(index, 0.732));
        let (start, parts, radius) = thrown(index, one, Vector::zeros(), Vector::zeros(), 8.0);
        let (other_start, other_parts, other_radius) = thrown(index + 1000, other, aim, -Vector::x(), 8.0);
        let side = |flight: Flight| Side { flight, parts: &parts, bounding_radius: radius };
        let other_side = |flight: Flight| Side { flight, parts: &other_parts, bounding_radius: other_radius };
        let (mut time, mut guesses) = (0.0, Vec::new());
        loop {
            looks += 1;
            let settings = Settings { tolerance: 1e-12, horizon: 3.0 - time };
            let (first, second) = (side(start.at(time)), other_side(other_start.at(time)));
            match look_at_bodies(&first, &second, &mut guesses, &settings) {
                Look::Touch(point) => {
                    touches += 1;
                    assert!(gap(&first, &second).abs() < 3e-12);
                    let between = point.arm_of_first - point.arm_of_second - (second.flight.position - first.flight.position);
                    assert!(between.norm() < 1e-11, "both arms end at the same point");
                    break;
                }
                Look::Overlap(depth) => panic!("{index}: overlap {depth}"),
                Look::ClearFor(wait) => {
                    assert!(wait > 0.0, "{index}: no progress at {time}");
                    for sample in 0..5 {
                        let then = time + wait * f64::from(sample) / 5.0;
                        let apart = gap(&side(start.at(then)), &other_side(other_start.at(then)));
                        assert!(apart > -1e-12, "{index}: {apart} at {then} of {time}+{wait}");
                    }
                    time += wait;
                    if time >= 3.0 {
                        break;
                    }
                }
            }
        }
    }
    assert!(touches > 80 && looks < 40 * 100, "{touches} touches, {looks} looks");
}

/// By hand: two balls that meet off centre; a stone that falls, one thrown up, and one that a ceiling's gravity lifts away.
#[test]
fn balls_meet_when_the_quadratic_says() {
    let near = |value: f64, expected: f64| assert!((value - expected).abs() < 1e-15 * expected.max(1.0), "{value} {expected}");
    near(time_to_meet(&Vector::new(5.0, 0.6, 0.0), &Vector::new(-2.0, 0.0, 0.0), 1.0), (5.0 - 0.8) / 2.0);
    assert_eq!(time_to_meet(&Vector::new(5.0, 1.1, 0.0), &Vector::new(-2.0, 0.0, 0.0), 1.0), f64::INFINITY);
    assert_eq!(time_to_meet(&Vector::new(5.0, 0.0, 0.0), &Vector::new(2.0, 0.0, 0.0), 1.0), f64::INFINITY);
    assert_eq!(time_to_meet(&Vector::new(0.5, 0.0, 0.0), &Vector::new(2.0, 0.0, 0.0), 1.0), 0.0);
    near(time_to_fall(6.0, 0.0, -10.0, 1.0), 1.0);
    near(time_to_fall(6.0, 10.0, -10.0, 1.0), 1.0 + 2.0_f64.sqrt());
    near(time_to_fall(6.0, -5.0, 0.0, 1.0), 1.0);
    near(time_to_fall(5.5, -10.0, 10.0, 1.0), 1.0 - 0.1_f64.sqrt());
    assert_eq!(time_to_fall(7.0, -10.0, 10.0, 1.0), f64::INFINITY);
    assert_eq!(time_to_fall(7.0, 1.0, 0.0, 1.0), f64::INFINITY);
}
