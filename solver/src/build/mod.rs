//! Scene to simulation: the only place that matches on options. What is not supported is refused, never ignored.

mod boundaries;
mod contacts;
mod hard;
mod insertion;
mod shapes;

use crate::bodies::BodySpecification;
use crate::contact::law::StepKind;
use crate::contact::stage::{Candidate, ContactStage, Partner};
use crate::motion::rotation::{
    ExplicitEuler, ExplicitEulerAsPrinted, FreeTurns, IsotropicSpin, Precession, RotationStage, RungeKutta4, Splitting,
    SplittingFourthOrder,
};
use crate::scene::{Body, ContactEdges, DampingTime, InitialOverlap, Measure, Rotation, Scene, SceneError, SceneErrorKind, Step};
use crate::scheme::granular::Stages;
use crate::{Bodies, Simulation, Vector};
pub use boundaries::SceneWall;
pub use insertion::{SceneInflow, Source};
use shapes::{ResolvedShape, orientation_of};

/// More contacts than a body has among bodies of its size.
const CONTACTS_OF_A_BODY: f64 = 12.0;

/// The part of the time of a Rayleigh wave that an advised step takes at most: a disturbance must not outrun the neighbours.
const PART_OF_WAVE_TIME: f64 = 0.2;

/// Steps that the shortest contact must last (S eq. 3.52).
const LEAST_STEPS_IN_A_CONTACT: f64 = 15.0;

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
        let inserted = self.insert_before_the_start(&shapes, &self.moving_walls()?, &mut specifications)?;
        self.refuse_unsupported_boundaries()?;
        self.refuse_unsupported_inflows(&shapes)?;
        let bodies = Bodies::new(specifications);
        let mut contacts = self.contact_stages(&bodies)?;
        self.refuse_overlaps(&bodies, &mut contacts)?;
        let hard = self.hard_stage(&bodies)?;
        let kind = StepKind {
            step: if hard.is_some() { self.step_of_hard_bodies()? } else { self.time_step(&bodies, &contacts)? },
            synchronous: true,
            lagged_damping: self.numerics.damping == DampingTime::Lagged,
            resolved_edges: self.numerics.contact_edges == ContactEdges::Resolved,
        };
        self.check_number_of_steps(kind.step)?;
        let mut left_out = Vec::new();
        if contacts.is_empty() && hard.is_none() {
            left_out.push(("contacts", self.why_no_contacts()));
        }
        let gravity = self.scene.gravity.map(Vector::from);
        if gravity.is_none() {
            left_out.push(("gravity", "the scene has none".to_string()));
        }
        // Hard bodies fly and turn in their own stage.
        let rotation = if hard.is_some() { Vec::new() } else { self.rotation_stages(&bodies, &contacts, &mut left_out) };
        let stages = Stages { contacts, gravity, rotation, hard };
        let remark = |shape: ResolvedShape| shape.remark.map(|remark| (format!("shape `{}`", shape.name), remark));
        let steps = self.steps_in_contacts(&bodies, &stages.contacts, kind.step).map(|remark| ("time step".to_string(), remark));
        let remarks = shapes.into_iter().filter_map(remark).chain(inserted).chain(steps).collect();
        Ok(Simulation { scene: self.clone(), bodies, stages, kind, steps_taken: 0, forces_are_current: false, remarks, left_out })
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
        let first = bodies.id(candidate.first);
        match candidate.second {
            Partner::Body(second) => format!("bodies {first} and {}", bodies.id(second)),
            Partner::Wall(wall) => format!("body {first} and boundary `{}`", self.boundaries[wall].name),
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
        let key = format!("{}.position", self.key_of_body(bodies.id(candidate.first)));
        SceneError::new(SceneErrorKind::Overlap, key, message)
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
                let shortest = scales().map(|(scale, _)| scale.half_period.min(scale.contact_duration)).fold(f64::INFINITY, f64::min);
                if shortest.is_infinite() {
                    let message = "nothing in the scene can touch, so there is no contact to advise a step from: give it in s";
                    return Err(SceneError::new(SceneErrorKind::Combination, "numerics.step", message));
                }
                let limit = stiffest.map_or(f64::INFINITY, |(scale, _)| scale.largest_step);
                // A body has up to a dozen contacts, and each sees the dashpots of the others as they were a step ago.
                let dampest = scales().map(|(scale, _)| scale.damping_time).fold(f64::INFINITY, f64::min);
                let wave = scales().map(|(scale, _)| scale.wave_time).fold(f64::INFINITY, f64::min);
                let accurate = (shortest / self.numerics.steps_per_contact.0).min(PART_OF_WAVE_TIME * wave);
                Ok(accurate.min(dampest / CONTACTS_OF_A_BODY).min(0.5 * limit))
            }
        }
    }

    /// For every pair of materials that can touch, how many steps its shortest contact lasts: S's criterion (eq. 3.51-3.52), which asks for 15. The
    /// turning of slender bodies and the number of contact points are in the durations.
    fn steps_in_contacts(&self, bodies: &Bodies, stages: &[Box<dyn ContactStage>], step: f64) -> Option<String> {
        let mut durations: Vec<([usize; 2], f64)> = Vec::new();
        let mut wave = f64::INFINITY;
        for (stage, candidate) in candidates_of(stages) {
            let scales = stage.time_scales(bodies, candidate, false);
            wave = wave.min(scales.wave_time);
            let other = match candidate.second {
                Partner::Body(second) => bodies.material(second),
                Partner::Wall(wall) => self.material_index(&self.boundaries[wall].material),
            };
            let materials = [bodies.material(candidate.first).min(other), bodies.material(candidate.first).max(other)];
            match durations.iter_mut().find(|(known, _)| *known == materials) {
                Some((_, shortest)) => *shortest = shortest.min(scales.contact_duration),
                None => durations.push((materials, scales.contact_duration)),
            }
        }
        let name = |material: usize| &self.materials[material].name;
        let of_pair = |([one, other], duration): &([usize; 2], f64)| {
            format!("{} on {}: contact duration {duration:.3e} s is {:.1} steps", name(*one), name(*other), duration / step)
        };
        let mut text = durations.iter().map(of_pair).collect::<Vec<_>>().join(", ");
        if wave.is_finite() {
            text += &format!(", Rayleigh wave {:.1} steps", wave / step);
        }
        let shortest = durations.iter().map(|(_, duration)| *duration).reduce(f64::min)? / step;
        let verdict = if shortest < LEAST_STEPS_IN_A_CONTACT { "fewer than" } else { "no fewer than" };
        Some(format!("{step:.3e} s; {text}; {verdict} the {LEAST_STEPS_IN_A_CONTACT} steps of S eq. 3.52"))
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
        let looked_at = self.looks_at_isotropic_orientation() || contacts.iter().any(|stage| stage.needs_orientation());
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

fn is_axisymmetric(inertia: Vector) -> bool {
    inertia.x == inertia.y || inertia.y == inertia.z || inertia.z == inertia.x
}
