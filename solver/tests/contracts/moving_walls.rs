//! A crowd among walls that move: lists, restarts, and continuations that tell walls anew.

use solver::{Scene, Simulation};

use crate::spheres::{build, state_bits};

const FRICTION: &str = "tangential = { linear_history = { friction = 0.4, stiffness = 5e4, damping_ratio = 0.0 } }";
const FLOOR: &str = "plane = { point = [0, 0, 0], normal = [0, 0, 1] }";

/// Balls and bricks in a vessel that turns, on a floor that shakes, under a paddle that comes down turning.
fn stirred(search: &str) -> Scene {
    let mut bodies = String::new();
    for index in 0..108_u32 {
        let place = |divisor: u32, modulus: u32| f64::from(index / divisor % modulus);
        let wobble = |seed: u32| f64::from((index * 7919 + seed * 104_729) % 1000) / 1000.0 - 0.5;
        let shape = if index % 4 == 0 { "brick" } else { "ball" };
        let position = [0.0125 * (place(1, 6) - 2.5), 0.0125 * (place(6, 6) - 2.5), 0.009 + 0.0125 * place(36, 3)];
        let velocity = [3.0 * wobble(1), 3.0 * wobble(2), 3.0 * wobble(3) - 1.0];
        bodies += &format!(
            "[[body]]\nid = {index}\nshape = \"{shape}\"\nmaterial = \"glass\"\nposition = {position:?}\nvelocity = {velocity:?}\n\
             angular_velocity = [{:?}, 40.0, {:?}]\n",
            80.0 * wobble(4),
            80.0 * wobble(5)
        );
    }
    let text = format!(
        r#"
[scene]
name = "stirred"
end_time = 1.0
gravity = [0.0, 0.0, -9.81]
[numerics]
step = 2e-6
neighbours = {{ {search} }}
[[material]]
name = "glass"
density = 2500.0
[[pair]]
materials = ["glass", "glass"]
normal = {{ linear_spring_dashpot = {{ stiffness = 1e5, restitution = 0.8 }} }}
{FRICTION}
[[shape]]
name = "ball"
geometry = {{ sphere = {{ radius = 0.006 }} }}
[[shape]]
name = "brick"
geometry = {{ cuboid = {{ lengths = [0.006, 0.007, 0.005] }} }}
{bodies}
[[boundary]]
name = "paddle"
material = "glass"
geometry = {{ plate = {{ corners = [[-0.03, -0.02, 0.05], [0.03, -0.02, 0.05], [0.03, 0.02, 0.05], [-0.03, 0.02, 0.05]] }} }}
motion = {{ translation = {{ velocity = [0, 0, -2] }}, rotation = {{ point = [0, 0, 0.05], axis = [1, 5, 0], angular_velocity = 50.0 }} }}
[[boundary]]
name = "floor"
material = "glass"
geometry = {{ {FLOOR} }}
motion = {{ oscillation = {{ amplitude = [0.0002, 0, 0.001], frequency = 400.0 }} }}
[[boundary]]
name = "drum"
material = "glass"
geometry = {{ cylinder = {{ centre = [0, 0, 0], axis = [0, 0, 1], radius = 0.055 }} }}
motion = {{ rotation = {{ point = [0, 0, 0], axis = [0, 0, 1], angular_velocity = -30.0 }}, removed_at = 0.003 }}
[[boundary]]
name = "lid"
material = "glass"
geometry = {{ plane = {{ point = [0, 0, 0.1], normal = [0, 0, -1] }} }}
"#
    );
    Scene::from_toml(&text, "stirred.toml").unwrap_or_else(|error| panic!("{error}"))
}

const STIRRED_UNTIL: f64 = 4e-3;

#[test]
fn a_list_misses_no_contact_with_walls_that_move() {
    let mut oracle = build(&stirred("method = \"all_pairs\""));
    oracle.run_until(STIRRED_UNTIL).expect("no guard stops this run");
    for skin in [2e-4, 2e-3] {
        let mut listed = build(&stirred(&format!("method = \"list\", skin = {skin:?}")));
        listed.run_until(STIRRED_UNTIL).expect("no guard stops this run");
        let lists = listed.ledger().total_work()["lists"];
        assert!(lists > 2 && lists < listed.steps_taken() / 2, "{lists} lists");
        assert!(state_bits(&mut oracle) == state_bits(&mut listed), "a contact was missed with a skin of {skin} m");
    }
    // Every kind of stage has been at work.
    let ledger = oracle.ledger();
    for stage in ["at walls that move", "shaped bodies"] {
        let entry = ledger.entries.iter().find(|entry| entry.reason.contains(stage)).unwrap_or_else(|| panic!("{stage}: {ledger}"));
        assert!(entry.work["contacts"] > 1000, "{entry:?}");
    }
}

#[test]
fn a_restart_among_moving_walls_is_bitwise_the_same() {
    let scene = stirred("method = \"list\", skin = 1e-3, lists_between_sorts = 2");
    let mut whole = build(&scene);
    whole.run_until(STIRRED_UNTIL).expect("no guard stops this run");
    for steps in [1, 777] {
        let mut first = build(&scene);
        (0..steps).for_each(|_| first.step());
        // Looking evaluates forces early; that must not show, here or in what is seen right after the restart.
        let energy = first.now().total_energy();
        let text = first.checkpoint().expect("the state is finite");
        let mut second = Simulation::resume(&scene, &text).expect("the same scene");
        assert_eq!(second.now().total_energy().to_bits(), energy.to_bits(), "seen differently after {steps} steps");
        second.run_until(STIRRED_UNTIL).expect("no guard stops this run");
        assert!(state_bits(&mut whole) == state_bits(&mut second), "a restart after {steps} steps shows");
        assert_eq!(whole.ledger(), second.ledger());
    }
}

/// A gate whose time is told only once the run has come to rest: the same bits as if it had been known from the start. What is past cannot be told anew.
#[test]
fn what_walls_will_do_may_be_told_in_a_continuation_but_not_what_they_did() {
    let with_times = |turns_from: f64, removed_at: f64| {
        let mut scene = stirred("method = \"list\", skin = 1e-3");
        let motion = scene.boundaries[2].motion.as_mut().expect("the drum moves");
        motion.rotation.as_mut().expect("it turns").start = turns_from;
        motion.removed_at = Some(removed_at);
        scene
    };
    let (known, unknown) = (with_times(1.6e-3, 3e-3), with_times(10.0, 20.0));
    let mut whole = build(&known);
    whole.run_until(STIRRED_UNTIL).expect("no guard stops this run");
    let mut first = build(&unknown);
    first.run_until(1.5e-3).expect("no guard stops this run");
    let text = first.checkpoint().expect("the state is finite");
    let mut second = Simulation::resume(&known, &text).expect("the same until now");
    second.run_until(STIRRED_UNTIL).expect("no guard stops this run");
    assert!(state_bits(&mut whole) == state_bits(&mut second));
    first.run_until(STIRRED_UNTIL).expect("no guard stops this run");
    assert!(state_bits(&mut first) != state_bits(&mut second), "the drum must matter");
    for (turns_from, removed_at) in [(1e-3, 3e-3), (1.6e-3, 1.5e-3)] {
        let error = Simulation::resume(&with_times(turns_from, removed_at), &text).err().expect("the past is what it was");
        assert!(error.to_string().contains("another scene"), "{error}");
    }
    let mut faster = known.clone();
    faster.boundaries[2].motion.as_mut().and_then(|motion| motion.rotation.as_mut()).expect("it turns").angular_velocity = -31.0;
    assert!(Simulation::resume(&faster, &text).is_err(), "only times may be told anew");
}

#[test]
fn the_order_of_bodies_does_not_show_at_walls() {
    let scene = stirred("method = \"list\", skin = 1e-3, lists_between_sorts = 1");
    let mut turned = scene.clone();
    turned.bodies.reverse();
    let (mut one, mut other) = (build(&scene), build(&turned));
    one.run_until(STIRRED_UNTIL).expect("no guard stops this run");
    other.run_until(STIRRED_UNTIL).expect("no guard stops this run");
    assert!(state_bits(&mut one) == state_bits(&mut other));
}
