//! The head-on contact with a linear spring and dashpot, in closed form, for both rules at which it may end.
//!
//! $m \ddot\delta + 2 \zeta \omega_0 m \dot\delta + k \delta = 0$, $\delta(0) = 0$, $\dot\delta(0) = v_0$, $\omega_0^2 = k/m$ with the effective mass $m$
//! (R eq. 3.22-3.27). Without attraction the contact ends when $k\delta + 2 \zeta \omega_0 m \dot\delta = 0$ (Schwager and Poeschel 2007).

use std::f64::consts::PI;

/// An isolated contact of unit impact velocity; times are in units of $1/\omega_0$, overlaps of $v_0/\omega_0$.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearContact {
    /// Damping as a fraction of critical, below one.
    pub damping_ratio: f64,
    /// Time from first touch to the end of the force.
    pub force_duration: f64,
    /// Time from first touch until the surfaces separate.
    pub duration: f64,
    /// Largest overlap.
    pub largest_overlap: f64,
    /// Overlap left when the force ends.
    pub residual_overlap: f64,
    /// Rebound over impact velocity.
    pub restitution: f64,
}

impl LinearContact {
    /// The contact that ends at zero overlap, with a restitution in (0, 1].
    pub fn until_zero_overlap(restitution: f64) -> LinearContact {
        let damping_ratio = -restitution.ln() / PI.hypot(restitution.ln());
        let duration = PI / damped_frequency(damping_ratio);
        LinearContact {
            damping_ratio,
            force_duration: duration,
            duration,
            largest_overlap: largest_overlap(damping_ratio),
            residual_overlap: 0.0,
            restitution,
        }
    }

    /// The contact that ends at zero force, with a restitution that underdamped contacts reach: above exp(-2).
    pub fn without_attraction(restitution: f64) -> LinearContact {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if contact_without_attraction(middle).restitution > restitution { low = middle } else { high = middle }
        }
        contact_without_attraction(0.5 * (low + high))
    }
}

fn damped_frequency(damping_ratio: f64) -> f64 {
    (1.0 - damping_ratio * damping_ratio).sqrt()
}

/// R eq. 3.23 at the time of eq. 3.25.
fn largest_overlap(damping_ratio: f64) -> f64 {
    let frequency = damped_frequency(damping_ratio);
    let time = frequency.atan2(damping_ratio) / frequency;
    overlap_and_rate(damping_ratio, time).0
}

/// Overlap (R eq. 3.23) and its rate at a time.
fn overlap_and_rate(damping_ratio: f64, time: f64) -> (f64, f64) {
    let frequency = damped_frequency(damping_ratio);
    let (sine, cosine) = (frequency * time).sin_cos();
    let decay = (-damping_ratio * time).exp();
    (decay * sine / frequency, decay * (cosine - damping_ratio / frequency * sine))
}

fn contact_without_attraction(damping_ratio: f64) -> LinearContact {
    let frequency = damped_frequency(damping_ratio);
    // The force falls to zero where the angle of (overlap, rate) reaches that of (2 zeta, -1): a root found by its own equation, not by
    // the arc cosine that the solver's calibration uses.
    let angle = PI - (2.0 * damping_ratio * frequency).atan2(1.0 - 2.0 * damping_ratio * damping_ratio);
    let force_duration = angle / frequency;
    let (residual_overlap, rate) = overlap_and_rate(damping_ratio, force_duration);
    LinearContact {
        damping_ratio,
        force_duration,
        duration: force_duration - residual_overlap / rate,
        largest_overlap: largest_overlap(damping_ratio),
        residual_overlap,
        restitution: -rate,
    }
}

/// Restitution that leapfrog with centred damping gives to a contact in its inside, as if both edges were exact: the design error of the
/// scheme. Contacts that end at zero overlap; `step` in units of $1/\omega_0$.
///
/// The recursion $(1+\beta) z^2 - (2 - h^2) z + (1 - \beta) = 0$, $\beta = \zeta h$, has roots of modulus $\sqrt{(1-\beta)/(1+\beta)}$ and angle
/// $\arccos((1 - h^2/2)/\sqrt{1-\beta^2})$; half a period takes $\pi$ over that angle steps.
pub fn restitution_of_leapfrog(damping_ratio: f64, step: f64) -> f64 {
    let damping = damping_ratio * step;
    let angle = ((1.0 - 0.5 * step * step) / (1.0 - damping * damping).sqrt()).acos();
    (0.5 * ((1.0 - damping) / (1.0 + damping)).ln() * PI / angle).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = include_str!("../../../reference-data/lsd_contact/data.csv");

    /// Independent: the reference data, computed elsewhere to the digits it prints.
    #[test]
    fn closed_forms_match_the_reference_table() {
        let mut rows = 0;
        for line in TABLE.lines().skip(1) {
            let numbers: Vec<f64> = line.split(',').map(|number| number.parse().expect("a table of numbers")).collect();
            let [nominal, ratio, duration, largest, cut, restitution, residual] = numbers[..] else { panic!("seven columns") };
            let whole = LinearContact::until_zero_overlap(nominal);
            let ended = contact_without_attraction(whole.damping_ratio);
            for (value, printed) in [
                (whole.damping_ratio, ratio),
                (whole.duration, duration),
                (whole.largest_overlap, largest),
                (ended.force_duration, cut),
                (ended.restitution, restitution),
                (ended.residual_overlap, residual),
            ] {
                // Nine significant digits are printed.
                assert!((value / printed - 1.0).abs() < 5e-9, "e = {nominal}: {value} against {printed}");
            }
            rows += 1;
        }
        assert_eq!(rows, 14);
    }

    #[test]
    fn calibration_without_attraction_gives_the_restitution() {
        for restitution in [0.3, 0.85, 1.0] {
            let contact = LinearContact::without_attraction(restitution);
            assert!((contact.restitution - restitution).abs() < 16.0 * f64::EPSILON);
        }
    }

    /// Independent: the complex roots of the recursion, by the formula for quadratics.
    #[test]
    fn leapfrog_restitution_is_that_of_the_roots_of_its_recursion() {
        use nalgebra::Complex;
        for (ratio, step) in [(0.2_f64, 0.1_f64), (0.05, 0.6), (0.7, 0.02)] {
            let (first, second, third) = (1.0 + ratio * step, -(2.0 - step * step), 1.0 - ratio * step);
            let discriminant = Complex::new(second * second - 4.0 * first * third, 0.0);
            let root = (discriminant.sqrt() - second) / (2.0 * first);
            let expected = root.norm().powf(PI / root.arg());
            // The angle of the root is found from a discriminant of step^2 beside terms of one.
            let floor = f64::EPSILON / (step * step);
            assert!((restitution_of_leapfrog(ratio, step) / expected - 1.0).abs() < 10.0 * floor);
        }
    }
}
