//! Pressure drop of packed beds by correlations of Ergun's form (R eq. 7.23 to 7.28): bands, not truths (`reference-data/ergun_constants`).

const TABLE: &str = include_str!("../../../reference-data/ergun_constants/data.csv");

/// A bed as correlations see it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bed {
    /// Volume of the fluid over that of the bed.
    pub void_fraction: f64,
    /// Six volumes over the surface of a particle (R eq. 7.24), in m.
    pub diameter: f64,
}

impl Bed {
    /// Viscous constant $\alpha$ of a bed whose pressure falls by so many Pa/m in creeping flow of a viscosity in Pa s and a superficial velocity in m/s.
    pub fn viscous_constant(&self, gradient: f64, viscosity: f64, velocity: f64) -> f64 {
        gradient / self.viscous_term(viscosity, velocity)
    }

    /// Inertial constant $\beta$ of a bed with a viscous constant, whose pressure falls by so many Pa/m in a fluid of a density in kg/m^3.
    pub fn inertial_constant(&self, gradient: f64, viscous_constant: f64, [viscosity, density, velocity]: [f64; 3]) -> f64 {
        (gradient - viscous_constant * self.viscous_term(viscosity, velocity)) / self.inertial_term(density, velocity)
    }

    fn viscous_term(&self, viscosity: f64, velocity: f64) -> f64 {
        let solid = 1.0 - self.void_fraction;
        viscosity * solid * solid * velocity / (self.void_fraction.powi(3) * self.diameter * self.diameter)
    }

    fn inertial_term(&self, density: f64, velocity: f64) -> f64 {
        density * (1.0 - self.void_fraction) * velocity * velocity / (self.void_fraction.powi(3) * self.diameter)
    }
}

/// Least and largest of the viscous constants.
pub fn viscous_band() -> [f64; 2] {
    band(1)
}

/// Least and largest of the inertial constants.
pub fn inertial_band() -> [f64; 2] {
    band(2)
}

fn band(column: usize) -> [f64; 2] {
    let values = TABLE.lines().skip(1).filter_map(|line| line.split(',').nth(column)?.parse::<f64>().ok());
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], value| [least.min(value), most.max(value)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_are_those_of_the_table() {
        assert_eq!((viscous_band(), inertial_band()), ([72.0, 295.0], [1.75, 4.99]));
        assert_eq!(TABLE.lines().count(), 11);
    }

    /// Water at a centimetre a second through millimetre spheres: 150 and 1.75 give 8.4 and 1.6 kPa/m by hand.
    #[test]
    fn constants_are_those_of_the_gradient_that_they_give() {
        let bed = Bed { void_fraction: 0.4, diameter: 1e-3 };
        let (viscous, inertial) = (150.0 * 1e-3 * 0.36 * 0.01 / (0.064 * 1e-6), 1.75 * 1e3 * 0.6 * 1e-4 / (0.064 * 1e-3));
        assert!((viscous - 8437.5_f64).abs() < 1e-9 && (inertial - 1640.625_f64).abs() < 1e-9);
        assert!((bed.viscous_constant(viscous, 1e-3, 0.01) / 150.0 - 1.0).abs() < 1e-14);
        assert!((bed.inertial_constant(viscous + inertial, 150.0, [1e-3, 1e3, 0.01]) / 1.75 - 1.0).abs() < 1e-13);
    }
}
