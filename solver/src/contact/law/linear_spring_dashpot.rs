//! Linear spring and dashpot along the normal (R eq. 3.18-3.19 and 3.22-3.27; S eq. 3.35-3.40).
//!
//! Equation of an isolated head-on contact, with overlap $\delta$ and effective mass $m$:
//! $$ m \ddot\delta + 2 \zeta \sqrt{k m}\, \dot\delta + k \delta = 0 . $$
//!
//! # The form that is coded
//!
//! Leapfrog kicks once a step, at the time of the positions. Three things make that kick second order for *every* phase at which
//! a contact may begin within a step:
//!
//! 1. *Centred damping.* The dashpot sees the velocity at the time of the kick, which contains half of the kick itself: solved in
//!    closed form for the contact's own share; the shares of other contacts and of gravity are predicted from the last step.
//! 2. *Resolved edges.* A kick stands for the force over half a step on either side. In the first and the last step of a contact
//!    the bodies touch during a part of that time only, and the dashpot force jumps at both ends. The kick is then the
//!    integral of the force over the part in which they touch, along the straight lines before and after it. The end is
//!    taken from the velocity *after* the kick, so that the scheme stays reversible in time.
//! 3. *A contact whose end was resolved stays ended* while its surfaces still separate.
//!
//! With damping, sampling the edges instead is of first order (a whole step of dashpot force more or less). It looks like second order when a
//! contact lasts a whole number of steps, because the errors of start and end then cancel.
//!
//! Errata: S eq. 3.37 has the relative velocity with the wrong sign (the dashpot would drive); R's tables 5.1 and 5.4 use half the
//! mass of the body as effective mass at a wall.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::normal::{NormalContact, NormalForce, NormalLaw, NormalMemory};
use super::{ContactScale, StepKind, TimeScales};
use crate::contact::sharing::Share;

/// Linear spring and dashpot with a calibrated damping ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearSpringDashpot {
    stiffness: f64,
    damping_ratio: f64,
    end_of_contact: EndOfContact,
}

/// When a contact ends.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EndOfContact {
    /// When the overlap is zero, although the dashpot pulls just before (R's rule).
    #[default]
    ZeroOverlap,
    /// When the total normal force is zero: no attraction (Schwager and Poeschel 2007).
    NoAttraction,
}

/// Half a kick: spring overlap integrated over it and time in contact, both in steps.
#[derive(Clone, Copy)]
struct HalfKick {
    overlap: f64,
    touched: f64,
}

impl LinearSpringDashpot {
    /// A law of given stiffness in N/m and restitution, calibrated for the rule at which a contact ends.
    pub fn new(stiffness: f64, restitution: f64, end_of_contact: EndOfContact) -> LinearSpringDashpot {
        LinearSpringDashpot { stiffness, damping_ratio: damping_ratio(restitution, end_of_contact), end_of_contact }
    }

    /// Damping as a fraction of critical.
    pub fn damping_ratio(&self) -> f64 {
        self.damping_ratio
    }

    /// Stiffness in N/m and dashpot in N s/m of a contact point.
    #[inline(always)]
    fn coefficients(&self, contact: &NormalContact) -> (f64, f64) {
        let stiffness = self.stiffness * contact.share.stiffness;
        if self.damping_ratio == 0.0 {
            return (stiffness, 0.0);
        }
        let critical = 2.0 * (self.stiffness / contact.inverse_damped_mass).sqrt();
        (stiffness, self.damping_ratio * critical * contact.share.dashpot)
    }

    /// Undamped angular frequency of a contact in rad/s.
    pub fn angular_frequency(&self, effective_mass: f64) -> f64 {
        (self.stiffness / effective_mass).sqrt()
    }

    /// Half period in s of an undamped contact.
    pub fn half_period(&self, effective_mass: f64) -> f64 {
        PI / self.angular_frequency(effective_mass)
    }

    /// Energy stored in the spring of a point at an overlap in m, in J.
    pub fn energy_of_share(&self, overlap: f64, share: &Share) -> f64 {
        0.5 * self.stiffness * share.stiffness * overlap * overlap
    }

    /// Whether a contact that has ended is pressed together again before its surfaces have parted: they approach, or, without attraction, other
    /// forces slow them down so much that spring plus dashpot push and rise.
    #[cold]
    fn is_loaded_again(&self, contact: &NormalContact, kind: &StepKind) -> bool {
        let (stiffness, dashpot) = self.coefficients(contact);
        let rate = contact.approach_rate + 0.5 * kind.step * contact.approach_acceleration;
        let force = stiffness * contact.overlap + dashpot * rate;
        let rise = stiffness * rate + dashpot * contact.approach_acceleration;
        contact.approach_rate > 0.0 || (self.end_of_contact == EndOfContact::NoAttraction && force > 0.0 && rise > 0.0)
    }
}

impl NormalLaw for LinearSpringDashpot {
    const NAME: &'static str = "linear spring-dashpot";

    #[inline(always)]
    fn mean_force(&self, contact: &NormalContact, kind: &StepKind, memory: &mut NormalMemory) -> NormalForce {
        if memory.ended {
            if !self.is_loaded_again(contact, kind) {
                memory.force = 0.0;
                return NormalForce::default();
            }
            *memory = NormalMemory::default();
        }
        let kick = Kick::new(self, contact, kind, memory.force);
        let mut force = kick.force();
        if kind.resolved_edges && !kind.synchronous {
            force = match self.end_of_contact {
                EndOfContact::ZeroOverlap => kick.end_at_zero_overlap(force, memory),
                EndOfContact::NoAttraction => kick.end_at_zero_force(force, memory),
            };
        } else if self.end_of_contact == EndOfContact::NoAttraction {
            force.mean = force.mean.max(0.0);
        }
        memory.force = force.mean;
        force
    }

    const KNOWS_INSIDE: bool = true;

    #[inline(always)]
    fn force_inside(&self, contact: &NormalContact, kind: &StepKind, last_force: f64) -> (NormalForce, bool) {
        let contact = NormalContact { is_new: false, ..*contact };
        let kick = Kick::new(self, &contact, kind, last_force);
        let force = kick.force();
        let has_edges = kind.resolved_edges && !kind.synchronous;
        let lasts = match self.end_of_contact {
            EndOfContact::ZeroOverlap => !has_edges || kick.overlap_after(force.mean) > 0.0,
            EndOfContact::NoAttraction if has_edges => force.mean > 0.0 && kick.force_lasts(kick.force_after(force.mean)),
            EndOfContact::NoAttraction => force.mean >= 0.0,
        };
        (force, lasts)
    }

    fn stored_energy(&self, overlap: f64, _curvature_radius: f64) -> f64 {
        self.energy_of_share(overlap, &Share::WHOLE)
    }

    fn expected_overlap(&self, _effective_mass: f64, _curvature_radius: f64) -> f64 {
        f64::NAN
    }

    fn time_scales(&self, contact: &ContactScale) -> TimeScales {
        let frequency = self.angular_frequency(contact.effective_mass);
        let contact_duration = match self.end_of_contact {
            EndOfContact::ZeroOverlap => PI / (frequency * (1.0 - self.damping_ratio * self.damping_ratio).sqrt()),
            EndOfContact::NoAttraction => duration_without_attraction(self.damping_ratio) / frequency,
        };
        TimeScales { contact_duration, ..TimeScales::of_oscillator(frequency, self.damping_ratio, contact.lagged_damping) }
    }

    fn without_curvature(&self) -> Option<LinearSpringDashpot> {
        Some(*self)
    }
}

/// Enough to converge to the last bit at any accurate step; steps near the limit of stability stop here.
const LARGEST_NUMBER_OF_ITERATIONS: usize = 20;

/// One kick of one contact: the numbers that its steps share.
struct Kick<'a> {
    contact: &'a NormalContact,
    step: f64,
    stiffness: f64,
    dashpot: f64,
    /// Approach acceleration from everything but this contact.
    external: f64,
    /// Approach rate at the time of the kick without this contact's share.
    approach_rate: f64,
    /// What the contact's own force over a step of full contact takes off its dashpot, as a part of that force: 0 if damping is lagged.
    implicit_share: f64,
    before: HalfKick,
    starts: bool,
}

impl<'a> Kick<'a> {
    #[inline(always)]
    fn new(law: &LinearSpringDashpot, contact: &'a NormalContact, kind: &StepKind, last_force: f64) -> Kick<'a> {
        let step = kind.step;
        let (stiffness, dashpot) = law.coefficients(contact);
        let external = contact.approach_acceleration + last_force * contact.inverse_effective_mass;
        let travel = contact.approach_rate * step;
        // A contact is new by memory, not by geometry: where the normal turns, overlap and rate do not tell the last overlap.
        let starts = kind.resolved_edges && !kind.synchronous && contact.is_new && travel > 0.0;
        let before =
            if starts { resolved_half(contact.overlap, travel.max(contact.overlap)) } else { whole_half(contact.overlap, -travel) };
        // How long ago the rate was that of now: zero rather than a branch.
        let since = if kind.lagged_damping || kind.synchronous { 0.0 } else { 0.5 * step };
        Kick {
            contact,
            step,
            stiffness,
            dashpot,
            external,
            approach_rate: contact.approach_rate + since * external,
            implicit_share: since * dashpot * contact.inverse_effective_mass,
            before,
            starts,
        }
    }

    /// The force if the contact goes on for the half step after the kick.
    #[inline(always)]
    fn force(&self) -> NormalForce {
        self.force_with(whole_half(self.contact.overlap, self.contact.approach_rate * self.step))
    }

    #[inline(always)]
    fn force_with(&self, after: HalfKick) -> NormalForce {
        let touched = self.before.touched + after.touched;
        let elastic = self.stiffness * (self.before.overlap + after.overlap);
        let mean = (elastic + self.dashpot * touched * self.approach_rate) * (1.0 / (1.0 + self.implicit_share * touched));
        let touched_before = if self.starts { self.before.touched } else { 1.0 };
        NormalForce { mean, elastic, touched_before, touched }
    }

    /// Approach acceleration in m/s^2 under a mean force.
    #[inline(always)]
    fn acceleration(&self, mean_force: f64) -> f64 {
        self.external - mean_force * self.contact.inverse_effective_mass
    }

    #[inline(always)]
    fn approach_rate_after(&self, mean_force: f64) -> f64 {
        self.contact.approach_rate + self.step * self.acceleration(mean_force)
    }

    /// Overlap in m at the next kick under a mean force until then.
    #[inline(always)]
    fn overlap_after(&self, mean_force: f64) -> f64 {
        self.contact.overlap + self.step * self.approach_rate_after(mean_force)
    }

    /// Force in N at the next kick under a mean force until then.
    #[inline(always)]
    fn force_after(&self, mean_force: f64) -> f64 {
        let rate_at_next = self.approach_rate_after(mean_force) + 0.5 * self.step * self.acceleration(mean_force);
        self.stiffness * self.overlap_after(mean_force) + self.dashpot * rate_at_next
    }

    /// Whether a force that pushes goes on to do so.
    #[inline(always)]
    fn force_lasts(&self, force_after: f64) -> bool {
        force_after >= 0.0 || self.contact.approach_rate >= 0.0
    }

    /// If the surfaces part before the next kick, the force only lasts until then.
    #[inline(always)]
    fn end_at_zero_overlap(&self, whole: NormalForce, memory: &mut NormalMemory) -> NormalForce {
        if self.overlap_after(whole.mean) > 0.0 {
            return whole;
        }
        memory.ended = true;
        self.force_until_parted(whole)
    }

    /// The force of a contact that ends before the next kick, from the one as if it went on.
    #[cold]
    #[inline(never)]
    fn force_until_parted(&self, whole: NormalForce) -> NormalForce {
        let overlap = self.contact.overlap;
        let mut force = whole;
        // A fixed-point iteration that contracts by (frequency x step)^2. It is carried to the end, because only then is the end of a contact
        // the exact mirror image of a start, which keeps the energy of long runs.
        for _ in 0..LARGEST_NUMBER_OF_ITERATIONS {
            let last = force.mean;
            let travel = (-self.approach_rate_after(force.mean) * self.step).max(overlap);
            force = if self.starts {
                self.force_with(resolved_half(overlap, travel))
            } else {
                // The half before the kick is written with the velocity after it, as the mirror image of a start.
                let mirrored = Kick { before: whole_half(overlap, travel), ..*self };
                mirrored.force_with(resolved_half(overlap, travel))
            };
            if (force.mean - last).abs() <= 4.0 * f64::EPSILON * last.abs() {
                break;
            }
        }
        force
    }

    /// If the force falls to zero before the next kick, it stays zero: the linear decay is integrated to its end.
    fn end_at_zero_force(&self, whole: NormalForce, memory: &mut NormalMemory) -> NormalForce {
        if whole.mean <= 0.0 {
            memory.ended = self.contact.approach_rate < 0.0;
            return NormalForce { mean: 0.0, ..whole };
        }
        let next = self.force_after(whole.mean);
        if self.force_lasts(next) {
            return whole;
        }
        memory.ended = true;
        let decay = whole.mean - next;
        let steps_to_zero = whole.mean / decay;
        NormalForce { mean: 0.5 * decay * (steps_to_zero + 0.5).powi(2), ..whole }
    }
}

/// The half of a kick on a side where the contact goes on: `travel` is the change of overlap over a step away from the kick.
#[inline(always)]
fn whole_half(overlap: f64, travel: f64) -> HalfKick {
    HalfKick { overlap: 0.5 * overlap + 0.125 * travel, touched: 0.5 }
}

/// The half of a kick on the side where the contact starts or ends: all the way to zero overlap, be that less or more than half a step.
fn resolved_half(overlap: f64, travel: f64) -> HalfKick {
    let touched = overlap / travel;
    HalfKick { overlap: 0.5 * travel * touched * touched, touched }
}

/// Damping as a fraction of critical that gives an isolated head-on contact a restitution, for a rule at which contacts end.
///
/// Zero overlap: $\zeta = -\ln e / \sqrt{\pi^2 + \ln^2 e}$ (R eq. 3.27 over $\omega_0$, S eq. 3.40), with the limit 1 at $e = 0$.
/// No attraction: the inverse of [`restitution_without_attraction`], by bisection.
pub fn damping_ratio(restitution: f64, end_of_contact: EndOfContact) -> f64 {
    if restitution >= 1.0 {
        return 0.0;
    }
    match end_of_contact {
        EndOfContact::ZeroOverlap if restitution <= 0.0 => 1.0,
        EndOfContact::ZeroOverlap => -restitution.ln() / PI.hypot(restitution.ln()),
        EndOfContact::NoAttraction => inverse_of_decreasing(restitution_without_attraction, restitution),
    }
}

/// Restitution of a contact that ends when its total force is zero, for a damping ratio $\zeta$:
/// $e = \exp(-2 \zeta \arccos \zeta / \sqrt{1 - \zeta^2})$, continued by $\operatorname{arcosh}$ above critical damping.
///
/// Source: the model of Schwager and Poeschel (2007); their three branches are one function once written with the arc cosine.
pub fn restitution_without_attraction(damping_ratio: f64) -> f64 {
    (-damping_ratio * duration_without_attraction(damping_ratio)).exp()
}

/// Duration of a contact that ends at zero force, times the undamped angular frequency: $2 \arccos \zeta / \sqrt{1 - \zeta^2}$.
pub fn duration_without_attraction(damping_ratio: f64) -> f64 {
    let excess = damping_ratio - 1.0;
    if excess.abs() < 1e-7 {
        // Both branches are 0/0 at critical damping; the limit and its slope are exact to 1e-14 here.
        return 2.0 * (1.0 - excess / 3.0);
    }
    let root = (1.0 - damping_ratio * damping_ratio).abs().sqrt();
    let angle = if excess < 0.0 { damping_ratio.acos() } else { damping_ratio.acosh() };
    2.0 * angle / root
}

fn inverse_of_decreasing(function: fn(f64) -> f64, target: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    while function(high) > target {
        high *= 2.0;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if function(middle) > target { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Independent: Schwager and Poeschel's printed branches, and the table of the reference data at e = 0.3 and 0.9.
    #[test]
    fn restitution_without_attraction_matches_published_branches() {
        let branch = |ratio: f64| {
            let root = (1.0 - ratio * ratio).abs().sqrt();
            let double = 2.0 * ratio * root;
            if ratio < 0.5_f64.sqrt() {
                (-ratio / root * (PI - double.asin())).exp()
            } else if ratio < 1.0 {
                (-ratio / root * double.asin()).exp()
            } else {
                (-ratio / root * ((ratio + root) / (ratio - root)).ln()).exp()
            }
        };
        for ratio in [0.01, 0.2, 0.6, 0.75, 0.95, 1.2, 3.0, 20.0] {
            // The published logarithm loses digits in ratio - root, about 1/(2 ratio) of either.
            let floor = f64::EPSILON * (4.0 + 2.0 * ratio * ratio);
            assert!((restitution_without_attraction(ratio) / branch(ratio) - 1.0).abs() < 10.0 * floor, "{ratio}");
        }
        assert!((restitution_without_attraction(0.357857131) - 0.3971405).abs() < 2e-9 + 5e-8);
        assert!((restitution_without_attraction(0.0335184491) - 0.902026069).abs() < 1e-9);
        let near_critical = (restitution_without_attraction(1.0 - 2e-7) - restitution_without_attraction(1.0 + 2e-7)).abs();
        assert!(near_critical < 4e-7, "continuous at critical damping: {near_critical}");
    }

    #[test]
    fn calibration_inverts_the_restitution() {
        for restitution in [1e-3, 0.05, 0.5, 0.9, 0.999, 1.0 - 1e-6] {
            let ratio = damping_ratio(restitution, EndOfContact::NoAttraction);
            // The restitution moves by 2 for a change of 1 in the ratio at most, so rounding of the ratio is the floor.
            assert!((restitution_without_attraction(ratio) - restitution).abs() < 8.0 * f64::EPSILON, "{restitution}");
            let ratio = damping_ratio(restitution, EndOfContact::ZeroOverlap);
            let back = (-PI * ratio / (1.0 - ratio * ratio).sqrt()).exp();
            assert!((back - restitution).abs() < 8.0 * f64::EPSILON, "{restitution}");
        }
        assert_eq!(damping_ratio(0.0, EndOfContact::ZeroOverlap), 1.0);
        assert_eq!(damping_ratio(1.0, EndOfContact::NoAttraction), 0.0);
    }

    /// A grain at rest on a wall: the force must not depend on the step. An implicit share without the memory of the last force would.
    #[test]
    fn static_force_is_elastic_whatever_the_step() {
        let law = LinearSpringDashpot::new(1e4, 0.5, EndOfContact::ZeroOverlap);
        let gravity_force = 2.0 * 9.81;
        let contact = NormalContact {
            overlap: gravity_force / 1e4,
            is_new: false,
            approach_rate: 0.0,
            approach_acceleration: 0.0,
            inverse_effective_mass: 0.5,
            inverse_damped_mass: 0.5,
            curvature_radius: f64::NAN,
            share: Share::WHOLE,
        };
        let kind = StepKind { step: 1e-3, synchronous: false, lagged_damping: false, resolved_edges: true };
        let mut memory = NormalMemory { force: gravity_force, ended: false };
        let force = law.mean_force(&contact, &kind, &mut memory);
        assert!((force.mean / gravity_force - 1.0).abs() < 8.0 * f64::EPSILON);
    }
}
