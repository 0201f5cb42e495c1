//! Contracts of walls that move, are curved, finite or made of faces, with one body each.

use std::f64::consts::TAU;

use solver::scene::{Scene, SceneErrorKind};
use solver::{Simulation, Vector};

use crate::spheres::build;

/// Radius in m of the ball.
const RADIUS: f64 = 0.01;
/// Stiffness of its normal contacts in N/m.
const STIFFNESS: f64 = 1e5;
const GRAVITY: f64 = 9.81;

const FRICTION: &str = "tangential = { linear_history = { friction = 0.4, stiffness = 5e4, damping_ratio = 0.0 } }";
const SLIDING: &str = "tangential = { viscous_coulomb = { friction = 0.2, damping_rate = 1e3 } }";
const FLOOR: &str = "plane = { point = [0, 0, 0], normal = [0, 0, 1] }";
const PLATE: &str = "plate = { corners = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]] }";
/// Two triangles whose seam runs along x = y.
const SEAM: &str = "mesh = { vertices = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], triangles = [[0, 1, 2], [0, 2, 3]] }";

/// One body at walls, as text.
struct Setup {
    body: &'static str,
    position: Vector,
    velocity: Vector,
    gravity: bool,
    restitution: f64,
    tangential: &'static str,
    step: f64,
    /// More keys of the body and of `[numerics]`.
    orientation: &'static str,
    numerics: &'static str,
    walls: Vec<(String, String)>,
}

impl Setup {
    /// A ball over walls at rest.
    fn ball(position: Vector, velocity: Vector, walls: &[&str]) -> Setup {
        let walls = walls.iter().map(|wall| ((*wall).to_string(), String::new())).collect();
        Setup {
            body: "ball",
            position,
            velocity,
            gravity: true,
            restitution: 0.8,
            tangential: "",
            step: 1e-5,
            orientation: "",
            numerics: "",
            walls,
        }
    }

    fn moving(mut self, motion: &str) -> Setup {
        self.walls.iter_mut().for_each(|wall| wall.1 = format!("motion = {{ {motion} }}"));
        self
    }

    fn text(&self) -> String {
        let gravity = if self.gravity { format!("gravity = [0.0, 0.0, {}]", -GRAVITY) } else { String::new() };
        let list = |vector: &Vector| format!("[{:?}, {:?}, {:?}]", vector.x, vector.y, vector.z);
        let walls = self.walls.iter().enumerate().map(|(index, (geometry, motion))| {
            format!("[[boundary]]\nname = \"wall {index}\"\nmaterial = \"glass\"\ngeometry = {{ {geometry} }}\n{motion}\n")
        });
        format!(
            r#"
[scene]
name = "walls"
end_time = 10.0
{gravity}
[numerics]
step = {:?}
initial_overlap = "allow"
{}
[[material]]
name = "glass"
density = 2500.0
[[pair]]
materials = ["glass", "glass"]
normal = {{ linear_spring_dashpot = {{ stiffness = {STIFFNESS:?}, restitution = {:?} }} }}
{}
[[shape]]
name = "ball"
geometry = {{ sphere = {{ radius = {RADIUS} }} }}
[[shape]]
name = "cube"
geometry = {{ cuboid = {{ lengths = [0.02, 0.02, 0.02] }} }}
[[shape]]
name = "egg"
geometry = {{ superellipsoid = {{ semi_axes = [0.01, 0.01, 0.02], exponents = [1.0, 1.0] }} }}
[[body]]
shape = "{}"
material = "glass"
position = {}
velocity = {}
{}
{}
"#,
            self.step,
            self.numerics,
            self.restitution,
            self.tangential,
            self.body,
            list(&self.position),
            list(&self.velocity),
            self.orientation,
            walls.collect::<String>(),
        )
    }

    fn scene(&self) -> Scene {
        Scene::from_toml(&self.text(), "walls.toml").unwrap_or_else(|error| panic!("{error}\n{}", self.text()))
    }

    fn at(&self, time: f64) -> Simulation {
        let mut simulation = build(&self.scene());
        simulation.run_until(time).expect("no guard stops this run");
        simulation
    }
}

/// Mass of the ball in kg, and the overlap in m under which it rests.
fn mass_and_overlap() -> (f64, f64) {
    let mass = 2500.0 * 2.0 / 3.0 * TAU * RADIUS.powi(3);
    (mass, mass * GRAVITY / STIFFNESS)
}

fn contacts(simulation: &Simulation) -> u64 {
    simulation.ledger().total_work()["contacts"]
}

/// Away from edges a plate and a mesh are a plane, the seam of its faces included: oblique bounces with friction, then rolling over the seam.
#[test]
fn a_ball_over_a_plate_or_a_seam_goes_as_over_a_plane() {
    let end = |wall: &str| {
        let setup = Setup {
            tangential: FRICTION,
            restitution: 0.3,
            ..Setup::ball(Vector::new(-0.02, 0.03, 0.011), Vector::new(0.9, -0.3, -0.5), &[wall])
        };
        let mut simulation = setup.at(0.3);
        let now = simulation.now();
        (now.position(0), now.velocity(0), now.angular_velocity(0) * RADIUS, contacts(&simulation))
    };
    let (position, velocity, spin, count) = end(FLOOR);
    assert!(position.x > position.y && count > 10_000, "over the seam, in contact: {position} {count}");
    for wall in [PLATE, SEAM] {
        let found = end(wall);
        assert_eq!(found.3, count, "{wall}");
        // Coordinates of a metre are rounded in each of 30000 steps; a contact turns an overlap into a velocity at its frequency of 3000/s.
        let floor = f64::EPSILON * 3e4_f64.sqrt();
        let off = ((found.0 - position).norm(), (found.1 - velocity).norm(), (found.2 - spin).norm());
        assert!(off.0 < 1e2 * floor && off.1 < 3e5 * floor && off.2 < 3e5 * floor, "{wall}: {off:?}");
    }
}

/// Times at which x passes zero downwards, in a horizontal trough of 0.1 m, from an angle at rest.
fn swings(tangential: &'static str, angle: f64, number: usize) -> (Vec<f64>, f64) {
    let length = 0.1 - RADIUS + mass_and_overlap().1;
    let position = Vector::new(length * angle.sin(), 0.5, -length * angle.cos());
    let trough = "cylinder = { centre = [0, 7, 0], axis = [0, 1, 0], radius = 0.1 }";
    let setup = Setup { tangential, restitution: 1.0, step: 2e-5, ..Setup::ball(position, Vector::zeros(), &[trough]) };
    let mut simulation = build(&setup.scene());
    let before = simulation.now().total_energy();
    let mut times = Vec::new();
    let mut last = position.x;
    let mut worst: f64 = 0.0;
    while times.len() < number {
        simulation.step();
        let place = simulation.bodies().position(0).x;
        if last > 0.0 && place <= 0.0 {
            times.push(simulation.time() - simulation.time_step() * place / (place - last));
            worst = worst.max((simulation.now().total_energy() - before).abs());
        }
        last = place;
        assert!(simulation.time() < 5.0, "it swings");
    }
    (times, worst / (mass_and_overlap().0 * GRAVITY * length * (1.0 - angle.cos())))
}

/// Frictionless, the ball is a pendulum of the length from the axis to its centre; if it rolls, its inertia makes that longer by 7/5, less what the overlap
/// takes from the arm. Period for small angles: $2 \pi \sqrt{L/g} (1 + \theta^2/16)$.
#[test]
fn a_ball_in_a_trough_swings_as_a_pendulum_and_keeps_its_energy() {
    let angle: f64 = 0.02;
    let overlap = mass_and_overlap().1;
    let arm = RADIUS - 0.5 * overlap;
    let rolling = 1.0 + 0.4 * (RADIUS / arm).powi(2);
    for (tangential, inertia, within) in [("", 1.0, 2e-7), (FRICTION, rolling, 2e-5)] {
        let (times, change) = swings(tangential, angle, 4);
        let exact = TAU * ((0.1 - RADIUS + overlap) * inertia / GRAVITY).sqrt() * (1.0 + angle * angle / 16.0);
        let found = (times[3] - times[0]) / 3.0;
        // Of the rolling ball the spring of friction gives way by 2/7 m g / k L = 6e-6 of the way.
        assert!((found / exact - 1.0).abs() < within, "{tangential}: {found} s, {exact} s: {:e}", found / exact - 1.0);
        assert!(change < 1e-5, "{change:e} of the energy of the swing");
    }
}

/// The same in the frame of the wall: restitution, friction, rest. Walls of every kind, balls and cubes.
#[test]
fn a_wall_in_steady_motion_is_a_wall_at_rest_in_its_frame() {
    let wind = Vector::new(0.3, -0.2, 1.1);
    let motion = "translation = { velocity = [0.3, -0.2, 1.1] }";
    let vessel = "cylinder = { centre = [0, 0, 0.1], axis = [1, 1, 0], radius = 0.1 }";
    for body in ["ball", "cube"] {
        // A cube on a corner: where it lies flat, rounding decides on contact points of no area.
        for wall in [FLOOR, PLATE, vessel].into_iter().chain((body == "ball").then_some(SEAM)) {
            let setup = |velocity: Vector| {
                let ball = Setup::ball(Vector::new(0.003, 0.005, if body == "cube" { 0.018 } else { 0.0105 }), velocity, &[wall]);
                let orientation = if body == "cube" { "orientation = [0.9, 0.3, 0.2, 0.1]" } else { "" };
                Setup { body, tangential: FRICTION, step: 2e-6, orientation, ..ball }
            };
            let thrown = Vector::new(0.4, 0.1, -0.3);
            let (mut rest, mut moved) = (setup(thrown).at(8e-3), setup(thrown + wind).moving(motion).at(8e-3));
            assert_eq!(contacts(&rest), contacts(&moved), "{body} {wall}");
            assert!(contacts(&rest) > 100 && rest.ledger().total_work()["deep"] == 0, "{body} {wall}");
            let time = rest.time();
            let (rest, moved) = (rest.now(), moved.now());
            let off = (
                (rest.position(0) + wind * time - moved.position(0)).norm(),
                (rest.velocity(0) + wind - moved.velocity(0)).norm(),
                (rest.angular_velocity(0) - moved.angular_velocity(0)).norm() * RADIUS,
            );
            // 4000 roundings of places in m and of speeds in m/s; the frequency of contacts is 3000/s.
            let floor = f64::EPSILON * 4000.0_f64.sqrt();
            assert!(off.0 < 10.0 * floor && off.1 < 3e4 * floor && off.2 < 3e4 * floor, "{body} {wall}: {off:?}");
        }
    }
}

/// A wall of 1 m/s that meets a ball at rest sends it off with 1 + e, whichever face of it, whatever the step and its phase.
#[test]
fn restitution_holds_for_the_speed_against_the_wall() {
    for (wall, side) in [(FLOOR, 1.0), (PLATE, 1.0), (PLATE, -1.0)] {
        let motion = format!("translation = {{ velocity = [0, 0, {side:?}] }}");
        let ball = Setup::ball(Vector::z() * side * 0.01013, Vector::zeros(), &[wall]).moving(&motion);
        let mut end = Setup { gravity: false, step: 1e-6, ..ball }.at(5e-3);
        let speed = end.now().velocity(0).z * side;
        // Of the law at this step, 1000 of them to a contact: second order.
        assert!((speed - 1.8).abs() < 1e-5, "{wall} {side}: {speed}");
    }
}

/// On a belt a ball slips under constant friction until it rolls: $v = a \omega\, I/(m a^2)$, at the time $V / (\mu g (1 + m a^2/I))$.
#[test]
fn a_ball_on_a_belt_slips_until_it_rolls() {
    let (mass, overlap) = mass_and_overlap();
    let arm = RADIUS - 0.5 * overlap;
    let ratio = arm * arm / (0.4 * RADIUS * RADIUS);
    let belt = |time: f64| {
        let ball =
            Setup::ball(Vector::z() * (RADIUS - overlap), Vector::zeros(), &[PLATE]).moving("translation = { velocity = [0.5, 0, 0] }");
        Setup { tangential: SLIDING, ..ball }.at(time)
    };
    let slip_time = 0.5 / (0.2 * GRAVITY * (1.0 + ratio));
    let mut slipping = belt(0.5 * slip_time);
    let now = slipping.now();
    let (speed, spin) = (now.velocity(0), now.angular_velocity(0));
    let expected = 0.2 * GRAVITY * now.time();
    assert!((speed.x / expected - 1.0).abs() < 1e-9 && speed.yz().norm() < 1e-9, "{speed} {expected}");
    // The top of the ball goes against the belt.
    let turned = -expected * mass * arm / (0.4 * mass * RADIUS * RADIUS);
    assert!((spin.y / turned - 1.0).abs() < 1e-9 && spin.xz().norm() < 1e-7, "{spin} {turned}");
    // Rolling: friction stops, slip is gone as the viscous law lets it, in (1 + ratio) parts of 1 ms.
    let mut rolling = belt(slip_time + 0.02);
    let now = rolling.now();
    assert!((now.velocity(0).x - 0.5 / (1.0 + ratio)).abs() < 1e-6, "{}", now.velocity(0));
    assert!((now.velocity(0).x - now.angular_velocity(0).y * arm - 0.5).abs() < 1e-6);
}

/// The wall of a drum that turns about its axis runs away under a ball, which follows and spins under constant friction.
#[test]
fn a_drum_that_turns_spins_a_ball_up() {
    let (_, overlap) = mass_and_overlap();
    let drum = "cylinder = { centre = [0, 0, 0.1], axis = [0, 1, 0], radius = 0.1 }";
    let motion = "rotation = { point = [0, 3, 0.1], axis = [0, 1, 0], angular_velocity = 20.0 }";
    let ball = Setup::ball(Vector::z() * (RADIUS - overlap), Vector::zeros(), &[drum]).moving(motion);
    let mut end = Setup { tangential: SLIDING, ..ball }.at(5e-3);
    let now = end.now();
    // 20/s y x -0.1 m z = -2 m/s x at the bottom.
    let speed = -0.2 * GRAVITY * now.time();
    let spin = -speed / (0.4 * RADIUS);
    // It has climbed to an angle of 3e-4, from where gravity has taken g t^2 / 6 L = 5e-4 of the speed.
    assert!((now.velocity(0).x / speed - 1.0).abs() < 1e-3, "{} {speed}", now.velocity(0));
    assert!((now.angular_velocity(0).y / spin - 1.0).abs() < 1e-3, "{} {spin}", now.angular_velocity(0));
}

/// A ball at rest on a gate falls from the time of its removal, which is put in the middle of a step, as kicks are.
#[test]
fn a_gate_that_is_removed_lets_the_ball_fall() {
    let (mass, overlap) = mass_and_overlap();
    let at = Vector::z() * (RADIUS - overlap);
    let gate = |geometry| Setup::ball(at, Vector::zeros(), &[geometry]).moving("removed_at = 0.010005");
    for geometry in [PLATE, FLOOR, "box = { lower = [-1, -1, 0], upper = [1, 1, 1] }"] {
        let mut held = gate(geometry).at(0.01);
        assert!(held.now().velocity(0).norm() < 1e-12 && held.now().contacts().contacts == 1);
        let mut falls = gate(geometry).at(0.06);
        let now = falls.now();
        let time = now.time() - 0.010005;
        assert!((now.velocity(0).z / (-GRAVITY * time) - 1.0).abs() < 1e-10, "{geometry}: {}", now.velocity(0));
        assert!((at.z - now.position(0).z - 0.5 * GRAVITY * time * time).abs() < 1e-5 * 1e-5 * GRAVITY, "{geometry}");
        assert_eq!(now.contacts().contacts, 0);
        // The spring of the gate went with it; nothing else is lost.
        let energy = mass * GRAVITY * at.z;
        assert!((now.total_energy() / energy - 1.0).abs() < 3e-8, "{geometry}");
    }
}

/// A cube that falls flat on a plate: the corners of the common face are those of the cube.
#[test]
fn a_cube_bounces_and_rests_on_a_plate_as_on_a_plane() {
    let fall = |wall: &str, time: f64| {
        let cube = Setup::ball(Vector::new(0.1, -0.2, 0.0105), Vector::z() * -0.3, &[wall]);
        // With its crust at the plane too, so that contact points are at the same places.
        let numerics = "shaped_contact = { crust_at_walls = true }";
        let mut simulation = Setup { body: "cube", restitution: 0.5, step: 5e-6, numerics, ..cube }.at(time);
        let now = simulation.now();
        (now.position(0).z, now.velocity(0).z, now.contacts().contacts)
    };
    for time in [0.005, 0.05, 0.5] {
        let (plane, plate) = (fall(FLOOR, time), fall(PLATE, time));
        assert!((plane.0 - plate.0).abs() < 1e-12 && (plane.1 - plate.1).abs() < 1e-9, "{time}: {plane:?} {plate:?}");
        assert_eq!(plane.2, plate.2);
    }
    assert_eq!(fall(PLATE, 0.5).2, 4);
}

/// A corner that goes deeper than its crust into a plate a hundred times as wide as the cube is pushed back at the corner.
#[test]
fn a_corner_meets_a_plate_as_a_plane_however_deep() {
    let bounce = |wall: &str| {
        let cube = Setup::ball(Vector::new(0.1, -0.2, 0.018), Vector::new(0.3, 0.0, -0.9), &[wall]);
        let (orientation, numerics) = ("orientation = [0.9, 0.3, 0.2, 0.1]", "shaped_contact = { crust_at_walls = true }");
        let mut simulation = Setup { body: "cube", tangential: FRICTION, step: 2e-6, orientation, numerics, ..cube }.at(3e-3);
        let deep = simulation.ledger().total_work()["deep"];
        let now = simulation.now();
        (now.velocity(0), now.angular_velocity(0) * 0.01, deep)
    };
    let (plane, plate) = (bounce(FLOOR), bounce(PLATE));
    assert!(plate.2 > 10, "not deep");
    let off = ((plane.0 - plate.0).norm(), (plane.1 - plate.1).norm());
    assert!(plane.1.norm() > 0.01 && off.0 < 1e-9 && off.1 < 1e-9, "{plane:?} {plate:?}");
}

#[test]
fn bodies_that_a_wall_does_not_know_are_refused_by_key() {
    let refusal = |text: String| {
        let error = Scene::from_toml(&text, "walls.toml").and_then(|scene| scene.build()).map(|_| ()).expect_err("refused");
        assert_eq!(error.kind, SceneErrorKind::Unsupported, "{error}");
        (error.key.clone(), error.message)
    };
    let with = |body: &'static str, wall: &str| Setup { body, ..Setup::ball(Vector::z() * 0.03, Vector::zeros(), &[FLOOR, wall]) };
    let tube = "cylinder = { centre = [0, 0, 0], axis = [0, 0, 1], radius = 1, length = 4 }";
    let vessel = "cylinder = { centre = [0, 0, 0], axis = [0, 0, 1], radius = 1 }";
    let walls = "box = { lower = [-1, -1, -1], upper = [1, 1, 1] }";
    for (body, wall, wanted) in
        [("egg", PLATE, "superellipsoids touch no walls but planes"), ("egg", vessel, "superellipsoids"), ("cube", tube, "tube with ends")]
    {
        let (key, message) = refusal(with(body, wall).text());
        assert_eq!(key, "boundary[1].geometry", "{message}");
        assert!(message.contains(wanted) && message.contains("wall 1"), "{message}");
    }
    for (body, wall) in [("cube", vessel), ("ball", tube), ("egg", walls)] {
        with(body, wall).scene().build().unwrap_or_else(|error| panic!("{error}"));
    }
    let hard = |setup: Setup| {
        let soft = format!("linear_spring_dashpot = {{ stiffness = {STIFFNESS:?}, restitution = 0.8 }}");
        let text = setup.text().replace(&soft, "impulse = { restitution = 0.8 }").replace("initial_overlap = \"allow\"", "");
        assert!(text.contains("impulse"));
        text
    };
    for (setup, wanted) in [
        (with("ball", PLATE), "boundary[1].geometry"),
        (Setup::ball(Vector::z() * 0.03, Vector::zeros(), &[FLOOR]).moving("removed_at = 1.0"), "boundary[0].motion"),
    ] {
        let (key, message) = refusal(hard(setup));
        assert_eq!(key, wanted, "{message}");
        assert!(message.contains("hard bodies know no walls but planes"), "{message}");
    }
    Scene::from_toml(&hard(with("ball", walls)), "walls.toml").unwrap().build().map(|_| ()).unwrap_or_else(|error| panic!("{error}"));
}
