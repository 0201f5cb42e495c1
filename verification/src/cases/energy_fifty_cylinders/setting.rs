//! Fifty cylinders in a closed box, a cluster in free space, and two balls that slip: the scenes of the case.

use solver::scene::{
    Body, Boundary, BoundaryGeometry, CoulombImpulse, EndOfContact, FrictionClamp, Geometry, HardContact, ImpulseRestitution,
    LinearSpringDashpot, Material, NamedShape, NormalLaw, Pair, PlaneGeometry, RodGeometry, Scene, SphereGeometry, Step, TangentialLaw,
    TimeDrivenContact,
};
use solver::{Orientation, Vector};

pub(super) const RADIUS: f64 = 0.004;
pub(super) const LENGTH: f64 = 0.0053;
const DENSITY: f64 = 1000.0;
pub(super) const CYLINDERS: usize = 50;
/// Edge of the box in m: the cylinders fill a sixteenth of it.
const EDGE: f64 = 0.06;
/// U_ref of S, in m/s: the speed of every cylinder at the start.
pub(super) const SPEED: f64 = 1.0;
/// Time in s in which a cylinder flies its diameter.
pub(super) const PASSAGE: f64 = 2.0 * RADIUS / SPEED;
/// In N/m: overlaps stay within a part in three hundred of the diameter.
const STIFFNESS: f64 = 1e6;
/// Cylinders of the cluster in free space.
const CLUSTER: usize = 8;
/// Time in s in which the cluster meets and parts.
pub(super) const CLUSTER_TIME: f64 = 4.0 * PASSAGE;

/// How cylinders touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Contact {
    EventDriven,
    TimeDriven,
    Soft,
    /// Event-driven, with restitution 0.9 and friction 0.3.
    Rough,
}

/// Duration in s of a soft head-on contact of two cylinders.
pub(super) fn contact_duration() -> f64 {
    let mass = DENSITY * std::f64::consts::PI * RADIUS * RADIUS * LENGTH;
    std::f64::consts::PI * (0.5 * mass / STIFFNESS).sqrt()
}

impl Contact {
    fn pair(self) -> Pair {
        let impulse = |restitution| NormalLaw::Impulse(ImpulseRestitution { restitution });
        let coulomb = CoulombImpulse { dynamic_friction: 0.3, static_friction: None, clamp: FrictionClamp::Stick };
        let soft = LinearSpringDashpot { stiffness: STIFFNESS, restitution: 1.0, end_of_contact: EndOfContact::ZeroOverlap };
        let (normal, tangential) = match self {
            Contact::EventDriven | Contact::TimeDriven => (impulse(1.0), None),
            Contact::Rough => (impulse(0.9), Some(TangentialLaw::CoulombImpulse(coulomb))),
            Contact::Soft => (NormalLaw::LinearSpringDashpot(soft), None),
        };
        Pair { materials: ["resin".into(), "resin".into()], normal, tangential, rolling: None }
    }

    /// Materials, laws and shapes, with a step in s.
    fn scene(self, name: &str, step: f64, end_time: f64) -> Scene {
        let mut scene = Scene::empty(name, end_time);
        scene.materials = vec![Material { name: "resin".into(), density: Some(DENSITY) }];
        scene.pairs = vec![self.pair()];
        scene.shapes =
            vec![NamedShape { name: "cylinder".into(), geometry: Geometry::Cylinder(RodGeometry { radius: RADIUS, length: LENGTH }) }];
        scene.numerics.step = Step::Seconds(step);
        scene.numerics.hard_contact = (self == Contact::TimeDriven).then(|| HardContact::TimeDriven(TimeDrivenContact::default()));
        scene
    }
}

/// Points that fill the unit cube evenly without pattern: multiples of the powers of one over 1.22074408460575947536, a root of
/// x^4 = x + 1, moved on by the seed.
fn spread(count: u64, random_seed: u64) -> Vector {
    let start = random_seed as f64 * 0.381_966_011_250_105_1;
    let part = |stride: f64| (start + count as f64 * stride).fract();
    Vector::new(part(0.819_172_513_396_164_4), part(0.671_043_606_703_789_2), part(0.549_700_477_901_970_2))
}

/// A unit vector from two numbers in [0, 1).
fn direction(first: f64, second: f64) -> Vector {
    let (height, angle) = (2.0 * first - 1.0, std::f64::consts::TAU * second);
    let across = (1.0 - height * height).sqrt();
    Vector::new(across * angle.cos(), across * angle.sin(), height)
}

/// Cylinders at random places and turns whose surrounding balls do not touch, in a box or ball about the origin.
fn thrown(count: usize, half_edge: f64, random_seed: u64) -> Vec<Body> {
    let ball = RADIUS.hypot(0.5 * LENGTH);
    let mut bodies: Vec<Body> = Vec::new();
    let mut tried = 0;
    while bodies.len() < count {
        tried += 1;
        let position = (spread(tried, random_seed) - Vector::repeat(0.5)) * (2.0 * (half_edge - ball));
        if bodies.iter().any(|other| (position - Vector::from(other.position)).norm() <= 2.0 * ball) {
            continue;
        }
        let numbers = spread(7 * tried + 3, random_seed + 100);
        let turn = Orientation::from_scaled_axis(direction(numbers.x, numbers.y) * (numbers.z * std::f64::consts::PI));
        let numbers = spread(11 * tried + 5, random_seed + 200);
        bodies.push(Body {
            position: position.into(),
            orientation: [turn.w, turn.i, turn.j, turn.k],
            velocity: (direction(numbers.x, numbers.z) * SPEED).into(),
            ..Body::new("cylinder", "resin")
        });
    }
    bodies
}

/// Fifty cylinders in a closed box, without spin at the start.
pub(super) fn closed_box(contact: Contact, step: f64, end_time: f64, random_seed: u64) -> Scene {
    let mut scene = contact.scene("fifty cylinders", step, end_time);
    scene.scene.random_seed = random_seed;
    scene.bodies = thrown(CYLINDERS, 0.5 * EDGE, random_seed);
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        for (side, word) in [(1.0, "low"), (-1.0, "high")] {
            let mut normal = [0.0; 3];
            normal[axis] = side;
            let geometry = BoundaryGeometry::Plane(PlaneGeometry { point: normal.map(|along| -along * 0.5 * EDGE), normal });
            scene.boundaries.push(Boundary::new(&format!("{word} {name}"), "resin", geometry));
        }
    }
    scene
}

/// Eight cylinders that fly to the middle of empty space, with spins.
pub(super) fn cluster(contact: Contact, step: f64, random_seed: u64) -> Scene {
    let mut scene = contact.scene("cluster of cylinders", step, CLUSTER_TIME);
    scene.bodies = thrown(CLUSTER, 0.4 * EDGE, random_seed);
    for body in &mut scene.bodies {
        let inwards = -Vector::from(body.position) / (2.0 * PASSAGE) + Vector::from(body.velocity) * 0.2;
        body.angular_velocity = (Vector::from(body.velocity) * (0.5 * SPEED / RADIUS)).into();
        body.velocity = inwards.into();
    }
    scene
}

/// Two balls of a kilogram and a metre that meet at 2 m/s with a slip in m/s: those of the errata.
pub(super) fn slipping_balls(slip: f64, friction: f64, clamp: FrictionClamp) -> Scene {
    let mut scene = Scene::empty("slipping balls", 1.0);
    scene.materials = vec![Material { name: "resin".into(), density: None }];
    scene.pairs = vec![Pair {
        materials: ["resin".into(), "resin".into()],
        normal: NormalLaw::Impulse(ImpulseRestitution { restitution: 0.9 }),
        tangential: Some(TangentialLaw::CoulombImpulse(CoulombImpulse { dynamic_friction: friction, static_friction: None, clamp })),
        rolling: None,
    }];
    scene.shapes = vec![NamedShape { name: "ball".into(), geometry: Geometry::Sphere(SphereGeometry { radius: 1.0 }) }];
    // They meet after half a second, straight beside each other.
    let ball = |side: f64| Body {
        mass: Some(1.0),
        position: [-1.5 * side, -0.25 * slip * side, 0.0],
        velocity: [side, 0.5 * slip * side, 0.0],
        ..Body::new("ball", "resin")
    };
    scene.bodies = vec![ball(1.0), ball(-1.0)];
    scene.numerics.step = Step::Seconds(1.0);
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The source gives one metre a second in all directions; nothing overlaps, and nothing prefers a direction.
    #[test]
    fn cylinders_fly_at_the_reference_speed_in_all_directions() {
        for random_seed in 0..5 {
            let scene = closed_box(Contact::EventDriven, 1e-3, 1.0, random_seed);
            let velocities: Vec<Vector> = scene.bodies.iter().map(|body| body.velocity.into()).collect();
            assert!(velocities.len() == CYLINDERS && velocities.iter().all(|velocity| (velocity.norm() - SPEED).abs() < 1e-14));
            let mean = velocities.iter().sum::<Vector>() / CYLINDERS as f64;
            // Three standard deviations of fifty random directions.
            assert!(mean.norm() < 3.0 / (CYLINDERS as f64).sqrt(), "{mean}");
            scene.build().unwrap();
        }
    }
}
