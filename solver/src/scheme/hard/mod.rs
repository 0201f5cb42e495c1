//! Hard bodies: free flight and impulses (S sections 2.4.5, 3.1 and A.1).
//!
//! [`EventDriven`] finds the time of every collision to rounding and is the truth; [`TimeDriven`] moves all bodies for a whole step and mends what
//! overlaps then, as S does. Both know one contact point for each two bodies. Velocities live at the time of the positions.

mod approach;
mod event_driven;
mod flight;
mod time_driven;

use serde::{Deserialize, Serialize};

pub use event_driven::EventDriven;
pub use time_driven::TimeDriven;

use crate::boundary::Plane;
use crate::contact::impulse::{CollisionPoint, ImpulseLaw};
use crate::contact::shaped::DetectedPart;
use crate::contact::stage::Candidate;
use crate::ledger::Ledger;
use crate::{Bodies, Vector};
use approach::Side;
use flight::Flight;

/// What may collide, and what happens then. The same for a whole run.
pub struct HardContacts {
    /// In the order of ids, bodies before walls.
    pub candidates: Vec<Candidate>,
    /// By the index that candidates give.
    pub laws: Vec<ImpulseLaw>,
    /// Walls.
    pub walls: Vec<Plane>,
    /// Parts of each shape, by its index.
    pub parts: Vec<std::sync::Arc<[DetectedPart]>>,
    /// Whether orientations of bodies matter that look the same to their own inertia, by storage index.
    pub turns: Vec<bool>,
}

/// How collisions are found.
pub enum Mode {
    /// At their own times.
    EventDriven(EventDriven),
    /// At the ends of steps.
    TimeDriven(TimeDriven),
}

/// Work of hard contacts since the start of the run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Impulses between two bodies or a body and a wall.
    pub collisions: u64,
    /// Looks at a pair.
    pub looks: u64,
    /// Sweeps over the contacts of a step.
    pub sweeps: u64,
    /// Contacts that approached even in the last sweep that a step may have.
    pub unresolved: u64,
    /// Overlaps that were pushed apart.
    pub relocations: u64,
}

/// Why hard bodies cannot go on.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Stop {
    /// Ever more collisions in ever less time.
    #[error(
        "more than {events} looks at pairs within {span:e} s at t = {time} s, the last at body {body}: an inelastic collapse or a contact at rest, \
         which event-driven hard contacts cannot hold; use numerics.hard_contact = {{ time_driven = {{}} }}, a soft contact law, or, if collisions \
         are many, a smaller step"
    )]
    Collapse {
        /// Id of a body.
        body: u32,
        /// Looks at pairs.
        events: u64,
        /// Time in s in which they fell.
        span: f64,
        /// Time in s.
        time: f64,
    },
    /// A body of three different moments turns so far in a step that its turn cannot be followed.
    #[error("body {body} turns by {angle:e} rad in one step at t = {time} s, more than can be followed: take a smaller step")]
    TurnsTooFar {
        /// Id of the body.
        body: u32,
        /// In rad.
        angle: f64,
        /// Time in s.
        time: f64,
    },
    /// Bodies in one another, which impulses do not lead to.
    #[error("body {body} overlaps its partner by {overlap:e} m at t = {time} s, so deep that no rounding explains it")]
    Overlap {
        /// Id of the first body.
        body: u32,
        /// In m.
        overlap: f64,
        /// Time in s.
        time: f64,
    },
}

/// Hard contacts at work: the stage of a simulation.
pub struct HardStage {
    pub(crate) contacts: HardContacts,
    mode: Mode,
    pub(crate) counts: Counts,
    stopped: Option<Stop>,
}

impl HardStage {
    /// A stage at the start of a run.
    pub fn new(contacts: HardContacts, mode: Mode) -> HardStage {
        HardStage { contacts, mode, counts: Counts::default(), stopped: None }
    }

    /// Advances all bodies by a step in s from a time in s. After a stop nothing moves any more.
    pub(crate) fn step(&mut self, bodies: &mut Bodies, gravity: Option<Vector>, step: f64, start: f64) {
        if self.stopped.is_some() {
            return;
        }
        let mut flights: Vec<Flight> =
            (0..bodies.len()).map(|index| Flight::of(bodies, index, gravity, self.contacts.turns[index])).collect();
        if let Some((index, angle)) = flights.iter().enumerate().find_map(|(index, flight)| Some((index, flight.too_far_a_turn(step)?))) {
            self.stopped = Some(Stop::TurnsTooFar { body: bodies.id(index), angle, time: start });
            return;
        }
        let done = match &self.mode {
            Mode::EventDriven(mode) => mode.step(&self.contacts, bodies, &mut flights, step, &mut self.counts),
            Mode::TimeDriven(mode) => {
                mode.step(&self.contacts, bodies, &mut flights, step, &mut self.counts);
                Ok(())
            }
        };
        for (index, flight) in flights.iter().enumerate() {
            flight.store(bodies, index);
        }
        self.stopped = done.err().map(|stop| stop.after(start));
    }

    /// Why the run cannot go on, if so.
    pub(crate) fn stopped(&self) -> Option<Stop> {
        self.stopped
    }

    /// Adds what is used, and how often.
    pub(crate) fn describe(&self, bodies: usize, steps: u64, ledger: &mut Ledger) {
        let Counts { collisions, looks, sweeps, unresolved, relocations } = self.counts;
        let pairs = ("candidate_pairs", self.contacts.candidates.len() as u64);
        match &self.mode {
            Mode::EventDriven(mode) => {
                let counts = [pairs, ("collisions", collisions), ("distance_evaluations", looks)];
                ledger.used("contacts", format!("impulses, event-driven, gap of a touch {:e} of size", mode.tolerance), counts);
            }
            Mode::TimeDriven(mode) => {
                let work = [("collisions", collisions), ("distance_evaluations", looks), ("sweeps", sweeps)];
                let counts = [pairs].into_iter().chain(work).chain([("unresolved", unresolved), ("relocations", relocations)]);
                ledger.used("contacts", format!("impulses, time-driven, at most {} sweeps", mode.sweeps), counts);
            }
        }
        ledger.used("motion", "free flight between impulses", [("steps", steps), ("body_steps", steps * bodies as u64)]);
    }

    /// Overlap in m of a candidate pair at the start, beyond rounding.
    pub(crate) fn overlap(&self, bodies: &Bodies, candidate: &Candidate) -> Option<f64> {
        let flight = |index| Flight::of(bodies, index, None, true);
        let touch = self.contacts.deepest_touch(bodies, &flight, candidate)?;
        (touch.overlap > 0.0).then_some(touch.overlap)
    }
}

impl Stop {
    fn time(&self) -> f64 {
        match self {
            Stop::Collapse { time, .. } | Stop::Overlap { time, .. } | Stop::TurnsTooFar { time, .. } => *time,
        }
    }

    fn after(self, start: f64) -> Stop {
        match self {
            Stop::Collapse { body, events, span, time } => Stop::Collapse { body, events, span, time: start + time },
            Stop::Overlap { body, overlap, time } => Stop::Overlap { body, overlap, time: start + time },
            Stop::TurnsTooFar { body, angle, time } => Stop::TurnsTooFar { body, angle, time: start + time },
        }
    }
}

impl HardContacts {
    fn side(&self, bodies: &Bodies, index: usize, flight: Flight) -> Side<'_> {
        Side { flight, parts: &self.parts[bodies.shape_index(index)], bounding_radius: bodies.shape(index).bounding_radius() }
    }

    /// Rate in m/s at which a pair approaches at a point.
    fn approach_rate(&self, flights: &[Flight], candidate: &Candidate, point: &CollisionPoint) -> f64 {
        flight::approach_rate(&flights[candidate.first()], candidate.second_body().map(|second| &flights[second]), point)
    }

    /// Changes the motion of a pair that collides at a point; `false` if it does not approach.
    fn collide(&self, flights: &mut [Flight], candidate: &Candidate, point: &CollisionPoint) -> bool {
        let second = candidate.second_body();
        let first_body = flights[candidate.first()].colliding();
        let second_body = second.map(|second| flights[second].colliding());
        let Some(impulse) = self.laws[candidate.laws()].impulse_on_first(&first_body, second_body.as_ref(), point) else { return false };
        flights[candidate.first()].take(&impulse, &point.arm_of_first);
        if let Some(second) = second {
            flights[second].take(&-impulse, &point.arm_of_second);
        }
        true
    }
}
