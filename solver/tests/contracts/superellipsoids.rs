//! A crowd of superellipsoids: round, boxy, pointed and cylinder-like; and one of these and bodies with edges.

use solver::Simulation;
use solver::scene::{Geometry, Scene, SuperellipsoidContact, SuperellipsoidGeometry, TangentialLaw};

use crate::shaped::{assert_falls_at_second_order_from, contacts_so_far, crowd, largest_change_of_energy};
use crate::spheres::{build, history, state_bits};

const EXPONENTS: [[f64; 2]; 5] = [[1.0, 1.0], [0.3, 0.3], [0.2, 1.0], [1.6, 1.2], [0.7, 1.4]];

/// The crowd of shapes with each shape replaced, and a ball left among them.
fn smooth_crowd(tangential: Option<TangentialLaw>, restitution: f64) -> Scene {
    crowd_with_every(1, tangential, restitution)
}

/// The same with every other shape left as it is: boxes, cylinders, polyhedra and glued bodies.
fn mixed_crowd(tangential: Option<TangentialLaw>, restitution: f64) -> Scene {
    crowd_with_every(2, tangential, restitution)
}

fn crowd_with_every(stride: usize, tangential: Option<TangentialLaw>, restitution: f64) -> Scene {
    let mut scene = crowd(false, tangential, restitution);
    let others = scene.shapes.iter_mut().filter(|shape| !matches!(shape.geometry, Geometry::Sphere(_))).step_by(stride);
    for (shape, exponents) in others.zip(EXPONENTS.into_iter().cycle()) {
        shape.geometry = Geometry::Superellipsoid(SuperellipsoidGeometry { semi_axes: [0.005, 0.004, 0.0035], exponents });
    }
    scene
}

#[test]
fn momentum_and_angular_momentum_are_kept_by_smooth_surfaces_and_by_vertices() {
    let (smooth, mixed) = (smooth_crowd(Some(history()), 0.7), mixed_crowd(Some(history()), 0.7));
    let (continuous, vertices) = (SuperellipsoidContact::Continuous, SuperellipsoidContact::Vertices);
    for (scene, superellipsoids) in [(&smooth, continuous), (&smooth, vertices), (&mixed, continuous)] {
        let mut scene = scene.clone();
        scene.numerics.shaped_contact.superellipsoids = superellipsoids;
        let mut simulation = build(&scene);
        let (momentum, spin) = (simulation.now().momentum(), simulation.now().angular_momentum());
        simulation.run_until(0.006).expect("no guard stops this run");
        assert!(contacts_so_far(&simulation) > 1000, "the bodies do not meet");
        // Every step rounds the momentum of every body, about 1e-3 kg m/s; arms are at most the distance of 0.05 m to the origin.
        let floor = f64::EPSILON * 1e-3 * ((simulation.steps_taken() * scene.bodies.len() as u64) as f64).sqrt();
        let change = ((simulation.now().momentum() - momentum).norm(), (simulation.now().angular_momentum() - spin).norm());
        assert!(change.0 < 10.0 * floor && change.1 < 10.0 * floor * 0.05, "{superellipsoids:?}: {change:?}, floor {floor}");
    }
}

/// The depth along a common normal is a potential: elastic motion keeps its energy, up to the second order of the step.
#[test]
fn elastic_motion_keeps_its_energy_at_second_order() {
    // Rounded edges are a part of the size of their body: contacts there begin to be resolved at twice the steps.
    for (scene, steps) in [(smooth_crowd(None, 1.0), 20.0), (mixed_crowd(None, 1.0), 40.0)] {
        assert_falls_at_second_order_from(steps, |steps_per_contact| {
            let (simulation, worst) = largest_change_of_energy(&mut scene.clone(), steps_per_contact);
            assert!(contacts_so_far(&simulation) > 100, "the bodies do not meet");
            worst
        });
    }
}

#[test]
fn a_run_resumed_is_the_run_that_went_on_and_the_order_of_bodies_does_not_show() {
    for scene in [smooth_crowd(Some(history()), 0.7), mixed_crowd(Some(history()), 0.7)] {
        let mut shuffled = scene.clone();
        shuffled.bodies.reverse();
        let (mut whole, mut other) = (build(&scene), build(&shuffled));
        whole.run_until(0.003).expect("no guard stops this run");
        let saved = whole.checkpoint().expect("the state is finite");
        let mut resumed = Simulation::resume(&scene, &saved).expect("the checkpoint belongs to the scene");
        for simulation in [&mut whole, &mut resumed, &mut other] {
            simulation.run_until(0.006).expect("no guard stops this run");
        }
        assert!(state_bits(&mut whole) == state_bits(&mut resumed), "the resumed run differs");
        assert!(state_bits(&mut whole) == state_bits(&mut other), "the order of bodies shows");
    }
}
