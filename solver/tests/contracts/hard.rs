//! Contracts of hard bodies: exact flights and collisions, conservation, restart, and what cannot go on is said.

use solver::scene::{
    Body, Boundary, BoundaryGeometry, CoulombImpulse, CuboidGeometry, EventDrivenContact, FrictionClamp, Geometry, HardContact,
    ImpulseRestitution, Material, NamedShape, NormalLaw, Pair, PlaneGeometry, RodGeometry, Scene, Step, TangentialLaw, TimeDrivenContact,
};
use solver::simulation::RunError;
use solver::{Simulation, Vector};

use super::spheres::{build, sphere, state_bits};

fn hard(restitution: f64, friction: Option<f64>) -> Pair {
    let tangential = friction.map(|friction| {
        TangentialLaw::CoulombImpulse(CoulombImpulse { dynamic_friction: friction, static_friction: None, clamp: FrictionClamp::Stick })
    });
    Pair {
        materials: ["steel".into(), "steel".into()],
        normal: NormalLaw::Impulse(ImpulseRestitution { restitution }),
        tangential,
        rolling: None,
    }
}

fn wall(name: &str, point: [f64; 3], normal: [f64; 3]) -> Boundary {
    Boundary::new(name, "steel", BoundaryGeometry::Plane(PlaneGeometry { point, normal }))
}

/// Bodies of all simple shapes on a lattice in a closed cube of unit edge, each with its own velocity and spin.
fn box_of_shapes(restitution: f64, friction: Option<f64>) -> Scene {
    let mut scene = Scene::empty("box of shapes", 10.0);
    scene.materials = vec![Material { name: "steel".into(), density: Some(1000.0) }];
    scene.pairs = vec![hard(restitution, friction)];
    let rod = || RodGeometry { radius: 0.05, length: 0.12 };
    let named = |name: &str, geometry| NamedShape { name: name.into(), geometry };
    scene.shapes = vec![
        sphere("0", 0.07),
        named("1", Geometry::Cylinder(rod())),
        named("2", Geometry::Spherocylinder(rod())),
        named("3", Geometry::Cuboid(CuboidGeometry { lengths: [0.1; 3] })),
    ];
    for place in 0..27 {
        let part = |stride: f64| (f64::from(place) * stride).fract() - 0.5;
        let lattice = |count: i32| 0.2 + 0.3 * f64::from(count % 3);
        scene.bodies.push(Body {
            position: [lattice(place), lattice(place / 3), lattice(place / 9)],
            velocity: [part(0.618_034), part(0.754_878), part(0.569_841)],
            orientation: [1.0, part(0.324_718), part(0.220_744), part(0.856_675)],
            angular_velocity: [10.0 * part(0.414_214), 10.0 * part(0.732_051), 0.0],
            ..Body::new(&(place % 4).to_string(), "steel")
        });
    }
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let mut along = [0.0; 3];
        along[axis] = 1.0;
        scene.boundaries.push(wall(&format!("low {name}"), [0.0; 3], along));
        scene.boundaries.push(wall(&format!("high {name}"), [1.0; 3], along.map(|component| -component)));
    }
    scene.numerics.step = Step::Seconds(0.05);
    scene
}

fn collisions(simulation: &Simulation) -> u64 {
    simulation.ledger().total_work()["collisions"]
}

/// Without friction and at restitution one the kinetic energy is kept to rounding, whatever the shapes.
#[test]
fn kinetic_energy_is_kept_by_thousands_of_collisions() {
    let mut simulation = build(&box_of_shapes(1.0, None));
    let before = simulation.now().kinetic_energy();
    simulation.run_until(40.0).unwrap();
    let change = simulation.now().kinetic_energy() / before - 1.0;
    assert!(collisions(&simulation) > 1800, "{}", collisions(&simulation));
    assert!(change.abs() < 1e-12, "{change:e} after {} collisions", collisions(&simulation));
    for index in 0..simulation.bodies().len() {
        let position = simulation.bodies().position(index);
        assert!(position.min() > 0.04 && position.max() < 0.96, "body {index} has left the box: {position}");
    }
}

#[test]
fn friction_and_restitution_only_take_energy_away() {
    for time_driven in [false, true] {
        let mut scene = box_of_shapes(0.8, Some(0.5));
        scene.numerics.hard_contact = time_driven.then(|| HardContact::TimeDriven(TimeDrivenContact::default()));
        scene.numerics.step = Step::Seconds(0.002);
        let mut simulation = build(&scene);
        let mut last = simulation.now().kinetic_energy();
        let first = last;
        for _ in 0..500 {
            simulation.step();
            let energy = simulation.now().kinetic_energy();
            assert!(energy <= last * (1.0 + 1e-13), "{last} -> {energy}");
            last = energy;
        }
        assert!(last < 0.9 * first && collisions(&simulation) > 20);
    }
}

/// A stone dropped from one metre on a floor: the height returns every bounce, the times of bounces are those of the parabola.
#[test]
fn an_elastic_ball_bounces_for_ever_to_the_same_height() {
    let mut scene = Scene::empty("bounce", 1000.0);
    scene.scene.gravity = Some([0.0, 0.0, -10.0]);
    scene.materials = vec![Material { name: "steel".into(), density: Some(1000.0) }];
    scene.pairs = vec![hard(1.0, None)];
    scene.shapes = vec![sphere("ball", 0.2)];
    scene.bodies = vec![Body { position: [0.0, 0.0, 1.45], velocity: [0.25, 0.0, 0.0], ..Body::new("ball", "steel") }];
    scene.boundaries = vec![wall("floor", [0.0; 3], [0.0, 0.0, 1.0])];
    scene.numerics.step = Step::Seconds(0.125);
    let mut simulation = build(&scene);
    simulation.run_until(1000.0).unwrap();
    // It falls for half a second, then bounces every second: a thousand bounces, and at the end it is at its height again.
    assert_eq!(collisions(&simulation), 1000);
    let position = simulation.bodies().position(0);
    assert!((position - Vector::new(250.0, 0.0, 1.45)).norm() < 1e-9, "{position}");
}

/// With restitution e the bounces end at t = t1 (1 + e)/(1 - e), here at 1.5 s: the run says so instead of hanging.
#[test]
fn an_inelastic_collapse_is_an_error_at_its_time() {
    let mut scene = Scene::empty("collapse", 10.0);
    scene.scene.gravity = Some([0.0, 0.0, -10.0]);
    scene.materials = vec![Material { name: "steel".into(), density: Some(1000.0) }];
    scene.pairs = vec![hard(0.5, None)];
    scene.shapes = vec![sphere("ball", 0.2)];
    scene.bodies = vec![Body { position: [0.0, 0.0, 1.45], ..Body::new("ball", "steel") }];
    scene.boundaries = vec![wall("floor", [0.0; 3], [0.0, 0.0, 1.0])];
    scene.numerics.step = Step::Seconds(0.01);
    let stop = build(&scene).run_until(10.0).unwrap_err();
    let RunError::Hard(solver::scheme::hard::Stop::Collapse { time, body: 0, .. }) = stop else { panic!("{stop}") };
    assert!((time - 1.5).abs() < 1e-3, "{time}");
    // In steps it comes to rest, at the height of half of the overlap of a step of free fall at most.
    scene.numerics.hard_contact = Some(HardContact::TimeDriven(TimeDrivenContact::default()));
    let mut simulation = build(&scene);
    simulation.run_until(10.0).unwrap();
    assert!((simulation.bodies().position(0).z - 0.2).abs() < 1e-3);
}

/// A box dropped flat meets the floor with four corners at once; one impulse after the other sends it back with the energy it had.
#[test]
fn a_box_that_lands_flat_comes_back() {
    let mut scene = Scene::empty("flat", 1.0);
    scene.materials = vec![Material { name: "steel".into(), density: Some(1000.0) }];
    scene.pairs = vec![hard(1.0, None)];
    scene.shapes = vec![NamedShape { name: "cube".into(), geometry: Geometry::Cuboid(CuboidGeometry { lengths: [0.2; 3] }) }];
    scene.bodies = vec![Body { position: [0.0, 0.0, 0.5], velocity: [0.0, 0.0, -1.0], ..Body::new("cube", "steel") }];
    scene.boundaries = vec![wall("floor", [0.0; 3], [0.0, 0.0, 1.0])];
    scene.numerics.step = Step::Seconds(0.1);
    let mut simulation = build(&scene);
    simulation.run_until(1.0).unwrap();
    assert!((simulation.now().kinetic_energy() / 4.0 - 1.0).abs() < 1e-12 && simulation.now().velocity(0).z > 0.0);
}

#[test]
fn a_restarted_run_of_hard_bodies_is_bitwise_the_same() {
    for time_driven in [false, true] {
        let mut scene = box_of_shapes(0.9, Some(0.2));
        scene.numerics.hard_contact = Some(if time_driven {
            HardContact::TimeDriven(TimeDrivenContact::default())
        } else {
            HardContact::EventDriven(EventDrivenContact::default())
        });
        let mut whole = build(&scene);
        whole.run_until(0.5).unwrap();
        let mut again = Simulation::resume(&scene, &whole.checkpoint().unwrap()).unwrap();
        whole.run_until(1.0).unwrap();
        again.run_until(1.0).unwrap();
        assert_eq!(state_bits(&mut whole), state_bits(&mut again));
        assert_eq!(whole.ledger(), again.ledger());
    }
}

/// Times do not depend on how often one looks: only rounding does.
#[test]
fn the_step_of_event_driven_bodies_does_not_show() {
    let positions = |step: f64| {
        let mut scene = box_of_shapes(1.0, None);
        scene.numerics.step = Step::Seconds(step);
        let mut simulation = build(&scene);
        simulation.run_until(0.5).unwrap();
        (0..simulation.bodies().len()).map(|index| simulation.bodies().position(index)).collect::<Vec<_>>()
    };
    for (coarse, fine) in positions(0.5).iter().zip(positions(0.5 / 64.0)) {
        assert!((coarse - fine).norm() < 1e-9, "{:e}", (coarse - fine).norm());
    }
}

/// R eq. 3.37: a cylinder that lands on one point of its rim, tilted by 0.7 rad; the arm of the impulse is R cos - L/2 sin.
#[test]
fn a_tilted_cylinder_leaves_a_wall_as_the_closed_form_says() {
    let (radius, length, tilt, restitution, mass) = (0.004, 0.0053, 0.7_f64, 0.85, 0.5);
    let mut scene = Scene::empty("tilted", 1.0);
    scene.materials = vec![Material { name: "steel".into(), density: None }];
    scene.pairs = vec![hard(restitution, None)];
    scene.shapes = vec![NamedShape { name: "rod".into(), geometry: Geometry::Cylinder(RodGeometry { radius, length }) }];
    let half = 0.5 * tilt;
    scene.bodies = vec![Body {
        mass: Some(mass),
        position: [0.0, 0.0, 0.01],
        velocity: [0.0, 0.0, -2.0],
        orientation: [half.cos(), 0.0, half.sin(), 0.0],
        ..Body::new("rod", "steel")
    }];
    scene.boundaries = vec![wall("floor", [0.0; 3], [0.0, 0.0, 1.0])];
    scene.numerics.step = Step::Seconds(0.004);
    let mut simulation = build(&scene);
    simulation.step();
    let arm = radius * tilt.cos() - 0.5 * length * tilt.sin();
    let inertia = mass * (radius * radius / 4.0 + length * length / 12.0);
    let impulse = (1.0 + restitution) * 2.0 / (1.0 / mass + arm * arm / inertia);
    let now = simulation.now();
    assert!((now.velocity(0).z - (impulse / mass - 2.0)).abs() < 1e-13, "{}", now.velocity(0).z);
    assert!((now.angular_velocity(0).y.abs() - impulse * arm / inertia).abs() < 1e-10, "{}", now.angular_velocity(0));
}

/// S eq. 2.35 and 2.41, errata: each of two bodies goes half of the overlap, at a wall the body all of it, and all away from each other.
#[test]
fn bodies_that_overlap_are_pushed_apart_by_equal_shares_and_off_walls_alone() {
    let mut scene = Scene::empty("overlaps", 1.0);
    scene.materials = vec![Material { name: "steel".into(), density: Some(1000.0) }];
    scene.pairs = vec![hard(1.0, None)];
    scene.shapes = vec![sphere("ball", 0.2)];
    let at = |x: f64, z: f64| Body { position: [x, 0.0, z], ..Body::new("ball", "steel") };
    scene.bodies = vec![at(-0.125, 1.0), at(0.125, 1.0), at(0.0, 0.125)];
    scene.boundaries = vec![wall("floor", [0.0; 3], [0.0, 0.0, 1.0])];
    scene.numerics.step = Step::Seconds(0.01);
    assert!(scene.build().is_err(), "overlaps at the start are refused");
    scene.numerics.initial_overlap = solver::scene::InitialOverlap::Allow;
    assert!(scene.build().is_err(), "event-driven bodies cannot begin in an overlap");
    scene.numerics.hard_contact = Some(HardContact::TimeDriven(TimeDrivenContact::default()));
    let mut simulation = build(&scene);
    simulation.step();
    for (index, expected) in [[-0.2, 0.0, 1.0], [0.2, 0.0, 1.0], [0.0, 0.0, 0.2]].into_iter().enumerate() {
        assert!((simulation.bodies().position(index) - Vector::from(expected)).norm() < 1e-15);
    }
    assert_eq!(simulation.now().kinetic_energy(), 0.0);
    scene.numerics.step = Step::default();
    assert_eq!(scene.build().err().map(|error| error.key), Some("numerics.step".into()));
}

/// However wild the numbers: an end in no time, and an error where squares are beyond the numbers.
#[test]
fn absurd_speeds_and_spins_end_with_an_error() {
    for (speed, spin) in [(1e200, 0.0), (1.0, 1e200), (1.0, 1e9), (1e-300, 1e-300)] {
        for shape in ["1", "brick"] {
            let mut scene = box_of_shapes(1.0, None);
            let lengths = [0.05, 0.07, 0.1];
            scene.shapes.push(NamedShape { name: "brick".into(), geometry: Geometry::Cuboid(CuboidGeometry { lengths }) });
            let body = scene.bodies[0].clone();
            scene.bodies[0] =
                Body { velocity: [speed, 0.0, 0.0], angular_velocity: [spin, 0.5 * spin, 0.1 * spin], shape: shape.into(), ..body };
            let ended = build(&scene).run_until(0.05);
            assert!(ended.is_err() || speed.max(spin) < 1e100, "{shape} {speed:e} {spin:e}");
        }
    }
}

/// Momentum of a free pair that meets off centre, with friction.
#[test]
fn a_collision_in_free_space_keeps_momentum_and_angular_momentum() {
    let mut scene = box_of_shapes(0.7, Some(0.4));
    scene.boundaries.clear();
    // Everything flies to the middle.
    for body in &mut scene.bodies {
        for axis in 0..3 {
            body.velocity[axis] = 0.3 * body.velocity[axis] + 0.5 - body.position[axis];
        }
    }
    let mut simulation = build(&scene);
    let (momentum, turning) = (simulation.now().momentum(), simulation.now().angular_momentum());
    simulation.run_until(2.0).unwrap();
    assert!(collisions(&simulation) > 20, "{}", collisions(&simulation));
    let change = (simulation.now().momentum() - momentum).norm();
    let turn = (simulation.now().angular_momentum() - turning).norm();
    assert!(change < 1e-13 * 27.0 && turn < 1e-13 * 27.0, "{change:e} {turn:e}");
}
