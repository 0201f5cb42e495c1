//! Viscous friction capped by Coulomb's law, without memory of displacement (R eq. 3.20-3.21).
//!
//! Coded form: $F_t = -\min(\mu k \delta,\ 2 \gamma_t m_r |v_t|)\, v_t / |v_t|$ with the reduced mass $m_r$ of the partners.
//! The cap uses the elastic part of the normal force, as R prints it. There is no static friction: a sphere on an
//! incline keeps slipping at $v = g \sin\alpha / (7 \gamma_t)$, a block creeps at $g \sin\alpha / (2 \gamma_t)$.

use serde::{Deserialize, Serialize};

use super::{ContactScale, StepKind, TangentialContact, TangentialLaw, TimeScales};
use crate::Vector;

/// Viscous friction capped by Coulomb's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViscousCoulomb {
    /// Coulomb coefficient.
    pub friction: f64,
    /// Dissipation rate in 1/s.
    pub damping_rate: f64,
}

/// Mean force of the last step in N: it tells a contact's own share in the predicted velocity.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct LastForce(Vector);

impl LastForce {
    /// Mean force of a dashpot in N s/m against the velocity of the contact point, no larger than a cap in N.
    #[inline(always)]
    pub(super) fn of_dashpot(&mut self, contact: &TangentialContact, kind: &StepKind, dashpot: f64, cap: f64) -> Vector {
        let (velocity, implicit_share) = velocity_without_own_share(contact, kind, &self.0, dashpot);
        let sticking = velocity * (-dashpot / (1.0 + implicit_share));
        self.0 = capped(sticking, cap);
        self.0
    }
}

impl TangentialLaw for ViscousCoulomb {
    type History = LastForce;
    const NEEDS_ROTATION: bool = true;
    const NAME: &'static str = "viscous friction capped by Coulomb's law";

    #[inline(always)]
    fn mean_force(&self, contact: &TangentialContact, kind: &StepKind, history: &mut LastForce) -> Vector {
        let dashpot = 2.0 * self.damping_rate * contact.reduced_mass * contact.share * contact.touched;
        history.of_dashpot(contact, kind, dashpot, self.friction * contact.elastic_force.max(0.0))
    }

    fn stored_energy(&self, _history: &LastForce, _share: f64) -> f64 {
        0.0
    }

    fn time_scales(&self, contact: &ContactScale) -> TimeScales {
        TimeScales::of_dashpot(2.0 * self.damping_rate * contact.reduced_mass, contact.effective_mass, contact.lagged_damping)
    }
}

/// Velocity of the contact point at the time of the force without the contact's own share in it, and the factor by which a dashpot in N s/m
/// must be divided (less one) to account for that share.
#[inline(always)]
pub(super) fn velocity_without_own_share(contact: &TangentialContact, kind: &StepKind, last_force: &Vector, dashpot: f64) -> (Vector, f64) {
    // Zero rather than a branch, so that several contacts can be evaluated at once.
    let since = if kind.lagged_damping || kind.synchronous { 0.0 } else { 0.5 * kind.step };
    let external = contact.acceleration - last_force * contact.inverse_effective_mass;
    (contact.velocity + since * external, since * dashpot * contact.inverse_effective_mass)
}

/// A force shortened to a largest length.
#[inline(always)]
pub(super) fn capped(force: Vector, largest: f64) -> Vector {
    force * part_below(&force, largest)
}

/// By what a force is shortened to a largest length: one if it is no longer.
#[inline(always)]
pub(super) fn part_below(force: &Vector, largest: f64) -> f64 {
    let squared = force.norm_squared();
    if squared > largest * largest { largest / squared.sqrt() } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn force_at(velocity: f64) -> Vector {
        let law = ViscousCoulomb { friction: 0.5, damping_rate: 3.0 };
        let contact = TangentialContact {
            normal_force: 7.0,
            elastic_force: 4.0,
            reduced_mass: 0.5,
            ..TangentialContact::at_velocity(Vector::x() * velocity)
        };
        let kind = StepKind { step: 0.1, synchronous: true, lagged_damping: false, resolved_edges: false };
        law.mean_force(&contact, &kind, &mut LastForce::default())
    }

    /// R eq. 3.20-3.21: 2 gamma_t m v below the cap, mu times the *elastic* part of the normal force above it.
    #[test]
    fn the_force_is_viscous_up_to_the_cap_on_the_elastic_force() {
        assert_eq!(force_at(0.1), Vector::x() * -(2.0 * 3.0 * 0.5 * 0.1));
        assert!((force_at(100.0) + Vector::x() * 2.0).norm() < 4.0 * f64::EPSILON);
    }
}
