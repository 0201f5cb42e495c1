//! Which bodies may touch until some body has moved far enough (Verlet's list).
//!
//! A pair is listed while its balls, each widened by half the skin, overlap. No listed pair can be missing before some body has moved by half the skin,
//! and that is looked at before every use: the sum of the largest speeds bounds all displacements at no cost, and only when the bound is
//! used up are the bodies themselves compared with where they were. A wall that moves uses up the same half of the skin, by the bound on its speed alone.

use serde::{Deserialize, Serialize};

use super::cells::{Ball, NearPair, near_pairs};
use super::morton;
use crate::domain::Domain;
use crate::{Bodies, Vector};

/// How neighbours are listed, the same for a whole run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Width in m by which pairs may be apart when they are listed.
    pub skin: f64,
    /// Lists after which bodies are sorted in space; 0 for never.
    pub lists_between_sorts: u64,
}

/// A list of near pairs and when it must be made anew.
#[derive(Debug, Clone, PartialEq)]
pub struct NeighbourList {
    settings: Settings,
    domain: Option<Domain>,
    state: ListState,
}

/// What a checkpoint keeps of a list, so that the next run makes the same lists at the same steps.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ListState {
    /// Where the bodies were when the list was made, in storage order, in m.
    reference: Vec<Vector>,
    /// When it was made, in s: walls were where they are at that time.
    #[serde(default)]
    time: f64,
    /// No body has come nearer to another or to a wall by more than twice this since, in m.
    travel: f64,
    /// What walls have contributed to it, in m.
    #[serde(default)]
    travel_of_walls: f64,
    /// Lists made so far.
    lists: u64,
    /// Lists that were due by the bound on displacements, but not by the displacements.
    looks: u64,
}

impl NeighbourList {
    /// A list that must be made before its first use.
    pub fn new(settings: Settings, domain: Option<Domain>) -> NeighbourList {
        NeighbourList { settings, domain, state: ListState { travel: f64::INFINITY, ..ListState::default() } }
    }

    /// Width in m by which pairs may be apart when they are listed.
    pub fn skin(&self) -> f64 {
        self.settings.skin
    }

    /// Name for the ledger.
    pub fn name(&self) -> String {
        let Settings { skin, lists_between_sorts } = self.settings;
        let sorted = match lists_between_sorts {
            0 => String::new(),
            every => format!(", bodies sorted in space every {every} lists"),
        };
        format!("list of pairs within a skin of {skin:.3e} m, by cells{sorted}")
    }

    /// Lists made so far.
    pub fn lists(&self) -> u64 {
        self.state.lists
    }

    /// Takes note of a step in s during which no body was faster than a speed in m/s, and no wall than another.
    pub fn note_motion(&mut self, speed: f64, speed_of_walls: f64, step: f64) {
        self.state.travel += (speed + speed_of_walls) * step;
        self.state.travel_of_walls += speed_of_walls * step;
    }

    /// Whether a body may have moved so far that pairs are missing.
    pub fn is_stale(&mut self, bodies: &Bodies) -> bool {
        let allowed = 0.5 * self.settings.skin;
        if self.state.travel <= allowed && self.state.reference.len() == bodies.len() {
            return false;
        }
        if self.state.reference.len() != bodies.len() {
            return true;
        }
        self.state.looks += 1;
        let moved = bodies.state.motion.iter().zip(&self.state.reference).map(|(body, place)| (body.position - place).norm_squared());
        self.state.travel = moved.fold(0.0, f64::max).sqrt() + self.state.travel_of_walls;
        self.state.travel > allowed
    }

    /// Puts bodies back into the periodic box and, when it is time, sorts them in space. Returns the order in which they are stored now if it has
    /// changed: the body that was at `order[n]` is at `n`.
    pub fn prepare(&mut self, bodies: &mut Bodies) -> Option<Vec<u32>> {
        if let Some(domain) = &self.domain {
            for body in &mut bodies.state.motion {
                body.position = domain.wrapped(&body.position);
            }
        }
        let interval = self.settings.lists_between_sorts;
        let is_due = interval > 0 && self.state.lists.is_multiple_of(interval);
        let order = is_due.then(|| morton::order(bodies)).filter(|order| !order.is_sorted());
        if let Some(order) = &order {
            bodies.reorder(order);
        }
        order
    }

    /// Makes the list for bodies where they are at a time in s.
    pub fn make(&mut self, bodies: &Bodies, time: f64) -> Vec<NearPair> {
        (self.state.time, self.state.travel_of_walls) = (time, 0.0);
        self.state.reference = bodies.state.motion.iter().map(|body| body.position).collect();
        self.state.travel = 0.0;
        self.state.lists += 1;
        self.pairs_of_reference(bodies)
    }

    /// The list again as it was made.
    fn pairs_of_reference(&self, bodies: &Bodies) -> Vec<NearPair> {
        let half_skin = 0.5 * self.settings.skin;
        let places = bodies.state.motion.iter().zip(&self.state.reference);
        let balls: Vec<Ball> = places.map(|(body, place)| Ball { position: *place, reach: body.radius + half_skin }).collect();
        near_pairs(&balls, self.domain.as_ref())
    }

    /// What a checkpoint keeps.
    pub fn state(&self) -> &ListState {
        &self.state
    }

    /// Takes back what [`NeighbourList::state`] gave, and returns the list as it was.
    pub fn restore(&mut self, state: ListState, bodies: &Bodies) -> Vec<NearPair> {
        self.state = state;
        self.pairs_of_reference(bodies)
    }

    /// When the list was made, in s.
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Where bodies were when the list was made, in m.
    pub fn reference(&self) -> &[Vector] {
        &self.state.reference
    }
}
