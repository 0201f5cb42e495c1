//! Scene to simulation: the only place that matches on options. What is not supported is refused, never ignored.

mod boundaries;
mod classes;
mod contacts;
mod flow;
mod hard;
mod insertion;
mod neighbours;
mod openings;
mod shapes;
mod stages;
mod step;

use std::sync::Arc;

use crate::bodies::BodySpecification;
use crate::contact::law::StepKind;
use crate::contact::pairs::{Candidate, Partner};
use crate::contact::stage::ContactStage;
use crate::measure::rest::RestWatch;
use crate::motion::rotation::{
    ExplicitEuler, ExplicitEulerAsPrinted, FreeTurns, IsotropicSpin, Precession, RotationStage, RungeKutta4, Splitting,
    SplittingFourthOrder, Turning,
};
use crate::openings::Openings;
use crate::scene::{Body, ContactEdges, DampingTime, InitialOverlap, Measure, Rotation, Scene, SceneError, SceneErrorKind};
use crate::scheme::granular::Stages;
use crate::shape::Shape;
use crate::{Bodies, Simulation, Vector};
pub use boundaries::SceneWall;
pub use insertion::Source;
use shapes::{ResolvedShape, orientation_of};
use stages::StageBuilder;

impl Scene {
    /// Resolves every option and returns the simulation of what the scene needs.
    ///
    /// # Errors
    ///
    /// A [`SceneError`] for a scene that does not validate, that this version cannot simulate, whose bodies overlap at the start,
    /// or whose step is above what its stiffest contact allows.
    pub fn build(&self) -> Result<Simulation, SceneError> {
        self.validate()?;
        let shapes = self.resolve_shapes()?;
        let mut specifications = self.body_specifications(&shapes);
        let walls = self.moving_walls()?;
        let inserted = self.insert_before_the_start(&shapes, &walls, &mut specifications)?;
        let at_start: Vec<u32> = (0..specifications.len() as u32).collect();
        let openings = self.openings(&shapes, &walls, specifications.iter().map(|body| u64::from(body.id) + 1).max().unwrap_or(0))?;
        // Bodies that come later are there while the scene is resolved: stages, sizes and time scales are those of all.
        specifications.extend(openings.iter().flat_map(Openings::waiting));
        let mut bodies = Bodies::new(specifications);
        let ids = bodies.by_id().map(|index| bodies.id(index)).collect();
        let named = |shape: &Arc<Shape>| shapes.iter().find(|named| Arc::ptr_eq(&named.shape, shape)).map(|named| named.name.clone());
        let shape_names = bodies.shapes().iter().map(named).collect();
        let flow = self.flow_and_virtual_masses(&shapes, &mut bodies)?;
        let builder = self.contact_stages(&bodies, &walls)?;
        let examples = builder.all_examples(&bodies);
        let StageBuilder { stages: contacts, pairing, walls: moving, .. } = builder;
        let hard = self.hard_stage(&bodies, &walls)?;
        let (step, contact_steps) = match (&hard, &self.fluid) {
            (Some(_), _) => (self.step_of_hard_bodies()?, 1),
            (None, None) => (self.time_step(&bodies, &contacts, &examples)?, 1),
            (None, Some(fluid)) => self.step_within(fluid, &bodies, &contacts, &examples)?,
        };
        let kind = StepKind {
            step,
            synchronous: true,
            lagged_damping: self.numerics.damping == DampingTime::Lagged,
            resolved_edges: self.numerics.contact_edges == ContactEdges::Resolved,
        };
        let steps = self.steps_in_contacts(&bodies, &contacts, &examples, kind.step).map(|remark| ("time step".to_string(), remark));
        self.check_number_of_steps(kind.step)?;
        let neighbours = if contacts.is_empty() { None } else { Some(self.neighbours(&bodies, pairing, moving)?) };
        let (rotation, left_out) = self.rotation_stages(&bodies, &contacts, hard.is_some());
        let flow = flow.map(|flow| flow.with_contact_steps(contact_steps));
        // Weight in a fluid is that less the fluid's, and acts through it.
        let gravity = self.scene.gravity.filter(|_| flow.is_none()).map(Vector::from);
        let stages = Stages { neighbours, contacts, gravity, rotation, hard, flow };
        bodies.reorder(&at_start);
        let remark = |shape: ResolvedShape| shape.remark.map(|remark| (format!("shape `{}`", shape.name), remark));
        let remarks = shapes.into_iter().filter_map(remark).chain(inserted).chain(steps).collect();
        let rest = self.scene.settled.as_ref().map(|criterion| RestWatch::new(criterion, kind.step));
        let mut simulation = Simulation {
            scene: self.clone(),
            bodies,
            ids,
            shape_names,
            stages,
            openings,
            rest,
            kind,
            steps_taken: 0,
            body_steps: 0,
            forces_are_current: false,
            remarks,
            left_out,
        };
        simulation.list_neighbours();
        self.refuse_overlaps(&simulation.bodies, &mut simulation.stages.contacts)?;
        simulation.end_step();
        Ok(simulation)
    }

    /// Whether an output or a probe asks for the orientation of bodies whose motion does not depend on it.
    pub(crate) fn looks_at_isotropic_orientation(&self) -> bool {
        self.output.sphere_orientation || self.probes.iter().any(|probe| probe.measure == Measure::Orientation)
    }

    fn body_specifications(&self, shapes: &[ResolvedShape]) -> Vec<BodySpecification> {
        let specification = |(place, body): (usize, &Body)| {
            // Validation has found every name.
            let shape = shapes.iter().find(|shape| shape.name == body.shape)?.shape.clone();
            let axes = *shape.axes();
            let material = self.material_index(&body.material);
            let density = self.materials[material].density;
            let mass = body.mass.unwrap_or_else(|| density.unwrap_or(f64::NAN) * shape.volume());
            Some(BodySpecification {
                id: body.id.unwrap_or(place as u32),
                mass,
                inertia: body.principal_inertia.map_or_else(|| shape.specific_inertia() * mass, Vector::from),
                shape,
                material,
                position: body.position.into(),
                velocity: body.velocity.into(),
                orientation: orientation_of(&body.orientation) * axes,
                angular_velocity: body.angular_velocity.into(),
            })
        };
        self.bodies.iter().enumerate().filter_map(specification).collect()
    }

    fn material_index(&self, name: &str) -> usize {
        self.materials.iter().position(|material| material.name == name).unwrap_or(usize::MAX)
    }

    fn key_of_body(&self, id: u32) -> String {
        let place = self.bodies.iter().enumerate().position(|(place, body)| body.id.unwrap_or(place as u32) == id);
        place.map_or("body".to_string(), |place| format!("body[{place}]"))
    }

    /// Names both sides of a candidate pair for an error.
    fn name_of(&self, bodies: &Bodies, candidate: &Candidate) -> String {
        let first = bodies.id(candidate.first());
        match candidate.second() {
            Partner::Body(second) => format!("bodies {first} and {}", bodies.id(second)),
            Partner::Wall(wall) => format!("body {first} and boundary `{}`", self.boundary_of_wall(wall).name),
        }
    }

    fn refuse_overlaps(&self, bodies: &Bodies, stages: &mut [Box<dyn ContactStage>]) -> Result<(), SceneError> {
        if self.numerics.initial_overlap == InitialOverlap::Allow {
            return Ok(());
        }
        let pairs = stages.iter_mut().flat_map(|stage| {
            let candidates = stage.candidates().to_vec();
            candidates.into_iter().filter_map(move |candidate| Some((stage.overlap(bodies, &candidate)?, candidate))).collect::<Vec<_>>()
        });
        for (overlap, candidate) in pairs {
            if overlap > 0.0 {
                return Err(self.overlap_error(bodies, &candidate, overlap));
            }
        }
        Ok(())
    }

    fn overlap_error(&self, bodies: &Bodies, candidate: &Candidate, overlap: f64) -> SceneError {
        let message = format!(
            "{} overlap by {overlap} m at the start; move them apart, or set numerics.initial_overlap = \"allow\"",
            self.name_of(bodies, candidate)
        );
        let key = format!("{}.position", self.key_of_body(bodies.id(candidate.first())));
        SceneError::new(SceneErrorKind::Overlap, key, message)
    }

    fn why_no_contacts(&self) -> String {
        if self.pairs.is_empty() {
            "the scene has no [[pair]]".to_string()
        } else {
            "no two things in the scene are of materials that have a [[pair]]".to_string()
        }
    }

    /// What the scene does not need, before it is known how bodies turn.
    fn left_out(&self, contacts: &[Box<dyn ContactStage>], is_hard: bool) -> LeftOut {
        let mut left_out = Vec::new();
        if contacts.is_empty() && !is_hard {
            left_out.push(("contacts", self.why_no_contacts()));
        }
        if self.scene.gravity.is_none() {
            left_out.push(("gravity", "the scene has none".to_string()));
        }
        left_out
    }

    /// How bodies turn, and what the scene does not need.
    fn rotation_stages(
        &self,
        bodies: &Bodies,
        contacts: &[Box<dyn ContactStage>],
        is_hard: bool,
    ) -> (Vec<Box<dyn RotationStage>>, LeftOut) {
        let mut left_out = self.left_out(contacts, is_hard);
        let mut stages: Vec<Box<dyn RotationStage>> = Vec::new();
        if is_hard {
            // Hard bodies fly and turn in their own stage.
            return (stages, left_out);
        }
        let is_in_flow = |index: usize| self.fluid.is_some() && bodies.shape(index).as_sphere().is_none();
        let looked_at = self.looks_at_isotropic_orientation()
            || contacts.iter().any(|stage| stage.needs_orientation())
            || (0..bodies.len()).any(is_in_flow);
        let turned = self.fluid.is_some() || contacts.iter().any(|stage| stage.needs_rotation());
        if Turning::Isotropic.members(bodies).is_empty() {
            left_out.push(("spin of isotropic bodies", "there are none".to_string()));
        } else if turned || looked_at {
            stages.push(Box::new(IsotropicSpin::new(bodies, looked_at)));
        } else {
            left_out.push((
                "spin of isotropic bodies",
                "no force turns them and nothing looks at their orientation, which stays as it was".to_string(),
            ));
        }
        if Turning::NotIsotropic.members(bodies).is_empty() {
            left_out.push(("free turns", "every body is isotropic".to_string()));
            return (stages, left_out);
        }
        let with_shortcut = self.numerics.rotation == Rotation::Splitting;
        if with_shortcut && !Turning::Axisymmetric.members(bodies).is_empty() {
            stages.push(Box::new(FreeTurns::new(bodies, Turning::Axisymmetric, Precession)));
        }
        let rest = if with_shortcut { Turning::General } else { Turning::NotIsotropic };
        if !rest.members(bodies).is_empty() {
            stages.push(match self.numerics.rotation {
                Rotation::Splitting | Rotation::SplittingWithoutShortcut => Box::new(FreeTurns::new(bodies, rest, Splitting)),
                Rotation::SplittingFourthOrder => Box::new(FreeTurns::new(bodies, rest, SplittingFourthOrder)),
                Rotation::RungeKuttaFourthOrder => Box::new(FreeTurns::new(bodies, rest, RungeKutta4)),
                Rotation::ExplicitEuler => Box::new(FreeTurns::new(bodies, rest, ExplicitEuler)),
                Rotation::ExplicitEulerAsPrinted => Box::new(FreeTurns::new(bodies, rest, ExplicitEulerAsPrinted)),
            });
        }
        (stages, left_out)
    }
}

/// Stages that are left out, and why.
type LeftOut = Vec<(&'static str, String)>;
