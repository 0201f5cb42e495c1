//! Time-driven hard bodies, as S has them: all bodies move for a whole step, and what overlaps then is mended.
//!
//! Contacts that approach take their impulses one after the other, sweep by sweep, until none approaches or the sweeps are used up. Then bodies that
//! overlap are pushed apart along the normal, each by half of the overlap; at a wall the body alone (S eq. 2.17, 2.35 and 2.41-2.42; errata: the printed signs push
//! bodies into each other, and by the whole overlap each, so that they end up apart by another one). Pushing does no work on kinetic energy, but
//! bodies that gravity pulls are lifted; and bodies that pass through each other's corners within a step are never seen. Collisions are late by half a step
//! in the mean: the scheme is of first order.

use super::flight::Flight;
use super::{Counts, HardContacts};
use crate::contact::Touch;
use crate::contact::detect::{PlacedCore, Points, core_pair, core_plane};
use crate::contact::impulse::CollisionPoint;
use crate::contact::shaped::DetectedPart;
use crate::contact::stage::{Candidate, Partner};
use crate::distance::{Pose, RoundedCore};
use crate::{Bodies, Vector};

/// Collisions at the ends of steps.
pub struct TimeDriven {
    /// The largest number of sweeps over the contacts of a step.
    pub sweeps: u32,
    /// Approach that is left alone after the first sweep, as a part of the fastest of the step.
    pub tolerance: f64,
}

impl TimeDriven {
    /// Advances all flights by a step in s.
    pub(super) fn step(&self, contacts: &HardContacts, bodies: &Bodies, flights: &mut [Flight], step: f64, counts: &mut Counts) {
        for flight in flights.iter_mut() {
            *flight = flight.at(step);
        }
        let flight = |index: usize| flights[index];
        let touches: Vec<(Candidate, Touch)> = contacts
            .candidates
            .iter()
            .filter(|candidate| contacts.may_touch(bodies, flights, candidate))
            .inspect(|_| counts.looks += 1)
            .filter_map(|candidate| Some((*candidate, contacts.deepest_touch(bodies, &flight, candidate)?)))
            .collect();
        counts.unresolved += self.resolve(contacts, flights, &touches, counts);
        relocate(flights, &touches);
        counts.relocations += touches.len() as u64;
    }

    /// Impulses until no contact approaches; returns how many did in the last sweep, if that was not enough.
    fn resolve(&self, contacts: &HardContacts, flights: &mut [Flight], touches: &[(Candidate, Touch)], counts: &mut Counts) -> u64 {
        let (mut approaching, mut fastest) = (0, 0.0_f64);
        for sweep in 0..self.sweeps {
            approaching = 0;
            let least = self.tolerance * fastest;
            for (candidate, touch) in touches {
                let point = CollisionPoint { normal: touch.normal, arm_of_first: touch.arm_of_first, arm_of_second: touch.arm_of_second };
                let rate = contacts.approach_rate(flights, candidate, &point);
                if rate <= least {
                    continue;
                }
                approaching += u64::from(contacts.collide(flights, candidate, &point));
                if sweep == 0 {
                    fastest = fastest.max(rate);
                }
            }
            if approaching == 0 {
                return 0;
            }
            counts.sweeps += 1;
            counts.collisions += approaching;
        }
        approaching
    }
}

/// Pushes bodies that overlap apart.
fn relocate(flights: &mut [Flight], touches: &[(Candidate, Touch)]) {
    let mut shifts = vec![Vector::zeros(); flights.len()];
    for (candidate, touch) in touches {
        let share = if candidate.second_body().is_some() { 0.5 } else { 1.0 };
        let shift = touch.normal * (share * touch.overlap);
        shifts[candidate.first()] -= shift;
        if let Some(second) = candidate.second_body() {
            shifts[second] += shift;
        }
    }
    for (flight, shift) in flights.iter_mut().zip(&shifts) {
        flight.position += shift;
    }
}

impl HardContacts {
    /// Whether the balls about a pair overlap.
    fn may_touch(&self, bodies: &Bodies, flights: &[Flight], candidate: &Candidate) -> bool {
        let radius = |index: usize| bodies.shape(index).bounding_radius();
        let position = flights[candidate.first()].position;
        match candidate.second() {
            Partner::Wall(wall) => self.walls[wall].height(&position) < radius(candidate.first()),
            Partner::Body(second) => {
                let reach = radius(candidate.first()) + radius(second);
                (flights[second].position - position).norm_squared() < reach * reach
            }
        }
    }

    /// The deepest contact point of a pair, if it overlaps.
    pub(super) fn deepest_touch(&self, bodies: &Bodies, flight: &dyn Fn(usize) -> Flight, candidate: &Candidate) -> Option<Touch> {
        let mut touches = Vec::new();
        let first = self.side(bodies, candidate.first(), flight(candidate.first()));
        match candidate.second() {
            Partner::Wall(wall) => {
                for part in first.parts {
                    core_plane(&placed(&first.flight, part, &part.against_walls), &self.walls[wall], Points::Deepest, &mut touches);
                }
            }
            Partner::Body(second) => {
                let second = self.side(bodies, second, flight(second));
                for part in first.parts {
                    let one = placed(&first.flight, part, &part.against_bodies);
                    for other in second.parts {
                        let other = placed(&second.flight, other, &other.against_bodies);
                        core_pair(&one, &other, None, Points::Deepest, &mut touches);
                    }
                }
            }
        }
        touches.into_iter().reduce(|deepest, touch| if touch.overlap > deepest.overlap { touch } else { deepest })
    }
}

fn placed<'a>(flight: &Flight, part: &DetectedPart, rounded: &'a RoundedCore) -> PlacedCore<'a> {
    let rotation = *(flight.orientation * part.orientation).to_rotation_matrix().matrix();
    let pose = Pose { position: flight.position + flight.orientation * part.position, rotation };
    PlacedCore { rounded, pose, centre_of_body: flight.position }
}
