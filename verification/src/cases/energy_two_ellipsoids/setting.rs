//! Two ellipsoids that meet head-on or turned, and one that meets a wall: the scenes of the case.

use solver::scene::{
    Body, Boundary, BoundaryGeometry, EndOfContact, Geometry, HardContact, ImpulseRestitution, LinearSpringDashpot, Material, NamedShape,
    NormalLaw, Pair, PlaneGeometry, Scene, Step, SuperellipsoidContact, SuperellipsoidGeometry, TimeDrivenContact,
};
use solver::{Orientation, Vector};
use std::sync::OnceLock;

use crate::exact::linear_contact::LinearContact;
use crate::exact::superellipsoid_twin::{Placed, distance};

/// Semi-axes in m; the first points along the motion.
pub(super) const SEMI_AXES: [f64; 3] = [0.005, 0.003, 0.003];
pub(super) const MASS: f64 = 1e-3;
/// Of each body in m/s: two of S's units of 1 m/s.
pub(super) const SPEED: f64 = 2.0;
/// In N/m, with which the ellipsoids overlap by half a hundredth of their length.
pub(super) const STIFFNESS: f64 = 4e6;
/// Time in s until they meet in hard runs, as in S figures 4-1 to 4-6.
const MEETING: f64 = 0.09;
/// The same of a turned pair, which may meet a second time later on.
const MEETING_OF_TURNED: f64 = 4e-4;

/// Who meets whom.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scenario {
    /// Two bodies, tip on tip, along their common axis.
    HeadOn,
    /// One body, tip on a wall.
    Wall,
    /// Two bodies turned and aside of each other's path, so that both spin afterwards.
    Turned,
}

/// How contacts are found and resolved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Contact {
    EventDriven,
    TimeDriven,
    /// Springs between smooth surfaces.
    Smooth,
    /// Springs between vertices.
    Vertices,
}

/// One run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Setting {
    pub scenario: Scenario,
    pub contact: Contact,
    pub restitution: f64,
    /// Steps in a soft contact, or in the flight before a hard one.
    pub steps: f64,
    /// In each angle.
    pub vertices: u32,
    pub stiffness: f64,
    /// Part of a step by which the start is moved on.
    pub phase: f64,
}

impl Setting {
    fn is_hard(&self) -> bool {
        matches!(self.contact, Contact::EventDriven | Contact::TimeDriven)
    }

    fn inverse_reduced_mass(&self) -> f64 {
        if self.scenario == Scenario::Wall { 1.0 / MASS } else { 2.0 / MASS }
    }

    /// Duration in s of a central soft contact.
    pub(super) fn contact_duration(&self) -> f64 {
        let frequency = (self.stiffness * self.inverse_reduced_mass()).sqrt();
        LinearContact::until_zero_overlap(self.restitution).duration / frequency
    }

    fn meeting(&self) -> f64 {
        if self.scenario == Scenario::Turned { MEETING_OF_TURNED } else { MEETING }
    }

    pub(super) fn step(&self) -> f64 {
        if self.is_hard() { self.meeting() / self.steps } else { self.contact_duration() / self.steps }
    }

    /// Time in s at which bodies have parted: hard ones fly as long as before.
    pub(super) fn end_time(&self) -> f64 {
        if self.is_hard() { 2.0 * self.meeting() } else { 4.0 * self.contact_duration() + 4.0 * self.step() }
    }

    /// Time in s of free flight before the contact.
    fn flight(&self) -> f64 {
        if self.is_hard() { self.meeting() - self.phase * self.step() } else { (1.0 + self.phase) * self.step() }
    }

    fn pair(&self) -> Pair {
        let normal = if self.is_hard() {
            NormalLaw::Impulse(ImpulseRestitution { restitution: self.restitution })
        } else {
            let (stiffness, restitution) = (self.stiffness, self.restitution);
            NormalLaw::LinearSpringDashpot(LinearSpringDashpot { stiffness, restitution, end_of_contact: EndOfContact::ZeroOverlap })
        };
        Pair { materials: ["any".into(), "any".into()], normal, tangential: None, rolling: None }
    }

    fn bodies(&self) -> Vec<Body> {
        let body = |side: f64, place: Vector, turn: Orientation| Body {
            mass: Some(MASS),
            position: place.into(),
            velocity: [-side * SPEED, 0.0, 0.0],
            orientation: [turn.w, turn.i, turn.j, turn.k],
            ..Body::new("ellipsoid", "any")
        };
        let way = SPEED * self.flight();
        let straight = Orientation::identity();
        match self.scenario {
            Scenario::Wall => vec![body(1.0, Vector::x() * (SEMI_AXES[0] + way), straight)],
            Scenario::HeadOn => [-1.0, 1.0].map(|side| body(side, Vector::x() * (side * (SEMI_AXES[0] + way)), straight)).to_vec(),
            Scenario::Turned => {
                let (turns, aside) = turned();
                let touching = touching_distance();
                [(-1.0, 0), (1.0, 1)]
                    .map(|(side, place)| body(side, Vector::x() * (side * (0.5 * touching + way)) + aside * side, turns[place]))
                    .to_vec()
            }
        }
    }

    /// The scene.
    pub(super) fn scene(&self) -> Scene {
        let mut scene = Scene::empty("two ellipsoids", self.end_time());
        scene.materials = vec![Material { name: "any".into(), density: None }];
        scene.pairs = vec![self.pair()];
        let geometry = Geometry::Superellipsoid(SuperellipsoidGeometry { semi_axes: SEMI_AXES, exponents: [1.0, 1.0] });
        scene.shapes = vec![NamedShape { name: "ellipsoid".into(), geometry }];
        scene.bodies = self.bodies();
        if self.scenario == Scenario::Wall {
            let geometry = BoundaryGeometry::Plane(PlaneGeometry { point: [0.0; 3], normal: [1.0, 0.0, 0.0] });
            scene.boundaries = vec![Boundary::new("wall", "any", geometry)];
        }
        scene.numerics.step = Step::Seconds(self.step());
        scene.numerics.hard_contact = (self.contact == Contact::TimeDriven).then(|| HardContact::TimeDriven(TimeDrivenContact::default()));
        if self.contact == Contact::Vertices {
            scene.numerics.shaped_contact.superellipsoids = SuperellipsoidContact::Vertices;
            scene.numerics.shaped_contact.vertices = self.vertices;
        }
        scene
    }
}

/// How the turned pair lies: turns of both, and by how much each is off the axis of motion, in m.
fn turned() -> ([Orientation; 2], Vector) {
    let turns = [Orientation::from_euler_angles(0.3, 0.9, -0.4), Orientation::from_euler_angles(-0.8, 0.2, 0.7)];
    (turns, Vector::new(0.0, 0.0008, -0.0005))
}

/// The turned pair with its centres so far apart along x.
fn turned_pair(apart: f64) -> [Placed; 2] {
    let (turns, aside) = turned();
    [(-1.0, turns[0]), (1.0, turns[1])].map(|(side, turn)| Placed {
        semi_axes: SEMI_AXES.into(),
        exponents: [1.0, 1.0],
        position: Vector::x() * (0.5 * side * apart) + aside * side,
        rotation: *turn.to_rotation_matrix().matrix(),
    })
}

/// Distance in m of the centres along x at which the turned pair touches: by bisection of its distance.
fn touching_distance() -> f64 {
    static FOUND: OnceLock<f64> = OnceLock::new();
    *FOUND.get_or_init(|| {
        let (mut low, mut high) = (SEMI_AXES[1], 3.0 * SEMI_AXES[0]);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            let [first, second] = turned_pair(middle);
            (low, high) = if distance(&first, &second).distance > 0.0 { (low, middle) } else { (middle, high) };
        }
        0.5 * (low + high)
    })
}

/// Velocity in m/s and kinetic energy in J of the turned pair after a rigid, frictionless impact: the first body's velocity.
pub(super) fn rigid_impact(restitution: f64) -> (Vector, f64) {
    let [first, second] = turned_pair(touching_distance());
    let normal = distance(&first, &second).normal;
    let arms = [first.support(&normal), second.support(&-normal)];
    let squares = Vector::from(SEMI_AXES).map(|axis| axis * axis);
    let inertia = Vector::new(squares.y + squares.z, squares.z + squares.x, squares.x + squares.y) * (0.2 * MASS);
    let spins = [(arms[0], first.rotation), (arms[1], second.rotation)]
        .map(|(arm, turn)| turn * turn.tr_mul(&arm.cross(&normal)).component_div(&inertia));
    let inverse_mass: f64 = (0..2).map(|place| 1.0 / MASS + normal.dot(&spins[place].cross(&arms[place]))).sum();
    let push = (1.0 + restitution) * 2.0 * SPEED * normal.x / inverse_mass;
    let velocity = Vector::x() * SPEED - normal * (push / MASS);
    let energy_of_spin: f64 = (0..2).map(|place| 0.5 * push * push * spins[place].dot(&arms[place].cross(&normal))).sum();
    (velocity, MASS * velocity.norm_squared() + energy_of_spin)
}
