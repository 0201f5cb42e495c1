//! Chapter 3 of S and its appendix A: impulses, soft contacts, turning.

use nalgebra::Matrix3;
use solver::contact::impulse::{CollidingBody, CollisionPoint, FrictionClamp, FrictionImpulse, ImpulseLaw};
use solver::{Orientation, Scene, Vector};

use super::{Erratum, ROUNDING};
use crate::case::Failure;

pub fn errata() -> Vec<Erratum> {
    vec![
        Erratum::new(3.9, "torque as force times arm", [RESTITUTION, "1"], [0.7, ROUNDING], || Ok(restitution_of_rod(-1.0)), rod_coded),
        Erratum::new(3.15, "restitution from kinetic energies", [RESTITUTION, "1"], [0.7, ROUNDING], energies_printed, rod_coded),
        Erratum::new(3.24, "a bracket is missing", [RESTITUTION, "1"], [0.7, ROUNDING], bracket_printed, bracket_coded),
        Erratum::new(
            3.25,
            "friction pushes the slip on",
            [ENERGY, "J"],
            [0.81 + 5.0 / 7.0 * 0.64, ROUNDING],
            || energy(FrictionClamp::NoneSignAsPrinted),
            || energy(FrictionClamp::Stick),
        ),
        Erratum::new(
            3.32,
            "no limit to friction",
            ["slip after a collision", "m/s"],
            [0.0, ROUNDING],
            || slip(FrictionClamp::None),
            || slip(FrictionClamp::Stick),
        ),
        Erratum::new(3.35, "the dashpot pushes on", [RESTITUTION, "1"], [0.8, 1e-4], || Ok(1.0 / 0.8), dashpot_coded),
        Erratum::new(
            3.49,
            "no gyroscopic torque",
            ["relative change of angular momentum in 10 s", "1"],
            [0.0, 1e-11],
            momentum_printed,
            momentum_coded,
        ),
        Erratum::new(
            3.33,
            "friction at a wall speeds up (A.4, A.7, A.8)",
            ["velocity along the wall", "m/s"],
            [0.82, ROUNDING],
            || along_wall(FrictionClamp::NoneSignAsPrinted),
            || along_wall(FrictionClamp::Stick),
        ),
    ]
}

const RESTITUTION: &str = "restitution at the contact point";
const ENERGY: &str = "kinetic energy after a collision";

/// A thin rod of 1 kg and 2 m that lands on its end at 45 degrees with 1 m/s, about which one over the moment of inertia is 3.
const ROD: CollidingBody = CollidingBody {
    velocity: Vector::new(0.0, 0.0, -1.0),
    spin: Vector::new(0.0, 0.0, 0.0),
    inverse_mass: 1.0,
    inverse_inertia: Matrix3::new(3.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 3.0),
};

fn end_of_rod() -> CollisionPoint {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    CollisionPoint { normal: -Vector::z(), arm_of_first: Vector::new(half, 0.0, -half), arm_of_second: Vector::zeros() }
}

const SMOOTH: ImpulseLaw = ImpulseLaw { restitution: 0.7, friction: None };

fn impulse(law: &ImpulseLaw, first: &CollidingBody, second: Option<&CollidingBody>, point: &CollisionPoint) -> Vector {
    law.impulse_on_first(first, second, point).unwrap_or_else(Vector::zeros)
}

/// Rebound over approach at the end of the rod, its spin taking the impulse's moment with a sign.
fn restitution_of_rod(sign: f64) -> f64 {
    let point = end_of_rod();
    let push = impulse(&SMOOTH, &ROD, None, &point);
    let mut rod = ROD;
    rod.velocity += push;
    rod.spin += rod.inverse_inertia * point.arm_of_first.cross(&push) * sign;
    rod.velocity_at(&point.arm_of_first).z
}

fn rod_after() -> CollidingBody {
    let (mut rod, point) = (ROD, end_of_rod());
    rod.take(&impulse(&SMOOTH, &ROD, None, &point), &point.arm_of_first);
    rod
}

fn rod_coded() -> Result<f64, Failure> {
    Ok(rod_after().velocity_at(&end_of_rod().arm_of_first).z)
}

fn energies_printed() -> Result<f64, Failure> {
    let energy = |rod: &CollidingBody| rod.velocity.norm_squared() + rod.spin.norm_squared() / 3.0;
    Ok((energy(&rod_after()) / energy(&ROD)).sqrt())
}

/// Two rods that meet end on end. As printed the dot product with the normal belongs to the second turning term alone, the first is no number:
/// it is left out.
fn rods_after(denominator: impl Fn(f64) -> f64) -> f64 {
    let point = CollisionPoint { arm_of_second: Vector::new(0.4, 0.3, 0.8), ..end_of_rod() };
    let (mut first, mut second) = (ROD, CollidingBody { velocity: Vector::zeros(), ..ROD });
    let turning = |arm: &Vector| 3.0 * arm.cross(&point.normal).norm_squared();
    let push = -point.normal * (1.7 / (2.0 + denominator(turning(&point.arm_of_first)) + turning(&point.arm_of_second)));
    first.take(&push, &point.arm_of_first);
    second.take(&-push, &point.arm_of_second);
    -point.relative_velocity(&first, Some(&second)).dot(&point.normal)
}

fn bracket_printed() -> Result<f64, Failure> {
    Ok(rods_after(|_| 0.0))
}

fn bracket_coded() -> Result<f64, Failure> {
    let point = CollisionPoint { arm_of_second: Vector::new(0.4, 0.3, 0.8), ..end_of_rod() };
    let (mut first, mut second) = (ROD, CollidingBody { velocity: Vector::zeros(), ..ROD });
    let push = impulse(&SMOOTH, &first, Some(&second), &point);
    first.take(&push, &point.arm_of_first);
    second.take(&-push, &point.arm_of_second);
    Ok(-point.relative_velocity(&first, Some(&second)).dot(&point.normal))
}

/// A solid ball of one kilogram and one metre.
fn ball(velocity: [f64; 3]) -> CollidingBody {
    CollidingBody {
        velocity: velocity.into(),
        spin: Vector::zeros(),
        inverse_mass: 1.0,
        inverse_inertia: Matrix3::from_diagonal_element(2.5),
    }
}

/// Two balls after they have met at 2 m/s, slipping by so much.
fn balls_after(slip: f64, restitution: f64, friction: f64, clamp: FrictionClamp) -> ([CollidingBody; 2], CollisionPoint) {
    let point = CollisionPoint { normal: Vector::x(), arm_of_first: Vector::x(), arm_of_second: -Vector::x() };
    let (mut first, mut second) = (ball([1.0, 0.5 * slip, 0.0]), ball([-1.0, -0.5 * slip, 0.0]));
    let friction = FrictionImpulse { dynamic_friction: friction, static_friction: friction, clamp };
    let push = impulse(&ImpulseLaw { restitution, friction: Some(friction) }, &first, Some(&second), &point);
    first.take(&push, &point.arm_of_first);
    second.take(&-push, &point.arm_of_second);
    ([first, second], point)
}

/// Of 1.64 J before; by hand the balls stick and keep 0.81 J along the line and 5/7 of 0.64 J across it.
fn energy(clamp: FrictionClamp) -> Result<f64, Failure> {
    let (balls, _) = balls_after(1.6, 0.9, 0.2, clamp);
    Ok(balls.iter().map(|ball| 0.5 * ball.velocity.norm_squared() + 0.2 * ball.spin.norm_squared()).sum())
}

/// Of 0.1 m/s before.
fn slip(clamp: FrictionClamp) -> Result<f64, Failure> {
    let ([first, second], point) = balls_after(0.1, 0.9, 0.5, clamp);
    Ok(point.relative_velocity(&first, Some(&second)).y)
}

/// A ball that comes down with 1 m/s and slides with 1 m/s: an impulse of 1.8 N s, a tenth of it along the wall.
fn along_wall(clamp: FrictionClamp) -> Result<f64, Failure> {
    let point = CollisionPoint { normal: -Vector::z(), arm_of_first: -Vector::z(), arm_of_second: Vector::zeros() };
    let friction = FrictionImpulse { dynamic_friction: 0.1, static_friction: 0.1, clamp };
    let mut ball = ball([1.0, 0.0, -1.0]);
    let push = impulse(&ImpulseLaw { restitution: 0.8, friction: Some(friction) }, &ball, None, &point);
    ball.take(&push, &point.arm_of_first);
    Ok(ball.velocity.x)
}

/// A ball thrown at a wall through the soft contact law, 200 steps in the contact. With the printed sign the dashpot feeds the motion: a restitution of
/// one over that asked for.
fn dashpot_coded() -> Result<f64, Failure> {
    let text = r#"
        scene = { name = "bounce", end_time = 0.2 }
        material = [{ name = "any" }]
        pair = [{ materials = ["any", "any"], normal = { linear_spring_dashpot = { stiffness = 1e4, restitution = 0.8 } } }]
        shape = [{ name = "ball", geometry = { sphere = { radius = 0.1 } } }]
        body = [{ shape = "ball", material = "any", mass = 1.0, position = [0.0, 0.0, 0.11], velocity = [0.0, 0.0, -1.0] }]
        boundary = [{ name = "floor", material = "any", geometry = { plane = { point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0] } } }]
        numerics = { steps_per_contact = 200.0 }
    "#;
    let mut simulation = Scene::from_toml(text, "bounce")?.build()?;
    simulation.run_until(0.2)?;
    Ok(simulation.now().velocity(0).z)
}

const INERTIA: [f64; 3] = [1.0, 2.0, 3.0];
const SPIN: [f64; 3] = [1.0, 0.5, 0.2];

/// Without the gyroscopic torque the spin stays, and the angular momentum follows the turning body.
fn momentum_printed() -> Result<f64, Failure> {
    let spin = Vector::from(SPIN);
    let turn = Orientation::new(spin * 10.0);
    let momentum = |turn: &Orientation| turn * (turn.inverse() * spin).component_mul(&Vector::from(INERTIA));
    let start = momentum(&Orientation::identity());
    Ok((momentum(&turn) - start).norm() / start.norm())
}

fn momentum_coded() -> Result<f64, Failure> {
    let text = r#"
        scene = { name = "top", end_time = 10.0 }
        material = [{ name = "any" }]
        shape = [{ name = "plate", geometry = { cuboid = { lengths = [4.9, 3.5, 0.1] } } }]
        body = [{ shape = "plate", material = "any", mass = 1.0, principal_inertia = [1.0, 2.0, 3.0], position = [0.0, 0.0, 0.0], angular_velocity = [1.0, 0.5, 0.2] }]
        numerics = { step = 1e-2 }
    "#;
    let mut simulation = Scene::from_toml(text, "top")?.build()?;
    let start = simulation.now().spin_momentum(0);
    simulation.run_until(10.0)?;
    Ok((simulation.now().spin_momentum(0) - start).norm() / start.norm())
}
