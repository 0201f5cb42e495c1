//! A window that lets bodies in during the run, each as soon as it is due and there is room (R sections 3.5 and 4.2.2).

use serde::{Deserialize, Serialize};

use super::{Draws, NewBody, NoRoom, Population, Turned, Window};
use crate::Vector;
use crate::domain::Domain;

/// When bodies are due, and how hard they are tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Schedule {
    /// When the first body is due, in s.
    pub start: f64,
    /// Bodies per s; infinite: all at the start, as fast as there is room.
    pub rate: f64,
    /// Attempts in one step, at least one. R tries once.
    pub attempts_per_step: u32,
    /// For how long a body that is due may wait for room before the run ends, in s; may be infinite.
    pub patience: f64,
}

/// How far the inflow has come: all that a checkpoint needs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct InflowState {
    /// Bodies let in.
    pub inserted: u32,
    /// Attempts made.
    pub attempts: u64,
    /// When the last body was let in, in s.
    pub last_at: Option<f64>,
}

/// Bodies that are still to come.
#[derive(Debug, Clone, PartialEq)]
pub struct Inflow {
    /// Which bodies.
    pub population: Population,
    /// Where.
    pub window: Window,
    /// How they are turned.
    pub turned: Turned,
    /// When.
    pub schedule: Schedule,
    /// Seed and stream of the attempts; another stream than that of the population.
    pub random: (u64, u64),
    /// What has happened so far.
    pub state: InflowState,
}

impl Inflow {
    /// Whether all bodies are in.
    pub fn is_done(&self) -> bool {
        self.state.inserted as usize >= self.population.len()
    }

    /// When the next body is due, in s; `None` if all are in.
    pub fn next_due(&self) -> Option<f64> {
        (!self.is_done()).then(|| self.schedule.start + f64::from(self.state.inserted) / self.schedule.rate)
    }

    /// Lets in what is due and finds room at a time in s, to be called once a step. `is_free` tells whether a ball at a place overlaps anything that is there;
    /// the new bodies do not overlap each other, nor their
    /// images in a periodic box.
    ///
    /// # Errors
    ///
    /// A body that has been due for longer than the patience and still finds no room. Nothing was let in by this call then.
    pub fn due(&mut self, time: f64, domain: Option<&Domain>, is_free: impl Fn(&Vector, f64) -> bool) -> Result<Vec<NewBody>, NoRoom> {
        let mut entered: Vec<NewBody> = Vec::new();
        for _ in 0..self.schedule.attempts_per_step {
            if self.next_due().is_none_or(|due| due > time) {
                break;
            }
            let draws = Draws::new(self.random.0, self.random.1, self.state.attempts);
            self.state.attempts += 1;
            let Some((kind, scale)) = self.population.body(self.state.inserted as usize) else { break };
            let radius = self.population.radius(kind, scale);
            let has_room = |position: &Vector| {
                let is_apart = |other: &NewBody| {
                    let between = other.position - position;
                    domain.map_or(between, |domain| domain.shortest(&between)).norm() >= other.radius + radius
                };
                entered.iter().all(is_apart) && is_free(position, radius)
            };
            if let Some((position, orientation)) = self.window.attempt(&self.turned, draws, has_room) {
                entered.push(NewBody { kind, scale, radius, position, orientation });
                self.state.inserted += 1;
                self.state.last_at = Some(time);
            }
        }
        if entered.is_empty() {
            self.check_patience(time)?
        }
        Ok(entered)
    }

    fn check_patience(&self, time: f64) -> Result<(), NoRoom> {
        let Some(due) = self.next_due() else { return Ok(()) };
        let waited = time - self.state.last_at.map_or(due, |last_at| due.max(last_at));
        if waited <= self.schedule.patience {
            return Ok(());
        }
        let wanted = self.population.len();
        Err(NoRoom::Time { left: wanted - self.state.inserted as usize, wanted, waited })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::insertion::Kind;

    fn inflow(number: usize, schedule: Schedule) -> Inflow {
        let kind = |radius: f64| Kind { radius, fraction: 1.0, scale: [0.5, 1.0] };
        Inflow {
            population: Population::new(vec![kind(0.05), kind(0.2)], number, 5, 0),
            window: Window::Box { lower: Vector::zeros(), upper: Vector::new(1.0, 1.0, 0.1) },
            turned: Turned::Random,
            schedule,
            random: (5, 1),
            state: InflowState::default(),
        }
    }

    const AT_ONCE: Schedule = Schedule { start: 1.0, rate: f64::INFINITY, attempts_per_step: 5, patience: f64::INFINITY };

    /// Bodies that fall at 1 m/s make room below the window: all come in, in their order, none twice, and no two overlap at any time.
    #[test]
    fn all_bodies_come_in_as_those_before_them_fall() {
        let mut inflow = inflow(200, AT_ONCE);
        let mut bodies: Vec<(NewBody, f64)> = Vec::new();
        for step in 0..20_000 {
            let time = f64::from(step) * 0.01;
            let place = |(body, since): &(NewBody, f64)| body.position - Vector::z() * (time - since);
            let is_free =
                |position: &Vector, radius: f64| bodies.iter().all(|body| (place(body) - position).norm() >= radius + body.0.radius);
            let entered = inflow.due(time, None, is_free).unwrap();
            assert!(time >= 1.0 || entered.is_empty());
            bodies.extend(entered.into_iter().map(|body| (body, time)));
        }
        assert!(inflow.is_done() && bodies.len() == 200 && inflow.next_due().is_none());
        assert!(inflow.state.attempts > 400, "{:?}", inflow.state);
        // Although large bodies are refused more often, numbers and sizes are those of the population.
        for (number, (body, _)) in bodies.iter().enumerate() {
            assert_eq!((body.kind, body.scale), inflow.population.body(number).unwrap());
        }
        assert_eq!(bodies.iter().filter(|(body, _)| body.kind == 1).count(), 100);
        for (place, (one, since)) in bodies.iter().enumerate() {
            for (other, other_since) in &bodies[..place] {
                let drop = Vector::z() * (since - other_since);
                assert!((other.position - drop - one.position).norm() >= one.radius + other.radius - 1e-12);
            }
        }
    }

    /// One body a second, at 1, 2, 3 s and so on, with no drift of the rate after many.
    #[test]
    fn bodies_come_at_their_rate() {
        let mut inflow = inflow(1000, Schedule { rate: 10.0, ..AT_ONCE });
        for step in 0..=2000 {
            let time = f64::from(step) * 0.0625;
            inflow.due(time, None, |_, _| true).unwrap();
            let expected = if time < 1.0 { 0 } else { ((time - 1.0) * 10.0).floor() as u32 + 1 };
            assert_eq!(inflow.state.inserted, expected.min(1000), "{time}");
        }
        assert!(inflow.is_done());
    }

    #[test]
    fn patience_ends_with_how_many_are_left() {
        let mut inflow = inflow(10, Schedule { patience: 0.5, ..AT_ONCE });
        // The window holds what it can, then nothing falls.
        let entered = inflow.due(1.0, None, |position, _| position.x < 0.4).unwrap().len();
        assert!((1..5).contains(&entered));
        assert_eq!(inflow.due(1.5, None, |_, _| false), Ok(Vec::new()));
        assert_eq!(inflow.due(1.75, None, |_, _| false), Err(NoRoom::Time { left: 10 - entered, wanted: 10, waited: 0.75 }));
    }

    /// What is drawn depends on the state alone: a run that is taken up again goes on bitwise.
    #[test]
    fn a_restart_goes_on_bitwise() {
        let is_free = |position: &Vector, radius: f64| position.x > radius;
        let (mut whole, mut first) = (inflow(100, AT_ONCE), inflow(100, AT_ONCE));
        let steps = |inflow: &mut Inflow, range: std::ops::Range<i32>| {
            range.flat_map(|step| inflow.due(1.0 + f64::from(step), None, is_free).unwrap()).collect::<Vec<_>>()
        };
        let expected = steps(&mut whole, 0..20);
        let mut found = steps(&mut first, 0..7);
        let saved = serde_json::to_string(&first.state).unwrap();
        let mut second = Inflow { state: serde_json::from_str(&saved).unwrap(), ..inflow(100, AT_ONCE) };
        found.extend(steps(&mut second, 7..20));
        assert_eq!((found, second.state), (expected, whole.state));
    }
}
