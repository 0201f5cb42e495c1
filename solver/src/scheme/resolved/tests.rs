use std::sync::Arc;

use super::*;
use crate::coupling::resolved::balance::Stop;
use crate::coupling::resolved::immersed::TOUCHING;
use crate::coupling::resolved::matter::Matter;
use crate::coupling::resolved::surface::Ball;
use crate::coupling::resolved::unsteady::{Body, Settings};
use crate::fluid::grid::{FaceField, Grid};
use crate::fluid::periodic::PeriodicBox;
use crate::scene::{Coupling, Direction, ImmersedMotion, MovingSides, NormalLaw, ResolvedCoupling};
use crate::{Orientation, Scene, Simulation};

const SPACING: f64 = 1e-3;
const RADIUS: f64 = 3e-3;
const DENSITY: f64 = 1000.0;
const GRAVITY: f64 = 10.0;
const STIFFNESS: f64 = 400.0;

/// A scene of a fluid in a box of so many cells, with more of a scene file.
fn scene(cells: [usize; 3], periodic: [bool; 3], density: f64, more: &str) -> Scene {
    let upper = cells.map(|cells| cells as f64 * SPACING);
    let coupling = if more.contains("[[body]]") { "coupling = { resolved = {} }" } else { "" };
    let text = format!(
        r#"
scene = {{ name = "in a fluid", end_time = 1.0 }}
domain = {{ lower = [0.0, 0.0, 0.0], upper = {upper:?}, periodic = {periodic:?} }}
{coupling}
[fluid]
density = {DENSITY:?}
viscosity = 0.02
spacing = {SPACING:?}
step = 1e-3
slip = 1e-8
[[material]]
name = "ball"
density = {density:?}
[[material]]
name = "side"
[[shape]]
name = "ball"
geometry = {{ sphere = {{ radius = {RADIUS:?} }} }}
{more}"#
    );
    Scene::from_toml(&text, "a test").expect("a sound scene")
}

fn with_gravity(mut scene: Scene) -> Scene {
    scene.scene.gravity = Some([0.0, 0.0, -GRAVITY]);
    scene
}

fn ball_at(position: [f64; 3], velocity: [f64; 3]) -> String {
    format!("[[body]]\nshape = \"ball\"\nmaterial = \"ball\"\nposition = {position:?}\nvelocity = {velocity:?}\n")
}

fn contacts(of: [&str; 2], restitution: f64) -> String {
    let law = format!("{{ linear_spring_dashpot = {{ stiffness = {STIFFNESS:?}, restitution = {restitution:?} }} }}");
    format!("[[pair]]\nmaterials = {of:?}\nnormal = {law}\n")
}

fn side(name: &str, point: [f64; 3], normal: [f64; 3]) -> String {
    let plane = format!("{{ plane = {{ point = {point:?}, normal = {normal:?} }} }}");
    format!("[[boundary]]\nname = \"{name}\"\nmaterial = \"side\"\ngeometry = {plane}\n")
}

fn run(simulation: &mut Simulation, fluid_steps: u32) {
    let end = simulation.time() + f64::from(fluid_steps) * 1e-3;
    simulation.run_until(end).expect("a run without harm");
}

fn volume() -> f64 {
    4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3)
}

/// The flow's own extrapolation of places is that of a constant pull.
#[test]
fn a_body_that_touches_nothing_moves_as_the_flow_alone_moves_it() {
    let at = [6.1e-3, 5.7e-3, 9.3e-3];
    let mut simulation = with_gravity(scene([12; 3], [true; 3], 1500.0, &ball_at(at, [0.0; 3]))).build().expect("a ball in its box");
    let grid = Grid::new([12; 3], SPACING, Vector::zeros()).expect("enough cells");
    let settings = Settings {
        density: DENSITY,
        viscosity: 0.02,
        advection: true,
        gravity: Vector::new(0.0, 0.0, -GRAVITY),
        driving: Driving::Force(Vector::zeros()),
        walls: [None; 3],
        fringe: None,
        step: 1e-3,
        stop: Stop { slip: 1e-8, most_iterations: 200 },
        deepest_overlap: TOUCHING,
    };
    let surface = Arc::new(Ball { radius: RADIUS });
    let immersed = ImmersedBody::fixed(surface, Vector::from(at));
    let matter = Some(Matter::ellipsoid(1500.0, &Vector::repeat(RADIUS)));
    let flow = PeriodicBox::new(grid);
    let mut alone = Unsteady::new(flow, settings, vec![Body { immersed, matter }], FaceField::zeros(&grid)).expect("the same");
    for _ in 0..20 {
        run(&mut simulation, 1);
        alone.step().expect("a step");
        let body = &alone.bodies()[0].immersed;
        assert!((simulation.bodies().position(0) - body.position).norm() < 1e-12 * RADIUS);
        assert!((simulation.now().velocity(0) - body.velocity).norm() < 1e-10 * 0.02);
    }
    let load = simulation.now().fluid_load(0);
    assert!((load.force - alone.fluid_load(0).force).norm() < 1e-8 * load.force.norm());
}

/// What lies on a floor presses on it with its weight less that of the fluid it displaces; what is lighter than the fluid presses on the ceiling.
#[test]
fn a_body_at_rest_presses_with_its_net_weight() {
    for (density, start) in [(1050.0, 3.05e-3), (2500.0, 3.05e-3), (8000.0, 3.05e-3), (300.0, 8.95e-3), (10.0, 8.95e-3)] {
        let sides = side("floor", [0.0; 3], [0.0, 0.0, 1.0]) + &side("ceiling", [0.0, 0.0, 12.0 * SPACING], [0.0, 0.0, -1.0]);
        let more = ball_at([4.2e-3, 4.9e-3, start], [0.0; 3]) + &contacts(["ball", "side"], 0.3) + &sides;
        let mut simulation = with_gravity(scene([10, 10, 12], [true, true, false], density, &more)).build().expect("a ball between walls");
        run(&mut simulation, 300);
        let wanted = (density - DENSITY).abs() * volume() * GRAVITY;
        let pressed = simulation.now().contacts().largest_overlap * STIFFNESS;
        let speed = simulation.now().velocity(0).norm();
        // The fluid that the fall has stirred comes to rest slowly, and a slip is left in every step.
        assert!((pressed / wanted - 1.0).abs() < 1e-3 && speed < 1e-5, "{density}: {pressed} {wanted} {speed}");
    }
}

/// Impulses of contacts only pass momentum on.
#[test]
fn balls_that_collide_keep_the_momentum_of_all() {
    let more = ball_at([3.6e-3, 6.0e-3, 6.2e-3], [0.3, 0.0, 0.0])
        + &ball_at([10.4e-3, 6.4e-3, 5.9e-3], [-0.2, 0.0, 0.0])
        + &contacts(["ball", "ball"], 0.9);
    let mut simulation = scene([14, 12, 12], [true; 3], 2500.0, &more).build().expect("two balls");
    let momentum = |simulation: &Simulation| simulation.stages.flow.as_ref().map_or(Vector::zeros(), |flow| flow.flow().momentum());
    let before = momentum(&simulation);
    let mut most_contacts = 0;
    for _ in 0..30 {
        run(&mut simulation, 1);
        most_contacts = most_contacts.max(simulation.now().contacts().contacts);
        let changed = (momentum(&simulation) - before).norm();
        assert!(changed < 1e-12 * before.norm(), "{changed:e} of {}", before.norm());
    }
    let [first, second] = [0, 1].map(|index| simulation.now().velocity(index).x);
    assert!(most_contacts == 1 && first < second, "{first} {second}");
}

/// A ball of twenty times the density of a thin fluid leaves a wall as its contact law says, even where the contact lasts less than a step of the fluid.
#[test]
fn a_heavy_ball_bounces_off_a_wall_with_its_restitution() {
    let rebound = |step: f64| {
        let floor = side("floor", [0.0; 3], [0.0, 0.0, 1.0]);
        let more = ball_at([4.2e-3, 4.9e-3, 4.6e-3], [0.0, 0.0, -0.5]) + &contacts(["ball", "side"], 0.8) + &floor;
        let mut scene = scene([10, 10, 12], [true, true, false], 20_000.0, &more);
        let fluid = scene.fluid.as_mut().expect("a fluid");
        (fluid.step, fluid.viscosity, fluid.slip) = (step, 1e-3, 1e-6);
        let NormalLaw::LinearSpringDashpot(law) = &mut scene.pairs[0].normal else { panic!("a linear spring") };
        law.stiffness = 2e4;
        let mut simulation = scene.build().expect("a ball above a floor");
        let (mut before, mut now, mut touches) = (0.0, -0.5, false);
        while now < 0.0 || touches {
            assert!(simulation.time() < 0.02, "still there");
            before = if touches { before } else { now };
            let next = simulation.time() + step;
            simulation.run_until(next).expect("a run without harm");
            (now, touches) = (simulation.now().velocity(0).z, simulation.now().contacts().contacts > 0);
        }
        -now / before
    };
    let [coarse, fine] = [1e-3, 2.5e-4].map(rebound);
    // The Stokes number is 6000: the fluid takes less than a hundredth. The added mass that a contact is weighed with is 0.024 of the mass, and not that at the wall.
    assert!((fine - 0.8).abs() < 0.016 && (coarse - 0.8).abs() < 0.048, "{coarse} {fine}");
}

#[test]
fn a_run_goes_on_from_a_checkpoint_to_the_bit() {
    let more = ball_at([3.6e-3, 6.0e-3, 6.2e-3], [0.3, 0.0, 0.0])
        + &ball_at([10.4e-3, 6.4e-3, 5.9e-3], [-0.2, 0.0, 0.0])
        + &contacts(["ball", "ball"], 0.9);
    let scene = with_gravity(scene([14, 12, 12], [true; 3], 2500.0, &more));
    let mut whole = scene.build().expect("two balls");
    run(&mut whole, 4);
    // In the middle of a step of the fluid too.
    whole.step();
    let text = whole.checkpoint().expect("finite numbers");
    let mut again = Simulation::resume(&scene, &text).expect("the same scene");
    for simulation in [&mut whole, &mut again] {
        simulation.run_until(9e-3).expect("a run without harm");
    }
    assert_eq!(whole.checkpoint().expect("finite"), again.checkpoint().expect("finite"));
    let other = with_gravity(self::scene([14, 12, 13], [true; 3], 2500.0, &more));
    assert!(Simulation::resume(&other, &text).is_err());
}

/// Bodies of given motion turn about their axis exactly, and a mean flow past them takes the pressure gradient that they resist with.
#[test]
fn bodies_of_given_motion_keep_it_and_their_drag_balances_the_pressure() {
    let brick = "[[shape]]\nname = \"brick\"\ngeometry = { cuboid = { lengths = [3e-3, 4e-3, 5e-3] } }\n\
                 [[body]]\nshape = \"brick\"\nmaterial = \"ball\"\nposition = [5e-3, 5e-3, 5e-3]\nangular_velocity = [0.0, 40.0, 30.0]\n";
    let mut scene = scene([10; 3], [true; 3], 2500.0, brick);
    scene.coupling = Some(Coupling { resolved: ResolvedCoupling { bodies: ImmersedMotion::Given } });
    let fluid = scene.fluid.as_mut().expect("a fluid");
    (fluid.velocity, fluid.mean_velocity) = ([0.01, 0.0, 0.0], Some([0.01, 0.0, 0.0]));
    let mut simulation = scene.build().expect("a brick in a stream");
    run(&mut simulation, 30);
    let turned = Orientation::from_scaled_axis(Vector::new(0.0, 40.0, 30.0) * 0.03);
    assert!(simulation.now().orientation(0).angle_to(&turned) < 1e-12);
    assert_eq!(simulation.bodies().position(0), Vector::repeat(5e-3));
    let (drag, gradient) = (simulation.now().fluid_load(0).force, simulation.now().mean_pressure_gradient());
    assert!(drag.x > 0.0 && (drag + gradient * 1e-6).norm() < 1e-10 * drag.norm(), "{drag} {gradient}");
    assert!((simulation.now().mean_flow() - Vector::x() * 0.01).norm() < 1e-14);
}

/// A ball that is set in motion has its whole momentum, and gives a part of it to the fluid that it pushes.
#[test]
fn a_ball_that_is_launched_keeps_its_direction_and_its_momentum() {
    for density in [100.0, 1000.0, 2500.0] {
        let mut simulation =
            scene([12; 3], [true; 3], density, &ball_at([6.1e-3, 5.7e-3, 6.3e-3], [0.1, 0.0, 0.0])).build().expect("a ball");
        run(&mut simulation, 1);
        let mass = density * volume();
        let momentum = simulation.stages.flow.as_ref().map_or(Vector::zeros(), |flow| flow.flow().momentum());
        let speed = simulation.now().velocity(0).x / 0.1;
        // Friction and images make the added mass more than a half.
        assert!((momentum - Vector::x() * (0.1 * mass)).norm() < 1e-12 * mass, "{density}: {momentum}");
        let free = density / (density + 0.5 * DENSITY);
        assert!(speed > 0.5 * free && speed < 1.1 * free, "{density}: {speed} {free}");
    }
}

/// An oblique bounce of a heavy ball, with friction that sets it spinning; looked at or not.
#[test]
fn friction_turns_a_ball_in_a_thin_fluid_as_without_one() {
    let floor = side("floor", [0.0; 3], [0.0, 0.0, 1.0]);
    let friction = "tangential = { linear_history = { friction = 0.2, stiffness = 6e3, damping_ratio = 0.1 } }\n";
    let more = ball_at([4.2e-3, 4.9e-3, 3.2e-3], [0.3, 0.0, -0.3]) + &contacts(["ball", "side"], 0.8) + friction + &floor;
    let mut wet = scene([10, 10, 12], [true, true, false], 20_000.0, &more);
    let NormalLaw::LinearSpringDashpot(law) = &mut wet.pairs[0].normal else { panic!("a linear spring") };
    law.stiffness = 2e4;
    let fluid = wet.fluid.as_mut().expect("a fluid");
    (fluid.step, fluid.viscosity, fluid.slip) = (2e-4, 1e-3, 1e-6);
    let dry = Scene { fluid: None, coupling: None, ..wet.clone() };
    let mut seen = wet.clone();
    seen.output.sphere_orientation = true;
    let after = |scene: &Scene| {
        let mut simulation = scene.build().expect("a ball above a floor");
        simulation.run_until(3e-3).expect("a run without harm");
        let now = simulation.now();
        assert!(now.velocity(0).z > 0.1 && now.contacts().contacts == 0);
        (now.velocity(0), now.angular_velocity(0), now.position(0))
    };
    let [wet, dry, seen] = [&wet, &dry, &seen].map(after);
    assert_eq!(wet, seen);
    let (turned, slowed) = (wet.1.y / dry.1.y - 1.0, wet.0.x - dry.0.x);
    // The fluid has taken a part of the momentum before, and takes one of the spin after.
    assert!(dry.1.y > 20.0 && turned.abs() < 0.06 && slowed.abs() < 0.06 * dry.0.x, "{turned} {slowed}: {wet:?} {dry:?}");
}

#[test]
fn a_brick_lies_flat_on_the_floor_with_its_net_weight() {
    let brick = "[[shape]]\nname = \"brick\"\ngeometry = { cuboid = { lengths = [5e-3, 4e-3, 6e-3] } }\n\
                 [[body]]\nshape = \"brick\"\nmaterial = \"ball\"\nposition = [5.2e-3, 4.9e-3, 3.02e-3]\n";
    let more = brick.to_string() + &contacts(["ball", "side"], 0.3) + &side("floor", [0.0; 3], [0.0, 0.0, 1.0]);
    let mut simulation = with_gravity(scene([10, 10, 12], [true, true, false], 2500.0, &more)).build().expect("a brick above a floor");
    run(&mut simulation, 150);
    let now = simulation.now();
    let wanted = 1500.0 * 120e-9 * GRAVITY;
    let seen = now.contacts();
    assert_eq!(seen.contacts, 4);
    assert!((4.0 * seen.largest_overlap * STIFFNESS / wanted - 1.0).abs() < 0.01, "{}", seen.largest_overlap);
    // Nothing holds it from turning about the vertical.
    let tilt = (now.orientation(0) * Vector::z()).xy().norm();
    assert!(tilt < 1e-5 && now.velocity(0).norm() < 1e-4, "{tilt} {}", now.velocity(0));
}

#[test]
fn fluid_between_sides_that_move_apart_is_sheared() {
    let mut scene = scene([4, 4, 10], [true, true, false], 2500.0, "");
    let fluid = scene.fluid.as_mut().expect("a fluid");
    (fluid.viscosity, fluid.step, fluid.slip) = (1.0, 0.01, 1e-10);
    fluid.moving_sides = vec![MovingSides { across: Direction::Z, lower: [0.0; 3], upper: [0.1, 0.04, 0.0] }];
    let mut simulation = scene.build().expect("a fluid alone");
    simulation.run_until(0.3).expect("a run without harm");
    // Planes of values at both sides and a spacing apart between them.
    assert!((simulation.now().mean_flow() - Vector::new(0.05, 0.02, 0.0)).norm() < 1e-8, "{}", simulation.now().mean_flow());
}

/// A ball that crosses a periodic side, on a list of neighbours, moves as one that does not.
#[test]
fn sides_that_repeat_are_not_felt() {
    let after = |x: f64| {
        let more =
            ball_at([x, 4.9e-3, 4.3e-3], [-0.2, 0.0, -0.2]) + &contacts(["ball", "side"], 0.8) + &side("floor", [0.0; 3], [0.0, 0.0, 1.0]);
        let mut simulation = scene([10, 10, 12], [true, true, false], 8000.0, &more).build().expect("a ball above a floor");
        run(&mut simulation, 20);
        (simulation.now().velocity(0), simulation.now().position(0))
    };
    let ((crossed, one), (stayed, other)) = (after(0.4e-3), after(7.4e-3));
    assert!((crossed - stayed).norm() < 1e-7, "{crossed} {stayed}");
    let apart = (one - other).x.rem_euclid(1e-3).min(-(one - other).x.rem_euclid(1e-3) + 1e-3);
    assert!(one.x > 5e-3 && apart < 1e-9, "{one} {other}");
}
