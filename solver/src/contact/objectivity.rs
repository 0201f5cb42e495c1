//! Stability test S07: what a loaded pair of spheres remembers turns with it.

use std::f64::consts::TAU;

use super::law::{EndOfContact, LinearHistory, LinearSpringDashpot, NoRolling, StepKind};
use super::pairs::Candidate;
use super::spheres::SphereContacts;
use super::stage::{ContactStage, Laws};
use crate::domain::{Image, Shifts};
use crate::shape::{Convex, Sphere};
use crate::test_bodies::at_rest;
use crate::{Bodies, Orientation, Vector};

const STEPS_PER_TURN: u32 = 200;
const STEP: f64 = 1.0 / STEPS_PER_TURN as f64;

/// The force on the first of two spheres side by side along x.
fn force(contacts: &mut SphereContacts<LinearHistory>, bodies: &mut Bodies) -> Vector {
    let kind = StepKind { step: STEP, synchronous: false, lagged_damping: false, resolved_edges: true };
    bodies.state.clear_forces(true);
    contacts.add_forces(bodies, &kind);
    bodies.force(0)
}

/// Two spheres that were sheared against each other turn about their common normal ten thousand times.
#[test]
fn a_loaded_pair_that_turns_about_its_normal_keeps_its_friction() {
    let laws = Laws {
        normal: LinearSpringDashpot::new(1e4, 1.0, EndOfContact::ZeroOverlap),
        tangential: LinearHistory { friction: 10.0, stiffness: 1e4, damping_ratio: 0.0 },
        rolling: NoRolling,
    };
    let ball = |id: u32, side: f64| {
        let mut body = at_rest(Convex::Sphere(Sphere { radius: 1.0 }), 1.0);
        (body.id, body.position) = (id, Vector::x() * (side * 0.9995));
        body
    };
    let mut bodies = Bodies::new(vec![ball(0, -1.0), ball(1, 1.0)]);
    let mut contacts = SphereContacts::new(vec![laws], Vec::new(), Shifts::of(None));
    contacts.set_candidates(&bodies, vec![Candidate::of_bodies(0, 1, 0, Image::SAME)], None);
    let spin = |bodies: &mut Bodies, rate: Vector| bodies.state.motion.iter_mut().for_each(|body| body.angular_velocity = rate);
    force(&mut contacts, &mut bodies);
    spin(&mut bodies, Vector::new(0.0, 0.3, 0.4) * (1e-4 / STEP));
    for _ in 0..2 {
        force(&mut contacts, &mut bodies);
    }
    spin(&mut bodies, Vector::x() * TAU);
    let friction = |force: Vector| Vector::new(0.0, force.y, force.z);
    let start = friction(force(&mut contacts, &mut bodies));
    assert!(start.norm() > 1.0, "{start}");
    let turns = 10_000;
    for step in 1..=STEPS_PER_TURN * turns {
        let now = friction(force(&mut contacts, &mut bodies));
        // At whole turns and between.
        if step % 25_037 == 0 || step % (1000 * STEPS_PER_TURN) == 0 {
            let turned = Orientation::from_scaled_axis(Vector::x() * (TAU * STEP * f64::from(step % STEPS_PER_TURN))) * start;
            // The tangent of the angle of a step lacks its fifth order.
            let lost = f64::from(step) * 2.0 / 15.0 * (TAU * STEP).powi(5);
            assert!((now.norm() / start.norm() - 1.0).abs() < 1e-8, "{step}: {now} {start}");
            assert!((now - turned).norm() < (1.02 * lost + 1e-9) * start.norm(), "{step}: {now} {turned} {lost}");
        }
    }
}
