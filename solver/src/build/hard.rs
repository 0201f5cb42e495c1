//! The stage of hard contacts of a scene, if its pairs have impulses.

use super::SceneWall;
use crate::Bodies;
use crate::broad_phase::all_pairs;
use crate::contact::impulse::{FrictionImpulse, ImpulseLaw};
use crate::contact::pairs::Candidate;
use crate::domain::Image;
use crate::scene::{Domain, HardContact, InitialOverlap, NormalLaw, Pair, Scene, SceneError, SceneErrorKind, Step, TangentialLaw};
use crate::scheme::hard::{EventDriven, HardContacts, HardStage, Mode, TimeDriven};

/// Above this many bodies every pair is too many: four million looks a step.
const LARGEST_NUMBER_OF_HARD_BODIES: usize = 3000;

impl Scene {
    /// The stage of hard contacts; `None` if no pair has impulses.
    pub(super) fn hard_stage(&self, bodies: &Bodies, walls: &[SceneWall]) -> Result<Option<HardStage>, SceneError> {
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
        let planes = self.planes_for_hard_bodies(walls)?;
        let candidates = self.hard_candidates(bodies, walls, pair_of)?;
        let parts = self.parts_of_shapes(bodies)?;
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
        let stage = HardStage::new(HardContacts { candidates, laws, walls: planes, parts, turns }, mode);
        self.refuse_hard_overlaps(bodies, &stage)?;
        Ok(Some(stage))
    }

    /// Every pair for the whole run: hard bodies are few.
    fn hard_candidates(
        &self,
        bodies: &Bodies,
        walls: &[SceneWall],
        laws_of: impl Fn(usize, usize) -> Option<usize>,
    ) -> Result<Vec<Candidate>, SceneError> {
        if bodies.len() > LARGEST_NUMBER_OF_HARD_BODIES {
            let message =
                format!("{} hard bodies are too many: every pair is looked at, for at most {LARGEST_NUMBER_OF_HARD_BODIES}", bodies.len());
            return Err(SceneError::new(SceneErrorKind::Unsupported, "body", message));
        }
        if self.domain.as_ref().is_some_and(Domain::is_periodic) {
            let message = "hard bodies know no periodic sides: give walls, or a soft contact law";
            return Err(SceneError::new(SceneErrorKind::Unsupported, "domain.periodic", message));
        }
        let material = |index| bodies.material(index);
        let pairs = all_pairs(bodies.len()).into_iter().map(|pair| (pair.low as usize, pair.high as usize));
        let of_bodies = pairs.filter_map(|(first, second)| {
            Some(Candidate::of_bodies(first, second, laws_of(material(first), material(second))?, Image::SAME))
        });
        let walls = || walls.iter().map(|wall| self.material_index(&self.boundaries[wall.boundary].material)).enumerate();
        let at_walls = (0..bodies.len()).flat_map(|first| {
            let laws_at = &laws_of;
            walls().filter_map(move |(wall, other)| Some(Candidate::at_wall(first, wall, laws_at(material(first), other)?)))
        });
        Ok(of_bodies.chain(at_walls).collect())
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
