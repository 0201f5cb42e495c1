//! Contracts of scenes of bodies of any shape.

use solver::scene::{
    Body, Boundary, BoundaryGeometry, CompositeGeometry, CuboidGeometry, Geometry, LobeGeometry, Material, NamedShape, NormalLaw, Pair,
    PartGeometry, PlaneGeometry, RegularGeometry, RodGeometry, Scene, Sharing, StepsPerContact, TangentialLaw,
};
use solver::{Simulation, Vector};

use super::spheres::{build, history, law, sphere, state_bits};

fn named(name: &str, geometry: Geometry) -> NamedShape {
    NamedShape { name: name.into(), geometry }
}

fn part(shape: &str, position: [f64; 3]) -> PartGeometry {
    PartGeometry { shape: shape.into(), position, orientation: [1.0, 0.1, 0.2, 0.3] }
}

fn shapes() -> Vec<NamedShape> {
    let rod = || RodGeometry { radius: 0.003, length: 0.01 };
    let parts = vec![part("ball", [0.0, 0.0, 0.004]), part("ball", [0.002, 0.0, -0.003]), part("rod", [0.0, 0.001, 0.0])];
    vec![
        sphere("ball", 0.004),
        named("rod", Geometry::Cylinder(rod())),
        named("brick", Geometry::Cuboid(CuboidGeometry { lengths: [0.006, 0.007, 0.008] })),
        named("cube", Geometry::Cuboid(CuboidGeometry { lengths: [0.007; 3] })),
        named("capsule", Geometry::Spherocylinder(RodGeometry { radius: 0.003, length: 0.004 })),
        named("icosahedron", Geometry::Icosahedron(RegularGeometry { edge: 0.005 })),
        named("tetrahedron", Geometry::Tetrahedron(RegularGeometry { edge: 0.009 })),
        named("trilobe", Geometry::Trilobe(LobeGeometry { diameter: 0.008, length: 0.007 })),
        named("cross", Geometry::CrossInSpace(RodGeometry { radius: 0.0015, length: 0.01 })),
        named("glued", Geometry::Composite(CompositeGeometry { parts, mass_properties: None })),
    ]
}

/// Two dozen bodies of all shapes thrown at each other, on a floor or in free space.
pub fn crowd(with_floor: bool, tangential: Option<TangentialLaw>, restitution: f64) -> Scene {
    let mut scene = Scene::empty("crowd of shapes", 0.01);
    scene.materials = vec![Material { name: "clay".into(), density: Some(2500.0) }];
    scene.pairs = vec![Pair { materials: ["clay".into(), "clay".into()], normal: law(restitution), tangential, rolling: None }];
    scene.shapes = shapes();
    for index in 0..24_u32 {
        let place = |divisor: u32, modulus: u32| f64::from(index / divisor % modulus);
        let wobble = |seed: u32| f64::from((index * 7919 + seed * 104_729) % 1000) / 1000.0 - 0.5;
        let centre = Vector::new(place(1, 3) - 1.0, place(3, 2) - 0.5, place(6, 4) - 1.0) * 0.0145 + Vector::z() * 0.03;
        let inwards = (Vector::z() * 0.03 - centre) * 60.0;
        scene.bodies.push(Body {
            id: Some(index * 3 + 1),
            position: centre.into(),
            velocity: [inwards.x + wobble(1), inwards.y + wobble(2), inwards.z + wobble(3)],
            orientation: [1.0, wobble(7), wobble(8), wobble(9)],
            angular_velocity: [80.0 * wobble(4), 80.0 * wobble(5), 80.0 * wobble(6)],
            ..Body::new(&scene.shapes[index as usize % scene.shapes.len()].name, "clay")
        });
    }
    if with_floor {
        scene.scene.gravity = Some([0.0, 0.0, -9.81]);
        let geometry = BoundaryGeometry::Plane(PlaneGeometry { point: [0.0, 0.0, 0.003], normal: [0.0, 0.0, 1.0] });
        scene.boundaries = vec![Boundary::new("ground", "clay", geometry)];
    }
    scene
}

pub fn contacts_so_far(simulation: &Simulation) -> u64 {
    simulation.ledger().total_work().get("contacts").copied().unwrap_or(0)
}

#[test]
fn momentum_and_angular_momentum_are_kept_whatever_the_shapes() {
    let scene = crowd(false, Some(history()), 0.7);
    let mut simulation = build(&scene);
    let (momentum, spin) = (simulation.now().momentum(), simulation.now().angular_momentum());
    simulation.run_until(0.01).expect("no guard stops this run");
    assert!(contacts_so_far(&simulation) > 1000, "the bodies do not meet");
    // Every step rounds the momentum of every body, about 1e-3 kg m/s; arms are at most the distance of 0.05 m to the origin.
    let roundings = (simulation.steps_taken() * scene.bodies.len() as u64) as f64;
    let floor = f64::EPSILON * 1e-3 * roundings.sqrt();
    let change = ((simulation.now().momentum() - momentum).norm(), (simulation.now().angular_momentum() - spin).norm());
    assert!(change.0 < 10.0 * floor && change.1 < 10.0 * floor * 0.05, "{change:?}, floor {floor}");
}

/// Springs that are not shared have a potential: elastic motion keeps its energy, up to the second order of the step.
#[test]
fn elastic_motion_keeps_its_energy_at_second_order() {
    let change = |steps_per_contact: f64| {
        let mut scene = crowd(false, None, 1.0);
        // Wide enough for the springs: the deepest overlap is about speed times the root of mass over stiffness.
        scene.numerics.shaped_contact.crust = 0.1;
        let (simulation, worst) = largest_change_of_energy(&mut scene, steps_per_contact);
        assert_eq!(simulation.ledger().total_work()["deep"], 0, "cores overlap: the scene is too soft");
        worst
    };
    assert_falls_at_second_order(change);
}

/// Of a crowd that is stiffened for its edges, within the time of its first collisions, over the energy at the start.
pub fn largest_change_of_energy(scene: &mut Scene, steps_per_contact: f64) -> (Simulation, f64) {
    let NormalLaw::LinearSpringDashpot(law) = &mut scene.pairs[0].normal else { panic!("the crowd has linear springs") };
    law.stiffness = 1e6;
    scene.numerics.steps_per_contact = StepsPerContact(steps_per_contact);
    let mut simulation = build(scene);
    let before = simulation.now().total_energy();
    let mut worst: f64 = 0.0;
    while simulation.time() < 0.004 {
        simulation.step();
        worst = worst.max((simulation.now().total_energy() / before - 1.0).abs());
    }
    (simulation, worst)
}

/// A change of energy at some number of steps to a contact: four times the steps, a sixteenth of it, half of that allowed.
pub fn assert_falls_at_second_order(change: impl Fn(f64) -> f64) {
    assert_falls_at_second_order_from(20.0, change);
}

/// The same from a number of steps to a contact at which its edges are resolved.
pub fn assert_falls_at_second_order_from(steps: f64, change: impl Fn(f64) -> f64) {
    let (coarse, fine) = (change(steps), change(4.0 * steps));
    assert!(fine < coarse / 8.0 && fine < 1e-3, "{coarse:.2e} at {steps} steps a contact, {fine:.2e} at four times as many");
}

/// Pairs that are certainly apart are not looked at. Whoever looks at all of them, as an observer does, sees no more contact points at any step;
/// fewer where a contact has ended before its overlap.
#[test]
fn no_contact_is_missed_where_pairs_are_not_looked_at() {
    let mut simulation = build(&crowd(true, Some(history()), 0.7));
    let mut seen = 0;
    while simulation.time() < 0.01 {
        let before = contacts_so_far(&simulation);
        let contacts = simulation.now().contacts().contacts;
        let counted = contacts_so_far(&simulation) - before;
        assert!(counted >= contacts, "{counted} of {contacts} at t = {} s", simulation.time());
        seen += contacts;
        simulation.step();
    }
    assert!(seen > 1000, "the bodies do not meet");
}

#[test]
fn neither_the_order_of_bodies_nor_that_of_parts_shows() {
    let scene = crowd(true, Some(history()), 0.7);
    let mut shuffled = scene.clone();
    shuffled.bodies.reverse();
    for shape in &mut shuffled.shapes {
        if let Geometry::Composite(composite) = &mut shape.geometry {
            composite.parts.rotate_left(1);
        }
    }
    let run = |scene: &Scene| {
        let mut simulation = build(scene);
        simulation.run_until(0.005).expect("no guard stops this run");
        (state_bits(&mut simulation), contacts_so_far(&simulation))
    };
    let (one, other) = (run(&scene), run(&shuffled));
    assert!(one.1 > 100, "the bodies do not meet");
    assert!(one == other, "the order of bodies or parts shows");
}

#[test]
fn a_run_resumed_is_the_run_that_went_on() {
    let scene = crowd(true, Some(history()), 0.7);
    let mut whole = build(&scene);
    whole.run_until(0.004).expect("no guard stops this run");
    let saved = whole.checkpoint().expect("the state is finite");
    let mut resumed = Simulation::resume(&scene, &saved).expect("the checkpoint belongs to the scene");
    for simulation in [&mut whole, &mut resumed] {
        simulation.run_until(0.008).expect("no guard stops this run");
    }
    assert!(state_bits(&mut whole) == state_bits(&mut resumed), "the resumed run differs");
}

/// Damped springs that are not shared take energy out of the motion, friction too; no shape and no number of contact points puts any in.
#[test]
fn damping_and_friction_never_add_energy() {
    let mut scene = crowd(false, Some(history()), 0.5);
    scene.numerics.steps_per_contact = StepsPerContact(50.0);
    let mut simulation = build(&scene);
    let start = simulation.now().total_energy();
    let mut least = start;
    while simulation.time() < 0.006 {
        simulation.step();
        let energy = simulation.now().total_energy();
        // Elastic motion at the same step swings by less than a thousandth.
        assert!(energy < least + 1e-3 * start, "energy rises by {:.1e} at {} s", (energy - least) / start, simulation.time());
        least = least.min(energy);
    }
    assert!(least < 0.95 * start, "nothing was lost");
}

/// One ball by itself and one ball called a composite meet other code and must do the same, whatever the sharing.
#[test]
fn a_composite_of_one_ball_is_that_ball() {
    let run = |geometry: Geometry, sharing: Sharing| {
        let mut scene = crowd(true, Some(history()), 0.7);
        scene.shapes[0] = sphere("ball", 0.004);
        scene.shapes.push(named("body", geometry));
        scene.numerics.shaped_contact.sharing = sharing;
        scene.bodies.truncate(2);
        for (body, x) in scene.bodies.iter_mut().zip([0.0, 0.0075]) {
            body.shape = "body".into();
            body.position = [x, 0.0, 0.0075 + 0.2 * x];
            body.velocity = [-x * 20.0, 0.1, -0.3];
            body.orientation = [1.0, 0.0, 0.0, 0.0];
        }
        scene.numerics.initial_overlap = solver::scene::InitialOverlap::Allow;
        scene.numerics.step = solver::scene::Step::Seconds(2e-6);
        let mut simulation = build(&scene);
        simulation.run_until(0.004).expect("no guard stops this run");
        let now = simulation.now();
        (now.velocity(0), now.angular_velocity(1) * 0.004)
    };
    let one = run(Geometry::Sphere(solver::scene::SphereGeometry { radius: 0.004 }), Sharing::Sum);
    for sharing in [Sharing::Sum, Sharing::ByOverlap, Sharing::ByCount] {
        let parts = vec![PartGeometry { shape: "ball".into(), position: [0.0; 3], orientation: [1.0, 0.0, 0.0, 0.0] }];
        let other = run(Geometry::Composite(CompositeGeometry { parts, mass_properties: None }), sharing);
        // A few thousand steps of rounding, in m/s.
        let floor = f64::EPSILON * 2000.0_f64.sqrt();
        assert!((one.0 - other.0).norm() < 100.0 * floor && (one.1 - other.1).norm() < 100.0 * floor, "{one:?} {other:?}");
    }
}

/// A part that floats beside the others is allowed, and said.
#[test]
fn parts_that_do_not_touch_are_said() {
    let mut scene = crowd(true, None, 1.0);
    scene.bodies.truncate(1);
    let entry = |scene: &Scene| {
        let ledger = build(scene).ledger();
        ledger.entries.into_iter().find(|entry| entry.stage == "shape `glued`").map(|entry| entry.reason)
    };
    let whole = entry(&scene).expect("the ledger speaks of composites");
    assert!(whole.contains("3 parts") && !whole.contains("do not touch"), "{whole}");
    if let Some(Geometry::Composite(composite)) = scene.shapes.last_mut().map(|shape| &mut shape.geometry) {
        composite.parts[0].position = [0.0, 0.0, 0.02];
    }
    let apart = entry(&scene).expect("the ledger speaks of composites");
    assert!(apart.contains("2 groups that do not touch"), "{apart}");
}

/// Two balls on a stick along x, stood upright: its lower ball reaches the floor, which it does not when it lies.
#[test]
fn parts_turn_with_their_body() {
    let overlaps = |orientation: [f64; 4]| {
        let mut scene = crowd(true, None, 1.0);
        let at = |x: f64| PartGeometry { shape: "ball".into(), position: [x, 0.0, 0.0], orientation: [1.0, 0.0, 0.0, 0.0] };
        scene
            .shapes
            .push(named("dumbbell", Geometry::Composite(CompositeGeometry { parts: vec![at(-0.01), at(0.01)], mass_properties: None })));
        // The floor lies at 3 mm; a ball has a radius of 4 mm.
        scene.bodies = vec![Body { position: [0.0, 0.0, 0.0165], orientation, ..Body::new("dumbbell", "clay") }];
        scene.build().err().is_some_and(|error| error.kind == solver::scene::SceneErrorKind::Overlap)
    };
    assert!(overlaps([1.0, 0.0, 1.0, 0.0]), "the lower ball is half a millimetre in the floor");
    assert!(!overlaps([1.0, 0.0, 0.0, 0.0]), "both balls are far above the floor");
}
