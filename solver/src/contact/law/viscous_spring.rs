//! The tangential law of S without memory (S eq. 3.41, 3.43-3.47, A.21-A.22): the stretch of the spring is guessed from the velocity.
//!
//! Coded form: $F_t = -(k_t \tau_c + \eta_t)\, v_t$, capped at $\mu |F_n|$, with the duration $\tau_c = \pi / \sqrt{k_n (1 - \gamma^2) / m}$ of a
//! head-on contact (eq. 3.44), $\eta_t = 2 \gamma \sqrt{m k_t}$ (eq. 3.45), the reduced mass $m$ of the partners and the damping ratio $\gamma$ of the normal
//! law (eq. 3.40).
//!
//! Errata: eq. 3.43 puts $\tau_c v_t$ for the sum 3.42 of displacements and calls it accurate. It turns the spring into a dashpot of $k_t \tau_c$: nothing
//! is stored, so a sticking contact point comes to rest where the spring throws it back. Eq. 3.46-3.47 take the velocity of the second partner
//! relative to the first, which would push them on: coded is that of the first relative to the second.

use super::viscous_coulomb::LastForce;
use super::{ContactScale, StepKind, TangentialContact, TangentialLaw, TimeScales};
use crate::Vector;

/// A tangential spring whose stretch is guessed as velocity times the duration of a contact, and a dashpot, capped by Coulomb's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViscousSpring {
    /// Coulomb coefficient.
    pub friction: f64,
    /// Tangential stiffness in N/m.
    pub stiffness: f64,
    /// Stiffness of the normal law in N/m.
    pub normal_stiffness: f64,
    /// Damping ratio of the normal law, below one.
    pub damping_ratio: f64,
}

impl ViscousSpring {
    /// What multiplies the velocity, in N s/m, for a reduced mass in kg.
    #[inline(always)]
    pub fn dashpot(&self, reduced_mass: f64) -> f64 {
        let frequency = (self.normal_stiffness * (1.0 - self.damping_ratio * self.damping_ratio) / reduced_mass).sqrt();
        let duration = std::f64::consts::PI / frequency;
        self.stiffness * duration + 2.0 * self.damping_ratio * (reduced_mass * self.stiffness).sqrt()
    }
}

impl TangentialLaw for ViscousSpring {
    type History = LastForce;
    const NEEDS_ROTATION: bool = true;
    const NAME: &'static str = "spring guessed from the velocity, capped by Coulomb's law";

    #[inline(always)]
    fn mean_force(&self, contact: &TangentialContact, kind: &StepKind, history: &mut LastForce) -> Vector {
        let dashpot = self.dashpot(contact.reduced_mass) * contact.share * contact.touched;
        history.of_dashpot(contact, kind, dashpot, self.friction * contact.normal_force.max(0.0))
    }

    fn stored_energy(&self, _history: &LastForce, _share: f64) -> f64 {
        0.0
    }

    fn time_scales(&self, contact: &ContactScale) -> TimeScales {
        TimeScales::of_dashpot(self.dashpot(contact.reduced_mass), contact.effective_mass, contact.lagged_damping)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: ViscousSpring = ViscousSpring { friction: 0.5, stiffness: 300.0, normal_stiffness: 800.0, damping_ratio: 0.6 };

    fn force_at(velocity: f64) -> Vector {
        let contact = TangentialContact {
            normal_force: 7.0,
            elastic_force: 4.0,
            reduced_mass: 0.5,
            ..TangentialContact::at_velocity(Vector::x() * velocity)
        };
        let kind = StepKind { step: 0.1, synchronous: true, lagged_damping: false, resolved_edges: false };
        LAW.mean_force(&contact, &kind, &mut LastForce::default())
    }

    /// By hand: m = 0.5, gamma = 0.6: root of 800 (1 - 0.36) / 0.5 is 32, tau_c = pi / 32; eta_t = 1.2 root(150).
    #[test]
    fn the_force_opposes_the_velocity_of_the_first_up_to_the_cap_on_the_total_force() {
        let coefficient = 300.0 * std::f64::consts::PI / 32.0 + 1.2 * 150.0_f64.sqrt();
        assert!((LAW.dashpot(0.5) / coefficient - 1.0).abs() < 4.0 * f64::EPSILON);
        assert!((force_at(0.01) + Vector::x() * (0.01 * coefficient)).norm() < 4.0 * f64::EPSILON);
        assert!((force_at(-100.0) - Vector::x() * 3.5).norm() < 8.0 * f64::EPSILON);
    }
}
