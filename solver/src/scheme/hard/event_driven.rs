//! Event-driven hard bodies: every collision at its own time, in the order of times.
//!
//! A queue holds for each pair the time until which it certainly stays apart: first that at which the balls about both bodies meet, in closed form; then
//! what a [look](super::approach) at the pair gives. Whoever comes first in the queue is looked at, and collides or is put back. A
//! collision changes the flights of its bodies only; what the queue says of them is outdated then, which a count of collisions per body tells.
//! The queue is made anew for each step, so that a step depends on the state of the bodies alone and a run can be cut at any of them.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::approach::{Look, Settings, look_at_bodies, look_at_wall, time_to_fall, time_to_meet};
use super::flight::Flight;
use super::{Counts, HardContacts, Stop};
use crate::Bodies;
use crate::contact::stage::{Candidate, Partner};
use crate::distance::Guess;

/// Collisions at their own times.
pub struct EventDriven {
    /// Gap at which bodies touch, as a part of their size.
    pub tolerance: f64,
    /// Candidate pairs of each body, by storage index.
    pairs_of: Vec<Vec<usize>>,
}

/// Part of a step in which [`EVENTS_OF_A_COLLAPSE`] mean that time does not pass any more.
const SPAN_OF_A_COLLAPSE: f64 = 1e-9;
/// Looks at pairs: of any pairs, and more for each candidate pair.
const EVENTS_OF_A_COLLAPSE: [u64; 2] = [10_000, 20];
/// Looks at pairs in one step above which a run would not come to its end, counted alike.
const EVENTS_OF_A_STEP: [u64; 2] = [20_000, 200];

impl EventDriven {
    /// The mode for given candidate pairs.
    pub fn new(tolerance: f64, candidates: &[Candidate], bodies: usize) -> EventDriven {
        let mut pairs_of = vec![Vec::new(); bodies];
        for (pair, candidate) in candidates.iter().enumerate() {
            candidate.bodies().for_each(|body| pairs_of[body].push(pair));
        }
        EventDriven { tolerance, pairs_of }
    }

    /// Advances all flights by a step in s.
    pub(super) fn step(
        &self,
        contacts: &HardContacts,
        bodies: &Bodies,
        flights: &mut [Flight],
        step: f64,
        counts: &mut Counts,
    ) -> Result<(), Stop> {
        let pairs = contacts.candidates.len();
        let mut run = Run {
            mode: self,
            contacts,
            bodies,
            flights,
            step,
            counts,
            queue: BinaryHeap::new(),
            collisions_of: vec![0; bodies.len()],
            guesses: vec![Vec::new(); pairs],
            guard: Guard::new(step, pairs as u64),
        };
        for pair in 0..pairs {
            run.expect(pair, 0.0);
        }
        let done = run.all_events();
        let end = done.map_or_else(|stop| stop.time(), |()| step);
        for flight in flights.iter_mut() {
            *flight = flight.at(end);
        }
        done
    }
}

/// When to look at a pair.
struct Event {
    /// In s since the start of the step.
    time: f64,
    pair: usize,
    /// Collisions of both bodies when this was written; a wall has none.
    collisions: [u32; 2],
}

impl Ord for Event {
    /// The earliest is the greatest; of equal times that of the lowest ids.
    fn cmp(&self, other: &Event) -> Ordering {
        other.time.total_cmp(&self.time).then(other.pair.cmp(&self.pair))
    }
}

impl PartialOrd for Event {
    fn partial_cmp(&self, other: &Event) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Event {
    fn eq(&self, other: &Event) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Event {}

/// One step at work.
struct Run<'a> {
    mode: &'a EventDriven,
    contacts: &'a HardContacts,
    bodies: &'a Bodies,
    flights: &'a mut [Flight],
    step: f64,
    counts: &'a mut Counts,
    queue: BinaryHeap<Event>,
    collisions_of: Vec<u32>,
    guesses: Vec<Vec<Option<Guess>>>,
    guard: Guard,
}

impl Run<'_> {
    fn all_events(&mut self) -> Result<(), Stop> {
        while let Some(event) = self.queue.pop() {
            if event.collisions != self.collisions(event.pair) {
                continue;
            }
            let body = self.bodies.id(self.contacts.candidates[event.pair].first());
            self.guard.count(event.time, body)?;
            self.look(&event)?;
        }
        Ok(())
    }

    fn collisions(&self, pair: usize) -> [u32; 2] {
        let candidate = &self.contacts.candidates[pair];
        let of = |body: usize| self.collisions_of[body];
        [of(candidate.first()), candidate.second_body().map_or(0, of)]
    }

    fn push(&mut self, pair: usize, time: f64) {
        if time < self.step {
            let collisions = self.collisions(pair);
            self.queue.push(Event { time, pair, collisions });
        }
    }

    /// Writes down when the balls about a pair meet.
    fn expect(&mut self, pair: usize, now: f64) {
        let candidate = &self.contacts.candidates[pair];
        let radius = |index: usize| self.bodies.shape(index).bounding_radius();
        let (position, velocity) = self.flights[candidate.first()].centre_at(now);
        let radius_of_first = radius(candidate.first());
        let wait = match candidate.second() {
            Partner::Body(second) => {
                let (other, its_velocity) = self.flights[second].centre_at(now);
                time_to_meet(&(other - position), &(its_velocity - velocity), radius_of_first + radius(second))
            }
            Partner::Wall(wall) => {
                let wall = &self.contacts.walls[wall];
                let acceleration = self.flights[candidate.first()].acceleration().dot(&wall.normal);
                time_to_fall(wall.height(&position), velocity.dot(&wall.normal), acceleration, radius_of_first)
            }
        };
        self.push(pair, now + wait);
    }

    fn look(&mut self, event: &Event) -> Result<(), Stop> {
        let (contacts, candidate) = (self.contacts, self.contacts.candidates[event.pair]);
        self.counts.looks += 1;
        let settings = Settings { tolerance: self.mode.tolerance, horizon: self.step - event.time };
        let first = contacts.side(self.bodies, candidate.first(), self.flights[candidate.first()].at(event.time));
        let known = match candidate.second() {
            Partner::Wall(wall) => look_at_wall(&first, &contacts.walls[wall], &settings),
            Partner::Body(second) => {
                let second = contacts.side(self.bodies, second, self.flights[second].at(event.time));
                look_at_bodies(&first, &second, &mut self.guesses[event.pair], &settings)
            }
        };
        match known {
            Look::ClearFor(time) => self.push(event.pair, event.time + time),
            Look::Overlap(overlap) => {
                return Err(Stop::Overlap { body: self.bodies.id(candidate.first()), overlap, time: event.time });
            }
            Look::Touch(point) => {
                for body in candidate.bodies() {
                    self.flights[body] = self.flights[body].at(event.time);
                    self.collisions_of[body] = self.collisions_of[body].wrapping_add(1);
                }
                self.counts.collisions += u64::from(contacts.collide(self.flights, &candidate, &point));
                let mode = self.mode;
                for body in candidate.bodies() {
                    mode.pairs_of[body].iter().for_each(|pair| self.expect(*pair, event.time));
                }
            }
        }
        Ok(())
    }
}

/// Tells a step that will not end.
struct Guard {
    span: f64,
    in_span: u64,
    in_step: u64,
    since: f64,
    events: u64,
    all_events: u64,
    step: f64,
}

impl Guard {
    fn new(step: f64, pairs: u64) -> Guard {
        let [in_span, in_step] = [EVENTS_OF_A_COLLAPSE, EVENTS_OF_A_STEP].map(|[any, each]| any + each * pairs);
        Guard { span: SPAN_OF_A_COLLAPSE * step, in_span, in_step, since: 0.0, events: 0, all_events: 0, step }
    }

    fn count(&mut self, time: f64, body: u32) -> Result<(), Stop> {
        if time > self.since + self.span {
            (self.since, self.events) = (time, 0);
        }
        self.events += 1;
        self.all_events += 1;
        if self.events > self.in_span {
            return Err(Stop::Collapse { body, events: self.in_span, span: self.span, time });
        }
        if self.all_events > self.in_step {
            return Err(Stop::Collapse { body, events: self.in_step, span: self.step, time });
        }
        Ok(())
    }
}
