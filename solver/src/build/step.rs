//! The time step of a scene: given, and then checked, or advised from what can touch.

use crate::Bodies;
use crate::contact::pairs::{Candidate, Partner};
use crate::contact::stage::ContactStage;
use crate::scene::{DampingTime, Fluid, Scene, SceneError, SceneErrorKind, Step};

/// More contacts than a body has among bodies of its size.
const CONTACTS_OF_A_BODY: f64 = 12.0;

/// The part of the time of a Rayleigh wave that an advised step takes at most: a disturbance must not outrun the neighbours.
const PART_OF_WAVE_TIME: f64 = 0.2;

/// More steps of contacts in one of the fluid are certainly not meant.
const MOST_CONTACT_STEPS: f64 = 1e6;

/// Steps that the shortest contact must last (S eq. 3.52).
const LEAST_STEPS_IN_A_CONTACT: f64 = 15.0;

impl Scene {
    /// The step in s. `examples` are pairs of every two sizes that can touch, with their stages.
    pub(super) fn time_step(
        &self,
        bodies: &Bodies,
        stages: &[Box<dyn ContactStage>],
        examples: &[(usize, Candidate)],
    ) -> Result<f64, SceneError> {
        let lagged = self.numerics.damping == DampingTime::Lagged;
        let scales = || examples.iter().map(|(stage, candidate)| (stages[*stage].time_scales(bodies, candidate, lagged), candidate));
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

    /// The step of contacts in s, and how many of them make one of the fluid: as few as the step of a scene without the fluid, given or advised, allows.
    pub(super) fn step_within(
        &self,
        fluid: &Fluid,
        bodies: &Bodies,
        stages: &[Box<dyn ContactStage>],
        examples: &[(usize, Candidate)],
    ) -> Result<(f64, u64), SceneError> {
        let nothing_asks = examples.is_empty() && matches!(self.numerics.step, Step::Chosen(_));
        let longest = if nothing_asks { fluid.step } else { self.time_step(bodies, stages, examples)? };
        let steps = (fluid.step / longest * (1.0 - 4.0 * f64::EPSILON)).ceil().max(1.0);
        if steps > MOST_CONTACT_STEPS {
            let message = format!(
                "{} s is {steps:e} steps of {longest:e} s for the stiffest contact; at most {MOST_CONTACT_STEPS:e} are allowed: take a shorter step or softer contacts",
                fluid.step
            );
            return Err(SceneError::new(SceneErrorKind::Combination, "fluid.step", message));
        }
        Ok((fluid.step / steps, steps as u64))
    }

    /// For every pair of materials that can touch, how many steps its shortest contact lasts: S's criterion (eq. 3.51-3.52), which asks for 15. The
    /// turning of slender bodies and the number of contact points are in the durations.
    pub(super) fn steps_in_contacts(
        &self,
        bodies: &Bodies,
        stages: &[Box<dyn ContactStage>],
        examples: &[(usize, Candidate)],
        step: f64,
    ) -> Option<String> {
        let mut durations: Vec<([usize; 2], f64)> = Vec::new();
        let mut wave = f64::INFINITY;
        for (stage, candidate) in examples {
            let scales = stages[*stage].time_scales(bodies, candidate, false);
            wave = wave.min(scales.wave_time);
            let other = match candidate.second() {
                Partner::Body(second) => bodies.material(second),
                Partner::Wall(wall) => self.material_index(&self.boundary_of_wall(wall).material),
            };
            let materials = [bodies.material(candidate.first()).min(other), bodies.material(candidate.first()).max(other)];
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
}
