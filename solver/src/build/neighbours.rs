//! How the bodies of a scene find their neighbours.

use std::sync::Arc;

use crate::Bodies;
use crate::boundary::MovingWall;
use crate::broad_phase::NeighbourList;
use crate::broad_phase::neighbour_list::{Settings, Skin};
use crate::contact::neighbours::{Neighbours, Pairing, Search};
use crate::scene::{Scene, SceneError, SceneErrorKind, SearchMethod};

/// Up to this many bodies the automatic choice tests every pair.
const FEW_BODIES: usize = 100;

/// Above this many bodies every pair is too many: four million tests a step.
const LARGEST_NUMBER_FOR_ALL_PAIRS: usize = 3000;

/// Above this many bodies the automatic choice sorts them in space: they no longer fit into the nearest cache.
const MANY_BODIES: usize = 4000;

/// Width of the first skin over the mean diameter, if none is given: that of bodies at rest, which may never need a second. Where bodies are fast the first list is used
/// up after a few steps.
const FIRST_SKIN: f64 = 0.03;

/// Lists between two sorts, if none are given.
const LISTS_BETWEEN_SORTS: u32 = 20;

impl Scene {
    /// The search for neighbours that the scene asks for.
    pub(super) fn neighbours(&self, bodies: &Bodies, pairing: Pairing, walls: Arc<[MovingWall]>) -> Result<Neighbours, SceneError> {
        let settings = &self.numerics.neighbours;
        let domain = self.periodic_domain();
        let all_pairs = match settings.method {
            SearchMethod::Automatic => bodies.len() <= FEW_BODIES && domain.is_none(),
            SearchMethod::AllPairs => true,
            SearchMethod::List => false,
        };
        let key = "numerics.neighbours.method";
        if all_pairs && domain.is_some() {
            let message = "all_pairs knows no periodic sides; take list";
            return Err(SceneError::new(SceneErrorKind::Combination, key, message));
        }
        if all_pairs && bodies.len() > LARGEST_NUMBER_FOR_ALL_PAIRS {
            let message = format!("all_pairs is for at most {LARGEST_NUMBER_FOR_ALL_PAIRS} bodies, not for {}; take list", bodies.len());
            return Err(SceneError::new(SceneErrorKind::Unsupported, key, message));
        }
        if all_pairs {
            return Ok(Neighbours::new(Search::AllPairs { is_done: false }, pairing, walls));
        }
        let radii = || (0..bodies.len()).map(|index| bodies.shape(index).bounding_radius());
        let diameter = 2.0 * radii().sum::<f64>() / bodies.len() as f64;
        let narrow = settings.skin.unwrap_or(FIRST_SKIN * diameter);
        let automatic = if bodies.len() > MANY_BODIES { LISTS_BETWEEN_SORTS } else { 0 };
        let lists_between_sorts = u64::from(settings.lists_between_sorts.unwrap_or(automatic));
        let largest = 2.0 * radii().fold(0.0, f64::max);
        let period = domain.map_or(f64::INFINITY, |domain| domain.smallest_period());
        let reach = largest + narrow;
        if period < reach {
            let message = format!(
                "the box repeats after {period} m, less than the largest body and the skin are wide, {reach} m: a body would meet images of itself \
                 that lie more than one period away"
            );
            return Err(SceneError::new(SceneErrorKind::Combination, "domain.upper", message));
        }
        let skin = match settings.skin {
            Some(skin) => Skin::Fixed(skin),
            None => Skin::Adapted { first: narrow, diameter, widest: period - largest },
        };
        let list = NeighbourList::new(Settings { skin, lists_between_sorts }, domain);
        Ok(Neighbours::new(Search::List(list), pairing, walls))
    }
}
