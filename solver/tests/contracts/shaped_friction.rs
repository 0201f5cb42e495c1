//! Friction of bodies of any shape: collisions in which sticking, sliding and turns between them happen converge at second order.

use solver::Vector;
use solver::scene::{
    Body, Boundary, BoundaryGeometry, CuboidGeometry, Geometry, LinearHistory, Material, NamedShape, Pair, PlaneGeometry, RodGeometry,
    Scene, Step, SuperellipsoidGeometry, TangentialLaw,
};

use crate::spheres::{build, law, sphere};

const DURATION: f64 = 0.006;

/// The law of a collision.
#[derive(Debug, Clone, Copy)]
struct Friction {
    coefficient: f64,
    damping_ratio: f64,
    restitution: f64,
}

/// A body that spins about all axes, thrown obliquely at a floor or at a ball that spins too; `phase` in steps of 0.01 ms tells when it arrives.
fn collision(geometry: &Geometry, at_wall: bool, friction: Friction, phase: f64, steps: f64) -> Scene {
    let mut scene = Scene::empty("one oblique collision", 1.0);
    scene.materials = vec![Material { name: "clay".into(), density: Some(2500.0) }];
    let Friction { coefficient, damping_ratio, restitution } = friction;
    let tangential = Some(TangentialLaw::LinearHistory(LinearHistory { friction: coefficient, stiffness: 8e3, damping_ratio }));
    scene.pairs = vec![Pair { materials: ["clay".into(), "clay".into()], normal: law(restitution), tangential, rolling: None }];
    scene.shapes = vec![NamedShape { name: "body".into(), geometry: geometry.clone() }, sphere("ball", 0.006)];
    scene.numerics.shaped_contact.crust = 0.1;
    scene.numerics.step = Step::Seconds(DURATION / steps);
    let velocity = Vector::new(0.4, 0.2, -1.0);
    scene.bodies = vec![Body {
        position: (Vector::new(-0.001, 0.0005, 0.0131) - velocity * (1e-5 * phase)).into(),
        velocity: velocity.into(),
        orientation: [1.0, 0.3, 0.5, 0.2],
        angular_velocity: [60.0, -90.0, 40.0],
        ..Body::new("body", "clay")
    }];
    if at_wall {
        let geometry = BoundaryGeometry::Plane(PlaneGeometry { point: [0.0, 0.0, 0.006], normal: [0.0, 0.0, 1.0] });
        scene.boundaries = vec![Boundary::new("floor", "clay", geometry)];
    } else {
        scene.bodies.push(Body { angular_velocity: [-50.0, 20.0, 30.0], ..Body::new("ball", "clay") });
    }
    scene
}

/// Velocity of the body after its collision, and its spin as the speed of a point 5 mm away.
fn outcome(scene: &Scene) -> [Vector; 2] {
    let mut simulation = build(scene);
    simulation.run_until(DURATION).expect("no guard stops this run");
    let thrown = Vector::from(scene.bodies[0].velocity);
    let now = simulation.now();
    assert!(now.contacts().contacts == 0 && (now.velocity(0) - thrown).norm() > 0.1, "the collision is not over");
    [now.velocity(0), now.angular_velocity(0) * 0.005]
}

/// Root mean squares over the time of arrival, in m/s, with as many steps as given, from sixteen times the most.
fn errors(geometry: &Geometry, at_wall: bool, friction: Friction, steps: [f64; 2]) -> [f64; 2] {
    let phases = [0.0, 0.31, 0.67];
    let mut squares = [0.0; 2];
    for phase in phases {
        let at = |steps: f64| outcome(&collision(geometry, at_wall, friction, phase, steps));
        let exact = at(16.0 * steps[1]);
        for (square, steps) in squares.iter_mut().zip(steps) {
            let found = at(steps);
            *square += (found[0] - exact[0]).norm_squared() + (found[1] - exact[1]).norm_squared();
        }
    }
    squares.map(|square| (square / phases.len() as f64).sqrt())
}

#[test]
fn oblique_collisions_converge_at_second_order_whatever_the_shape() {
    let semi_axes = [0.005, 0.004, 0.0035];
    let geometries = [
        Geometry::Superellipsoid(SuperellipsoidGeometry { semi_axes, exponents: [1.0, 1.0] }),
        Geometry::Superellipsoid(SuperellipsoidGeometry { semi_axes, exponents: [0.5, 0.7] }),
        Geometry::Cuboid(CuboidGeometry { lengths: [0.006, 0.007, 0.008] }),
        Geometry::Cylinder(RodGeometry { radius: 0.003, length: 0.01 }),
        sphere("ball", 0.004).geometry,
    ];
    let elastic = |coefficient: f64| Friction { coefficient, damping_ratio: 0.0, restitution: 1.0 };
    for friction in [elastic(0.5), elastic(0.05), Friction { coefficient: 0.5, damping_ratio: 0.1, restitution: 0.7 }] {
        let mut orders = Vec::new();
        for (geometry, at_wall) in geometries.iter().flat_map(|geometry| [(geometry, true), (geometry, false)]) {
            let [coarse, fine] = errors(geometry, at_wall, friction, [1600.0, 6400.0]);
            orders.push(0.5 * (coarse / fine).log2());
            // Of speeds of about 1 m/s; 220 steps in a contact, then 880; meanwhile the slip turns by up to a right angle.
            let floor = 1e-5;
            assert!(coarse < 10.0 * floor && fine < floor, "{coarse:.1e}, {fine:.1e}, wall: {at_wall}, {friction:?}, {geometry:?}");
        }
        let mean = orders.iter().sum::<f64>() / orders.len() as f64;
        println!("{mean} {orders:.2?}");
        // Where a collision sticks and slides, and where dashpots jump, a part of the second order is left to chance.
        assert!(mean > 1.8, "{mean:.2}: {orders:.2?}, {friction:?}");
    }
}
