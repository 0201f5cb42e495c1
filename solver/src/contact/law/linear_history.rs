//! A tangential spring with memory, a dashpot beside it, capped by Coulomb's law (S eq. 3.41, 3.42, 3.47).
//!
//! The spring is stretched by the relative displacement of the contact points since they first touched; it is turned with the contact
//! plane, and slip rewrites it so that spring and dashpot together carry just the Coulomb force.
//!
//! Coded form, with $c = 2 \zeta_t \sqrt{k_t m_t}$ and the tangential effective mass $m_t$ (2/7 of the reduced mass for two solid
//! spheres): $\xi \leftarrow \xi + v_t \Delta t$, $F = -k_t \xi - c v_t$; if $|F| > \mu F_n$: $F \leftarrow \mu F_n F/|F|$ and $\xi \leftarrow -(F + c v_t)/k_t$.
//!
//! Errata: S replaces the sum 3.42 by $\tau_c v_t$ (eq. 3.43), which makes the law a dashpot without memory; S eq. 3.45 takes the
//! reduced mass for the tangential effective mass; S eq. 3.47 has the velocity of the second partner relative to the first.
//! Leapfrog's velocity between two positions is their exact difference over the step, so the spring carries no half-step lag.

use serde::{Deserialize, Serialize};

use super::carried::carried_along;
use super::sliding::sliding_force;
use super::viscous_coulomb::velocity_without_own_share;
use super::{ContactScale, StepKind, TangentialContact, TangentialLaw, TimeScales};
use crate::Vector;

/// A tangential spring with memory, capped by Coulomb's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearHistory {
    /// Coulomb coefficient.
    pub friction: f64,
    /// Spring stiffness in N/m.
    pub stiffness: f64,
    /// Damping as a fraction of critical.
    pub damping_ratio: f64,
}

/// What a contact remembers.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Spring {
    /// Stretch in m.
    stretch: Vector,
    /// Mean force of the last step in N.
    force: Vector,
}

impl TangentialLaw for LinearHistory {
    type History = Spring;
    const NEEDS_ROTATION: bool = true;
    const NAME: &'static str = "spring with memory capped by Coulomb's law";

    #[inline(always)]
    fn mean_force(&self, contact: &TangentialContact, kind: &StepKind, history: &mut Spring) -> Vector {
        let stuck = Sticking::new(self, contact, kind, history);
        *history = if stuck.holds() { stuck.spring } else { stuck.sliding(contact, kind, &history.force) };
        history.force
    }

    #[inline(always)]
    fn force_inside(&self, contact: &TangentialContact, kind: &StepKind, history: &mut Spring) -> (Vector, bool) {
        let stuck = Sticking::new(self, contact, kind, history);
        *history = stuck.spring;
        (history.force, stuck.holds())
    }

    fn stored_energy(&self, history: &Spring, share: f64) -> f64 {
        0.5 * share * self.stiffness * history.stretch.norm_squared()
    }

    fn time_scales(&self, contact: &ContactScale) -> TimeScales {
        TimeScales::of_oscillator(self.angular_frequency(contact.effective_mass), self.damping_ratio, contact.lagged_damping)
    }
}

impl LinearHistory {
    /// Undamped angular frequency of a contact point on the spring, in rad/s.
    pub fn angular_frequency(&self, effective_mass: f64) -> f64 {
        (self.stiffness / effective_mass).sqrt()
    }
}

/// A contact during one step as if it stuck.
struct Sticking {
    /// After the step.
    spring: Spring,
    /// Largest force in N.
    cap: f64,
    stiffness: f64,
    dashpot: f64,
    /// At the time of the force without its own share.
    velocity: Vector,
    /// What the force takes off its dashpot, as a part of it.
    implicit_share: f64,
}

impl Sticking {
    #[inline(always)]
    fn new(law: &LinearHistory, contact: &TangentialContact, kind: &StepKind, history: &Spring) -> Sticking {
        let mut stretch = carried_along(history.stretch, &contact.normal, contact.twist);
        stretch += contact.displacement * if kind.synchronous { 0.0 } else { contact.touched_before };
        let stiffness = law.stiffness * contact.share;
        let critical = 2.0 * (law.stiffness / contact.inverse_effective_mass).sqrt();
        let dashpot = law.damping_ratio * critical * contact.share * contact.touched;
        let (velocity, implicit_share) = velocity_without_own_share(contact, kind, &history.force, dashpot);
        let mean_stretch = stretch + contact.displacement * contact.stretch_ahead;
        let force = (stiffness * mean_stretch + dashpot * velocity) * (-1.0 / (1.0 + implicit_share));
        let cap = law.friction * contact.normal_force.max(0.0);
        Sticking { spring: Spring { stretch, force }, cap, stiffness, dashpot, velocity, implicit_share }
    }

    #[inline(always)]
    fn holds(&self) -> bool {
        self.spring.force.norm_squared() <= self.cap * self.cap
    }

    /// The spring of a contact that does not stick.
    #[inline(always)]
    fn sliding(&self, contact: &TangentialContact, kind: &StepKind, last_force: &Vector) -> Spring {
        let stiffness = self.stiffness / (1.0 + self.implicit_share);
        let force = sliding_force(&self.spring.force, last_force, contact, kind, stiffness, self.cap);
        // What the dashpot gives at the velocity that the shortened force leaves; both over the part of the step in which the bodies touch, so that the
        // next step, a whole one, does not find the spring stretched for more or less than its dashpot.
        let slip = self.dashpot * self.velocity + force * self.implicit_share;
        let touched = if contact.touched > 0.0 { contact.touched } else { 1.0 };
        Spring { stretch: (force + slip) * (-1.0 / (self.stiffness * touched)), force }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact(velocity: Vector, normal_force: f64) -> TangentialContact {
        let displacement = velocity * KIND.step;
        TangentialContact { displacement, normal_force, elastic_force: normal_force, ..TangentialContact::at_velocity(velocity) }
    }

    const KIND: StepKind = StepKind { step: 0.1, synchronous: false, lagged_damping: true, resolved_edges: false };

    /// Loading, unloading and reloading below the cap returns all energy: the force is a function of the displacement alone.
    #[test]
    fn below_the_cap_the_spring_has_no_hysteresis() {
        let law = LinearHistory { friction: 1.0, stiffness: 10.0, damping_ratio: 0.0 };
        let mut spring = Spring::default();
        for velocity in [1.0, 1.0, -3.0, 1.0] {
            law.mean_force(&contact(Vector::x() * velocity, 100.0), &KIND, &mut spring);
        }
        assert!(law.stored_energy(&spring, 1.0) < 10.0 * f64::EPSILON);
    }

    /// Slip leaves the spring stretched to exactly the Coulomb force, so that sticking again starts from there.
    #[test]
    fn slip_rewrites_the_spring() {
        let law = LinearHistory { friction: 0.5, stiffness: 10.0, damping_ratio: 0.0 };
        let mut spring = Spring::default();
        for _ in 0..100 {
            let force = law.mean_force(&contact(Vector::x(), 1.0), &KIND, &mut spring);
            assert!(force.norm() <= 0.5 * (1.0 + 4.0 * f64::EPSILON));
        }
        assert!((law.stiffness * spring.stretch.norm() - 0.5).abs() < 4.0 * f64::EPSILON);
    }

    /// A loaded contact carried round rigidly by small turns: the force keeps its size and turns with it (objectivity).
    #[test]
    fn a_force_carried_round_keeps_its_size_and_its_place_in_the_plane() {
        let law = LinearHistory { friction: 10.0, stiffness: 10.0, damping_ratio: 0.0 };
        let mut spring = Spring { stretch: Vector::x(), force: Vector::zeros() };
        let turns = 1000;
        for index in 1..=turns {
            let angle = std::f64::consts::PI / 3.0 * f64::from(index) / f64::from(turns);
            let normal = Vector::new(angle.sin(), 0.0, angle.cos());
            let force = law.mean_force(&TangentialContact { normal, ..contact(Vector::zeros(), 10.0) }, &KIND, &mut spring);
            let expected = Vector::new(angle.cos(), 0.0, -angle.sin()) * -10.0;
            // Each turn rounds a vector of size ten.
            assert!((force - expected).norm() < 10.0 * f64::EPSILON * f64::from(turns).sqrt() * 10.0, "{force}");
        }
    }

    /// A contact that began a quarter of a step ago is stretched by a quarter of a step, whatever the step before did.
    #[test]
    fn a_new_contact_is_stretched_since_it_touched() {
        let law = LinearHistory { friction: 10.0, stiffness: 10.0, damping_ratio: 0.0 };
        let mut spring = Spring::default();
        let new = TangentialContact { touched_before: 0.25, ..contact(Vector::x() * 2.0, 10.0) };
        let force = law.mean_force(&new, &KIND, &mut spring);
        assert_eq!(force, Vector::x() * (-10.0 * 2.0 * 0.1 * 0.25));
    }

    /// A contact that touched for more or less of a step than the next one does, slides from its start: spring and dashpot then carry the Coulomb force, so
    /// that the next step must find it sliding on. A spring that is stretched for a dashpot of another length would throw the force about.
    #[test]
    fn a_spring_that_slides_from_first_touch_keeps_its_direction() {
        let law = LinearHistory { friction: 0.1, stiffness: 10.0, damping_ratio: 0.5 };
        let slip = Vector::x() * 2.0;
        for touched in [0.6, 1.4] {
            let mut spring = Spring::default();
            let first = TangentialContact { touched_before: touched - 0.5, touched, ..contact(slip, 1.0) };
            law.mean_force(&first, &KIND, &mut spring);
            for _ in 0..3 {
                let force = law.mean_force(&contact(slip, 1.0), &KIND, &mut spring);
                assert!((force + Vector::x() * 0.1).norm() < 4.0 * f64::EPSILON, "{touched}: {force}");
            }
        }
    }
}
