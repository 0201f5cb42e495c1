//! Dilute and moderately dense gases of smooth hard spheres by Enskog's kinetic theory.

use std::f64::consts::PI;

use solver::Vector;
use solver::insertion::Draws;

/// A gas of equal smooth spheres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gas {
    /// Diameter in m.
    pub diameter: f64,
    /// Bodies per m^3.
    pub number_density: f64,
    /// Restitution, in (0, 1].
    pub restitution: f64,
}

impl Gas {
    /// Part of the volume that the spheres fill.
    pub fn volume_fraction(&self) -> f64 {
        PI / 6.0 * self.number_density * self.diameter.powi(3)
    }

    /// Pair correlation at contact of hard spheres (Carnahan and Starling 1969).
    pub fn contact_value(&self) -> f64 {
        let fraction = self.volume_fraction();
        (1.0 - 0.5 * fraction) / (1.0 - fraction).powi(3)
    }

    /// Collisions of one sphere in 1/s at a thermal speed $\sqrt{T/m}$ in m/s (root mean square along one axis): $4 \sqrt\pi\, n d^2 \chi \sqrt{T/m}$.
    pub fn collision_rate(&self, thermal_speed: f64) -> f64 {
        4.0 * PI.sqrt() * self.number_density * self.diameter * self.diameter * self.contact_value() * thermal_speed
    }

    /// Second Sonine coefficient of the homogeneous cooling state (van Noije and Ernst 1998).
    pub fn sonine_coefficient(&self) -> f64 {
        let restitution = self.restitution;
        let square = restitution * restitution;
        16.0 * (1.0 - restitution) * (1.0 - 2.0 * square) / (81.0 - 17.0 * restitution + 30.0 * square * (1.0 - restitution))
    }

    /// Time in s after which a cooling gas has a quarter of its energy, $E = E_0 / (1 + t/\tau)^2$ (Haff 1983). A collision takes $(1 - e^2) T$ of energy
    /// on average, so that $\tau = 6 / ((1 - e^2)\,\omega_0)$, shortened by $1 + 3 a_2 / 16$ for speeds that are not quite Maxwell's.
    pub fn cooling_time(&self, thermal_speed: f64) -> f64 {
        let loss = 1.0 - self.restitution * self.restitution;
        6.0 / (loss * self.collision_rate(thermal_speed) * (1.0 + 3.0 / 16.0 * self.sonine_coefficient()))
    }

    /// Collisions of one sphere while its energy falls from that at the start by a time over the cooling time.
    pub fn collisions_until(&self, time_over_cooling_time: f64) -> f64 {
        6.0 / (1.0 - self.restitution * self.restitution) * time_over_cooling_time.ln_1p()
    }
}

/// As many elastic spheres of one kind as of another, in one box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EvenMixture {
    /// Masses in kg.
    pub masses: [f64; 2],
    /// Diameters in m.
    pub diameters: [f64; 2],
    /// Spheres of either kind per m^3.
    pub number_density: f64,
}

impl EvenMixture {
    /// Collisions in 1/s of a sphere with those of the other kind, both at a temperature in J ($m \langle v_x^2 \rangle$).
    pub fn cross_collision_rate(&self, temperature: f64) -> f64 {
        let ([one, other], diameter) = (self.masses, 0.5 * self.diameters.iter().sum::<f64>());
        let volume: f64 = self.diameters.iter().map(|diameter| PI / 6.0 * diameter.powi(3)).sum();
        let alike = Gas { diameter: (6.0 / PI * 0.5 * volume).cbrt(), number_density: 2.0 * self.number_density, restitution: 1.0 };
        let relative_speed = (temperature * (1.0 / one + 1.0 / other)).sqrt();
        self.number_density * (8.0 * PI).sqrt() * diameter * diameter * alike.contact_value() * relative_speed
    }

    /// How much of a small difference of the two temperatures is lost in a second. A collision hands on $4 m_1 m_2 (T_1 - T_2) / (m_1 + m_2)^2$ on average:
    /// it scatters evenly, $\Delta E_1 = -\mu\,\mathbf V \cdot \mathbf g$ of the common and the relative velocity, which correlate by
    /// $(T_1 - T_2) / (m_1 + m_2)$, and pairs collide as often as they are fast. Each kind has 3/2 of its temperature as energy.
    pub fn equilibration_rate(&self, temperature: f64) -> f64 {
        let [one, other] = self.masses;
        16.0 / 3.0 * one * other / (one + other).powi(2) * self.cross_collision_rate(temperature)
    }
}

/// Velocities of a body in thermal motion, in units of the root of temperature over mass: three normal deviates (Box and Muller).
pub fn thermal(draws: &mut Draws) -> Vector {
    let mut deviate = || {
        let (size, angle) = (1.0 - draws.unit(), std::f64::consts::TAU * draws.unit());
        (-2.0 * size.ln()).sqrt() * angle.cos()
    };
    Vector::new(deviate(), deviate(), deviate())
}

/// Variance of the mean of a quantity over a time, over its variance at one time, if it forgets itself as $e^{-rate\,t}$.
pub fn variance_of_mean(rate: f64, time: f64) -> f64 {
    let memories = rate * time;
    2.0 / memories * (1.0 - (-(-memories).exp_m1()) / memories)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A small difference of temperatures, its loss by pairs thrown at random: chosen by the flux, scattered evenly.
    #[test]
    fn energy_handed_on_is_that_of_pairs_thrown() {
        let (masses, temperatures, pairs) = ([1.0_f64, 3.375], [1.3, 0.9], 400_000);
        let total = masses[0] + masses[1];
        let thrown: Vec<[f64; 2]> = (0..pairs)
            .map(|pair| {
                let [one, other] =
                    [0, 1].map(|kind| thermal(&mut Draws::new(7, kind as u64, pair)) * (temperatures[kind] / masses[kind]).sqrt());
                let (common, relative) = ((one * masses[0] + other * masses[1]) / total, one - other);
                [relative.norm(), relative.norm() * masses[0] * masses[1] / total * common.dot(&relative)]
            })
            .collect();
        let [flux, handed_on] = [0, 1].map(|which| thrown.iter().map(|pair| pair[which]).sum::<f64>());
        let mixture = EvenMixture { masses, diameters: [1.0, 1.5], number_density: 0.01 };
        let per_collision = 1.5 * mixture.equilibration_rate(1.0) / 2.0 / mixture.cross_collision_rate(1.0);
        let expected = per_collision * (temperatures[0] - temperatures[1]);
        // Of a quotient of sums: what each pair differs from it.
        let scatter = thrown.iter().map(|pair| (pair[1] - expected * pair[0]).powi(2)).sum::<f64>().sqrt() / flux;
        assert!(scatter < 0.01 * expected, "{scatter} {expected}");
        assert!((handed_on / flux - expected).abs() < 4.0 * scatter, "{} {expected}", handed_on / flux);
    }

    /// Two equal kinds are one gas of twice the density, in which half of the collisions are with the other kind.
    #[test]
    fn a_mixture_of_equals_is_one_gas() {
        let mixture = EvenMixture { masses: [2.0; 2], diameters: [0.01; 2], number_density: 5e4 };
        let rate = Gas { restitution: 1.0, ..GAS }.collision_rate((3.0_f64 / 2.0).sqrt());
        assert!((2.0 * mixture.cross_collision_rate(3.0) / rate - 1.0).abs() < 1e-14);
    }

    #[test]
    fn means_over_short_middling_and_long_times() {
        assert!((variance_of_mean(2.0, 0.5) - 2.0 * (-1.0_f64).exp()).abs() < 4.0 * f64::EPSILON);
        assert!((variance_of_mean(2.0, 1e-4) - 1.0).abs() < 1e-4);
        assert!((variance_of_mean(2.0, 1e4) / 1e-4 - 1.0).abs() < 1e-4);
    }

    const GAS: Gas = Gas { diameter: 0.01, number_density: 1e5, restitution: 0.8 };

    /// The rate of a dilute gas by quadrature over Maxwell's relative speeds: flux of partners through the cross-section, $n \pi d^2 \langle g \rangle$.
    #[test]
    fn collision_rate_is_the_flux_through_the_cross_section() {
        let (speed, parts) = (0.3, 20_000);
        // Relative speeds: Maxwell with twice the temperature, 4 pi g^2 (4 pi T/m)^(-3/2) exp(-g^2 / (4 T/m)).
        let width = 20.0 * speed / f64::from(parts);
        let mean: f64 = (0..parts)
            .map(|part| (f64::from(part) + 0.5) * width)
            .map(|g| g * 4.0 * PI * g * g * (4.0 * PI * speed * speed).powf(-1.5) * (-0.25 * (g / speed).powi(2)).exp() * width)
            .sum();
        let rate = GAS.number_density * PI * GAS.diameter * GAS.diameter * mean * GAS.contact_value();
        assert!((GAS.collision_rate(speed) / rate - 1.0).abs() < 1e-7, "{} {rate}", GAS.collision_rate(speed));
    }

    /// Pressure of hard spheres by Carnahan and Starling: Z = 1 + 4 phi chi; at phi = 0.494, where they freeze, Z is 12.5 (Hoover and Ree 1968).
    #[test]
    fn contact_value_gives_the_pressure_at_freezing() {
        let gas = Gas { number_density: 0.494 * 6.0 / (PI * 1e-6), ..GAS };
        assert!((1.0 + 4.0 * gas.volume_fraction() * gas.contact_value() - 12.5).abs() < 0.05);
    }

    /// The printed root of the Sonine coefficient: it vanishes at e = 1/sqrt 2 and in an elastic gas.
    #[test]
    fn speeds_are_maxwells_in_an_elastic_gas_and_at_one_restitution() {
        assert_eq!(Gas { restitution: 1.0, ..GAS }.sonine_coefficient(), 0.0);
        assert!(Gas { restitution: 0.5_f64.sqrt(), ..GAS }.sonine_coefficient().abs() < 1e-15);
        assert!(GAS.sonine_coefficient() < 0.0);
    }

    /// Haff's law solves dT/dt = -(1 - e^2) omega T / 3 with omega ~ sqrt T: the energy and its loss agree at any time.
    #[test]
    fn cooling_time_belongs_to_the_loss_of_a_collision() {
        let (speed, change) = (0.3, 1e-6_f64);
        let time = GAS.cooling_time(speed);
        let loss = (1.0 - (1.0 + change).powi(-2)) / (change * time);
        let expected = (1.0 - 0.64) / 3.0 * GAS.collision_rate(speed) * (1.0 + 3.0 / 16.0 * GAS.sonine_coefficient());
        assert!((loss / expected - 1.0).abs() < 10.0 * change);
        assert!((GAS.collisions_until(1e-6) / (GAS.collision_rate(speed) * time * 1e-6) - 1.0).abs() < 0.01);
    }
}
