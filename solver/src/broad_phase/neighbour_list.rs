//! Which bodies may touch until some body has moved far enough (Verlet's list).
//!
//! A pair is listed while its balls, each widened by half the skin, overlap. No listed pair can be missing before some body has moved by half the skin,
//! and that is looked at before every use: the sum of the largest speeds bounds all displacements at no cost, and only when the bound is
//! used up are the bodies themselves compared with where they were. A wall that moves uses up the same half of the skin, by the bound on its speed alone.

use serde::{Deserialize, Serialize};

use super::cells::{Ball, NearPair, near_pairs};
use super::morton;
use crate::domain::Domain;
use crate::relocation::Relocation;
use crate::{Bodies, Vector};

/// How neighbours are listed, the same for a whole run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Width in m by which pairs may be apart when they are listed.
    pub skin: Skin,
    /// Lists after which bodies are sorted in space; 0 for never.
    pub lists_between_sorts: u64,
}

/// Width in m by which pairs may be apart when they are listed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Skin {
    /// Always this.
    Fixed(f64),
    /// What costs least at the speed with which the last list was used up.
    ///
    /// A list costs as much as many tests of its pairs, and a skin of $w$ lasts $w / 2 s$ steps in which bodies move by $s$ at most, with a part of about $3 w / d$ more
    /// pairs than a skin of none, among bodies of a diameter $d$. The sum is least at a $w$ in proportion to $\sqrt{s d}$.
    Adapted {
        /// Of the first list.
        first: f64,
        /// Mean diameter of the bodies.
        diameter: f64,
        /// No skin is wider: a body must not meet two images of another.
        widest: f64,
    },
}

/// Square of the best skin over diameter and motion in a step: two thirds of what a list costs, measured in tests of the pairs of bodies that touch or nearly do.
const COST_OF_LIST: f64 = 20.0;
/// Limits of an adapted skin over the diameter.
const NARROWEST: f64 = 0.03;
const WIDEST: f64 = 0.5;

impl Skin {
    fn first(&self) -> f64 {
        match *self {
            Skin::Fixed(skin) | Skin::Adapted { first: skin, .. } => skin,
        }
    }

    /// The next skin, after steps in which the fastest body moved so far in m; the last one if no step tells anything.
    fn next(&self, last: f64, travel: f64, steps: u64) -> f64 {
        match *self {
            Skin::Fixed(skin) => skin,
            Skin::Adapted { diameter, widest, .. } if steps > 0 => {
                let best = (COST_OF_LIST * diameter * travel / steps as f64).sqrt();
                best.clamp(NARROWEST * diameter, WIDEST * diameter).min(widest)
            }
            Skin::Adapted { first, .. } => {
                if last > 0.0 {
                    last
                } else {
                    first
                }
            }
        }
    }
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
    /// Width in m by which its pairs may have been apart.
    #[serde(default)]
    skin: f64,
    /// Steps since.
    #[serde(default)]
    steps: u64,
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
        let state = ListState { travel: f64::INFINITY, skin: settings.skin.first(), ..ListState::default() };
        NeighbourList { settings, domain, state }
    }

    /// Width in m by which pairs may have been apart when they were listed.
    pub fn skin(&self) -> f64 {
        self.state.skin
    }

    /// Name for the ledger.
    pub fn name(&self) -> String {
        let skin = match self.settings.skin {
            Skin::Fixed(skin) => format!("of {skin:.3e} m"),
            Skin::Adapted { .. } => format!("adapted to the speed, {:.3e} m at the end", self.state.skin),
        };
        let sorted = match self.settings.lists_between_sorts {
            0 => String::new(),
            every => format!(", bodies sorted in space every {every} lists"),
        };
        format!("list of pairs within a skin {skin}, by cells{sorted}")
    }

    /// Lists made so far.
    pub fn lists(&self) -> u64 {
        self.state.lists
    }

    /// Takes note of a step in s during which no body was faster than a speed in m/s, and no wall than another.
    pub fn note_motion(&mut self, speed: f64, speed_of_walls: f64, step: f64) {
        self.state.steps += 1;
        self.state.travel += (speed + speed_of_walls) * step;
        self.state.travel_of_walls += speed_of_walls * step;
    }

    /// Whether a body may have moved so far that pairs are missing.
    pub fn is_stale(&mut self, bodies: &Bodies) -> bool {
        let allowed = 0.5 * self.state.skin;
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
        self.state.skin = self.settings.skin.next(self.state.skin, self.state.travel, self.state.steps);
        self.state.reference = bodies.state.motion.iter().map(|body| body.position).collect();
        (self.state.time, self.state.steps, self.state.travel, self.state.travel_of_walls) = (time, 0, 0.0, 0.0);
        self.state.lists += 1;
        self.pairs_of_reference(bodies)
    }

    /// Forgets bodies that are gone; `moved` tells where the others are stored, in the order they had. Their pairs stay listed.
    pub(crate) fn forget_gone(&mut self, moved: &Relocation) {
        let mut old = 0..;
        self.state.reference.retain(|_| old.next().is_some_and(|old| moved.place(old).is_some()));
    }

    /// The list again as it was made.
    fn pairs_of_reference(&self, bodies: &Bodies) -> Vec<NearPair> {
        let half_skin = 0.5 * self.state.skin;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Convex, Sphere};
    use crate::test_bodies::at_rest;

    const SKIN: Skin = Skin::Adapted { first: 0.2, diameter: 2.0, widest: 0.9 };

    /// A ball that moves by some metres in each of some steps, until its list is used up: steps that it lasted.
    fn steps_of_list(list: &mut NeighbourList, motion: f64) -> u64 {
        let mut bodies = Bodies::new(vec![at_rest(Convex::Sphere(Sphere { radius: 1.0 }), 1.0)]);
        list.make(&bodies, 0.0);
        (1..)
            .find(|_| {
                list.note_motion(motion, 0.0, 1.0);
                bodies.state.motion[0].position.x += motion;
                list.is_stale(&bodies)
            })
            .unwrap_or(0)
    }

    #[test]
    fn an_adapted_skin_follows_the_speed_between_its_limits() {
        let mut list = NeighbourList::new(Settings { skin: SKIN, lists_between_sorts: 0 }, None);
        // Half of the first skin.
        assert_eq!(steps_of_list(&mut list, 0.03), 4);
        for (motion, skin) in [(0.001, (COST_OF_LIST * 2.0 * 0.001).sqrt()), (1e-6, NARROWEST * 2.0), (0.3, 0.9)] {
            steps_of_list(&mut list, motion);
            let lasted = steps_of_list(&mut list, motion);
            assert!((list.skin() / skin - 1.0).abs() < 1e-9, "{} for {skin} at {motion}", list.skin());
            assert!(lasted.abs_diff((0.5 * skin / motion) as u64 + 1) <= 1, "{lasted} steps");
        }
    }

    #[test]
    fn a_given_skin_stays() {
        let mut list = NeighbourList::new(Settings { skin: Skin::Fixed(0.2), lists_between_sorts: 0 }, None);
        for motion in [0.03, 0.001, 0.09] {
            assert!(steps_of_list(&mut list, motion).abs_diff((0.1 / motion) as u64 + 1) <= 1);
        }
    }
}
