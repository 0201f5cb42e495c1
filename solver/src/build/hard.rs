//! The stage of hard contacts of a scene, if its pairs have impulses.

use crate::Bodies;
use crate::contact::impulse::{FrictionImpulse, ImpulseLaw};
use crate::contact::stage::Candidate;
use crate::scene::{HardContact, InitialOverlap, NormalLaw, Pair, Scene, SceneError, SceneErrorKind, Step, TangentialLaw};
use crate::scheme::hard::{EventDriven, HardContacts, HardStage, Mode, TimeDriven};

impl Scene {
    /// The stage of hard contacts; `None` if no pair has impulses.
    pub(super) fn hard_stage(&self, bodies: &Bodies) -> Result<Option<HardStage>, SceneError> {
        let laws: Vec<ImpulseLaw> = self.pairs.iter().filter_map(impulse_law).collect();
        if laws.is_empty() {
            return Ok(None);
        }
        let pair_of = |one: usize, other: usize| {
            let [one, other] = [one, other].map(|material| self.materials.get(material).map(|material| &material.name));
            self.pairs.iter().position(|pair| {
                let [first, second] = [Some(&pair.materials[0]), Some(&pair.materials[1])];
                (first, second) == (one, other) || (second, first) == (one, other)
            })
        };
        let candidates = self.candidates(bodies, pair_of)?;
        let parts = self.parts_of_bodies(bodies)?;
        let looked_at = self.looks_at_isotropic_orientation();
        let turns = (0..bodies.len()).map(|index| looked_at || bodies.shape(index).as_sphere().is_none()).collect();
        let mode = match self.numerics.hard_contact.clone().unwrap_or_default() {
            HardContact::EventDriven(mode) => Mode::EventDriven(EventDriven::new(mode.tolerance, &candidates, bodies.len())),
            HardContact::TimeDriven(mode) => Mode::TimeDriven(TimeDriven { sweeps: mode.sweeps, tolerance: mode.tolerance }),
        };
        if matches!(mode, Mode::EventDriven(_)) && self.numerics.initial_overlap == InitialOverlap::Allow {
            let message = "event-driven hard contacts cannot begin in an overlap: use time_driven, or leave it out";
            return Err(SceneError::new(SceneErrorKind::Combination, "numerics.initial_overlap", message));
        }
        let stage = HardStage::new(HardContacts { candidates, laws, walls: self.walls(), parts, turns }, mode);
        self.refuse_hard_overlaps(bodies, &stage)?;
        Ok(Some(stage))
    }

    fn refuse_hard_overlaps(&self, bodies: &Bodies, stage: &HardStage) -> Result<(), SceneError> {
        if self.numerics.initial_overlap == InitialOverlap::Allow {
            return Ok(());
        }
        let overlap_of = |candidate: &Candidate| Some((*candidate, stage.overlap(bodies, candidate)?));
        match stage.contacts.candidates.iter().find_map(overlap_of) {
            None => Ok(()),
            Some((candidate, overlap)) => Err(self.overlap_error(bodies, &candidate, overlap)),
        }
    }

    /// The step in s between two looks at hard bodies: there is no contact to advise it from.
    pub(super) fn step_of_hard_bodies(&self) -> Result<f64, SceneError> {
        match self.numerics.step {
            Step::Seconds(step) => Ok(step),
            Step::Chosen(_) => {
                let message = "hard contacts have no duration to advise a step from: give it in s";
                Err(SceneError::new(SceneErrorKind::Combination, "numerics.step", message))
            }
        }
    }
}

fn impulse_law(pair: &Pair) -> Option<ImpulseLaw> {
    let NormalLaw::Impulse(normal) = &pair.normal else { return None };
    let friction = match &pair.tangential {
        Some(TangentialLaw::CoulombImpulse(law)) => Some(FrictionImpulse {
            dynamic_friction: law.dynamic_friction,
            static_friction: law.static_friction.unwrap_or(law.dynamic_friction),
            clamp: law.clamp,
        }),
        _ => None,
    };
    Some(ImpulseLaw { restitution: normal.restitution, friction })
}
