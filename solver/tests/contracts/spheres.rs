//! Contracts of scenes of spheres.

use solver::scene::{
    Body, Boundary, BoundaryGeometry, ContactEdges, EndOfContact, General, Geometry, LinearHistory, LinearSpringDashpot, Material, Measure,
    NamedShape, NormalLaw, Pair, PlaneGeometry, Probe, Scene, SphereGeometry, TangentialLaw,
};
use solver::{Simulation, Vector};

pub fn sphere(name: &str, radius: f64) -> NamedShape {
    NamedShape { name: name.into(), geometry: Geometry::Sphere(SphereGeometry { radius }) }
}

pub fn law(restitution: f64) -> NormalLaw {
    NormalLaw::LinearSpringDashpot(LinearSpringDashpot { stiffness: 1e4, restitution, end_of_contact: EndOfContact::ZeroOverlap })
}

pub fn history() -> TangentialLaw {
    TangentialLaw::LinearHistory(LinearHistory { friction: 0.4, stiffness: 3e3, damping_ratio: 0.1 })
}

/// Forty spheres of two sizes thrown at each other and on a floor, with friction.
fn crowd(gravity: Option<[f64; 3]>, with_floor: bool) -> Scene {
    let mut scene = Scene::empty("crowd", 0.05);
    scene.scene = General { gravity, ..scene.scene };
    scene.materials = vec![Material { name: "glass".into(), density: Some(2500.0) }, Material { name: "floor".into(), density: None }];
    scene.pairs = vec![
        Pair { materials: ["glass".into(), "glass".into()], normal: law(0.8), tangential: Some(history()), rolling: None },
        Pair { materials: ["glass".into(), "floor".into()], normal: law(0.6), tangential: Some(history()), rolling: None },
    ];
    scene.shapes = vec![sphere("small", 0.004), sphere("large", 0.006)];
    for index in 0..40_u32 {
        let place = |divisor: u32, modulus: u32| f64::from(index / divisor % modulus);
        let wobble = |seed: u32| f64::from((index * 7919 + seed * 104_729) % 1000) / 1000.0 - 0.5;
        let position = [0.0125 * place(1, 4), 0.0125 * place(4, 4), 0.007 + 0.0125 * place(16, 4)];
        scene.bodies.push(Body {
            id: Some(index * 3 + 1),
            position,
            velocity: [wobble(1), wobble(2), wobble(3) - 0.5],
            angular_velocity: [40.0 * wobble(4), 40.0 * wobble(5), 40.0 * wobble(6)],
            ..Body::new(if index % 3 == 0 { "large" } else { "small" }, "glass")
        });
    }
    if with_floor {
        let geometry = BoundaryGeometry::Plane(PlaneGeometry { point: [0.0; 3], normal: [0.0, 0.0, 2.0] });
        scene.boundaries = vec![Boundary::new("ground", "floor", geometry)];
    }
    scene
}

/// Positions, velocities and spins of all bodies as bits, by id.
pub fn state_bits(simulation: &mut Simulation) -> Vec<u64> {
    let now = simulation.now();
    now.bodies()
        .by_id()
        .flat_map(|index| [now.position(index), now.velocity(index), now.angular_velocity(index)])
        .flat_map(|vector| [vector.x.to_bits(), vector.y.to_bits(), vector.z.to_bits()])
        .collect()
}

pub fn build(scene: &Scene) -> Simulation {
    scene.build().expect("the scene builds")
}

#[test]
fn a_restarted_run_is_bitwise_the_same() {
    let scene = crowd(Some([0.0, 0.0, -9.81]), true);
    let mut whole = build(&scene);
    whole.run_until(0.02).expect("no guard stops this run");
    for steps_before in [1, 137] {
        let mut first = build(&scene);
        for _ in 0..steps_before {
            first.step();
        }
        // Looking evaluates forces and contact memory early; that must not show.
        first.now().total_energy();
        let text = first.checkpoint().expect("the state is finite");
        let mut second = Simulation::resume(&scene, &text).expect("the same scene");
        second.run_until(0.02).expect("no guard stops this run");
        assert!(state_bits(&mut whole) == state_bits(&mut second), "a restart after {steps_before} steps shows");
        assert_eq!(whole.ledger(), second.ledger());
    }
    assert!(whole.ledger().total_work()["contacts"] > 1000, "the run must have contacts: {}", whole.ledger());
}

#[test]
fn a_checkpoint_of_another_scene_is_refused() {
    let scene = crowd(None, false);
    let text = build(&scene).checkpoint().expect("the state is finite");
    let mut other = scene.clone();
    other.bodies[3].velocity[0] += 1e-9;
    let error = Simulation::resume(&other, &text).err().expect("another scene must be refused");
    assert!(error.to_string().contains("another scene"), "{error}");
    assert!(Simulation::resume(&scene, &text[..text.len() / 2]).is_err());
    let mut longer = scene;
    longer.scene.end_time *= 2.0;
    assert!(Simulation::resume(&longer, &text).is_ok(), "a run may be continued further");
}

#[test]
fn the_order_of_bodies_in_the_scene_does_not_show() {
    let scene = crowd(Some([0.0, 0.0, -9.81]), true);
    let mut shuffled = scene.clone();
    shuffled.bodies.reverse();
    shuffled.bodies.swap(3, 17);
    shuffled.pairs.reverse();
    shuffled.pairs[0].materials.swap(0, 1);
    let (mut one, mut other) = (build(&scene), build(&shuffled));
    one.run_until(0.05).expect("no guard stops this run");
    other.run_until(0.05).expect("no guard stops this run");
    assert!(state_bits(&mut one) == state_bits(&mut other), "the order of bodies shows");
}

#[test]
fn looking_does_not_change_what_happens() {
    let scene = crowd(Some([0.0, 0.0, -9.81]), true);
    let (mut watched, mut alone) = (build(&scene), build(&scene));
    for _ in 0..500 {
        watched.now().total_energy();
        watched.step();
        alone.step();
    }
    assert!(state_bits(&mut watched) == state_bits(&mut alone), "looking shows");
}

#[test]
fn momentum_and_angular_momentum_are_kept_by_contacts_with_friction() {
    let mut simulation = build(&crowd(None, false));
    let (momentum, angular) = (simulation.now().momentum(), simulation.now().angular_momentum());
    simulation.run_until(0.05).expect("no guard stops this run");
    let work = simulation.ledger().total_work();
    assert!(work["contacts"] > 1000);
    let now = simulation.now();
    let largest = (0..now.bodies().len()).map(|index| now.bodies().mass(index) * now.velocity(index).norm()).fold(0.0, f64::max);
    // Every kick and drift rounds once, at the size of the momentum of one grain; the errors add up as a random walk.
    let floor = f64::EPSILON * largest * (work["body_steps"] as f64).sqrt();
    assert!((now.momentum() - momentum).norm() < 10.0 * floor, "{}", (now.momentum() - momentum).norm() / floor);
    let reach = 0.1;
    assert!((now.angular_momentum() - angular).norm() < 10.0 * floor * reach);
}

/// A ball of 5 mm between two walls that squeeze it, with a strong dashpot at each: the advised step must calm it down.
#[test]
fn strong_dashpots_on_one_body_are_stable_at_the_advised_step() {
    for (restitution, end_of_contact) in
        [(0.005, EndOfContact::NoAttraction), (0.1, EndOfContact::NoAttraction), (0.0, EndOfContact::ZeroOverlap)]
    {
        for steps_per_contact in [3.0, 10.0, 50.0] {
            let mut scene = crowd(None, true);
            scene.bodies.truncate(1);
            scene.bodies[0].position = [0.0, 0.0, 0.006 - 5e-6];
            scene.bodies[0].velocity = [0.0, 0.0, 1e-3];
            let mut lid = scene.boundaries[0].clone();
            lid.name = "lid".into();
            lid.geometry = BoundaryGeometry::Plane(PlaneGeometry { point: [0.0, 0.0, 0.012 - 1e-5], normal: [0.0, 0.0, -1.0] });
            scene.boundaries.push(lid);
            let normal = LinearSpringDashpot { stiffness: 1e4, restitution, end_of_contact };
            scene.pairs[1] = Pair { normal: NormalLaw::LinearSpringDashpot(normal), tangential: None, ..scene.pairs[1].clone() };
            scene.numerics.initial_overlap = solver::scene::InitialOverlap::Allow;
            scene.numerics.steps_per_contact = solver::scene::StepsPerContact(steps_per_contact);
            let mut simulation = build(&scene);
            let start = simulation.now().total_energy();
            simulation.run_until(0.05).expect("no guard stops this run");
            let end = simulation.now().total_energy();
            assert!(end <= start, "e = {restitution}, {steps_per_contact} steps: energy {start} J became {end} J");
        }
    }
}

/// Without attraction the force is the larger of zero and spring plus dashpot: gravity may bring it back while the surfaces still overlap. The
/// two treatments of edges must converge to the same motion.
#[test]
fn edges_resolved_and_sampled_converge_to_the_same_motion_under_gravity() {
    let velocity_at_end = |edges, steps_per_contact: f64| {
        let mut scene = crowd(Some([0.0, 0.0, -9.81]), true);
        scene.bodies.truncate(1);
        scene.bodies[0].position = [0.0, 0.0, 0.006 + 1e-8];
        scene.bodies[0].velocity = [0.0, 0.0, -0.15];
        let normal = LinearSpringDashpot { stiffness: 1e4, restitution: 0.1, end_of_contact: EndOfContact::NoAttraction };
        scene.pairs[1] = Pair { normal: NormalLaw::LinearSpringDashpot(normal), tangential: None, ..scene.pairs[1].clone() };
        scene.numerics.contact_edges = edges;
        scene.numerics.steps_per_contact = solver::scene::StepsPerContact(steps_per_contact);
        let mut simulation = build(&scene);
        simulation.run_until(2.5e-3).expect("no guard stops this run");
        simulation.now().velocity(0).z
    };
    let difference = |steps| (velocity_at_end(ContactEdges::Resolved, steps) - velocity_at_end(ContactEdges::Sampled, steps)).abs();
    let (coarse, fine) = (difference(500.0), difference(4000.0));
    // Sampled edges are of first order: eight times the steps, an eighth of the difference, with a factor of two for the phase of the start.
    assert!(fine < coarse / 4.0 && fine < 1e-4, "{coarse} m/s at 500 steps, {fine} m/s at 4000");
}

/// A ball thrown obliquely at a ball: the torque of friction must act with the lever arm of the contact point, in the right sense. The two
/// balls then keep their common angular momentum, and each spins up to slow the slip down.
#[test]
fn friction_spins_bodies_so_that_slip_falls() {
    let mut scene = crowd(None, false);
    scene.bodies.truncate(2);
    for (body, position, velocity) in [(0, [0.0, 0.0, 0.0], [0.0; 3]), (1, [0.0, 0.0, 0.0101], [0.3, 0.0, -1.0])] {
        scene.bodies[body].position = position;
        scene.bodies[body].velocity = velocity;
        scene.bodies[body].angular_velocity = [0.0; 3];
    }
    let mut simulation = build(&scene);
    simulation.run_until(5e-3).expect("no guard stops this run");
    let now = simulation.now();
    for index in 0..2 {
        assert!(now.angular_velocity(index).y > 1.0, "both balls spin as gears do: {}", now.angular_velocity(index));
    }
    let slip_after = now.velocity(1).x - now.velocity(0).x - now.angular_velocity(1).y * 0.004 - now.angular_velocity(0).y * 0.006;
    assert!(slip_after.abs() < 0.3, "slip fell from 0.3 m/s to {slip_after}");
}

/// A second bounce knows nothing of the first: it goes as in a scene that starts between the two.
#[test]
fn a_contact_that_has_ended_is_forgotten() {
    let mut scene = crowd(Some([0.0, 0.0, -9.81]), true);
    scene.bodies.truncate(1);
    scene.bodies[0].position = [0.0, 0.0, 0.0063];
    scene.bodies[0].velocity = [0.4, 0.1, -0.5];
    scene.bodies[0].angular_velocity = [0.0; 3];
    let mut whole = build(&scene);
    let contacts_after = |simulation: &mut Simulation, steps: usize| {
        (0..steps).for_each(|_| simulation.step());
        simulation.ledger().total_work()["contacts"]
    };
    let mut steps = 0;
    while whole.bodies().half_step_velocity(0).z < 0.0 || whole.now().contacts().contacts > 0 {
        whole.step();
        steps += 1;
        assert!(steps < 100_000, "the ball bounces");
    }
    let first_bounce = contacts_after(&mut whole, 10);
    let now = whole.now();
    let mut between = scene.clone();
    between.bodies[0].position = now.position(0).into();
    between.bodies[0].velocity = now.velocity(0).into();
    between.bodies[0].angular_velocity = now.angular_velocity(0).into();
    let mut fresh = build(&between);
    let flight = (2.2 * 0.6 * 0.5 / 9.81 / whole.time_step()) as usize;
    let second_bounce = contacts_after(&mut fresh, flight);
    assert!(second_bounce > 10, "there is a second bounce");
    assert_eq!(contacts_after(&mut whole, flight) - first_bounce, second_bounce);
    let (whole, fresh) = (whole.now(), fresh.now());
    // The fresh run differs by the rounding of its start, which a flight of as many steps as this adds up.
    let floor = f64::EPSILON * flight as f64;
    assert!((whole.velocity(0) - fresh.velocity(0)).norm() < 1e3 * floor);
    assert!((whole.angular_velocity(0) - fresh.angular_velocity(0)).norm() * 0.006 < 1e3 * floor);
}

#[test]
fn what_a_scene_does_not_need_is_not_there() {
    let mut scene = crowd(None, false);
    for pair in &mut scene.pairs {
        pair.tangential = None;
    }
    let mut simulation = build(&scene);
    simulation.run_until(0.01).expect("no guard stops this run");
    let ledger = simulation.ledger();
    for stage in ["gravity", "spin of isotropic bodies", "free turns"] {
        let entry = ledger.entries.iter().find(|entry| entry.stage == stage).unwrap_or_else(|| panic!("{stage} is listed"));
        assert!(!entry.used && entry.work.is_empty() && !entry.reason.is_empty(), "{entry:?}");
    }
    assert!(!ledger.total_work().contains_key("turns"));
    // Asking to see orientations brings the spin back without touching the motion of the centres.
    scene.probes = vec![Probe { measure: Measure::Orientation, body: None }];
    let mut seen = build(&scene);
    seen.run_until(0.01).expect("no guard stops this run");
    assert!(seen.ledger().total_work()["turns"] > 0);
    assert!(state_bits(&mut simulation) == state_bits(&mut seen), "the motion of the centres must not change");
    let turned = seen.now().orientation(0).angle();
    let spin = Vector::from(scene.bodies[0].angular_velocity).norm();
    assert!((turned - spin * seen.time()).abs() < 1e-9, "a free sphere turns by its spin times the time");
}
