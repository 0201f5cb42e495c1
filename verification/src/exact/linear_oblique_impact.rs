//! The oblique impact on linear springs with Coulomb's slider (Maw, Barber and Fawcett's problem for linear springs), by pieces of closed form joined at
//! their events: nothing is stepped.
//!
//! Along the normal a damped oscillator until its overlap is zero. Along the contact plane a spring that is stretched by the slip $s$ of the contact
//! point: sticking, $m_t \dot s = -k_t \xi$, is an undamped oscillator; slipping, $m_t \dot s = \mp \mu F_n$, is in closed form too, since $\int F_n dt$ is the normal
//! mass times the loss of approach velocity. The lever arms are constant: the contact point of a soft sphere that moves by half the overlap is in
//! [`oblique_impact`](super::oblique_impact).

use std::f64::consts::PI;

use super::bisection::bisect;

/// The setting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearObliqueImpact {
    /// Effective mass along the normal in kg.
    pub normal_mass: f64,
    /// Effective mass of the contact point along the contact plane in kg.
    pub tangential_mass: f64,
    /// Normal stiffness in N/m.
    pub stiffness: f64,
    /// Normal damping as a fraction of critical, below one.
    pub damping_ratio: f64,
    /// Tangential stiffness in N/m.
    pub tangential_stiffness: f64,
    /// Coulomb coefficient.
    pub friction: f64,
}

/// The end of an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearOutcome {
    /// Velocity of separation in m/s.
    pub rebound: f64,
    /// Slip velocity in m/s.
    pub slip: f64,
    /// Pieces of sticking and slipping.
    pub pieces: usize,
}

/// One piece: what the contact point does from a time on.
#[derive(Debug, Clone, Copy)]
struct Piece {
    start: f64,
    /// Sign of the slipping force; zero while it sticks.
    direction: f64,
    stretch: f64,
    slip: f64,
}

/// More pieces than any impact has.
const LARGEST_NUMBER_OF_PIECES: usize = 100;
/// Parts of the shorter half period in which an event is looked for.
const PARTS: f64 = 400.0;

impl LinearObliqueImpact {
    /// The end of an impact at an approach and a slip velocity in m/s.
    pub fn after(&self, approach: f64, slip: f64) -> LinearOutcome {
        let normal = Normal::new(self, approach);
        let tangential = Tangential { setting: self, normal };
        let sticks = self.tangential_stiffness * slip.abs() <= self.friction * self.stiffness * approach || self.damping_ratio > 0.0;
        let mut piece = Piece { start: 0.0, direction: if sticks { 0.0 } else { slip.signum() }, stretch: 0.0, slip };
        let mut pieces = 1;
        while let Some(event) = tangential.end_of(&piece).filter(|_| pieces < LARGEST_NUMBER_OF_PIECES) {
            piece = tangential.next(&piece, event);
            pieces += 1;
        }
        // Without attraction along the plane: the cap is zero once the normal force pulls.
        let (_, slip) = tangential.at(&piece, normal.end_of_push);
        LinearOutcome { rebound: -normal.at(normal.duration).1, slip, pieces }
    }
}

/// The motion along the normal.
#[derive(Debug, Clone, Copy)]
struct Normal {
    mass: f64,
    stiffness: f64,
    dashpot: f64,
    decay: f64,
    frequency: f64,
    approach: f64,
    duration: f64,
    /// When the force falls to zero.
    end_of_push: f64,
}

impl Normal {
    fn new(setting: &LinearObliqueImpact, approach: f64) -> Normal {
        let undamped = (setting.stiffness / setting.normal_mass).sqrt();
        let ratio = setting.damping_ratio;
        let root = (1.0 - ratio * ratio).sqrt();
        let frequency = undamped * root;
        let angle = PI - (2.0 * ratio * root).atan2(1.0 - 2.0 * ratio * ratio);
        Normal {
            mass: setting.normal_mass,
            stiffness: setting.stiffness,
            dashpot: 2.0 * ratio * undamped * setting.normal_mass,
            decay: ratio * undamped,
            frequency,
            approach,
            duration: PI / frequency,
            end_of_push: angle / frequency,
        }
    }

    /// Overlap and approach rate at a time.
    fn at(&self, time: f64) -> (f64, f64) {
        let (sine, cosine) = (self.frequency * time).sin_cos();
        let scale = self.approach * (-self.decay * time).exp();
        (scale * sine / self.frequency, scale * (cosine - self.decay / self.frequency * sine))
    }

    /// Force and its rate at a time.
    fn force(&self, time: f64) -> (f64, f64) {
        let (overlap, rate) = self.at(time);
        let force = self.stiffness * overlap + self.dashpot * rate;
        (force, self.stiffness * rate - self.dashpot * force / self.mass)
    }
}

/// The motion along the contact plane.
struct Tangential<'a> {
    setting: &'a LinearObliqueImpact,
    normal: Normal,
}

impl Tangential<'_> {
    fn frequency(&self) -> f64 {
        (self.setting.tangential_stiffness / self.setting.tangential_mass).sqrt()
    }

    /// Stretch and slip at a time of a piece.
    fn at(&self, piece: &Piece, time: f64) -> (f64, f64) {
        let setting = self.setting;
        if piece.direction == 0.0 {
            let frequency = self.frequency();
            let (sine, cosine) = (frequency * (time - piece.start)).sin_cos();
            return (piece.stretch * cosine + piece.slip / frequency * sine, piece.slip * cosine - frequency * piece.stretch * sine);
        }
        let impulse = self.normal.mass * (self.normal.at(piece.start).1 - self.normal.at(time).1);
        let slip = piece.slip - piece.direction * setting.friction * impulse / setting.tangential_mass;
        // Slip rewrites the spring: it carries the Coulomb force.
        (piece.direction * setting.friction * self.normal.force(time).0 / setting.tangential_stiffness, slip)
    }

    /// Above zero once a piece is over: force beyond the cap of a sticking point, cap beyond the force of a slipping one.
    fn excess(&self, piece: &Piece, time: f64) -> f64 {
        let (stretch, slip) = self.at(piece, time);
        let (force, rate) = self.normal.force(time);
        if piece.direction == 0.0 {
            self.setting.tangential_stiffness * stretch.abs() - self.setting.friction * force
        } else {
            self.setting.friction * rate - piece.direction * self.setting.tangential_stiffness * slip
        }
    }

    /// When a piece ends, if it ends before the force along the normal does.
    fn end_of(&self, piece: &Piece) -> Option<f64> {
        let stride = PI / self.frequency().max(self.normal.frequency) / PARTS;
        let end = self.normal.end_of_push;
        let mut low = piece.start;
        while low < end {
            let high = (low + stride).min(end);
            if self.excess(piece, high) > 0.0 {
                return Some(bisect(|time| self.excess(piece, time), low, high));
            }
            low = high;
        }
        None
    }

    fn next(&self, piece: &Piece, event: f64) -> Piece {
        let (stretch, slip) = self.at(piece, event);
        let direction = if piece.direction == 0.0 { stretch.signum() } else { 0.0 };
        Piece { start: event, direction, stretch, slip }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SETTING: LinearObliqueImpact = LinearObliqueImpact {
        normal_mass: 0.3,
        tangential_mass: 0.3 * 2.0 / 7.0,
        stiffness: 1e4,
        damping_ratio: 0.0,
        tangential_stiffness: 0.5e4,
        friction: 0.3,
    };

    /// Closed form: fast slip never sticks, and loses (7/2) mu (1 + e) of the approach velocity, as a rigid sphere does.
    #[test]
    fn fast_slip_is_that_of_a_rigid_sphere() {
        let outcome = SETTING.after(0.7, 5.0);
        assert_eq!(outcome.pieces, 1);
        assert!((outcome.slip - (5.0 - 3.5 * 0.3 * 2.0 * 0.7)).abs() < 1e-14, "{outcome:?}");
        assert!((outcome.rebound - 0.7).abs() < 1e-14);
    }

    /// Closed form: with so much friction that nothing slips the contact point swings for the whole contact, and the end alone may slip.
    #[test]
    fn a_point_that_sticks_swings() {
        let sticking = LinearObliqueImpact { friction: 1e6, ..SETTING };
        let angle = PI * (0.5_f64 * 3.5).sqrt();
        let outcome = sticking.after(0.7, 0.4);
        // The last piece, where the cap is below the spring, lasts about a millionth of the contact.
        assert!((outcome.slip - 0.4 * angle.cos()).abs() < 1e-5 && outcome.pieces == 2, "{outcome:?} {}", 0.4 * angle.cos());
    }

    /// Independent: the same law stepped two million times by an explicit scheme of first order.
    #[test]
    fn pieces_match_a_brute_force_integration() {
        for (ratio, slip) in [(0.0, 0.3), (0.1, 0.9), (0.2, -1.6)] {
            let setting = LinearObliqueImpact { damping_ratio: ratio, ..SETTING };
            let exact = setting.after(0.7, slip);
            let dashpot = 2.0 * ratio * (setting.stiffness * setting.normal_mass).sqrt();
            let step = PI * (setting.normal_mass / setting.stiffness).sqrt() / 2e6;
            let (mut overlap, mut rate, mut stretch, mut slip): (f64, f64, f64, f64) = (0.0, 0.7, 0.0, slip);
            loop {
                overlap += rate * step;
                stretch += slip * step;
                let force = setting.stiffness * overlap + dashpot * rate;
                let cap = (setting.friction * force).max(0.0);
                let trial = setting.tangential_stiffness * stretch;
                let tangential = trial.clamp(-cap, cap);
                stretch = tangential / setting.tangential_stiffness;
                rate -= force / setting.normal_mass * step;
                slip -= tangential / setting.tangential_mass * step;
                if overlap < 0.0 {
                    break;
                }
            }
            assert!((slip - exact.slip).abs() < 1e-5 && (rate + exact.rebound).abs() < 1e-5, "{exact:?} {slip} {rate}");
            assert!(exact.pieces > 1, "{exact:?}");
        }
    }
}
