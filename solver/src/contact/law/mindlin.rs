//! Mindlin's tangential spring for spheres on Hertz's law, no slip inside the contact area, capped by Coulomb's law.
//!
//! Stiffness $k_t = 8 G^* \sqrt{R^* \delta}$ with $1/G^* = (2 - \nu_1)/G_1 + (2 - \nu_2)/G_2$. It grows and falls with the overlap, so that the force is not a
//! function of displacement and overlap. The choice coded (Thornton, Cummins and Cleary 2013): under a rising overlap the force only
//! grows by $k_t$ times the displacement, $dF = -k_t\, d\xi$; under a falling one it first sinks in proportion to $k_t$, $dF = -k_t\, d\xi + F\, dk_t/k_t$, since
//! the area that carried it shrinks. Without the second term a cycle of loading, shearing and unloading would return more energy than it took; with it
//! the stored energy $F^2 / 2 k_t$ never gains by a change of overlap.
//!
//! The displacement of a step is exact in leapfrog; the stiffness of a rising overlap is its mean over the step, along the straight line of the motion, so
//! that the first step of a contact is right at any phase. A dashpot beside the spring, as a fraction of critical, is an option.

use serde::{Deserialize, Serialize};

use super::carried::carried_along;
use super::sliding::sliding_force;
use super::viscous_coulomb::velocity_without_own_share;
use super::{ContactScale, StepKind, TangentialContact, TangentialLaw, TimeScales};
use crate::Vector;

/// Mindlin's spring without slip inside the contact area, capped by Coulomb's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mindlin {
    /// Coulomb coefficient; the cap uses the total normal force.
    pub friction: f64,
    /// Effective shear modulus in Pa.
    pub effective_shear_modulus: f64,
    /// Damping as a fraction of critical, of the spring as stiff as it is.
    pub damping_ratio: f64,
}

/// What a contact remembers.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct LoadedSpring {
    /// Force of the spring on the first partner in N.
    spring: Vector,
    /// Overlap in m at that force.
    overlap: f64,
    /// Stiffness in N/m at that overlap.
    stiffness: f64,
    /// Mean force of the last step in N, spring and dashpot.
    force: Vector,
}

impl Mindlin {
    /// Stiffness in N/m at an overlap in m.
    #[inline]
    pub fn stiffness(&self, curvature_radius: f64, overlap: f64) -> f64 {
        8.0 * self.effective_shear_modulus * (curvature_radius * overlap).sqrt()
    }

    /// Spring force after a displacement in m, from that before and the overlaps at both.
    fn spring_after(&self, before: Vector, contact: &TangentialContact, last_overlap: f64, displacement: Vector) -> Vector {
        let (last, now) = (last_overlap.sqrt(), contact.overlap.sqrt());
        let per_root = self.stiffness(contact.curvature_radius, 1.0) * contact.share;
        if now < last {
            return before * (now / last) - displacement * (per_root * now);
        }
        // Mean of the root of the overlap along a straight line, without a difference of nearly equal numbers.
        let mean_root = 2.0 / 3.0 * (now * now + now * last + last * last) / (now + last);
        before - displacement * (per_root * mean_root)
    }
}

impl TangentialLaw for Mindlin {
    type History = LoadedSpring;
    const NEEDS_ROTATION: bool = true;
    const NAME: &'static str = "Mindlin's spring capped by Coulomb's law";

    fn mean_force(&self, contact: &TangentialContact, kind: &StepKind, history: &mut LoadedSpring) -> Vector {
        let turned = carried_along(history.spring, &contact.normal, contact.twist);
        let displacement = if kind.synchronous { Vector::zeros() } else { contact.displacement * contact.touched_before };
        let mut spring = self.spring_after(turned, contact, history.overlap, displacement);
        let stiffness = self.stiffness(contact.curvature_radius, contact.overlap) * contact.share;
        let dashpot = 2.0 * self.damping_ratio * (stiffness / contact.inverse_effective_mass).sqrt() * contact.touched;
        let (velocity, implicit_share) = velocity_without_own_share(contact, kind, &history.force, dashpot);
        let taken_off = 1.0 / (1.0 + implicit_share);
        let sticking = (spring - velocity * dashpot) * taken_off;
        let largest = self.friction * contact.normal_force.max(0.0);
        let mut force = sticking;
        if sticking.norm_squared() > largest * largest {
            force = sliding_force(&sticking, &history.force, contact, kind, stiffness * taken_off, largest);
            let slip_velocity = velocity + force * (implicit_share / dashpot.max(f64::MIN_POSITIVE));
            spring = force + slip_velocity * dashpot;
        }
        *history = LoadedSpring { spring, overlap: contact.overlap, stiffness, force };
        force
    }

    fn stored_energy(&self, history: &LoadedSpring, _share: f64) -> f64 {
        if history.stiffness > 0.0 { 0.5 * history.spring.norm_squared() / history.stiffness } else { 0.0 }
    }

    fn time_scales(&self, contact: &ContactScale) -> TimeScales {
        let stiffness = self.stiffness(contact.curvature_radius, contact.overlap);
        TimeScales::of_oscillator((stiffness / contact.effective_mass).sqrt(), self.damping_ratio, contact.lagged_damping)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: Mindlin = Mindlin { friction: 1e9, effective_shear_modulus: 1e6, damping_ratio: 0.0 };
    const KIND: StepKind = StepKind { step: 1e-3, synchronous: false, lagged_damping: false, resolved_edges: true };

    fn contact(overlap: f64, velocity: f64) -> TangentialContact {
        let displacement = Vector::x() * (velocity * KIND.step);
        TangentialContact { displacement, overlap, curvature_radius: 0.01, ..TangentialContact::at_velocity(Vector::x() * velocity) }
    }

    /// Exact: along a straight path of overlap a t and displacement b t the force is the integral 8 G root(R a) b (2/3) t^(3/2), however many steps
    /// it takes; back along it the spring as stiff as it is keeps its stretch.
    #[test]
    fn loading_is_integrated_exactly_and_unloading_keeps_the_stretch() {
        for steps in [1, 7] {
            let mut history = LoadedSpring::default();
            let mut force = Vector::zeros();
            for index in 1..=steps {
                let part = f64::from(index) / f64::from(steps);
                force = LAW.mean_force(&contact(1e-4 * part, 0.1 / f64::from(steps)), &KIND, &mut history);
            }
            let exact = -8e6 * (0.01_f64 * 1e-4).sqrt() * 1e-4 * 2.0 / 3.0;
            assert!((force.x / exact - 1.0).abs() < 16.0 * f64::EPSILON, "{steps}: {force}");
            let released = LAW.mean_force(&contact(2.5e-5, 0.0), &KIND, &mut history);
            assert!((released.x / (0.5 * exact) - 1.0).abs() < 16.0 * f64::EPSILON);
        }
    }

    /// Press, shear, release and shear back: a force that kept its size while the area shrinks would return more than it took.
    #[test]
    fn no_cycle_of_overlap_and_displacement_returns_energy() {
        let mut history = LoadedSpring::default();
        let mut taken = 0.0;
        let mut last = Vector::zeros();
        let paths = [(1e-4, 0.0), (1e-4, 1.0), (1e-5, 0.0), (1e-5, -1.0), (1e-4, 0.0), (1e-4, 1.0), (1e-5, 0.0), (1e-5, -1.0)];
        for (overlap, velocity) in paths {
            let force = LAW.mean_force(&contact(overlap, velocity), &KIND, &mut history);
            taken -= 0.5 * (force + last).x * velocity * KIND.step;
            last = force;
            assert!(LAW.stored_energy(&history, 1.0) <= taken * (1.0 + 1e-9) + 1e-15, "{overlap} {velocity}");
        }
    }

    #[test]
    fn slip_rewrites_the_spring() {
        let law = Mindlin { friction: 0.5, ..LAW };
        let mut history = LoadedSpring::default();
        let slipping = |velocity| TangentialContact { normal_force: 1.0, ..contact(1e-4, velocity) };
        for _ in 0..10 {
            assert!((law.mean_force(&slipping(1.0), &KIND, &mut history).x + 0.5).abs() < 4.0 * f64::EPSILON);
        }
        // A step back by half of what carries the Coulomb force leaves half of it.
        let back = 0.25 / law.stiffness(0.01, 1e-4) / KIND.step;
        assert!((law.mean_force(&slipping(-back), &KIND, &mut history).x + 0.25).abs() < 1e-12);
    }
}
