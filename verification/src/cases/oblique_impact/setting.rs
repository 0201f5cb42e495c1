//! One oblique impact: its scene, its exact solution, and what a run of it gives.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use solver::Vector;
use solver::contact::law::hertz::{Elasticity, effective_modulus, effective_shear_modulus};
use solver::contact::law::{ViscousSpring, linear_spring_dashpot};
use solver::scene::{
    self, Body, Boundary, BoundaryGeometry, ContactEdges, DampingTime, EndOfContact, Geometry, LinearHistory, LinearSpringDashpot,
    Material, NamedShape, NormalLaw, Pair, PlaneGeometry, Scene, SphereGeometry, Step, TangentialLaw,
};

use crate::case::Failure;
use crate::exact::oblique_impact::{Normal, ObliqueImpact, Outcome, Sphere, Tangential, Velocities};

/// Contact laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Laws {
    /// Linear spring and dashpot; tangential spring with memory. Stiffnesses in N/m.
    Spring { stiffness: f64, tangential: f64 },
    /// The same with the stretch guessed from the velocity (S eq. 3.43).
    Guessed { stiffness: f64, tangential: f64 },
    /// Hertz and Mindlin; a wall is rigid.
    Elastic(Elasticity),
}

/// How the scheme takes damping and edges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Scheme {
    Resolved,
    Lagged,
}

/// An oblique impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Setting {
    pub(super) laws: Laws,
    pub(super) scheme: Scheme,
    /// Radius in m of the first body and, if it does not meet a wall, of the second.
    pub(super) radii: [Option<f64>; 2],
    /// In kg/m^3.
    pub(super) density: f64,
    pub(super) restitution: f64,
    pub(super) friction: f64,
    pub(super) before: Velocities,
}

/// The direction of approach and that across it: oblique, so that no axis is special.
pub(super) fn axes() -> [Vector; 2] {
    [Vector::new(2.0, 3.0, 6.0) / 7.0, Vector::new(6.0, 2.0, -3.0) / 7.0]
}

impl Setting {
    fn spheres(&self) -> (Sphere, Option<Sphere>) {
        let sphere = |radius| Sphere::solid(radius, self.density);
        (sphere(self.radii[0].unwrap_or(f64::NAN)), self.radii[1].map(sphere))
    }

    /// The same impact as an ordinary differential equation.
    pub(super) fn exact(&self) -> ObliqueImpact {
        let (first, second) = self.spheres();
        let (laws, friction) = ((Normal::Linear(0.0, 0.0), Tangential::Dashpot(0.0)), self.friction);
        let mut impact = ObliqueImpact { first, second, normal: laws.0, tangential: laws.1, friction, moves: true };
        let mass = impact.normal_mass();
        (impact.normal, impact.tangential) = match self.laws {
            Laws::Spring { stiffness, tangential } => (Normal::linear(stiffness, self.restitution, mass), Tangential::Spring(tangential)),
            Laws::Guessed { stiffness, tangential } => {
                let damping_ratio = linear_spring_dashpot::damping_ratio(self.restitution, EndOfContact::ZeroOverlap);
                let law = ViscousSpring { friction, stiffness: tangential, normal_stiffness: stiffness, damping_ratio };
                (Normal::linear(stiffness, self.restitution, mass), Tangential::Dashpot(law.dashpot(mass)))
            }
            Laws::Elastic(elasticity) => {
                let sides = self.elastic_sides(elasticity);
                let root = self.curvature_radius().sqrt();
                let stiffness = 4.0 / 3.0 * effective_modulus(&sides) * root;
                (Normal::hertz(stiffness, self.restitution, mass), Tangential::Mindlin(8.0 * effective_shear_modulus(&sides) * root))
            }
        };
        impact
    }

    fn elastic_sides(&self, elasticity: Elasticity) -> Vec<Elasticity> {
        std::iter::once(elasticity).chain(self.radii[1].map(|_| elasticity)).collect()
    }

    fn curvature_radius(&self) -> f64 {
        1.0 / self.radii.iter().flatten().map(|radius| 1.0 / radius).sum::<f64>()
    }

    fn pair(&self, other: &str) -> Pair {
        let linear = |stiffness| {
            let (restitution, end_of_contact) = (self.restitution, EndOfContact::ZeroOverlap);
            NormalLaw::LinearSpringDashpot(LinearSpringDashpot { stiffness, restitution, end_of_contact })
        };
        let friction = self.friction;
        let (normal, tangential) = match self.laws {
            Laws::Spring { stiffness, tangential } => {
                (linear(stiffness), TangentialLaw::LinearHistory(LinearHistory { friction, stiffness: tangential, damping_ratio: 0.0 }))
            }
            Laws::Guessed { stiffness, tangential } => {
                (linear(stiffness), TangentialLaw::ViscousSpring(scene::ViscousSpring { friction, stiffness: tangential }))
            }
            Laws::Elastic(first) => {
                let (second, restitution) = (self.radii[1].map(|_| first), self.restitution);
                let normal = scene::Hertz { first, second, restitution, reference_speed: Some(self.before.approach) };
                (NormalLaw::Hertz(normal), TangentialLaw::Mindlin(scene::Mindlin { friction, damping_ratio: 0.0 }))
            }
        };
        Pair { materials: ["ball".into(), other.into()], normal, tangential: Some(tangential), rolling: None }
    }

    /// The scene at a step in s; bodies meet a whole step and a part of one after the start.
    pub(super) fn scene(&self, step: f64, phase: f64, duration: f64) -> Scene {
        let mut scene = Scene::empty("oblique impact", 2.0 * duration + 4.0 * step);
        let [along, across] = axes();
        let material = |name: &str, density| Material { name: name.into(), density };
        scene.materials = vec![material("ball", Some(self.density)), material("wall", None)];
        scene.pairs = vec![self.pair(if self.radii[1].is_some() { "ball" } else { "wall" })];
        let shape =
            |radius: &f64| NamedShape { name: format!("{radius} m"), geometry: Geometry::Sphere(SphereGeometry { radius: *radius }) };
        scene.shapes = self.radii.iter().flatten().map(shape).collect();
        scene.shapes.dedup();
        let turning = along.cross(&across);
        let velocity = along * self.before.approach + across * self.before.tangential;
        let first_touch = (1.0 + phase) * step;
        let reach: f64 = self.radii.iter().flatten().sum();
        let first = Body {
            position: (-along * reach - velocity * first_touch).into(),
            velocity: velocity.into(),
            angular_velocity: (turning * self.before.spin_of_first).into(),
            ..Body::new(&scene.shapes[0].name, "ball")
        };
        scene.bodies = vec![first];
        match self.radii[1] {
            Some(radius) => scene.bodies.push(Body {
                angular_velocity: (turning * self.before.spin_of_second).into(),
                ..Body::new(&format!("{radius} m"), "ball")
            }),
            None => {
                let geometry = BoundaryGeometry::Plane(PlaneGeometry { point: [0.0; 3], normal: (-along).into() });
                scene.boundaries = vec![Boundary::new("wall", "wall", geometry)];
            }
        }
        scene.numerics.step = Step::Seconds(step);
        if self.scheme == Scheme::Lagged {
            scene.numerics.damping = DampingTime::Lagged;
            scene.numerics.contact_edges = ContactEdges::Sampled;
        }
        scene
    }

    /// Runs the impact in a number of steps to a contact.
    pub(super) fn run(&self, exact: &Outcome, steps: f64, phase: f64) -> Result<Run, Failure> {
        let step = exact.duration / steps;
        let mut simulation = self.scene(step, phase, exact.duration).build()?;
        let last = simulation.steps_to(simulation.scene().scene.end_time);
        let (mut touched, mut overlaps, mut largest_overlap) = (false, [f64::NEG_INFINITY; 3], 0.0_f64);
        while simulation.steps_taken() < last {
            simulation.step();
            overlaps = [overlaps[1], overlaps[2], self.overlap(&simulation)];
            touched |= overlaps[2] > 0.0;
            if overlaps[1] >= overlaps[0] && overlaps[1] >= overlaps[2] {
                largest_overlap = largest_overlap.max(vertex(overlaps));
            }
            // One step outside tells the straight line on which they leave.
            if touched && overlaps[1] <= 0.0 && overlaps[2] < overlaps[1] {
                simulation.check_guards()?;
                let duration = simulation.time() + overlaps[2] * step / (overlaps[1] - overlaps[2]) - (1.0 + phase) * step;
                return Ok(Run { after: self.velocities(&simulation), largest_overlap, duration, work: simulation.ledger().total_work() });
            }
        }
        Err(Failure::NothingMeasured("the bodies had not parted after twice the duration of the exact contact".into()))
    }

    fn overlap(&self, simulation: &solver::Simulation) -> f64 {
        let bodies = simulation.bodies();
        let reach: f64 = self.radii.iter().flatten().sum();
        match self.radii[1] {
            Some(_) => reach - (bodies.position(1) - bodies.position(0)).norm(),
            None => reach + bodies.position(0).dot(&axes()[0]),
        }
    }

    fn velocities(&self, simulation: &solver::Simulation) -> Velocities {
        let bodies = simulation.bodies();
        let [along, across] = axes();
        let turning = along.cross(&across);
        let of_second = |of: &dyn Fn(usize) -> Vector| if self.radii[1].is_some() { of(1) } else { Vector::zeros() };
        let velocity = bodies.half_step_velocity(0) - of_second(&|index| bodies.half_step_velocity(index));
        Velocities {
            approach: velocity.dot(&along),
            tangential: velocity.dot(&across),
            spin_of_first: bodies.half_step_angular_velocity(0).dot(&turning),
            spin_of_second: of_second(&|index| bodies.half_step_angular_velocity(index)).dot(&turning),
        }
    }

    /// Radius in m of the first body.
    pub(super) fn radius(&self) -> f64 {
        self.radii[0].unwrap_or(f64::NAN)
    }

    /// Speed in m/s of the size of the impact.
    pub(super) fn speed(&self) -> f64 {
        self.before.approach + self.before.tangential.abs() + self.radius() * self.before.spin_of_first.abs()
    }

    /// The first term of the error of leapfrog along the normal, in m/s: (angle in a step)^2 / 24 of the half turn of a contact, times the approach
    /// velocity. Of it are felt: the part that a dashpot turns, the angle by which the normal of two spheres turns, and, of springs alone, what their
    /// edges leave: the square of the angle in a step, or its root where the force begins as overlap^3/2.
    pub(super) fn design_error_of_rebound(&self, steps: f64) -> f64 {
        let angle = PI / steps;
        let dashpot = 2.0 * linear_spring_dashpot::damping_ratio(self.restitution, EndOfContact::ZeroOverlap);
        let duration = || self.exact().after(&self.before).duration;
        let turn = self.radii[1].map_or(0.0, |second| self.before.tangential.abs() * duration() / (self.radius() + second));
        let edges = if matches!(self.laws, Laws::Elastic(_)) { angle.sqrt() } else { angle * angle };
        angle * angle / 24.0 * PI * self.before.approach * (dashpot + turn + edges)
    }

    /// The slip in m/s that friction takes away if all goes well: all there is, or what Coulomb's law allows a rigid sphere.
    fn slip_to_take(&self) -> f64 {
        let exact = self.exact();
        exact.slip(&self.before).abs().min(self.slip_at_the_cap())
    }

    /// What Coulomb's law takes from the slip of a rigid sphere that slides all the time, in m/s.
    fn slip_at_the_cap(&self) -> f64 {
        let exact = self.exact();
        self.friction * (1.0 + self.restitution) * self.before.approach * exact.normal_mass() / exact.tangential_mass()
    }

    /// The first term of the error of leapfrog along the contact plane, in m/s: of the tangential velocity and of the spin times the radius, which
    /// share the change of slip. Under Hertz's law a sphere that slides takes its friction from the normal force, with its error.
    pub(super) fn design_errors_across(&self, steps: f64) -> [f64; 2] {
        let exact = self.exact();
        let turning = exact.first.radius * exact.first.radius / exact.first.inertia;
        let slides = exact.slip(&self.before).abs() > self.slip_at_the_cap();
        if slides && matches!(self.laws, Laws::Elastic(_)) {
            let velocity = self.friction * self.design_error_of_rebound(steps);
            return [velocity, velocity * exact.normal_mass() * turning];
        }
        let angle = self.largest_angle();
        let slip = (angle / steps).powi(2) / 24.0 * angle * self.slip_to_take();
        [1.0 / exact.normal_mass(), turning].map(|share| slip * exact.tangential_mass() * share)
    }

    /// Largest angle in a contact that an undamped spring of the law turns through: of the normal and of the tangential one.
    pub(super) fn largest_angle(&self) -> f64 {
        let exact = self.exact();
        match self.laws {
            Laws::Spring { stiffness, tangential } | Laws::Guessed { stiffness, tangential } => {
                PI * (tangential / exact.tangential_mass() * exact.normal_mass() / stiffness).sqrt().max(1.0)
            }
            // Stiffness at the largest overlap: the normal one is 1.5 F/overlap; T = 2.9432 overlap/v and v^2 = 0.8 F overlap/m.
            Laws::Elastic(elasticity) => {
                let sides = self.elastic_sides(elasticity);
                let ratio =
                    4.0 * effective_shear_modulus(&sides) / effective_modulus(&sides) * exact.normal_mass() / exact.tangential_mass();
                2.9432 * (1.5_f64 / 0.8).sqrt() * ratio.sqrt().max(1.0)
            }
        }
    }
}

/// What a run gives.
pub(super) struct Run {
    pub(super) after: Velocities,
    /// In m.
    pub(super) largest_overlap: f64,
    /// In s.
    pub(super) duration: f64,
    pub(super) work: BTreeMap<String, u64>,
}

/// Height of the parabola through three equidistant points.
fn vertex([left, middle, right]: [f64; 3]) -> f64 {
    let curvature = left - 2.0 * middle + right;
    if curvature == 0.0 { middle } else { middle - (right - left).powi(2) / (8.0 * curvature) }
}
