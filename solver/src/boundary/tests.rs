use super::*;
use crate::contact::Touch;
use crate::contact::detect::{PlacedCore, Points, core_pair};
use crate::shape::{Convex, Cuboid, Cylinder as Rod, Polyhedron};
use nalgebra::Matrix3;

fn square() -> Wall {
    Wall::Plate(Plate::new(&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]].map(Vector::from)).unwrap())
}

fn touches(wall: &PlacedWall<'_>, position: Vector, radius: f64) -> Vec<SphereTouch> {
    let mut touches = Vec::new();
    wall.touch_sphere(&position, radius, &mut touches);
    touches
}

/// A plate that has turned upright by a quarter and gone aside: contacts turn with it, its material points move as the motion says, then it is gone.
#[test]
fn contacts_move_with_the_wall() {
    let turn = Some(Turn { point: Vector::zeros(), angular_velocity: -Vector::y(), interval: [0.0, std::f64::consts::FRAC_PI_2] });
    let translation = Some(Translation { velocity: Vector::x(), interval: [0.0, 10.0] });
    let gate = MovingWall { wall: square(), motion: Motion { turn, translation, removed_at: Some(6.0), ..Motion::default() } };
    // Corners at (5, 0..2, 0..2) by now.
    let wall = gate.at(5.0).unwrap();
    let found = touches(&wall, Vector::new(5.25, 1.0, 1.5), 0.5);
    assert_eq!(found.len(), 1);
    assert!((found[0].overlap - 0.25).abs() < 1e-15 && (found[0].normal + Vector::x()).norm() < 1e-15, "{found:?}");
    assert!((found[0].arm + Vector::x() * 0.375).norm() < 1e-15);
    assert!((wall.distance(&Vector::new(5.0, 1.0, 3.0)) - 1.0).abs() < 1e-15);
    assert_eq!(wall.velocity_at(&Vector::new(5.0, 1.0, 2.0)), Vector::x());
    // While it turns about its axis, which is carried along: omega x r = -y x 2 x = 2 z at its far edge.
    let start = gate.at(0.0).unwrap();
    assert_eq!(start.velocity_at(&Vector::new(2.0, 1.0, 0.0)), Vector::new(1.0, 0.0, 2.0));
    assert!(gate.at(6.0).is_none());
}

/// A wall that never moves is looked at in place: not a bit changes.
#[test]
fn rest_costs_no_rounding() {
    let plane = Plane { point: Vector::new(0.1, 0.2, 0.3), normal: Vector::new(0.36, 0.48, 0.8) };
    let still = MovingWall { wall: Wall::Plane(plane.clone()), motion: Motion::default() };
    let ball = Vector::new(0.7, -0.3, 0.5);
    assert_eq!(touches(&still.at(1e9).unwrap(), ball, 0.9), plane.touch_sphere(&ball, 0.9).into_iter().collect::<Vec<_>>());
    assert_eq!(still.velocity_at(&ball, 1.0), Vector::zeros());
}

/// Of every kind of wall nothing in a ball of the distance touches.
#[test]
fn the_distance_is_what_a_ball_may_reach() {
    let lattice = |index: u32| {
        let part = |stride: f64| (f64::from(index) * stride).fract();
        Vector::new(part(0.618_034), part(0.754_878), part(0.569_841)) * 4.0 - Vector::repeat(1.0)
    };
    let cylinder = |side, half_length| Wall::Cylinder(Cylinder { centre: Vector::x(), axis: Vector::y(), radius: 0.7, half_length, side });
    let mesh = Mesh::new(&[Vector::zeros(), Vector::x(), Vector::y(), Vector::z()], &[[0, 1, 2], [0, 1, 3]], 0.1).unwrap();
    let walls = [
        Wall::Plane(Plane { point: Vector::zeros(), normal: Vector::z() }),
        cylinder(Side::Inside, f64::INFINITY),
        cylinder(Side::Inside, 0.5),
        cylinder(Side::Outside, f64::INFINITY),
        cylinder(Side::Outside, 0.5),
        square(),
        Wall::Mesh(mesh),
    ];
    for wall in &walls {
        for index in 0..500 {
            let (point, mut found) = (lattice(index), Vec::new());
            let distance = wall.distance(&point);
            wall.touch_sphere(&point, distance - 1e-14, &mut found);
            assert!(found.is_empty(), "{wall:?} {point}");
            wall.touch_sphere(&point, distance.max(0.0) + 1e-9, &mut found);
            assert!(!found.is_empty(), "{wall:?} {point}");
        }
    }
}

/// What shaped bodies see of a plate: the distance of their cores, against a plane over its face and against corners where they stick out.
#[test]
fn shaped_bodies_touch_plates_by_their_cores() {
    let square = square();
    let look = |convex: &Convex, position: Vector, reach: f64| {
        let rounded = RoundedCore::with_crust(convex, 0.02).unwrap();
        let body = PlacedCore { rounded: &rounded, pose: Pose { position, rotation: Matrix3::identity() }, centre_of_body: position };
        let mut found: Vec<Touch> = Vec::new();
        square.each_piece_within(&position, reach, |piece| {
            let wall = PlacedCore { rounded: &piece.rounded, pose: piece.pose, centre_of_body: piece.pose.position };
            core_pair(&body, &wall, None, Points::All, &mut found);
        });
        found
    };
    let cube = Convex::Cuboid(Cuboid { lengths: Vector::repeat(1.0) });
    let on_face = look(&cube, Vector::new(1.0, 1.0, 0.49), 1.0);
    assert_eq!(on_face.len(), 4);
    assert!(on_face.iter().all(|touch| (touch.overlap - 0.01).abs() < 1e-15 && (touch.normal + Vector::z()).norm() < 1e-14), "{on_face:?}");
    // Halfway over the edge, contact ends there: corners of the common piece at x = 2.
    let over_edge = look(&cube, Vector::new(2.2, 1.0, -0.49), 1.0);
    let farthest = over_edge.iter().map(|touch| touch.arm_of_first.x + 2.2).fold(0.0, f64::max);
    assert!(over_edge.len() == 4 && (farthest - 2.0).abs() < 1e-12, "{over_edge:?}");
    assert!(over_edge.iter().all(|touch| (touch.normal - Vector::z()).norm() < 1e-14));
    // A side against the edge of the plate.
    let beside = look(&cube, Vector::new(2.49, 1.0, 0.0), 1.0);
    assert!(
        !beside.is_empty()
            && beside.iter().all(|touch| (touch.overlap - 0.01).abs() < 1e-14 && (touch.normal + Vector::x()).norm() < 1e-12)
    );
    assert!(look(&cube, Vector::new(1.0, 1.0, 2.0), 1.0).is_empty());
    let tetrahedron = Convex::Polyhedron(std::sync::Arc::new(Polyhedron::tetrahedron(1.0).unwrap()));
    // An edge of a tetrahedron, half of sqrt 1/2 below its centre. Half its angle has the sine sqrt 1/3: rounded by a crust c, it ends (sqrt 3 - 1) c higher.
    let found = look(&tetrahedron, Vector::new(1.0, 1.0, 0.5 * 0.5_f64.sqrt() - 0.03), 1.0);
    let overlap = 0.03 - 0.02 * (3.0_f64.sqrt() - 1.0);
    assert!(found.len() == 2 && found.iter().all(|touch| (touch.overlap - overlap).abs() < 1e-13), "{found:?} {overlap}");
    let rod = Convex::Cylinder(Rod { radius: 0.2, length: 1.0 });
    let standing = look(&rod, Vector::new(1.0, 1.0, 0.49), 1.0);
    assert!(standing.len() > 2 && standing.iter().all(|touch| (touch.overlap - 0.01).abs() < 1e-13), "{standing:?}");
}

/// A cube beside a rod and on its end, finite and infinite; a vessel has no convex pieces.
#[test]
fn shaped_bodies_touch_rods_by_their_cores() {
    let rounded = RoundedCore::with_crust(&Convex::Cuboid(Cuboid { lengths: Vector::repeat(1.0) }), 0.02).unwrap();
    let look = |half_length: f64, side: Side, position: Vector| {
        let rod = Wall::Cylinder(Cylinder { centre: Vector::zeros(), axis: Vector::y(), radius: 0.3, half_length, side });
        let body = PlacedCore { rounded: &rounded, pose: Pose { position, rotation: Matrix3::identity() }, centre_of_body: position };
        let mut found: Vec<Touch> = Vec::new();
        rod.each_piece_within(&position, 1.0, |piece| {
            let wall = PlacedCore { rounded: &piece.rounded, pose: piece.pose, centre_of_body: piece.pose.position };
            core_pair(&body, &wall, None, Points::All, &mut found);
        });
        found
    };
    for (half_length, place, normal) in [
        (f64::INFINITY, Vector::new(0.0, 1e3, 0.79), -Vector::z()),
        (2.0, Vector::new(0.79, 1.2, 0.0), -Vector::x()),
        (2.0, Vector::new(0.1, -2.49, 0.1), Vector::y()),
    ] {
        let found = look(half_length, Side::Outside, place);
        assert!(found.len() > 1, "{place}: {found:?}");
        assert!(found.iter().all(|touch| (touch.overlap - 0.01).abs() < 1e-12 && (touch.normal - normal).norm() < 1e-12), "{found:?}");
    }
    assert!(look(2.0, Side::Inside, Vector::new(0.79, 1.2, 0.0)).is_empty());
}
