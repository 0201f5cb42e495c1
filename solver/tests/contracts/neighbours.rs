//! Contracts of the neighbour list: it misses nothing, and neither lists, sorting, threads nor periodic sides show in the results.

use solver::scene::{
    Body, Boundary, BoundaryGeometry, CuboidGeometry, Domain, General, Geometry, Material, NamedShape, Pair, PlaneGeometry, RodGeometry,
    Scene, SearchMethod, Step,
};
use solver::{Simulation, Vector};

use crate::spheres::{build, history, law, sphere, state_bits};

/// Numbers in [-0.5, 0.5) that look random, one stream for each seed.
fn wobble(index: u32, seed: u32) -> f64 {
    let mixed = (u64::from(index) << 32 | u64::from(seed)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    ((mixed ^ mixed >> 29).wrapping_mul(0xBF58_476D_1CE4_E5B9) >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
}

/// A fast crowd of balls whose sizes differ by a hundred, and of bricks, in a box of walls.
fn mixed_crowd(count: u32, end_time: f64) -> Scene {
    let mut scene = Scene::empty("mixed crowd", end_time);
    scene.scene = General { gravity: Some([0.0, 0.0, -9.81]), ..scene.scene };
    scene.materials = vec![Material { name: "glass".into(), density: Some(2500.0) }, Material { name: "wall".into(), density: None }];
    let pair =
        |other: &str| Pair { materials: ["glass".into(), other.into()], normal: law(0.9), tangential: Some(history()), rolling: None };
    scene.pairs = vec![pair("glass"), pair("wall")];
    let brick = CuboidGeometry { lengths: [0.004, 0.006, 0.01] };
    scene.shapes = vec![
        sphere("dust", 0.0002),
        sphere("sand", 0.002),
        sphere("boulder", 0.02),
        NamedShape { name: "brick".into(), geometry: Geometry::Cuboid(brick) },
    ];
    for (name, normal) in [("left", [1.0, 0.0, 0.0]), ("front", [0.0, 1.0, 0.0]), ("ground", [0.0, 0.0, 1.0])] {
        let geometry = |point| BoundaryGeometry::Plane(PlaneGeometry { point, normal });
        scene.boundaries.push(Boundary::new(name, "wall", geometry([0.0; 3])));
        let back = BoundaryGeometry::Plane(PlaneGeometry { point: [0.12; 3], normal: normal.map(|coordinate: f64| -coordinate) });
        scene.boundaries.push(Boundary::new(&format!("opposite {name}"), "wall", back));
    }
    let mut balls: Vec<(Vector, f64)> = Vec::new();
    for index in 0..count {
        let (shape, radius) = match index % 16 {
            0 if index < 32 => ("boulder", 0.02),
            1..=5 => ("sand", 0.002),
            6..=8 => ("brick", 0.007),
            _ => ("dust", 0.0002),
        };
        // The first place of many where it touches nothing.
        let is_free = |place: &Vector| balls.iter().all(|(other, other_radius)| (place - other).norm() > radius + other_radius);
        let places = (0..1000).map(|attempt| {
            let coordinate = |axis: u32| 0.06 + (0.12 - 2.1 * radius) * wobble(index, 100 * attempt + axis);
            Vector::new(coordinate(1), coordinate(2), coordinate(3))
        });
        let place = places.into_iter().find(is_free).expect("there is room for so many");
        balls.push((place, radius));
        scene.bodies.push(Body {
            id: Some(index),
            position: place.into(),
            velocity: [4.0 * wobble(index, 4), 4.0 * wobble(index, 5), 4.0 * wobble(index, 6)],
            angular_velocity: [40.0 * wobble(index, 7), 40.0 * wobble(index, 8), 40.0 * wobble(index, 9)],
            ..Body::new(shape, "glass")
        });
    }
    scene.numerics.step = Step::Seconds(5e-7);
    scene
}

fn with_search(mut scene: Scene, method: SearchMethod, skin: Option<f64>, lists_between_sorts: u32) -> Scene {
    scene.numerics.neighbours.method = method;
    scene.numerics.neighbours.skin = skin;
    scene.numerics.neighbours.lists_between_sorts = Some(lists_between_sorts);
    scene
}

fn lists_made(simulation: &Simulation) -> u64 {
    simulation.ledger().entries.iter().find(|entry| entry.stage == "neighbours").map_or(0, |entry| entry.work["lists"])
}

/// The same bits as with every pair tested at every step, so nothing was missed at any of them.
#[test]
fn a_list_misses_no_contact_of_a_fast_crowd_of_mixed_sizes_and_shapes() {
    let end_time = 2e-3;
    let mut oracle = build(&with_search(mixed_crowd(200, end_time), SearchMethod::AllPairs, None, 0));
    oracle.run_until(end_time).expect("no guard stops this run");
    for skin in [Some(1e-5), Some(1e-3), None] {
        let mut listed = build(&with_search(mixed_crowd(200, end_time), SearchMethod::List, skin, 0));
        listed.run_until(end_time).expect("no guard stops this run");
        assert!(lists_made(&listed) > 2, "the list must have been made anew: {}", lists_made(&listed));
        assert!(state_bits(&mut oracle) == state_bits(&mut listed), "a contact was missed with a skin of {skin:?} m");
    }
}

/// A rod that drifts away end to end from another is told from it by its gap; its pair leaves the list all the same as soon as the balls round both have parted,
/// and comes back before the rods can touch. What was known of it must not show.
#[test]
fn a_pair_that_leaves_the_list_and_comes_back_finds_what_one_that_stays_finds() {
    let mut met = 0;
    for index in 0..8 {
        let mut scene = Scene::empty("rods end to end", 2e-2);
        scene.materials = vec![Material { name: "glass".into(), density: Some(2500.0) }];
        scene.pairs =
            vec![Pair { materials: ["glass".into(), "glass".into()], normal: law(0.9), tangential: Some(history()), rolling: None }];
        let (radius, length) = (0.003, 0.03);
        scene.shapes = vec![NamedShape { name: "rod".into(), geometry: Geometry::Cylinder(RodGeometry { radius, length }) }];
        let plane = PlaneGeometry { point: [0.0, 0.0, 2.0 * length + 7e-4], normal: [0.0, 0.0, -1.0] };
        scene.boundaries = vec![Boundary::new("ceiling", "glass", BoundaryGeometry::Plane(plane))];
        let rod = |height: f64, tilt: f64| Body {
            position: [1e-3 * wobble(index, 1), 1e-3 * wobble(index, 2), height],
            orientation: [1.0, tilt * wobble(index, 3), tilt * wobble(index, 4), 0.0],
            ..Body::new("rod", "glass")
        };
        // The balls part at a gap of 6e-4 m.
        scene.bodies = vec![rod(0.5 * length, 0.0), Body { velocity: [0.0, 0.0, 0.1], ..rod(1.5 * length + 5e-4, 2e-3) }];
        scene.numerics.step = Step::Seconds(5e-6);
        let mut oracle = build(&with_search(scene.clone(), SearchMethod::AllPairs, None, 0));
        let mut listed = build(&with_search(scene, SearchMethod::List, Some(1e-6), 0));
        for simulation in [&mut oracle, &mut listed] {
            simulation.run_until(2e-2).expect("no guard stops this run");
        }
        met += u32::from(listed.bodies().position(0).z < 0.4999 * length);
        assert!(state_bits(&mut oracle) == state_bits(&mut listed), "{index}: the list shows");
    }
    assert_eq!(met, 8, "the rods must have met");
}

/// Sorting changes the order of sums, so rounding only; and whatever the order of bodies in the scene, not even that.
#[test]
fn sorting_in_space_does_not_depend_on_the_order_of_bodies() {
    let end_time = 5e-4;
    let scene = with_search(mixed_crowd(200, end_time), SearchMethod::List, Some(1e-4), 1);
    let mut sorted = build(&scene);
    sorted.run_until(end_time).expect("no guard stops this run");
    let mut turned = scene.clone();
    turned.bodies.reverse();
    let mut turned = build(&turned);
    turned.run_until(end_time).expect("no guard stops this run");
    assert!(state_bits(&mut sorted) == state_bits(&mut turned));
    let mut unsorted = build(&with_search(scene, SearchMethod::List, Some(1e-4), 0));
    unsorted.run_until(end_time).expect("no guard stops this run");
    let bits = (state_bits(&mut sorted), state_bits(&mut unsorted));
    let largest = bits.0.iter().zip(&bits.1).map(|(one, other)| (f64::from_bits(*one) - f64::from_bits(*other)).abs()).fold(0.0, f64::max);
    // Spins of dust, the largest numbers here, are some thousand rad/s; chaos has had a hundred steps.
    assert!(largest < 1e4 * 1e6 * f64::EPSILON, "sorting moved something by {largest:e}");
}

#[test]
fn a_restart_between_two_lists_is_bitwise_the_same() {
    let end_time = 4e-4;
    let scene = with_search(mixed_crowd(150, end_time), SearchMethod::List, Some(1e-4), 2);
    let mut whole = build(&scene);
    whole.run_until(end_time).expect("no guard stops this run");
    let mut first = build(&scene);
    (0..77).for_each(|_| first.step());
    let text = first.checkpoint().expect("the state is finite");
    let mut second = Simulation::resume(&scene, &text).expect("the same scene");
    second.run_until(end_time).expect("no guard stops this run");
    assert!(state_bits(&mut whole) == state_bits(&mut second), "a restart shows");
    assert_eq!(whole.ledger(), second.ledger());
}

/// Enough candidates for several parts, by a wide skin; balls and bricks.
#[test]
fn results_are_bitwise_the_same_on_any_number_of_threads() {
    let end_time = 2e-3;
    let scene = with_search(mixed_crowd(400, end_time), SearchMethod::List, Some(0.2), 0);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started");
        pool.install(|| {
            let mut simulation = build(&scene);
            simulation.run_until(end_time).expect("no guard stops this run");
            let pairs: u64 = simulation.ledger().entries.iter().filter_map(|entry| entry.work.get("pair_tests")).sum();
            assert!(pairs / simulation.steps_taken() > 6000, "too few pairs for three parts: {pairs}");
            let contacts = simulation.ledger().total_work()["contacts"];
            assert!(contacts > 100, "too few contacts for one between two parts: {contacts}");
            state_bits(&mut simulation)
        })
    };
    let alone = run(1);
    assert!(run(2) == alone && run(3) == alone);
}

fn periodic(mut scene: Scene, upper: [f64; 3], sides: [bool; 3]) -> Scene {
    scene.domain = Some(Domain { lower: [0.0; 3], upper, periodic: sides });
    scene
}

fn two_balls(positions: [[f64; 3]; 2], velocities: [[f64; 3]; 2]) -> Scene {
    let mut scene = Scene::empty("two balls", 0.01);
    scene.materials = vec![Material { name: "glass".into(), density: Some(2500.0) }];
    scene.pairs = vec![Pair { materials: ["glass".into(), "glass".into()], normal: law(0.8), tangential: Some(history()), rolling: None }];
    scene.shapes = vec![sphere("ball", 0.005)];
    scene.bodies = positions
        .into_iter()
        .zip(velocities)
        .map(|(position, velocity)| Body { position, velocity, angular_velocity: [3.0, -20.0, 7.0], ..Body::new("ball", "glass") })
        .collect();
    scene.numerics.step = Step::Seconds(1e-6);
    scene
}

/// A collision across the side is the one in the open, displaced.
#[test]
fn balls_collide_across_a_periodic_side_as_in_the_open() {
    let velocities = [[-0.5, 0.1, 0.0], [0.5, 0.0, 0.05]];
    let mut open = build(&two_balls([[0.106, 0.05, 0.05], [0.094, 0.051, 0.05]], velocities));
    let mut across = build(&periodic(two_balls([[0.006, 0.05, 0.05], [0.094, 0.051, 0.05]], velocities), [0.1; 3], [true; 3]));
    open.run_until(0.01).expect("no guard stops this run");
    across.run_until(0.01).expect("no guard stops this run");
    for index in 0..2 {
        let (here, there) = (open.now().velocity(index), across.now().velocity(index));
        // Rounding of places of size 0.1 in overlaps of size 1e-4, through a contact.
        assert!((here - there).norm() < 1e3 * f64::EPSILON * 0.1 / 1e-4, "{here} {there}");
        let apart = open.bodies().position(index) - across.bodies().position(index);
        let whole_lengths = (apart / 0.1).map(f64::round) * 0.1;
        assert!((apart - whole_lengths).norm() < 1e-12, "{apart}");
    }
    assert!(open.now().velocity(0).x > 0.1, "they must have met");
}

/// A body that meets images of itself further off than one period is refused, with the numbers.
#[test]
fn a_box_shorter_than_its_bodies_is_refused() {
    let mut scene = periodic(two_balls([[0.05; 3]; 2], [[0.0; 3]; 2]), [0.0099, 1.0, 1.0], [true, false, false]);
    scene.bodies.truncate(1);
    scene.numerics.neighbours.skin = Some(1e-9);
    let error = scene.build().err().expect("the box is shorter than the ball").to_string();
    assert!(error.contains("domain.upper") && error.contains("0.0099") && error.contains("0.010000001"), "{error}");
    scene.domain.as_mut().expect("it was set").upper[0] = 0.0101;
    assert_eq!(build(&scene).now().contacts().contacts, 0);
}
