//! Bodies that come and go: between two steps those that have come into an [`Outlet`] are taken out, then those that wait at an [`Inlet`] are let in, as
//! far as they are due and there is room (R section 4.2.2).
//!
//! A body that comes in gets the id after the largest there has been; ids are never used twice. Whatever contacts remember of a body that leaves is dropped.
//! Both happen at the end of a step, so that nothing depends on when somebody looks.

mod inlet;
mod outlet;

use serde::{Deserialize, Serialize};

pub use inlet::Inlet;
pub use outlet::{Departure, Outlet};

use crate::bodies::{BodySpecification, Motion};
use crate::contact::law::StepKind;
use crate::domain::Domain;
use crate::insertion::{InflowState, NewBody, NoRoom};
use crate::ledger::Ledger;
use crate::relocation::Relocation;
use crate::{Bodies, Vector};

/// All outlets and inlets of a scene, and who has passed them.
#[derive(Debug, Clone, PartialEq)]
pub struct Openings {
    outlets: Vec<(String, Outlet)>,
    inlets: Vec<Inlet>,
    domain: Option<Domain>,
    /// Id of the first body that comes in.
    first_id: u32,
    record: Record,
    stopped: Option<Waited>,
}

/// Who has passed: all that a checkpoint needs.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Bodies that have left, by time, at the same time by id.
    pub departures: Vec<Departure>,
    /// By which inlet each body came, in the order of their ids.
    pub came_by: Vec<u32>,
    /// How far each inlet is.
    pub inflows: Vec<InflowState>,
}

/// A body has waited for room in vain.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("insertion `{insertion}`: {reason}")]
pub struct Waited {
    insertion: String,
    reason: NoRoom,
}

impl Openings {
    /// Openings nobody has passed yet; `first_id` is above all ids that there are.
    pub fn new(outlets: Vec<(String, Outlet)>, inlets: Vec<Inlet>, domain: Option<Domain>, first_id: u32) -> Openings {
        let record = Record { inflows: vec![InflowState::default(); inlets.len()], ..Record::default() };
        Openings { outlets, inlets, domain, first_id, record, stopped: None }
    }

    /// Bodies that will come in, with ids that they may or may not get: enough to know sizes and materials from.
    pub fn waiting(&self) -> impl Iterator<Item = BodySpecification> {
        let waiting = self.inlets.iter().flat_map(|inlet| &inlet.waiting);
        waiting.zip(self.first_id..).map(|(body, id)| BodySpecification { id, ..body.clone() })
    }

    /// Takes out and lets in what is due at a time in s. If anybody has passed, tells where the bodies that stayed are stored now.
    pub(crate) fn pass(&mut self, bodies: &mut Bodies, kind: &StepKind, gravity: Vector, time: f64) -> Option<Relocation> {
        let before = bodies.len();
        let left = self.take_out(bodies, time);
        let after = bodies.len();
        self.let_in(bodies, kind, gravity, time);
        let came = bodies.len() > after;
        left.or_else(|| came.then(|| Relocation::of_order(&(0..before as u32).collect::<Vec<_>>(), before)))
    }

    fn take_out(&mut self, bodies: &mut Bodies, time: f64) -> Option<Relocation> {
        let outlet_of = |body: &Motion| self.outlets.iter().position(|(_, outlet)| outlet.holds(&body.position));
        if self.outlets.is_empty() || bodies.state.motion.iter().all(|body| outlet_of(body).is_none()) {
            return None;
        }
        let leave = |index: usize| {
            let outlet = outlet_of(&bodies.state.motion[index])? as u32;
            Some(Departure { id: bodies.id(index), outlet, time, mass: bodies.mass(index) })
        };
        self.record.departures.extend(bodies.by_id().filter_map(leave));
        let order: Vec<u32> = (0..bodies.len() as u32).filter(|index| outlet_of(&bodies.state.motion[*index as usize]).is_none()).collect();
        let moved = Relocation::of_order(&order, bodies.len());
        bodies.reorder(&order);
        Some(moved)
    }

    fn let_in(&mut self, bodies: &mut Bodies, kind: &StepKind, gravity: Vector, time: f64) {
        for (number, inlet) in self.inlets.iter_mut().enumerate() {
            let next = inlet.inflow.state.inserted as usize;
            match inlet.due(bodies, self.domain.as_ref(), time) {
                Ok(entered) => {
                    for (body, waiting) in entered.iter().zip(&inlet.waiting[next..]) {
                        let id = self.first_id + self.record.came_by.len() as u32;
                        self.record.came_by.push(number as u32);
                        let position = self.domain.as_ref().map_or(body.position, |domain| domain.wrapped(&body.position));
                        bodies.push(in_flight(waiting, &NewBody { position, ..*body }, id, gravity * kind.age_of_velocities()));
                        bodies.state.motion.last_mut().into_iter().for_each(|motion| motion.acceleration = gravity);
                    }
                }
                Err(reason) => self.stopped = Some(Waited { insertion: inlet.name.clone(), reason }),
            }
            self.record.inflows[number] = inlet.inflow.state;
        }
    }

    /// Why the run cannot go on, if so.
    pub(crate) fn stopped(&self) -> Option<&Waited> {
        self.stopped.as_ref()
    }

    /// How many wait to come in.
    pub fn still_out(&self) -> usize {
        self.inlets.iter().map(|inlet| inlet.inflow.population.len() - inlet.inflow.state.inserted as usize).sum()
    }

    /// Who has passed.
    pub fn record(&self) -> &Record {
        &self.record
    }

    /// Tells a ledger who has passed.
    pub(crate) fn describe(&self, ledger: &mut Ledger) {
        for (number, (name, outlet)) in self.outlets.iter().enumerate() {
            let left = self.record.departures.iter().filter(|departure| departure.outlet as usize == number).count();
            ledger.used(&format!("outlet `{name}`"), outlet.name(), [("bodies_left", left as u64)]);
        }
        for Inlet { name, inflow, .. } in &self.inlets {
            let counts = [("bodies_in", u64::from(inflow.state.inserted)), ("attempts", inflow.state.attempts)];
            ledger.used(&format!("inlet `{name}`"), format!("{} bodies during the run", inflow.population.len()), counts);
        }
    }

    /// Takes back a record, and adds the bodies that had come in by then to those of the start; `None` if it is of other openings.
    pub(crate) fn restore(&mut self, record: Record, bodies: &mut Bodies) -> Option<()> {
        if record.inflows.len() != self.inlets.len() {
            return None;
        }
        let mut next = vec![0; self.inlets.len()];
        for (place, inlet) in record.came_by.iter().enumerate() {
            let number = next.get_mut(*inlet as usize)?;
            let waiting = self.inlets[*inlet as usize].waiting.get(*number)?;
            *number += 1;
            let id = self.first_id.checked_add(place as u32)?;
            if bodies.index_of(id).is_none() {
                bodies.push(BodySpecification { id, ..waiting.clone() });
            }
        }
        for (inlet, state) in self.inlets.iter_mut().zip(&record.inflows) {
            inlet.inflow.state = *state;
        }
        let is_known = record.departures.iter().all(|departure| (departure.outlet as usize) < self.outlets.len());
        let is_whole = is_known && next.iter().zip(&record.inflows).all(|(came, state)| *came == state.inserted as usize);
        self.record = record;
        is_whole.then_some(())
    }
}

/// A body that comes in: it has flown freely until now, and its velocity is asked for as it was some time ago.
fn in_flight(waiting: &BodySpecification, body: &NewBody, id: u32, gained_since: Vector) -> BodySpecification {
    BodySpecification {
        id,
        position: body.position,
        velocity: waiting.velocity - gained_since,
        orientation: body.orientation * waiting.shape.axes(),
        ..waiting.clone()
    }
}
