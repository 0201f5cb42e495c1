//! Contracts of elastic contacts and of resistance to rolling: closed forms, rest, refusals, time scales in the ledger.

use solver::Simulation;
use solver::scene::{
    Body, Boundary, BoundaryGeometry, ConstantTorque, CuboidGeometry, Elasticity, Geometry, Hertz, InitialOverlap, Mindlin, NamedShape,
    NormalLaw, Pair, PlaneGeometry, RollingLaw, Scene, SceneErrorKind, SpringTorque, Step, TangentialLaw, ViscousSpring,
};

use crate::spheres::{build, history, law, sphere};

const RADIUS: f64 = 0.01;
const GRAVITY: f64 = 9.81;
const GLASS: Elasticity = Elasticity { young_modulus: 1e7, poisson_ratio: 0.25 };

fn hertz(reference_speed: Option<f64>) -> NormalLaw {
    NormalLaw::Hertz(Hertz { first: GLASS, second: None, restitution: 0.7, reference_speed })
}

fn mindlin() -> TangentialLaw {
    TangentialLaw::Mindlin(Mindlin { friction: 0.4, damping_ratio: 0.2 })
}

/// A ball that rolls on a floor under gravity, with a given resistance.
fn rolling_ball(normal: NormalLaw, tangential: TangentialLaw, rolling: RollingLaw, velocity: f64) -> Scene {
    let mut scene = Scene::empty("rolling ball", 1.0);
    scene.scene.gravity = Some([0.0, 0.0, -GRAVITY]);
    let material = |name: &str, density| solver::scene::Material { name: name.into(), density };
    scene.materials = vec![material("ball", Some(2500.0)), material("floor", None)];
    let materials = ["ball".into(), "floor".into()];
    scene.pairs = vec![Pair { materials, normal, tangential: Some(tangential), rolling: Some(rolling) }];
    scene.shapes = vec![sphere("ball", RADIUS)];
    let geometry = BoundaryGeometry::Plane(PlaneGeometry { point: [0.0; 3], normal: [0.0, 0.0, 1.0] });
    scene.boundaries = vec![Boundary::new("floor", "floor", geometry)];
    let weight = 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3) * GRAVITY;
    let overlap = match &scene.pairs[0].normal {
        NormalLaw::LinearSpringDashpot(law) => weight / law.stiffness,
        NormalLaw::Hertz(_) => (weight / (4.0 / 3.0 * 1e7 / (1.0 - 0.0625) * RADIUS.sqrt())).powf(2.0 / 3.0),
        NormalLaw::Impulse(_) => panic!("a soft law"),
    };
    let spin = velocity / (RADIUS - 0.5 * overlap);
    scene.bodies = vec![Body {
        position: [0.0, 0.0, RADIUS - overlap],
        velocity: [velocity, 0.0, 0.0],
        angular_velocity: [0.0, spin, 0.0],
        ..Body::new("ball", "ball")
    }];
    scene.numerics.initial_overlap = InitialOverlap::Allow;
    scene
}

fn velocity(simulation: &mut Simulation) -> f64 {
    simulation.now().velocity(0).x
}

/// Closed form: a rolling ball is slowed by mu_r g r / (a (1 + I/(m a^2))) with the arm a of its contact point, whatever the law of the torque; and then
/// it rests.
#[test]
fn a_rolling_ball_is_slowed_by_the_torque_and_comes_to_rest() {
    let friction = 0.05;
    let constant = RollingLaw::ConstantTorque(ConstantTorque { friction });
    let spring = RollingLaw::SpringTorque(SpringTorque { friction, stiffness: 0.5, damping_ratio: 0.5 });
    for normal in [law(0.7), hertz(Some(0.1))] {
        let tangential = if matches!(normal, NormalLaw::Hertz(_)) { mindlin() } else { history() };
        for rolling in [constant.clone(), spring.clone()] {
            let scene = rolling_ball(normal.clone(), tangential.clone(), rolling, 0.2);
            let mut simulation = build(&scene);
            let arm = RADIUS - 0.5 * (RADIUS - scene.bodies[0].position[2]);
            let expected = friction * GRAVITY * RADIUS / arm / (1.0 + 0.4 * (RADIUS / arm).powi(2));
            simulation.run_until(0.1).expect("a run");
            let (early, start) = (velocity(&mut simulation), simulation.time());
            simulation.run_until(0.4).expect("a run");
            let slowing = (early - velocity(&mut simulation)) / (simulation.time() - start);
            // Friction's own springs still swing by a part of what they were loaded with in the beginning.
            assert!((slowing / expected - 1.0).abs() < 1e-3, "{slowing} against {expected}");
            simulation.run_until(1.0).expect("a run");
            assert!(velocity(&mut simulation).abs() < 1e-5, "{}", velocity(&mut simulation));
            let spin = simulation.now().angular_velocity(0).norm();
            assert!(spin * RADIUS < 1e-5, "{spin}");
        }
    }
}

/// A resting ball is held on a slope below the angle of rolling friction by the spring, and rolls down it without.
#[test]
fn rolling_friction_holds_a_ball_on_a_gentle_slope() {
    let slope = |rolling: Option<RollingLaw>| {
        let spring = RollingLaw::SpringTorque(SpringTorque { friction: 0.05, stiffness: 0.5, damping_ratio: 0.5 });
        let mut scene = rolling_ball(law(0.7), history(), spring, 0.0);
        scene.pairs[0].rolling = rolling.clone();
        scene.scene.gravity = Some([GRAVITY * 0.03_f64.sin(), 0.0, -GRAVITY * 0.03_f64.cos()]);
        let mut simulation = build(&scene);
        simulation.run_until(1.0).expect("a run");
        velocity(&mut simulation)
    };
    let held = slope(Some(RollingLaw::SpringTorque(SpringTorque { friction: 0.05, stiffness: 0.5, damping_ratio: 0.5 })));
    assert!(held.abs() < 1e-4, "{held}");
    assert!(slope(None) > 0.15);
}

#[test]
fn the_ledger_counts_the_steps_of_each_contact() {
    let torque = RollingLaw::ConstantTorque(ConstantTorque { friction: 0.05 });
    let mut scene = rolling_ball(hertz(Some(0.1)), mindlin(), torque, 0.2);
    let text = |scene: &Scene| build(scene).ledger().to_string();
    assert!(text(&scene).contains("ball on floor: contact duration"), "{}", text(&scene));
    assert!(text(&scene).contains("no fewer than the 15 steps"), "{}", text(&scene));
    assert!(text(&scene).contains("rolling torque of constant size") && text(&scene).contains("Rayleigh wave"), "{}", text(&scene));
    let advised = build(&scene).time_step();
    scene.numerics.step = Step::Seconds(8.0 * advised);
    assert!(text(&scene).contains("; fewer than the 15 steps"), "{}", text(&scene));
    scene.numerics.step = Step::Seconds(1e3 * advised);
    assert_eq!(scene.build().err().map(|error| error.kind), Some(SceneErrorKind::StepTooLarge));
}

#[test]
fn laws_that_do_not_go_together_are_refused() {
    let torque = || RollingLaw::ConstantTorque(ConstantTorque { friction: 0.05 });
    let good = || rolling_ball(hertz(Some(0.1)), mindlin(), torque(), 0.2);
    let refused = |change: &dyn Fn(&mut Scene), kind: SceneErrorKind, key: &str| {
        let mut scene = good();
        change(&mut scene);
        let error = scene.build().err().unwrap_or_else(|| panic!("{key} must be refused"));
        assert_eq!((error.kind, error.key.as_str()), (kind, key), "{error}");
    };
    refused(&|scene| scene.pairs[0].tangential = Some(history()), SceneErrorKind::Combination, "pair[0].tangential");
    refused(&|scene| scene.pairs[0].normal = law(0.5), SceneErrorKind::Combination, "pair[0].tangential");
    refused(&|scene| scene.pairs[0].tangential = None, SceneErrorKind::Combination, "pair[0].rolling");
    refused(&|scene| scene.pairs[0].normal = hertz(None), SceneErrorKind::Combination, "pair[0].normal.hertz.reference_speed");
    refused(&|scene| scene.pairs[0].normal = hertz(Some(-1.0)), SceneErrorKind::Value, "pair[0].normal.hertz.reference_speed");
    let cube = |scene: &mut Scene| {
        scene.shapes = vec![NamedShape { name: "ball".into(), geometry: Geometry::Cuboid(CuboidGeometry { lengths: [0.02; 3] }) }];
    };
    refused(&cube, SceneErrorKind::Unsupported, "pair[0].rolling");
    let cube_without_rolling = |scene: &mut Scene| {
        cube(scene);
        scene.pairs[0].rolling = None;
    };
    refused(&cube_without_rolling, SceneErrorKind::Unsupported, "pair[0].normal.hertz");
    let poisson = |scene: &mut Scene| {
        let first = Elasticity { poisson_ratio: 0.6, ..GLASS };
        scene.pairs[0].normal = NormalLaw::Hertz(Hertz { first, second: None, restitution: 0.7, reference_speed: None });
    };
    refused(&poisson, SceneErrorKind::Value, "pair[0].normal.hertz.first.poisson_ratio");
    let critical = |scene: &mut Scene| {
        scene.pairs[0].normal = law(0.0);
        scene.pairs[0].tangential = Some(TangentialLaw::ViscousSpring(ViscousSpring { friction: 0.3, stiffness: 1e3 }));
    };
    refused(&critical, SceneErrorKind::Value, "pair[0].normal.linear_spring_dashpot.restitution");
}
