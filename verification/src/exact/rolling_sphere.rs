//! A sphere on a flat wall with friction, by pieces of closed form joined at their events: nothing is stepped.
//!
//! The wall may be inclined: gravity pulls along it. The normal force is constant. With the slip velocity $u = v - \omega a$ at the contact point (lever arm
//! $a$) and the tangential effective mass $m_t = 1/(1/m + a^2/I)$, $\dot u = g_\parallel - F/m_t$, and whatever the friction force does,
//! $v (1 + j) = v_0 + j (\ldots) + g_\parallel t + j u$ with $j = I/(m a^2)$: friction only exchanges spin and velocity.

use super::bisection::bisect;

/// A sphere on a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingSphere {
    /// Mass in kg.
    pub mass: f64,
    /// Moment of inertia in kg m^2.
    pub inertia: f64,
    /// Distance from the centre to the contact point in m.
    pub arm: f64,
    /// Gravity along the wall in m/s^2.
    pub pull: f64,
    /// Largest friction force in N.
    pub cap: f64,
    /// Velocity along the pull at the start, in m/s.
    pub start_velocity: f64,
    /// Slip velocity of the contact point at the start, in m/s: the velocity itself if the sphere does not spin then.
    pub start_slip: f64,
    /// Torque against rolling in N m, while the sphere rolls along the pull.
    pub resistance: f64,
}

/// Velocity along the wall and angular velocity, both positive when rolling down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rolling {
    /// In m/s.
    pub velocity: f64,
    /// In rad/s.
    pub angular_velocity: f64,
    /// Slip velocity at the contact point in m/s.
    pub slip: f64,
}

impl RollingSphere {
    /// Tangential effective mass of the contact point in kg.
    pub fn effective_mass(&self) -> f64 {
        1.0 / (1.0 / self.mass + self.arm * self.arm / self.inertia)
    }

    /// Acceleration in m/s^2 of the contact point if there were no friction.
    pub fn slip_pull(&self) -> f64 {
        self.pull + self.resistance * self.arm / self.inertia
    }

    /// Velocity and spin that belong to a slip velocity at a time.
    fn at_slip(&self, time: f64, slip: f64) -> Rolling {
        let ratio = self.inertia / (self.mass * self.arm * self.arm);
        let start = self.start_velocity + ratio * (self.start_velocity - self.start_slip);
        let pull = self.pull - self.resistance / (self.mass * self.arm);
        let velocity = (start + pull * time + ratio * slip) / (1.0 + ratio);
        Rolling { velocity, angular_velocity: (velocity - slip) / self.arm, slip }
    }

    /// The state at a time under viscous friction `coefficient * slip` in N s/m that never reaches the cap.
    pub fn with_viscous_friction(&self, coefficient: f64, time: f64) -> Rolling {
        let relaxation = self.effective_mass() / coefficient;
        let terminal = self.slip_pull() * relaxation;
        self.at_slip(time, terminal + (self.start_slip - terminal) * (-time / relaxation).exp())
    }

    /// The motion until a time under a spring with memory in N/m and a dashpot in N s/m, unstretched at the start, capped by Coulomb's law.
    pub fn with_spring(&self, stiffness: f64, dashpot: f64, until: f64) -> SpringMotion {
        let law = Spring { mass: self.effective_mass(), stiffness, dashpot, pull: self.slip_pull(), cap: self.cap };
        let start = State { stretch: 0.0, slip: self.start_slip };
        let mut piece = Piece { start: 0.0, sticks: law.force(&start).abs() < self.cap, state: start };
        let mut pieces = vec![piece];
        for _ in 0..LARGEST_NUMBER_OF_EVENTS {
            let Some(duration) = law.duration(&piece, until) else { break };
            piece = Piece { start: piece.start + duration, sticks: !piece.sticks, state: law.after(&piece, duration) };
            pieces.push(piece);
        }
        SpringMotion { sphere: *self, law, pieces }
    }
}

/// A motion by pieces: sticking and slipping in turn.
#[derive(Debug, Clone)]
pub struct SpringMotion {
    sphere: RollingSphere,
    law: Spring,
    pieces: Vec<Piece>,
}

impl SpringMotion {
    /// The state at a time, not after the end that the motion was found for.
    pub fn at(&self, time: f64) -> Rolling {
        let last = self.pieces.iter().rev().find(|piece| piece.start <= time);
        let slip = last.map_or(self.sphere.start_slip, |piece| self.law.after(piece, time - piece.start).slip);
        self.sphere.at_slip(time, slip)
    }
}

/// One piece of the motion and the state it starts from.
#[derive(Debug, Clone, Copy)]
struct Piece {
    start: f64,
    sticks: bool,
    state: State,
}

/// Enough for any motion that settles; a motion with more would be chattering.
const LARGEST_NUMBER_OF_EVENTS: usize = 1000;

/// Stretch of the spring and slip velocity.
#[derive(Debug, Clone, Copy)]
struct State {
    stretch: f64,
    slip: f64,
}

#[derive(Debug, Clone, Copy)]
struct Spring {
    mass: f64,
    stiffness: f64,
    dashpot: f64,
    pull: f64,
    cap: f64,
}

impl Spring {
    /// Friction force against the slip.
    fn force(&self, state: &State) -> f64 {
        self.stiffness * state.stretch + self.dashpot * state.slip
    }

    /// The state some time into a piece.
    fn after(&self, piece: &Piece, time: f64) -> State {
        if piece.sticks { self.stick(&piece.state, time) } else { self.slip(&piece.state, time) }
    }

    /// How long a piece lasts, if it ends before a time.
    fn duration(&self, piece: &Piece, until: f64) -> Option<f64> {
        let within = until - piece.start;
        if piece.sticks { self.end_of_stick(&piece.state, within) } else { self.end_of_slip(&piece.state, within) }
    }

    /// Sticking: a damped oscillator about the stretch that holds the pull.
    fn stick(&self, start: &State, time: f64) -> State {
        let rest = self.mass * self.pull / self.stiffness;
        let (decay, square) = (0.5 * self.dashpot / self.mass, self.stiffness / self.mass);
        let frequency = (square - decay * decay).sqrt();
        let (offset, slip) = (start.stretch - rest, start.slip);
        let (sine, cosine) = (frequency * time).sin_cos();
        let factor = (-decay * time).exp();
        State {
            stretch: rest + factor * (offset * cosine + (slip + decay * offset) / frequency * sine),
            slip: factor * (slip * cosine - (square * offset + decay * slip) / frequency * sine),
        }
    }

    /// When the force of a sticking contact reaches the cap, within a time.
    fn end_of_stick(&self, start: &State, within: f64) -> Option<f64> {
        let excess = |time: f64| self.force(&self.stick(start, time)).abs() - self.cap;
        let period = 2.0 * std::f64::consts::PI / (self.stiffness / self.mass).sqrt();
        // The force is a damped wave: no excursion is shorter than a small part of its period.
        let stride = period / 200.0;
        let mut low = 0.0;
        while low < within {
            let high = (low + stride).min(within);
            if excess(high) > 0.0 && (low > 0.0 || excess(low) <= 0.0) {
                return Some(bisect(excess, low, high));
            }
            low = high;
        }
        None
    }

    /// Acceleration of the slip under the full friction force.
    fn slip_acceleration(&self, slip: f64) -> f64 {
        self.pull - self.cap * slip.signum() / self.mass
    }

    fn slip(&self, start: &State, time: f64) -> State {
        let slip = start.slip + self.slip_acceleration(start.slip) * time;
        // The spring is rewritten so that spring and dashpot together carry the cap.
        State { stretch: (self.cap * start.slip.signum() - self.dashpot * slip) / self.stiffness, slip }
    }

    /// When the force that spring and dashpot would carry begins to fall below the cap, within a time: $k u + c \dot u = 0$.
    fn end_of_slip(&self, start: &State, within: f64) -> Option<f64> {
        let acceleration = self.slip_acceleration(start.slip);
        let end = -self.dashpot / self.stiffness * acceleration;
        let time = (end - start.slip) / acceleration;
        let slows = acceleration * start.slip.signum() < 0.0;
        (slows && time < within).then_some(time.max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = include_str!("../../../reference-data/slipping_ball/data.csv");

    fn ball(radius: f64, mass: f64) -> RollingSphere {
        let inertia = 0.4 * mass * radius * radius;
        RollingSphere { mass, inertia, arm: radius, pull: 0.0, cap: 0.0, start_velocity: 0.0, start_slip: 0.0, resistance: 0.0 }
    }

    /// Independent: the published end of slip and final velocity of a rigid ball, reached as the spring gets stiff.
    #[test]
    fn a_sliding_ball_ends_as_published() {
        let gravity = 9.81;
        for line in TABLE.lines().skip(1) {
            let numbers: Vec<f64> = line.split(',').map(|number| number.parse().expect("a table of numbers")).collect();
            let [friction, slip_time, velocity, spin] = numbers[..] else { panic!("four columns") };
            let ball = RollingSphere { cap: friction * gravity, start_velocity: 1.0, start_slip: 1.0, ..ball(5e-4, 1.0) };
            let stiffness = 1e9;
            let dashpot = 2.0 * 0.2 * (stiffness * ball.effective_mass()).sqrt();
            let motion = ball.with_spring(stiffness, dashpot, slip_time * 1.1);
            let end = motion.at(slip_time * 1.1);
            assert!((end.velocity / velocity - 1.0).abs() < 1e-8 && (end.angular_velocity / spin - 1.0).abs() < 1e-8, "{end:?}");
            let midway = motion.at(0.5 * slip_time);
            // The spring loads in a time of cap / (stiffness v): 1e-8 s.
            assert!((midway.velocity - (1.0 - friction * gravity * 0.5 * slip_time)).abs() < 1e-7, "{midway:?}");
        }
    }

    /// Exact: a ball that never slips rolls with 5/7 of the pull once its spring has settled.
    #[test]
    fn a_rolling_ball_has_five_sevenths_of_the_pull() {
        let ball = RollingSphere { pull: 3.0, cap: f64::INFINITY, ..ball(0.01, 0.2) };
        let end = ball.with_spring(1e6, 2.0 * 0.3 * (1e6 * ball.effective_mass()).sqrt(), 1.0).at(1.0);
        assert!((end.velocity - 5.0 / 7.0 * 3.0).abs() < 1e-12, "{end:?}");
        assert!((end.angular_velocity * 0.01 - end.velocity).abs() < 1e-12);
    }

    /// Exact: a ball that rolls against a torque M slows by M/(a m (1 + 2/5)) once its spring has settled.
    #[test]
    fn a_torque_slows_a_rolling_ball() {
        let ball = RollingSphere { cap: f64::INFINITY, start_velocity: 2.0, resistance: 0.003, ..ball(0.01, 0.2) };
        let end = ball.with_spring(1e6, 2.0 * 0.3 * (1e6 * ball.effective_mass()).sqrt(), 1.0).at(1.0);
        assert!((end.velocity - (2.0 - 0.003 / (0.01 * 0.2 * 1.4))).abs() < 1e-12, "{end:?}");
        assert!((end.angular_velocity * 0.01 - end.velocity).abs() < 1e-12);
    }

    /// Independent: the same law stepped a million times by an explicit scheme of first order, error of the order of the step.
    #[test]
    fn pieces_match_a_brute_force_integration() {
        let ball = RollingSphere { pull: 3.0, cap: 0.1, start_velocity: 0.05, start_slip: 0.05, ..ball(0.01, 0.2) };
        let (stiffness, dashpot, mass) = (2e3, 1.0, ball.effective_mass());
        let (end, steps) = (0.03, 1_000_000);
        let step = end / f64::from(steps);
        let (mut slip, mut stretch) = (ball.start_velocity, 0.0);
        for _ in 0..steps {
            stretch += slip * step;
            let trial: f64 = stiffness * stretch + dashpot * slip;
            let force = trial.clamp(-ball.cap, ball.cap);
            if force != trial {
                stretch = (force - dashpot * slip) / stiffness;
            }
            slip += (ball.pull - force / mass) * step;
        }
        let exact = ball.with_spring(stiffness, dashpot, end).at(end);
        assert!((exact.slip - slip).abs() < 20.0 * step, "{} against {slip}", exact.slip);
    }
}
