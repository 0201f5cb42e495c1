//! Scene to simulation: the only place that matches on options. What is not supported is refused, never ignored.

use std::sync::Arc;

use crate::bodies::BodySpecification;
use crate::boundary::Plane;
use crate::broad_phase::{LARGEST_NUMBER_OF_BODIES, all_pairs};
use crate::contact::law::{self, Frictionless, LinearHistory, LinearSpringDashpot, StepKind, ViscousCoulomb};
use crate::contact::stage::{Candidate, ContactStage, Contacts, Laws, Partner};
use crate::motion::rotation::{
    ExplicitEuler, ExplicitEulerAsPrinted, FreeTurns, IsotropicSpin, Precession, RotationStage, RungeKutta4, Splitting,
    SplittingFourthOrder,
};
use crate::scene::{
    Body, BoundaryGeometry, ContactEdges, DampingTime, Geometry, InitialOverlap, Measure, NormalLaw, Pair, Rotation, Scene, SceneError,
    SceneErrorKind, Step, TangentialLaw,
};
use crate::scheme::granular::Stages;
use crate::shape::{Convex, Cuboid, Shape, Sphere};
use crate::{Bodies, Orientation, Simulation, Vector};

/// More contacts than a body has among bodies of its size.
const CONTACTS_OF_A_BODY: f64 = 12.0;

impl Scene {
    /// Resolves every option and returns the simulation of what the scene needs.
    ///
    /// # Errors
    ///
    /// A [`SceneError`] for a scene that does not validate, that this version cannot simulate, whose bodies overlap at the start,
    /// or whose step is above what its stiffest contact allows.
    pub fn build(&self) -> Result<Simulation, SceneError> {
        self.validate()?;
        let bodies = Bodies::new(self.body_specifications());
        let contacts = self.contact_stages(&bodies)?;
        self.refuse_overlaps(&bodies, &contacts)?;
        let kind = StepKind {
            step: self.time_step(&bodies, &contacts)?,
            synchronous: true,
            lagged_damping: self.numerics.damping == DampingTime::Lagged,
            resolved_edges: self.numerics.contact_edges == ContactEdges::Resolved,
        };
        self.check_number_of_steps(kind.step)?;
        let mut left_out = Vec::new();
        if contacts.is_empty() {
            left_out.push(("contacts", self.why_no_contacts()));
        }
        let gravity = self.scene.gravity.map(Vector::from);
        if gravity.is_none() {
            left_out.push(("gravity", "the scene has none".to_string()));
        }
        let rotation = self.rotation_stages(&bodies, &contacts, &mut left_out);
        let stages = Stages { contacts, gravity, rotation };
        Ok(Simulation { scene: self.clone(), bodies, stages, kind, steps_taken: 0, forces_are_current: false, left_out })
    }

    /// Whether an output or a probe asks for the orientation of bodies whose motion does not depend on it.
    pub(crate) fn looks_at_isotropic_orientation(&self) -> bool {
        self.output.sphere_orientation || self.probes.iter().any(|probe| probe.measure == Measure::Orientation)
    }

    fn body_specifications(&self) -> Vec<BodySpecification> {
        let specification = |(place, body): (usize, &Body)| {
            let shape = self.shape_of(body);
            let material = self.material_index(&body.material);
            let density = self.materials[material].density;
            let mass = body.mass.unwrap_or_else(|| density.unwrap_or(f64::NAN) * shape.volume());
            let [w, x, y, z] = body.orientation;
            BodySpecification {
                id: body.id.unwrap_or(place as u32),
                mass,
                inertia: body.principal_inertia.map_or_else(|| shape.specific_inertia() * mass, Vector::from),
                shape,
                material,
                position: body.position.into(),
                velocity: body.velocity.into(),
                orientation: Orientation::new_normalize(nalgebra::Quaternion::new(w, x, y, z)),
                angular_velocity: body.angular_velocity.into(),
            }
        };
        self.bodies.iter().enumerate().map(specification).collect()
    }

    fn shape_of(&self, body: &Body) -> Arc<Shape> {
        let geometry = self.shapes.iter().find(|shape| shape.name == body.shape).map(|shape| &shape.geometry);
        Arc::new(Shape::of_one(match geometry {
            Some(Geometry::Cuboid(cuboid)) => Convex::Cuboid(Cuboid { lengths: cuboid.lengths.into() }),
            Some(Geometry::Sphere(sphere)) => Convex::Sphere(Sphere { radius: sphere.radius }),
            // Validation has found every shape.
            None => Convex::Sphere(Sphere { radius: f64::NAN }),
        }))
    }

    fn material_index(&self, name: &str) -> usize {
        self.materials.iter().position(|material| material.name == name).unwrap_or(usize::MAX)
    }

    fn walls(&self) -> Vec<Plane> {
        let wall = |geometry: &BoundaryGeometry| {
            let BoundaryGeometry::Plane(plane) = geometry;
            Plane { point: plane.point.into(), normal: Vector::from(plane.normal).normalize() }
        };
        self.boundaries.iter().map(|boundary| wall(&boundary.geometry)).collect()
    }

    /// One stage per kind of tangential law, with the candidate pairs between whose materials such a law stands.
    fn contact_stages(&self, bodies: &Bodies) -> Result<Vec<Box<dyn ContactStage>>, SceneError> {
        let mut stages: Vec<Box<dyn ContactStage>> = Vec::new();
        let frictionless = |pair: &Pair| pair.tangential.is_none().then_some(Frictionless);
        let viscous = |pair: &Pair| match &pair.tangential {
            Some(TangentialLaw::ViscousCoulomb(law)) => Some(ViscousCoulomb { friction: law.friction, damping_rate: law.damping_rate }),
            _ => None,
        };
        let history = |pair: &Pair| match &pair.tangential {
            Some(TangentialLaw::LinearHistory(law)) => {
                Some(LinearHistory { friction: law.friction, stiffness: law.stiffness, damping_ratio: law.damping_ratio })
            }
            _ => None,
        };
        stages.extend(self.contact_stage(bodies, frictionless)?);
        stages.extend(self.contact_stage(bodies, viscous)?);
        stages.extend(self.contact_stage(bodies, history)?);
        Ok(stages)
    }

    fn contact_stage<Tangential: law::TangentialLaw>(
        &self,
        bodies: &Bodies,
        tangential: impl Fn(&Pair) -> Option<Tangential>,
    ) -> Result<Option<Box<dyn ContactStage>>, SceneError> {
        let count = self.materials.len();
        let mut laws = Vec::new();
        let mut laws_between = vec![None; count * count];
        for pair in &self.pairs {
            let Some(tangential) = tangential(pair) else { continue };
            let NormalLaw::LinearSpringDashpot(normal) = &pair.normal;
            let normal = LinearSpringDashpot::new(normal.stiffness, normal.restitution, normal.end_of_contact);
            let [one, other] = [self.material_index(&pair.materials[0]), self.material_index(&pair.materials[1])];
            laws_between[one * count + other] = Some(laws.len());
            laws_between[other * count + one] = Some(laws.len());
            laws.push(Laws { normal, tangential });
        }
        let laws_of = |one: usize, other: usize| laws_between[one * count + other];
        let candidates = self.candidates(bodies, laws_of, Tangential::NEEDS_ROTATION)?;
        if candidates.is_empty() {
            return Ok(None);
        }
        Ok(Some(Box::new(Contacts::new(laws, self.walls(), candidates))))
    }

    fn candidates(
        &self,
        bodies: &Bodies,
        laws_of: impl Fn(usize, usize) -> Option<usize>,
        needs_rotation: bool,
    ) -> Result<Vec<Candidate>, SceneError> {
        let mut candidates = Vec::new();
        let bodies_interact = self.materials.iter().enumerate().any(|(one, _)| (0..=one).any(|other| laws_of(one, other).is_some()));
        if bodies_interact && bodies.len() > LARGEST_NUMBER_OF_BODIES {
            let message = format!(
                "{} bodies that touch are too many for this version, which tests every pair: at most {LARGEST_NUMBER_OF_BODIES}",
                bodies.len()
            );
            return Err(SceneError::new(SceneErrorKind::Unsupported, "body", message));
        }
        for (first, second) in all_pairs(bodies, |one, other| laws_of(one, other).is_some()) {
            let laws = laws_of(bodies.material(first), bodies.material(second));
            candidates.extend(laws.map(|laws| Candidate { first, second: Partner::Body(second), laws }));
        }
        for first in 0..bodies.len() {
            for (wall, boundary) in self.boundaries.iter().enumerate() {
                let laws = laws_of(bodies.material(first), self.material_index(&boundary.material));
                candidates.extend(laws.map(|laws| Candidate { first, second: Partner::Wall(wall), laws }));
            }
        }
        for candidate in &candidates {
            self.refuse_shapes_without_contact(bodies, candidate)?;
            if needs_rotation {
                self.refuse_unequal_moments(bodies, candidate)?;
            }
        }
        Ok(candidates)
    }

    fn refuse_unequal_moments(&self, bodies: &Bodies, candidate: &Candidate) -> Result<(), SceneError> {
        match partners(candidate).find(|index| !bodies.is_isotropic(*index)) {
            None => Ok(()),
            Some(index) => Err(SceneError::new(
                SceneErrorKind::Unsupported,
                format!("{}.principal_inertia", self.key_of_body(bodies.id(index))),
                "friction turns only bodies of three equal moments in this version; give equal moments, or a [[pair]] without tangential law",
            )),
        }
    }

    fn refuse_shapes_without_contact(&self, bodies: &Bodies, candidate: &Candidate) -> Result<(), SceneError> {
        match partners(candidate).find(|index| bodies.shape(*index).as_sphere().is_none()) {
            None => Ok(()),
            Some(index) => Err(SceneError::new(
                SceneErrorKind::Unsupported,
                self.key_of_body(bodies.id(index)),
                format!(
                    "a {} cannot touch anything in this version, only spheres can; give it a material without a [[pair]]",
                    bodies.shape(index).name()
                ),
            )),
        }
    }

    fn key_of_body(&self, id: u32) -> String {
        let place = self.bodies.iter().enumerate().position(|(place, body)| body.id.unwrap_or(place as u32) == id);
        place.map_or("body".to_string(), |place| format!("body[{place}]"))
    }

    /// Names both sides of a candidate pair for an error.
    fn name_of(&self, bodies: &Bodies, candidate: &Candidate) -> String {
        let first = bodies.id(candidate.first);
        match candidate.second {
            Partner::Body(second) => format!("bodies {first} and {}", bodies.id(second)),
            Partner::Wall(wall) => format!("body {first} and boundary `{}`", self.boundaries[wall].name),
        }
    }

    fn refuse_overlaps(&self, bodies: &Bodies, stages: &[Box<dyn ContactStage>]) -> Result<(), SceneError> {
        if self.numerics.initial_overlap == InitialOverlap::Allow {
            return Ok(());
        }
        for (stage, candidate) in candidates_of(stages) {
            if let Some(overlap) = stage.overlap(bodies, candidate) {
                let message = format!(
                    "{} overlap by {overlap} m at the start; move them apart, or set numerics.initial_overlap = \"allow\"",
                    self.name_of(bodies, candidate)
                );
                let key = format!("{}.position", self.key_of_body(bodies.id(candidate.first)));
                return Err(SceneError::new(SceneErrorKind::Overlap, key, message));
            }
        }
        Ok(())
    }

    fn time_step(&self, bodies: &Bodies, stages: &[Box<dyn ContactStage>]) -> Result<f64, SceneError> {
        let lagged = self.numerics.damping == DampingTime::Lagged;
        let scales = || candidates_of(stages).map(|(stage, candidate)| (stage.time_scales(bodies, candidate, lagged), candidate));
        let stiffest = scales().min_by(|left, right| left.0.largest_step.total_cmp(&right.0.largest_step));
        match self.numerics.step {
            Step::Seconds(step) => match stiffest {
                Some((scale, candidate)) if step >= scale.largest_step => {
                    let message = format!(
                        "{step} s is not below {} s, the limit of stability of the stiffest contact, {}; an accurate step is {} s \
                         (half period over {})",
                        scale.largest_step,
                        self.name_of(bodies, candidate),
                        scale.half_period / self.numerics.steps_per_contact.0,
                        self.numerics.steps_per_contact.0
                    );
                    Err(SceneError::new(SceneErrorKind::StepTooLarge, "numerics.step", message))
                }
                _ => Ok(step),
            },
            Step::Chosen(_) => {
                let shortest = scales().map(|(scale, _)| scale.half_period).fold(f64::INFINITY, f64::min);
                if shortest.is_infinite() {
                    let message = "nothing in the scene can touch, so there is no contact to advise a step from: give it in s";
                    return Err(SceneError::new(SceneErrorKind::Combination, "numerics.step", message));
                }
                let limit = stiffest.map_or(f64::INFINITY, |(scale, _)| scale.largest_step);
                // A body has up to a dozen contacts, and each sees the dashpots of the others as they were a step ago.
                let dampest = scales().map(|(scale, _)| scale.damping_time).fold(f64::INFINITY, f64::min);
                Ok((shortest / self.numerics.steps_per_contact.0).min(dampest / CONTACTS_OF_A_BODY).min(0.5 * limit))
            }
        }
    }

    fn why_no_contacts(&self) -> String {
        if self.pairs.is_empty() {
            "the scene has no [[pair]]".to_string()
        } else {
            "no two things in the scene are of materials that have a [[pair]]".to_string()
        }
    }

    fn rotation_stages(
        &self,
        bodies: &Bodies,
        contacts: &[Box<dyn ContactStage>],
        left_out: &mut Vec<(&'static str, String)>,
    ) -> Vec<Box<dyn RotationStage>> {
        let mut stages: Vec<Box<dyn RotationStage>> = Vec::new();
        let looked_at = self.looks_at_isotropic_orientation();
        let turned = contacts.iter().any(|stage| stage.needs_rotation());
        let (isotropic, others): (Vec<usize>, Vec<usize>) = (0..bodies.len()).partition(|index| bodies.is_isotropic(*index));
        if isotropic.is_empty() {
            left_out.push(("spin of isotropic bodies", "there are none".to_string()));
        } else if turned || looked_at {
            stages.push(Box::new(IsotropicSpin::new(isotropic, looked_at)));
        } else {
            left_out.push((
                "spin of isotropic bodies",
                "no force turns them and nothing looks at their orientation, which stays as it was".to_string(),
            ));
        }
        if others.is_empty() {
            left_out.push(("free turns", "every body is isotropic".to_string()));
            return stages;
        }
        let with_shortcut = self.numerics.rotation == Rotation::Splitting;
        let (axisymmetric, general): (Vec<usize>, Vec<usize>) =
            others.into_iter().partition(|index| with_shortcut && is_axisymmetric(bodies.inertia(*index)));
        if !axisymmetric.is_empty() {
            stages.push(Box::new(FreeTurns::new(axisymmetric, Precession)));
        }
        if !general.is_empty() {
            stages.push(match self.numerics.rotation {
                Rotation::Splitting | Rotation::SplittingWithoutShortcut => Box::new(FreeTurns::new(general, Splitting)),
                Rotation::SplittingFourthOrder => Box::new(FreeTurns::new(general, SplittingFourthOrder)),
                Rotation::RungeKuttaFourthOrder => Box::new(FreeTurns::new(general, RungeKutta4)),
                Rotation::ExplicitEuler => Box::new(FreeTurns::new(general, ExplicitEuler)),
                Rotation::ExplicitEulerAsPrinted => Box::new(FreeTurns::new(general, ExplicitEulerAsPrinted)),
            });
        }
        stages
    }
}

fn candidates_of(stages: &[Box<dyn ContactStage>]) -> impl Iterator<Item = (&dyn ContactStage, &Candidate)> {
    stages.iter().flat_map(|stage| stage.candidates().iter().map(move |candidate| (stage.as_ref(), candidate)))
}

/// The bodies of a candidate pair.
fn partners(candidate: &Candidate) -> impl Iterator<Item = usize> {
    let second = match candidate.second {
        Partner::Body(second) => Some(second),
        Partner::Wall(_) => None,
    };
    std::iter::once(candidate.first).chain(second)
}

fn is_axisymmetric(inertia: Vector) -> bool {
    inertia.x == inertia.y || inertia.y == inertia.z || inertia.z == inertia.x
}
