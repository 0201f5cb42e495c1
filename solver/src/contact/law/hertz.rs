//! Hertz's spring with Tsuji's dashpot along the normal: two elastic spheres, or a sphere on a flat wall. S names it as future work (section 3.2).
//!
//! Equation of an isolated head-on contact, with overlap $\delta$, effective mass $m$ and $K = \frac43 E^* \sqrt{R^*}$:
//! $$ m \ddot\delta + \alpha \sqrt{m K}\, \delta^{1/4} \dot\delta + K \delta^{3/2} = 0 . $$
//!
//! # Calibration
//!
//! In closed form. With $y = \frac45 \delta^{5/4}$ for the overlap the equation $m v\, dv/dy + \alpha \sqrt{m K}\, v + \frac54 K y = 0$ is that of the linear
//! spring-dashpot with the damping ratio $\zeta = \alpha / \sqrt5$: the same restitution, at every speed. Contacts end at zero overlap, as in
//! R: $\alpha = -\sqrt5 \ln e / \sqrt{\pi^2 + \ln^2 e}$ (Antypov and Elliott 2011 found it too).
//!
//! # The form that is coded
//!
//! The spring is sampled once a step: its force rises from zero as $t^{3/2}$, so that edges cost no order. The dashpot rises as $t^{1/4}$, and a sampled sum
//! of it would be of order 5/4. Its impulse over a kick is therefore $\alpha \sqrt{m K}\, (y_+ - y_-)$, with the overlaps half a step after and before:
//! consecutive kicks telescope, whatever the phase at which a contact begins. The overlap after contains the kick itself, and is found by Newton's method
//! on a concave function, which cannot fail.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::linear_spring_dashpot::{EndOfContact, damping_ratio};
use super::normal::{NormalContact, NormalForce, NormalLaw, NormalMemory};
use super::{ContactScale, LinearSpringDashpot, StepKind, TimeScales};

/// Elastic constants of one side of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Elasticity {
    /// Young's modulus in Pa, above zero.
    pub young_modulus: f64,
    /// Poisson's ratio, above -1 and at most 0.5.
    pub poisson_ratio: f64,
}

impl Elasticity {
    /// Shear modulus in Pa.
    pub fn shear_modulus(&self) -> f64 {
        0.5 * self.young_modulus / (1.0 + self.poisson_ratio)
    }
}

/// Modulus $E^*$ in Pa of two sides against each other along the normal; a side that is not given is rigid.
pub fn effective_modulus(sides: &[Elasticity]) -> f64 {
    1.0 / sides.iter().map(|side| (1.0 - side.poisson_ratio * side.poisson_ratio) / side.young_modulus).sum::<f64>()
}

/// Modulus $G^*$ in Pa of two sides against each other along the contact plane; a side that is not given is rigid.
pub fn effective_shear_modulus(sides: &[Elasticity]) -> f64 {
    1.0 / sides.iter().map(|side| (2.0 - side.poisson_ratio) / side.shear_modulus()).sum::<f64>()
}

/// Duration of an undamped contact times impact speed over largest overlap: $\frac45 \sqrt\pi\, \Gamma(2/5) / \Gamma(9/10)$.
pub const DURATION: f64 = 2.943_275_184_324_705;

/// Hertz's spring with a calibrated dashpot.
#[derive(Debug, Clone, PartialEq)]
pub struct Hertz {
    /// The sides that are elastic, in any order; a missing one is rigid.
    sides: Vec<Elasticity>,
    effective_modulus: f64,
    damping_ratio: f64,
    reference_speed: f64,
}

impl Hertz {
    /// A law between elastic sides (one, if the other is rigid) with a restitution in [0, 1]. Its time scales are those of an impact at a reference speed
    /// in m/s.
    pub fn new(sides: Vec<Elasticity>, restitution: f64, reference_speed: f64) -> Hertz {
        let effective_modulus = effective_modulus(&sides);
        let damping_ratio = damping_ratio(restitution, EndOfContact::ZeroOverlap);
        Hertz { sides, effective_modulus, damping_ratio, reference_speed }
    }

    /// Force over overlap^(3/2), in N/m^(3/2).
    #[inline]
    pub fn stiffness(&self, curvature_radius: f64) -> f64 {
        4.0 / 3.0 * self.effective_modulus * curvature_radius.sqrt()
    }

    /// Dashpot force over overlap^(1/4) and approach rate.
    #[inline]
    fn damping(&self, stiffness: f64, mass: f64) -> f64 {
        5.0_f64.sqrt() * self.damping_ratio * (mass * stiffness).sqrt()
    }
}

impl NormalLaw for Hertz {
    const NAME: &'static str = "Hertz's spring and Tsuji's dashpot";

    fn mean_force(&self, contact: &NormalContact, kind: &StepKind, memory: &mut NormalMemory) -> NormalForce {
        if memory.ended {
            if contact.approach_rate <= 0.0 {
                memory.force = 0.0;
                return NormalForce::default();
            }
            *memory = NormalMemory::default();
        }
        let travel = contact.approach_rate * kind.step;
        let starts = contact.is_new && !kind.synchronous && travel > 0.0;
        let stiffness = self.stiffness(contact.curvature_radius);
        let elastic = stiffness * contact.overlap * contact.overlap.sqrt();
        let touched_before = if starts && kind.resolved_edges { (contact.overlap / travel).min(1.0) } else { 1.0 };
        let mut mean = elastic;
        if self.damping_ratio > 0.0 {
            let damping = self.damping(stiffness, 1.0 / contact.inverse_damped_mass);
            let kick = Kick::new(contact, kind, memory, elastic, damping);
            mean = if kind.resolved_edges && !kind.lagged_damping && !kind.synchronous {
                kick.telescoping(if starts { 0.0 } else { measure_of(contact.overlap - 0.5 * travel) }, memory)
            } else {
                kick.sampled()
            };
        }
        memory.force = mean;
        NormalForce { mean, elastic, touched_before, touched: 1.0, stretch_ahead: 0.0 }
    }

    fn stored_energy(&self, overlap: f64, curvature_radius: f64) -> f64 {
        0.4 * self.stiffness(curvature_radius) * overlap * overlap * overlap.sqrt()
    }

    /// $\delta = (5 m v^2 / 4 K)^{2/5}$ at the reference speed, without damping.
    fn expected_overlap(&self, effective_mass: f64, curvature_radius: f64) -> f64 {
        let speed = self.reference_speed;
        (1.25 * effective_mass * speed * speed / self.stiffness(curvature_radius)).powf(0.4)
    }

    fn time_scales(&self, contact: &ContactScale) -> TimeScales {
        let overlap = contact.overlap;
        let slope = 1.5 * self.stiffness(contact.curvature_radius) * overlap.sqrt();
        // The dashpot is proportional to the square root of the slope, as that of a linear spring, but for this factor.
        let damping_ratio = self.damping_ratio * (5.0_f64 / 6.0).sqrt();
        let scales = TimeScales::of_oscillator((slope / contact.effective_mass).sqrt(), damping_ratio, contact.lagged_damping);
        let duration = DURATION * overlap / self.reference_speed;
        TimeScales { contact_duration: duration, half_period: scales.half_period.min(duration), ..scales }
    }

    /// $\pi r \sqrt{\rho/G} / (0.1631 \nu + 0.8766)$, of the stiffer side.
    fn wave_time(&self, radius: f64, density: f64) -> f64 {
        let of_side = |side: &Elasticity| {
            std::f64::consts::PI * radius * (density / side.shear_modulus()).sqrt() / (0.1631 * side.poisson_ratio + 0.8766)
        };
        self.sides.iter().map(of_side).fold(f64::INFINITY, f64::min)
    }

    fn without_curvature(&self) -> Option<LinearSpringDashpot> {
        None
    }
}

/// $y = \frac45 \delta^{5/4}$ of an overlap in m; zero where the partners do not touch.
#[inline]
fn measure_of(overlap: f64) -> f64 {
    if overlap > 0.0 { 0.8 * overlap * overlap.sqrt().sqrt() } else { 0.0 }
}

/// Newton's method doubles its digits; from the far side of a concave function it needs no more.
const LARGEST_NUMBER_OF_ITERATIONS: usize = 20;

/// One kick of one damped contact.
struct Kick<'a> {
    contact: &'a NormalContact,
    step: f64,
    elastic: f64,
    damping: f64,
    /// Approach acceleration from everything but this contact; nothing if damping is lagged or the velocity is not.
    external: f64,
    /// Whether the contact's own force is in the velocity of its dashpot.
    centred: bool,
}

impl<'a> Kick<'a> {
    fn new(contact: &'a NormalContact, kind: &StepKind, memory: &NormalMemory, elastic: f64, damping: f64) -> Kick<'a> {
        let external = contact.approach_acceleration + memory.force * contact.inverse_effective_mass;
        let centred = !kind.lagged_damping && !kind.synchronous;
        Kick { contact, step: kind.step, elastic, damping, external, centred }
    }

    /// The dashpot sampled at the time of the kick.
    fn sampled(&self) -> f64 {
        let dashpot = self.damping * self.contact.overlap.sqrt().sqrt();
        if !self.centred {
            return self.elastic + dashpot * self.contact.approach_rate;
        }
        let half = 0.5 * self.step;
        let rate = self.contact.approach_rate + half * self.external;
        (self.elastic + dashpot * rate) / (1.0 + half * dashpot * self.contact.inverse_effective_mass)
    }

    fn rate_after(&self, mean: f64) -> f64 {
        self.contact.approach_rate + self.step * (self.external - mean * self.contact.inverse_effective_mass)
    }

    /// The dashpot's impulse from the overlaps half a step before, given as $y$, and half a step after.
    fn telescoping(&self, before: f64, memory: &mut NormalMemory) -> f64 {
        let (half, overlap) = (0.5 * self.step, self.contact.overlap);
        let force_with = |after: f64| self.elastic + self.damping * (after - before) / self.step;
        let mut mean = force_with(measure_of(overlap + half * self.rate_after(self.elastic)));
        for _ in 0..LARGEST_NUMBER_OF_ITERATIONS {
            let after = overlap + half * self.rate_after(mean);
            let own_share = half * self.damping * after.max(0.0).sqrt().sqrt() * self.contact.inverse_effective_mass;
            let change = (mean - force_with(measure_of(after))) / (1.0 + own_share);
            mean -= change;
            if change.abs() <= 4.0 * f64::EPSILON * mean.abs() {
                break;
            }
        }
        if overlap + self.step * self.rate_after(mean) > 0.0 {
            return mean;
        }
        // The surfaces part before the next kick: this one lasts until then.
        memory.ended = true;
        force_with(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::sharing::Share;

    const GLASS: Elasticity = Elasticity { young_modulus: 4.8e10, poisson_ratio: 0.2 };

    /// Independent: test 1 of Chung and Ooi (2011), two glass spheres of 10 mm at 20 m/s relative speed, from the reference table.
    #[test]
    fn time_scales_are_those_of_the_published_impact() {
        let law = Hertz::new(vec![GLASS, GLASS], 1.0, 20.0);
        let mass = 2800.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-6;
        let overlap = law.expected_overlap(0.5 * mass, 0.005);
        assert!((overlap / 2.741_127_02e-4 - 1.0).abs() < 2e-9, "{overlap}");
        assert!((law.stiffness(0.005) * overlap.powf(1.5) / 10_696.889 - 1.0).abs() < 1e-8);
        let scale =
            ContactScale { effective_mass: 0.5 * mass, reduced_mass: 0.5 * mass, curvature_radius: 0.005, overlap, lagged_damping: false };
        // The table's duration is 3e-8 shorter: its constant has eight digits.
        assert!((law.time_scales(&scale).contact_duration / 4.033_945_45e-5 - 1.0).abs() < 1e-7);
        // By hand: G = 20 GPa, root of 2800 / 2e10 is 3.7416573868e-4, times 0.01 pi / (0.1631 * 0.2 + 0.8766).
        assert!((law.wave_time(0.01, 2800.0) - 1.292_840_4e-5).abs() < 1e-11, "{}", law.wave_time(0.01, 2800.0));
        // The spring at the largest overlap holds the energy of the impact.
        assert!((law.stored_energy(overlap, 0.005) / (0.25 * mass * 400.0) - 1.0).abs() < 16.0 * f64::EPSILON);
    }

    /// A rigid partner has no compliance: the effective moduli are those of the elastic side alone.
    #[test]
    fn effective_moduli_are_by_hand() {
        assert!((effective_modulus(&[GLASS, GLASS]) / (4.8e10 / (2.0 * 0.96)) - 1.0).abs() < 4.0 * f64::EPSILON);
        assert!((effective_modulus(&[GLASS]) / 5e10 - 1.0).abs() < 4.0 * f64::EPSILON);
        assert!((effective_shear_modulus(&[GLASS]) / (2e10 / 1.8) - 1.0).abs() < 4.0 * f64::EPSILON);
    }

    /// Exact: the restitution of the calibration, approached at second order for any phase; the impact is stepped as leapfrog does.
    #[test]
    fn a_head_on_impact_returns_the_restitution() {
        for restitution in [0.2, 0.6, 0.9, 1.0] {
            let errors = |steps: f64| {
                [0, 5, 10, 15, 19].map(|phase| (rebound(restitution, steps, (f64::from(phase) + 0.5) / 20.0) - restitution).abs())
            };
            let [coarse, fine] = [50.0, 200.0].map(|steps| errors(steps).into_iter().fold(0.0, f64::max));
            assert!(coarse < 10.0 / (50.0 * 50.0) && fine < 10.0 / (200.0 * 200.0), "{restitution}: {coarse} {fine}");
        }
    }

    fn rebound(restitution: f64, steps: f64, phase: f64) -> f64 {
        let law = Hertz::new(vec![GLASS], restitution, 1.0);
        let (radius, mass) = (0.01, 1.0);
        let step = DURATION * law.expected_overlap(mass, radius) / steps;
        let kind = StepKind { step, synchronous: false, lagged_damping: false, resolved_edges: true };
        let (mut rate, mut overlap, mut memory) = (1.0, phase * step, NormalMemory::default());
        let mut is_new = true;
        while overlap > 0.0 {
            let contact = NormalContact {
                overlap,
                is_new,
                approach_rate: rate,
                approach_acceleration: -memory.force / mass,
                inverse_effective_mass: 1.0 / mass,
                inverse_damped_mass: 1.0 / mass,
                curvature_radius: radius,
                share: Share::WHOLE,
            };
            rate -= law.mean_force(&contact, &kind, &mut memory).mean / mass * step;
            overlap += rate * step;
            is_new = false;
        }
        -rate
    }
}
