//! The motion during an oblique impact, from the first touch to the last.

use super::{Normal, ObliqueImpact, Outcome, Tangential, Velocities};
use crate::exact::extrapolation::{State, Step, extrapolate, root};

/// Time (or overlap, where time is counted), rate of the overlap, tangential velocity, both spins, spring, turn of the normal.
type Unknowns = State<7>;

/// What the contact point does.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Mode {
    Sticks,
    /// In the direction of a sign.
    Slips(f64),
    /// The normal force pulls, so that friction has no hold.
    Released,
}

/// What stands for time.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Clock {
    /// The fourth root of the overlap; the first unknown is time.
    Root,
    /// Time; the first unknown is the overlap.
    Time,
}

/// The motion.
pub(super) struct Motion<'a> {
    setting: &'a ObliqueImpact,
    before: Velocities,
    mode: Mode,
    clock: Clock,
    /// Now, as the clock counts.
    now: f64,
    state: Unknowns,
    /// Whether the overlap rises: Mindlin's spring is then counted as a force, else as a stretch.
    rises: bool,
    /// Overlap in m of an undamped impact.
    scale: f64,
    events: usize,
}

/// Part of the largest undamped overlap below which its fourth root stands for time.
const SHALLOW: f64 = 0.25;
/// Steps of a third of the motion, at least.
const PARTS: f64 = 24.0;
/// More events than any impact has.
const LARGEST_NUMBER_OF_EVENTS: usize = 100;
/// Largest error of a step, of the scale of each unknown.
const TOLERANCE: f64 = 2e-14;
/// Below this part of the first trial a step will not converge at all.
const SHORTEST: f64 = 1e-6;

impl<'a> Motion<'a> {
    pub(super) fn new(setting: &'a ObliqueImpact, before: &Velocities) -> Motion<'a> {
        let mass = setting.normal_mass();
        let scale = match setting.normal {
            Normal::Linear(stiffness, _) => before.approach * (mass / stiffness).sqrt(),
            Normal::Hertz(stiffness, _) => (1.25 * mass * before.approach * before.approach / stiffness).powf(0.4),
        };
        let state = [0.0, before.approach, before.tangential, before.spin_of_first, before.spin_of_second, 0.0, 0.0];
        let mut motion =
            Motion { setting, before: *before, mode: Mode::Sticks, clock: Clock::Root, now: 0.0, state, rises: true, scale, events: 0 };
        motion.mode = motion.mode_at_touch();
        motion
    }

    /// By the leading terms of force and cap.
    fn mode_at_touch(&self) -> Mode {
        let slip = self.setting.slip(&self.before);
        let (friction, approach) = (self.setting.friction, self.before.approach);
        let slips = match (self.setting.normal, self.setting.tangential) {
            (Normal::Linear(_, damping) | Normal::Hertz(_, damping), Tangential::Spring(_) | Tangential::Mindlin(_)) if damping > 0.0 => {
                false
            }
            (Normal::Linear(stiffness, _), Tangential::Spring(spring)) => spring * slip.abs() > friction * stiffness * approach,
            (Normal::Hertz(stiffness, _), Tangential::Mindlin(spring)) => spring * 2.0 / 3.0 * slip.abs() > friction * stiffness * approach,
            (Normal::Linear(_, damping), Tangential::Dashpot(dashpot)) => dashpot * slip.abs() > friction * damping * approach,
            (Normal::Hertz(..), Tangential::Dashpot(_)) => slip != 0.0,
            // A spring of constant stiffness on Hertz's law, or Mindlin's on a linear one: rising as t against t^(3/2), and the reverse.
            (Normal::Hertz(..), Tangential::Spring(_)) => slip != 0.0,
            (Normal::Linear(..), Tangential::Mindlin(_)) => false,
        };
        if slips { Mode::Slips(slip.signum()) } else { Mode::Sticks }
    }

    pub(super) fn run(mut self) -> Outcome {
        let shallow = (SHALLOW * self.scale).sqrt().sqrt();
        let never = |_: &Unknowns| -1.0;
        self.advance(shallow, shallow / PARTS, never);
        (self.clock, self.now) = (Clock::Time, self.state[0]);
        self.state[0] = SHALLOW * self.scale;
        let trial = self.scale / self.before.approach / PARTS;
        self.advance(f64::INFINITY, trial, |state| -state[1]);
        let largest_overlap = self.state[0];
        let carried = self.trial(self.root_now(), &self.state);
        self.rises = false;
        self.load_spring(carried);
        let leaves = SHALLOW * largest_overlap;
        self.advance(f64::INFINITY, trial, |state| leaves - state[0]);
        let (time, root) = (self.now, self.root_now());
        (self.clock, self.now) = (Clock::Root, root);
        self.state[0] = time;
        self.advance(0.0, -root / PARTS, never);
        self.outcome(largest_overlap)
    }

    fn outcome(&self, largest_overlap: f64) -> Outcome {
        let [duration, rate, tangential, spin_of_first, spin_of_second, _, turn] = self.state;
        let (sine, cosine) = turn.sin_cos();
        let after = Velocities {
            approach: rate * cosine - tangential * sine,
            tangential: rate * sine + tangential * cosine,
            spin_of_first,
            spin_of_second,
        };
        Outcome { after, duration, largest_overlap, turn, events: self.events }
    }

    /// Moves the clock to a target in steps of a trial length, or until a measure of the state rises above zero; every change of mode ends a step.
    fn advance(&mut self, target: f64, mut trial: f64, stop: impl Fn(&Unknowns) -> f64) {
        let shortest = SHORTEST * trial.abs();
        while self.now != target && self.events < LARGEST_NUMBER_OF_EVENTS {
            let is_last = trial.abs() >= (target - self.now).abs();
            let length = if is_last { target - self.now } else { trial };
            let slope = self.derivative(0.0, &self.state);
            let step = self.step(&slope, length);
            if !step.converged && length.abs() > shortest {
                trial = 0.5 * length;
                continue;
            }
            if !step.converged {
                self.state = [f64::NAN; 7];
                return;
            }
            let at = |part: f64| self.step(&slope, part * length).end;
            let event_of = |excess: &dyn Fn(f64, &Unknowns) -> f64| {
                let happens = excess(length, &step.end) > 0.0;
                happens.then(|| root(|part| excess(part * length, &at(part)), 0.0, 1.0))
            };
            let stopped = event_of(&|_, state| stop(state));
            let changes =
                [Mode::Released, self.other_mode()].map(|mode| Some((event_of(&|offset, state| self.excess(mode, offset, state))?, mode)));
            let change = changes.into_iter().flatten().min_by(|one, other| one.0.total_cmp(&other.0));
            let change = change.filter(|(part, _)| stopped.is_none_or(|stopped| *part < stopped));
            let taken = change.map_or(stopped, |(part, _)| Some(part));
            let end = taken.map_or(step.end, at);
            self.now = if taken.is_none() && is_last { target } else { self.now + taken.unwrap_or(1.0) * length };
            self.state = end;
            match change {
                Some((_, mode)) => self.enter(mode),
                None if stopped.is_some() => return,
                None => {}
            }
        }
    }

    fn step(&self, slope: &Unknowns, length: f64) -> Step<7> {
        let speed = self.before.approach + self.setting.slip(&self.before).abs() + self.before.tangential.abs();
        let clock = if self.clock == Clock::Root { self.scale / self.before.approach } else { self.scale };
        let stretch = self.scale * speed / self.before.approach;
        let spring = match self.setting.tangential {
            Tangential::Mindlin(stiffness) if self.rises => stretch * stiffness * self.scale.sqrt(),
            _ => stretch,
        };
        let spin = speed / self.setting.first.radius.min(self.setting.second.map_or(f64::INFINITY, |second| second.radius));
        let scales = [clock, speed, speed, spin, spin, spring, stretch * self.inverse_distance(0.0) + f64::MIN_POSITIVE];
        extrapolate(|offset, state| self.derivative(offset, state), &self.state, slope, length, &scales.map(|scale| TOLERANCE * scale))
    }

    /// The fourth root of the overlap.
    fn root_at(&self, offset: f64, state: &Unknowns) -> f64 {
        match self.clock {
            Clock::Root => self.now + offset,
            Clock::Time => state[0].sqrt().sqrt(),
        }
    }

    fn root_now(&self) -> f64 {
        self.root_at(0.0, &self.state)
    }

    fn inverse_distance(&self, overlap: f64) -> f64 {
        let distance = |second: super::Sphere| 1.0 / (self.setting.first.radius + second.radius - overlap);
        if self.setting.moves { self.setting.second.map_or(0.0, distance) } else { 0.0 }
    }

    /// Lever arms at the fourth root of an overlap.
    fn arms(&self, root: f64) -> [f64; 2] {
        let shrinks = if self.setting.moves { 0.5 * root.powi(4) } else { 0.0 };
        [self.setting.first.radius - shrinks, self.setting.second.map_or(0.0, |second| second.radius - shrinks)]
    }

    fn slip(&self, root: f64, state: &Unknowns) -> f64 {
        let [first, second] = self.arms(root);
        state[2] + first * state[3] + second * state[4]
    }

    fn normal_force(&self, root: f64, state: &Unknowns) -> f64 {
        match self.setting.normal {
            Normal::Linear(stiffness, damping) => stiffness * root.powi(4) + damping * state[1],
            Normal::Hertz(stiffness, damping) => stiffness * root.powi(6) + damping * root * state[1],
        }
    }

    /// Rate of the overlap's rate.
    fn acceleration(&self, root: f64, state: &Unknowns) -> f64 {
        -self.normal_force(root, state) / self.setting.normal_mass() - state[2] * state[2] * self.inverse_distance(root.powi(4))
    }

    fn normal_force_rate(&self, root: f64, state: &Unknowns) -> f64 {
        let (rate, acceleration) = (state[1], self.acceleration(root, state));
        match self.setting.normal {
            Normal::Linear(stiffness, damping) => stiffness * rate + damping * acceleration,
            Normal::Hertz(stiffness, 0.0) => 1.5 * stiffness * root * root * rate,
            Normal::Hertz(stiffness, damping) => {
                1.5 * stiffness * root * root * rate + damping * (0.25 * rate * rate / root.powi(3) + root * acceleration)
            }
        }
    }

    /// What the tangential law would carry against the slip.
    fn trial(&self, root: f64, state: &Unknowns) -> f64 {
        match self.setting.tangential {
            Tangential::Spring(stiffness) => stiffness * state[5],
            Tangential::Mindlin(_) if self.rises => state[5],
            Tangential::Mindlin(stiffness) => stiffness * root * root * state[5],
            Tangential::Dashpot(dashpot) => dashpot * self.slip(root, state),
        }
    }

    /// Loads the spring so that it carries a force.
    fn load_spring(&mut self, force: f64) {
        let root = self.root_now();
        self.state[5] = match self.setting.tangential {
            Tangential::Spring(stiffness) => force / stiffness,
            Tangential::Mindlin(_) if self.rises => force,
            Tangential::Mindlin(stiffness) => force / (stiffness * root * root),
            Tangential::Dashpot(_) => 0.0,
        };
    }

    fn derivative(&self, offset: f64, state: &Unknowns) -> Unknowns {
        let root = self.root_at(offset, state);
        let [_, rate, tangential, ..] = *state;
        let force = match self.mode {
            Mode::Sticks => -self.trial(root, state),
            Mode::Slips(sign) => -sign * self.setting.friction * self.normal_force(root, state).max(0.0),
            Mode::Released => 0.0,
        };
        let slip = self.slip(root, state);
        let spring = match (self.mode, self.setting.tangential) {
            (Mode::Sticks, Tangential::Mindlin(stiffness)) if self.rises => stiffness * root * root * slip,
            (Mode::Sticks, Tangential::Spring(_) | Tangential::Mindlin(_)) => slip,
            _ => 0.0,
        };
        let [arm, other_arm] = self.arms(root);
        let inverse_distance = self.inverse_distance(root.powi(4));
        let rates = [
            if self.clock == Clock::Root { 1.0 } else { rate },
            self.acceleration(root, state),
            force / self.setting.normal_mass() + rate * tangential * inverse_distance,
            arm * force / self.setting.first.inertia,
            self.setting.second.map_or(0.0, |second| other_arm * force / second.inertia),
            spring,
            -tangential * inverse_distance,
        ];
        match self.clock {
            Clock::Root => rates.map(|per_time| per_time * (4.0 * root.powi(3) / rate)),
            Clock::Time => rates,
        }
    }

    /// The mode that a change of friction would lead to.
    fn other_mode(&self) -> Mode {
        match self.mode {
            Mode::Sticks => Mode::Slips(0.0),
            Mode::Slips(_) | Mode::Released => Mode::Sticks,
        }
    }

    /// Above zero where the motion should be in another mode.
    fn excess(&self, mode: Mode, offset: f64, state: &Unknowns) -> f64 {
        let root = self.root_at(offset, state);
        let force = self.normal_force(root, state);
        let friction = self.setting.friction;
        match (self.mode, mode) {
            (Mode::Released, _) => -1.0,
            (_, Mode::Released) => -force,
            (Mode::Sticks, _) => self.trial(root, state).abs() - friction * force,
            (Mode::Slips(sign), _) => match self.setting.tangential {
                Tangential::Dashpot(_) => friction * force - sign * self.trial(root, state),
                Tangential::Spring(stiffness) => friction * self.normal_force_rate(root, state) - sign * stiffness * self.slip(root, state),
                Tangential::Mindlin(stiffness) => {
                    let shrinks = if self.rises { 0.0 } else { 0.5 * friction * force * state[1] / root.powi(4) };
                    let rate = sign * stiffness * root * root * self.slip(root, state) + shrinks;
                    friction * self.normal_force_rate(root, state) - rate
                }
            },
        }
    }

    fn enter(&mut self, mode: Mode) {
        self.events += 1;
        let root = self.root_now();
        match (self.mode, mode) {
            (_, Mode::Released) => self.mode = Mode::Released,
            (Mode::Sticks, _) => self.mode = Mode::Slips(self.trial(root, &self.state).signum()),
            (Mode::Slips(sign), _) => {
                self.load_spring(sign * self.setting.friction * self.normal_force(root, &self.state));
                self.mode = Mode::Sticks;
            }
            (Mode::Released, _) => {}
        }
    }
}
