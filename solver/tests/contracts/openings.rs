//! Contracts of bodies that come and go, and of the criterion of rest.

use solver::scene::SceneErrorKind;
use solver::{Scene, Simulation, Vector};

use crate::spheres::state_bits;

/// A funnel: balls of several sizes and bricks rain from a window on a slope of two walls and leave through the slit between them, over and over.
fn rain(during_run: &str, numerics: &str) -> String {
    format!(
        r#"
scene = {{ name = "rain", gravity = [0.0, 0.0, -9.81], end_time = 0.25, random_seed = 3 }}

[[material]]
name = "glass"
density = 2500.0

[[pair]]
materials = ["glass", "glass"]
normal = {{ linear_spring_dashpot = {{ stiffness = 500.0, restitution = 0.5 }} }}
tangential = {{ linear_history = {{ friction = 0.3, stiffness = 150.0 }} }}

[[shape]]
name = "ball"
geometry = {{ sphere = {{ radius = 0.004 }} }}

[[shape]]
name = "brick"
geometry = {{ cuboid = {{ lengths = [0.005, 0.006, 0.007] }} }}

[[body]]
shape = "ball"
material = "glass"
position = [0.011, 0.0, 0.02]

[[body]]
id = 7
shape = "brick"
material = "glass"
position = [-0.01, 0.01, 0.021]

[[insertion]]
name = "cloud"
material = "glass"
number = 150
shapes = [{{ shape = "ball", fraction = 3.0, scale = [0.5, 1.0] }}, {{ shape = "brick" }}]
region = {{ box = {{ lower = [-0.01, -0.01, 0.04], upper = [0.01, 0.01, 0.05] }} }}
velocity = [0.1, 0.0, -0.5]
angular_velocity = [1.0, 2.0, 3.0]
during_run = {during_run}

[[outlet]]
name = "below"
region = {{ behind_plane = {{ point = [0.0, 0.0, -0.01], normal = [0.0, 0.0, 2.0] }} }}

[[outlet]]
name = "hole"
region = {{ box = {{ lower = [0.01, 0.01, 0.0], upper = [0.03, 0.03, 0.02] }} }}

[[boundary]]
name = "left"
material = "glass"
geometry = {{ plate = {{ corners = [[-0.007, -0.03, 0.0], [-0.007, 0.03, 0.0], [-0.03, 0.03, 0.03], [-0.03, -0.03, 0.03]] }} }}

[[boundary]]
name = "right"
material = "glass"
geometry = {{ plate = {{ corners = [[0.007, -0.03, 0.0], [0.007, 0.03, 0.0], [0.03, 0.03, 0.03], [0.03, -0.03, 0.03]] }} }}

[numerics]
step = 2e-5
{numerics}
"#
    )
}

fn build(text: &str) -> Simulation {
    Scene::from_toml(text, "rain.toml").and_then(|scene| scene.build()).expect("this scene is one")
}

const AS_THERE_IS_ROOM: &str = "{ start = 0.01 }";

fn departures_of(simulation: &Simulation) -> Vec<(u32, u32, u64)> {
    simulation.departures().iter().map(|departure| (departure.id, departure.outlet, departure.time.to_bits())).collect()
}

/// All come, most have left, nobody is counted twice or lost, and nobody who comes in overlaps anybody.
#[test]
fn bodies_come_as_there_is_room_and_leave_with_their_ids_and_times() {
    let mut simulation = build(&rain(AS_THERE_IS_ROOM, ""));
    assert_eq!((simulation.bodies().len(), simulation.ids().len()), (2, 152));
    let mut largest: f64 = 0.0;
    while simulation.time() < 0.25 {
        let before = simulation.bodies().len() + simulation.departures().len();
        simulation.step();
        let came = simulation.bodies().len() + simulation.departures().len() - before;
        if came > 0 {
            let bodies = simulation.bodies();
            let radius = |index: usize| bodies.shape(index).bounding_radius();
            for new in bodies.by_id().skip(bodies.len() - came) {
                for other in (0..bodies.len()).filter(|other| *other != new) {
                    assert!((bodies.position(new) - bodies.position(other)).norm() >= radius(new) + radius(other));
                }
            }
        }
        largest = largest.max(simulation.now().contacts().largest_overlap);
    }
    let left = simulation.departures();
    assert!(left.len() > 50 && left.iter().any(|departure| departure.outlet == 1), "{}", left.len());
    assert!(left.is_sorted_by(|one, other| (one.time, one.id) < (other.time, other.id)));
    let mut all: Vec<u32> = left.iter().map(|departure| departure.id).collect();
    all.extend((0..simulation.bodies().len()).map(|index| simulation.bodies().id(index)));
    all.sort_unstable();
    let expected: Vec<u32> = [0, 7].into_iter().chain(8..158).collect();
    assert_eq!(all, expected);
    // Bodies do collide on their way.
    assert!(largest > 1e-5, "{largest}");
    for index in 0..simulation.bodies().len() {
        assert!(simulation.bodies().position(index).z >= -0.01);
    }
}

/// Neither the way neighbours are found, nor where memory is stored, nor looking shows in the bits.
#[test]
fn coming_and_going_is_bitwise_the_same_with_all_pairs_and_lists_looked_at_or_not() {
    let run = |numerics: &str, looks: bool| {
        let mut simulation = build(&rain(AS_THERE_IS_ROOM, numerics));
        while simulation.time() < 0.2 {
            simulation.step();
            if looks {
                simulation.now().kinetic_energy();
            }
        }
        (state_bits(&mut simulation), departures_of(&simulation))
    };
    let oracle = run("neighbours = { method = \"all_pairs\" }", false);
    assert!(oracle.1.len() > 30);
    assert!(run("neighbours = { method = \"list\", skin = 0.0005 }", false) == oracle);
    assert!(run("neighbours = { method = \"list\", skin = 0.003 }", true) == oracle);
}

#[test]
fn a_restart_with_coming_and_going_is_bitwise_the_same() {
    for method in ["all_pairs", "list"] {
        let text = rain("{ rate = 800.0 }", &format!("neighbours = {{ method = \"{method}\", lists_between_sorts = 3 }}"));
        let mut whole = build(&text);
        whole.run_until(0.25).expect("no guard stops this run");
        let scene = Scene::from_toml(&text, "rain.toml").expect("a scene");
        for steps in [0, 1, 3000, 9000] {
            let mut first = build(&text);
            (0..steps).for_each(|_| first.step());
            let saved = first.checkpoint().expect("the state is finite");
            let mut second = Simulation::resume(&scene, &saved).expect("the same scene");
            second.run_until(0.25).expect("no guard stops this run");
            assert!(state_bits(&mut whole) == state_bits(&mut second), "{method}: a restart after {steps} steps shows");
            assert_eq!(whole.ledger(), second.ledger());
            assert_eq!(departures_of(&whole), departures_of(&second));
        }
    }
}

/// A checkpoint whose record was tampered with is refused, not believed and no reason to panic.
#[test]
fn a_checkpoint_of_other_passages_is_refused() {
    let text = rain(AS_THERE_IS_ROOM, "");
    let scene = Scene::from_toml(&text, "rain.toml").expect("a scene");
    let mut simulation = build(&text);
    simulation.run_until(0.15).expect("no guard stops this run");
    let saved: serde_json::Value = serde_json::from_str(&simulation.checkpoint().expect("finite")).expect("JSON");
    assert!(Simulation::resume(&scene, &saved.to_string()).is_ok());
    type Change = fn(&mut serde_json::Value);
    let changes: [Change; 6] = [
        |saved| saved["passed"]["came_by"][3] = 9.into(),
        |saved| saved["passed"]["inflows"][0]["inserted"] = 4_000_000_000_u32.into(),
        |saved| saved["passed"]["departures"][0]["outlet"] = 2.into(),
        |saved| saved["passed"]["departures"] = serde_json::json!([]),
        |saved| saved["ids"][0] = saved["ids"][1].clone(),
        |saved| saved["passed"] = serde_json::Value::Null,
    ];
    for (number, change) in changes.into_iter().enumerate() {
        let mut other = saved.clone();
        change(&mut other);
        assert!(Simulation::resume(&scene, &other.to_string()).is_err(), "change {number}");
    }
}

/// A body that comes in between two steps flies the parabola from its place and velocity, to the last step and the last digit.
#[test]
fn a_body_that_comes_late_flies_the_exact_parabola() {
    let text = rain(AS_THERE_IS_ROOM, "").replace("number = 150", "number = 1").replace(
        "region = { box = { lower = [-0.01, -0.01, 0.04], upper = [0.01, 0.01, 0.05] } }",
        "region = { point = { position = [0.1, 0.2, 0.3] } }",
    );
    let mut simulation = build(&text);
    simulation.run_until(0.05).expect("no guard stops this run");
    let index = simulation.bodies().index_of(8).expect("it is in");
    // It is due at 0.01 s, the end of a step.
    let flown = 0.04;
    let (start, velocity, gravity) = (Vector::new(0.1, 0.2, 0.3), Vector::new(0.1, 0.0, -0.5), Vector::new(0.0, 0.0, -9.81));
    // Leapfrog is exact on a parabola; each of 2000 steps rounds.
    let place = start + velocity * flown + gravity * (0.5 * flown * flown);
    let now = simulation.now();
    assert!((now.position(index) - place).norm() < 2000.0 * f64::EPSILON, "{}", now.position(index) - place);
    assert!((now.velocity(index) - velocity - gravity * flown).norm() < 2000.0 * f64::EPSILON);
    assert_eq!(now.angular_velocity(index), Vector::new(1.0, 2.0, 3.0));
}

/// A window that has filled up ends the run with how many are left, and what there was is kept.
#[test]
fn a_body_that_waits_in_vain_ends_the_run() {
    let text = rain("{ patience = 0.02 }", "").replace("gravity = [0.0, 0.0, -9.81], ", "").replace("velocity = [0.1, 0.0, -0.5]\n", "");
    let error = build(&text).run_until(0.2).expect_err("nothing makes room").to_string();
    assert!(error.contains("insertion `cloud`: no room for the last") && error.contains("of 150 bodies after 0.02"), "{error}");
}

/// Across a periodic side there is room only where no image is.
#[test]
fn who_comes_in_sees_images_across_periodic_sides() {
    let text = r#"
scene = { name = "images", end_time = 0.01, random_seed = 5 }
domain = { lower = [0.0, 0.0, 0.0], upper = [0.05, 0.05, 0.05], periodic = [true, true, true] }
material = [{ name = "glass", density = 2500.0 }]
shape = [{ name = "ball", geometry = { sphere = { radius = 0.004 } } }]
numerics = { step = 1e-5 }

[[pair]]
materials = ["glass", "glass"]
normal = { linear_spring_dashpot = { stiffness = 500.0, restitution = 0.5 } }

[[insertion]]
name = "crowd"
material = "glass"
number = 150
shapes = [{ shape = "ball" }]
region = { box = { lower = [0.0, 0.0, 0.0], upper = [0.05, 0.05, 0.05] } }
during_run = { attempts_per_step = 100 }
"#;
    let mut simulation = build(text);
    simulation.run_until(0.01).expect("no guard stops this run");
    assert!(simulation.bodies().len() > 100, "{}", simulation.bodies().len());
    // Nobody moves, so nobody touches unless an image was overlooked.
    assert_eq!(simulation.now().contacts().contacts, 0);
    assert_eq!(simulation.now().kinetic_energy(), 0.0);
}

/// A ball on the ground, dropped from a height: the run ends when it has bounced out, held for as long as is asked, and after its fall, not before.
#[test]
fn a_run_ends_when_bodies_have_settled() {
    let text = r#"
scene = { name = "drop", gravity = [0.0, 0.0, -9.81], end_time = 10.0, settled = { speed = 1e-3, hold = 0.05 } }
material = [{ name = "glass", density = 2500.0 }]
shape = [{ name = "ball", geometry = { sphere = { radius = 0.005 } } }]
boundary = [{ name = "floor", material = "glass", geometry = { plane = { point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0] } } }]
body = [{ shape = "ball", material = "glass", position = [0.0, 0.0, 0.055] }]
numerics = { step = 1e-5 }

[[pair]]
materials = ["glass", "glass"]
normal = { linear_spring_dashpot = { stiffness = 1000.0, restitution = 0.5 } }
"#;
    let mut simulation = build(text);
    simulation.run_until(10.0).expect("no guard stops this run");
    // Newton's law: the fall from 0.05 m, then bounces whose times are a geometric series: t (1 + 2 e / (1 - e)) = 3 t; contacts of 1e-3 s or so add to it.
    let bounced_out = 3.0 * (2.0_f64 * 0.05 / 9.81).sqrt();
    let (expected, time) = (bounced_out + 0.05, simulation.time());
    assert!(simulation.has_settled() && time > 0.95 * expected && time < 1.25 * expected, "{time} s, expected {expected} s");
    let saved = simulation.checkpoint().expect("finite");
    let scene = Scene::from_toml(text, "drop.toml").expect("a scene");
    assert!(Simulation::resume(&scene, &saved).expect("the same scene").has_settled());
    let mut half = build(text);
    half.run_until(time - 0.02).expect("no guard stops this run");
    let mut resumed = Simulation::resume(&scene, &half.checkpoint().expect("finite")).expect("the same scene");
    resumed.run_until(10.0).expect("no guard stops this run");
    assert_eq!((resumed.time(), state_bits(&mut resumed)), (time, state_bits(&mut simulation)));
}

#[test]
fn openings_and_rests_that_cannot_be_are_refused_by_key() {
    let text = rain(AS_THERE_IS_ROOM, "");
    let hard = |with: &str| {
        let hard = "normal = { impulse = { restitution = 0.5 } }\n";
        let (before, rest) = text.split_once("normal = { linear").expect("a law");
        let rest = rest.split_once("[[shape]]").expect("shapes").1;
        let scene = format!("{before}{hard}[[shape]]{rest}");
        let (before, rest) = scene.split_once("[[boundary]]").expect("walls");
        format!("{before}[numerics]{}", rest.split_once("[numerics]").expect("numerics").1)
            .replace("during_run = { start = 0.01 }\n", with)
            .replace("number = 150", "number = 3")
    };
    for (text, kind, key, wanted) in [
        (text.replace("[0.0, 0.0, 2.0]", "[0.0, 0.0, 0.0]"), SceneErrorKind::Value, "outlet[0].region.behind_plane.normal", "no direction"),
        (text.replace("[0.0, 0.0, -0.01]", "[0.0, 0.0, nan]"), SceneErrorKind::Value, "outlet[0].region.behind_plane.point", "NaN"),
        (
            text.replace("upper = [0.03, 0.03, 0.02]", "upper = [0.03, 0.01, 0.02]"),
            SceneErrorKind::Value,
            "outlet[1].region.box.upper",
            "above",
        ),
        (text.replace("\"hole\"", "\"below\""), SceneErrorKind::Reference, "outlet[1].name", "twice"),
        (text.replace("behind_plane", "behind"), SceneErrorKind::Format, "outlet[0].region.behind", "behind_plane"),
        (
            text.replace("seed = 3", "seed = 3, settled = { speed = 0.0, hold = 1.0 }"),
            SceneErrorKind::Value,
            "scene.settled.speed",
            "above 0",
        ),
        (
            text.replace("seed = 3", "seed = 3, settled = { speed = 1.0, hold = -1.0 }"),
            SceneErrorKind::Value,
            "scene.settled.hold",
            "above 0",
        ),
        (text.replace("seed = 3", "seed = 3, settled = { speed = 1.0 }"), SceneErrorKind::Format, "scene.settled", "hold"),
        (text.replace("id = 7", "id = 4294967200"), SceneErrorKind::Combination, "body", "do not suffice for 150 bodies"),
        (hard("during_run = {}\n"), SceneErrorKind::Unsupported, "insertion[0].during_run", "hard bodies"),
        (hard(""), SceneErrorKind::Unsupported, "outlet[0]", "hard bodies"),
    ] {
        let error =
            Scene::from_toml(&text, "rain.toml").and_then(|scene| scene.build()).err().unwrap_or_else(|| panic!("{key} must be refused"));
        assert_eq!((error.kind, error.key.as_str()), (kind, key), "{error}");
        assert!(error.to_string().contains(wanted), "{error}");
    }
}

/// Bodies as tables are where they were and move as they did, in sizes of their own and with the masses that were given.
#[test]
fn a_run_can_start_where_another_one_is() {
    let text = rain(AS_THERE_IS_ROOM, "initial_overlap = \"allow\"").replace("position = [0.011", "mass = 0.001\nposition = [0.011");
    let mut first = build(&text);
    first.run_until(0.03).expect("no guard stops this run");
    let tables = first.as_tables();
    let mut scene = Scene::from_toml(&text, "rain.toml").expect("a scene");
    scene.shapes.extend(tables.shapes);
    scene.bodies = tables.bodies;
    scene.insertions.clear();
    let mut second = scene.build().expect("a scene");
    assert_eq!(first.bodies().len(), second.bodies().len());
    assert!((0..second.bodies().len()).any(|index| second.bodies().mass(index) == 0.001));
    let places: Vec<(u32, Vector)> =
        (0..first.bodies().len()).map(|index| (first.bodies().id(index), first.now().position(index))).collect();
    for (id, place) in places {
        let (here, there) = (first.bodies().index_of(id).expect("it is there"), second.bodies().index_of(id).expect("it was taken over"));
        assert_eq!(first.bodies().mass(here), second.bodies().mass(there));
        assert_eq!(place, second.now().position(there));
        assert!((first.now().velocity(here) - second.now().velocity(there)).norm() == 0.0);
        assert!((first.now().angular_velocity(here) - second.now().angular_velocity(there)).norm() < 1e-12);
        assert!(
            first.now().orientation(here).angle_to(&second.now().orientation(there)) < 1e-7
                || first.bodies().shape(here).as_sphere().is_some()
        );
    }
}
