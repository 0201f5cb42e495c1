//! A torque of constant size against the direction of rolling (Ai, Chen, Rotter and Ooi 2011, type A).
//!
//! Coded form: $M = -\mu_r R^* F_n\, \omega / |\omega|$ with the relative spin $\omega$ in the contact plane. As printed, the torque of a sphere at rest jumps to
//! and fro by its full size each step. Coded is Coulomb's law proper: up to that size the torque is what brings the relative spin to rest within the step.

use serde::{Deserialize, Serialize};

use super::{RollingContact, RollingLaw};
use crate::Vector;
use crate::contact::law::viscous_coulomb::capped;
use crate::contact::law::{StepKind, TimeScales};

/// A torque of constant size against the direction of rolling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConstantTorque {
    /// Coefficient of rolling friction: largest torque over rolling radius and normal force.
    pub friction: f64,
}

/// Mean torque of the last step in N m: it tells a contact's own share in the predicted spin.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct LastTorque(Vector);

impl RollingLaw for ConstantTorque {
    type History = LastTorque;
    const NEEDS_ROTATION: bool = true;
    const NAME: &'static str = "rolling torque of constant size";

    fn mean_torque(&self, contact: &RollingContact, kind: &StepKind, history: &mut LastTorque) -> Vector {
        let external = contact.spin_rate - history.0 / contact.inertia;
        let stopping = -(contact.spin / kind.step + external) * contact.inertia;
        let in_plane = stopping - contact.normal * stopping.dot(&contact.normal);
        let torque = capped(in_plane, self.friction * contact.rolling_radius * contact.normal_force.max(0.0));
        history.0 = torque;
        torque
    }

    fn stored_energy(&self, _history: &LastTorque) -> f64 {
        0.0
    }

    fn time_scales(&self, _inertia: f64, _lagged_damping: bool) -> TimeScales {
        TimeScales::NONE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: a free spin of 3 rad/s under a torque of 0.1 * 0.5 * 4 on an inertia of 2 falls by 0.1 a second, and stays zero after 30.
    #[test]
    fn a_spin_falls_evenly_and_stays_at_rest() {
        let law = ConstantTorque { friction: 0.1 };
        let kind = StepKind { step: 0.7, synchronous: false, lagged_damping: false, resolved_edges: true };
        let (mut spin, mut rate, mut history) = (Vector::x() * 3.0, Vector::zeros(), LastTorque::default());
        for index in 1..=60 {
            let contact = RollingContact {
                normal: Vector::z(),
                spin,
                spin_rate: rate,
                normal_force: 4.0,
                rolling_radius: 0.5,
                inertia: 2.0,
                touched_before: 1.0,
                twist: 0.0,
            };
            rate = law.mean_torque(&contact, &kind, &mut history) / 2.0;
            spin += rate * kind.step;
            let expected = (3.0 - 0.1 * 0.7 * f64::from(index)).max(0.0);
            assert!((spin.x - expected).abs() < 1e-13, "{index}: {spin}");
        }
    }
}
