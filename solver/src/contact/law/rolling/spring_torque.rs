//! A spring and dashpot against rolling, with a largest torque (Iwashita and Oda 1998; Ai, Chen, Rotter and Ooi 2011, type C).
//!
//! Coded form: the angle $\theta \leftarrow \theta + \omega \Delta t$ of relative rolling since the first touch loads a spring $M = -k_r \theta$ up to
//! $\mu_r R^* F_n$; rolling on rewrites the angle, as slip rewrites a tangential spring. Below the largest torque a dashpot $-2 \zeta_r \sqrt{I k_r}\,\omega$ with the
//! reduced moment of inertia $I$ of the partners works beside the spring; at it the dashpot is silent (their $f = 0$), so that a rolling sphere feels the
//! same torque as from the constant law.

use serde::{Deserialize, Serialize};

use super::{RollingContact, RollingLaw};
use crate::Vector;
use crate::contact::law::carried::carried_along;
use crate::contact::law::viscous_coulomb::capped;
use crate::contact::law::{StepKind, TimeScales};

/// A spring and dashpot against rolling, with a largest torque.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringTorque {
    /// Coefficient of rolling friction: largest torque over rolling radius and normal force.
    pub friction: f64,
    /// Stiffness in N m a radian.
    pub stiffness: f64,
    /// Damping as a fraction of critical, for the reduced moment of inertia of the partners.
    pub damping_ratio: f64,
}

/// What a contact remembers.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Rolled {
    /// Angle in the spring, in rad.
    angle: Vector,
    /// Mean torque of the last step in N m.
    torque: Vector,
}

impl RollingLaw for SpringTorque {
    type History = Rolled;
    const NEEDS_ROTATION: bool = true;
    const NAME: &'static str = "rolling torque of a spring and dashpot";

    fn mean_torque(&self, contact: &RollingContact, kind: &StepKind, history: &mut Rolled) -> Vector {
        let mut angle = carried_along(history.angle, &contact.normal, contact.twist);
        if !kind.synchronous {
            let rolled = contact.spin * (kind.step * contact.touched_before);
            // Rolled in the middle of the step, half of whose turn is still to come.
            angle += rolled + contact.normal.cross(&rolled) * (0.5 * contact.twist);
        }
        let spring = angle * -self.stiffness;
        let loaded = capped(spring, self.friction * contact.rolling_radius * contact.normal_force.max(0.0));
        let mut torque = loaded;
        if loaded == spring {
            let dashpot = 2.0 * self.damping_ratio * (self.stiffness * contact.inertia).sqrt();
            let centred = !kind.lagged_damping && !kind.synchronous;
            let half = if centred { 0.5 * kind.step } else { 0.0 };
            let external = contact.spin_rate - history.torque / contact.inertia;
            torque = (spring - (contact.spin + external * half) * dashpot) / (1.0 + half * dashpot / contact.inertia);
        } else {
            angle = -loaded / self.stiffness;
        }
        *history = Rolled { angle, torque };
        torque
    }

    fn stored_energy(&self, history: &Rolled) -> f64 {
        0.5 * self.stiffness * history.angle.norm_squared()
    }

    fn time_scales(&self, inertia: f64, lagged_damping: bool) -> TimeScales {
        TimeScales::of_oscillator((self.stiffness / inertia).sqrt(), self.damping_ratio, lagged_damping)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact(spin: f64, spin_rate: f64) -> RollingContact {
        RollingContact {
            normal: Vector::z(),
            spin: Vector::x() * spin,
            spin_rate: Vector::x() * spin_rate,
            normal_force: 4.0,
            rolling_radius: 0.5,
            inertia: 2.0,
            touched_before: 1.0,
            twist: 0.0,
        }
    }

    const KIND: StepKind = StepKind { step: 0.01, synchronous: false, lagged_damping: false, resolved_edges: true };

    /// By hand: rolling on carries 0.1 * 0.5 * 4; turning back unloads along the stiffness at once.
    #[test]
    fn rolling_on_rewrites_the_spring() {
        let law = SpringTorque { friction: 0.1, stiffness: 50.0, damping_ratio: 0.0 };
        let mut history = Rolled::default();
        for _ in 0..100 {
            assert!(law.mean_torque(&contact(1.0, 0.0), &KIND, &mut history).norm() <= 0.2 * (1.0 + 4.0 * f64::EPSILON));
        }
        let back = law.mean_torque(&contact(-0.1, 0.0), &KIND, &mut history);
        assert!((back.x + 0.2 - 50.0 * 0.1 * 0.01).abs() < 1e-14, "{back}");
    }

    /// Exact: below the largest torque the spin is a damped oscillator; after a period of it the amplitude has fallen by exp(-2 pi zeta / root(1 - zeta^2)).
    #[test]
    fn below_the_largest_torque_the_spin_is_a_damped_oscillator() {
        let (law, inertia) = (SpringTorque { friction: 1e9, stiffness: 50.0, damping_ratio: 0.3 }, 2.0);
        let root = (1.0_f64 - 0.09).sqrt();
        let (frequency, decay) = (5.0 * root, 5.0 * 0.3);
        let period = 2.0 * std::f64::consts::PI / frequency;
        let steps = 2000;
        let kind = StepKind { step: period / f64::from(steps), ..KIND };
        let start = -0.5 * kind.step;
        let exact = |time: f64| (-decay * time).exp() * ((frequency * time).cos() - decay / frequency * (frequency * time).sin());
        let (mut spin, mut rate, mut history) =
            (exact(start), -2.0 * decay, Rolled { angle: -Vector::x() * kind.step * exact(start), torque: Vector::zeros() });
        history.torque = Vector::x() * rate * inertia;
        for _ in 0..steps {
            rate = law.mean_torque(&contact(spin, rate), &kind, &mut history).x / inertia;
            spin += rate * kind.step;
        }
        let error = (spin - exact(period + start)).abs();
        // Leapfrog's error in the phase is (frequency x step)^2 / 24 of 2 pi; the angle starts within (frequency x step)^2 of the exact one.
        assert!(error < (5.0 * kind.step).powi(2), "{error}");
    }
}
