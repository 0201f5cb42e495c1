//! The head-on contact on Hertz's law, in closed form: without damping, and the restitution with Tsuji's dashpot.
//!
//! $m \ddot\delta + K \delta^{3/2} = 0$: $\delta_m = (5 m v^2 / 4 K)^{2/5}$ and $T = \frac45 \sqrt\pi\, \Gamma(2/5)/\Gamma(9/10)\, \delta_m / v$.

use std::f64::consts::PI;

/// An undamped head-on contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzContact {
    /// Largest overlap in m.
    pub largest_overlap: f64,
    /// Largest force in N.
    pub largest_force: f64,
    /// Duration in s.
    pub duration: f64,
}

impl HertzContact {
    /// The contact for an effective mass in kg, a stiffness in N/m^(3/2) and an impact velocity in m/s.
    pub fn new(mass: f64, stiffness: f64, velocity: f64) -> HertzContact {
        let largest_overlap = (1.25 * mass * velocity * velocity / stiffness).powf(0.4);
        let duration = 0.8 * PI.sqrt() * gamma(0.4) / gamma(0.9) * largest_overlap / velocity;
        HertzContact { largest_overlap, largest_force: stiffness * largest_overlap.powf(1.5), duration }
    }
}

/// Euler's gamma function of a positive number, by Stirling's series after a shift of the argument: to about 1e-15.
fn gamma(argument: f64) -> f64 {
    let shifted = argument + 20.0;
    let series =
        1.0 / (12.0 * shifted) - 1.0 / (360.0 * shifted.powi(3)) + 1.0 / (1260.0 * shifted.powi(5)) - 1.0 / (1680.0 * shifted.powi(7));
    let logarithm = (shifted - 0.5) * shifted.ln() - shifted + 0.5 * (2.0 * PI).ln() + series;
    (0..20).fold(logarithm.exp(), |value, index| value / (argument + f64::from(index)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Published: Gamma(1/2) is the root of pi; Gamma(2/5) and Gamma(9/10) from tables.
    #[test]
    fn gamma_is_gamma() {
        // The logarithm is about 40 there: its rounding is the floor.
        let floor = 128.0 * f64::EPSILON;
        for (argument, value) in [(0.5, PI.sqrt()), (0.4, 2.218_159_543_757_688), (0.9, 1.068_628_702_119_319_3), (5.0, 24.0)] {
            assert!((gamma(argument) / value - 1.0).abs() < floor, "{argument}: {}", gamma(argument));
        }
    }

    const TABLE: &str = include_str!("../../../reference-data/chung_ooi_hertz/data.csv");

    /// Independent: impacts 1 to 3 of Chung and Ooi (2011), computed elsewhere to the digits they print.
    #[test]
    fn closed_forms_match_the_reference_table() {
        let mut rows = 0;
        for line in TABLE.lines().skip(1) {
            let numbers: Vec<f64> = line.split(',').filter_map(|number| number.parse().ok()).collect();
            let [modulus, poisson, density, radius, velocity, overlap, force, duration] = numbers[..] else {
                panic!("eight numbers: {line}")
            };
            let two = line.contains("two spheres");
            let effective = modulus / (1.0 - poisson * poisson) * if two { 0.5 } else { 1.0 };
            let (curvature, part) = if two { (0.5 * radius, 0.5) } else { (radius, 1.0) };
            let mass = part * density * 4.0 / 3.0 * PI * radius.powi(3);
            let contact = HertzContact::new(mass, 4.0 / 3.0 * effective * curvature.sqrt(), velocity);
            // Nine digits are printed; the table's duration has a constant of eight.
            assert!((contact.largest_overlap / overlap - 1.0).abs() < 5e-9, "{line}");
            assert!((contact.largest_force / force - 1.0).abs() < 5e-9, "{line}");
            assert!((contact.duration / duration - 1.0).abs() < 1e-7, "{line}");
            rows += 1;
        }
        assert_eq!(rows, 8);
    }
}
