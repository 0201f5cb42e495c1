//! Spheres that settle in a tank, as measured by ten Cate et al. (2002) (`reference-data/tencate_settling`).

const TABLE: &str = include_str!("../../../reference-data/tencate_settling/data.csv");

/// Of measured velocities, as a part of them.
pub const UNCERTAINTY: f64 = 0.01;

/// One of the experiments. SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Experiment {
    /// In kg/m^3.
    pub fluid_density: f64,
    /// In Pa s.
    pub viscosity: f64,
    /// In kg/m^3.
    pub solid_density: f64,
    /// In m.
    pub diameter: f64,
    /// Velocity of the sphere without bounds by Abraham's drag in m/s.
    pub unbounded: f64,
    /// Reynolds number of that.
    pub reynolds: f64,
    /// Largest velocity that was measured in m/s.
    pub fastest: f64,
}

/// The experiment of a name, `E1` or `E4`; `None` if it is not in the table.
pub fn experiment(name: &str) -> Option<Experiment> {
    TABLE.lines().skip(1).find_map(|line| {
        let mut words = line.split(',');
        words.next().filter(|word| *word == name)?;
        let numbers: Vec<f64> = words.map_while(|word| word.parse().ok()).collect();
        let [fluid_density, viscosity, solid_density, diameter, unbounded, reynolds, fastest] = numbers.try_into().ok()?;
        Some(Experiment { fluid_density, viscosity, solid_density, diameter, unbounded, reynolds, fastest })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Abraham (1970): $C_d = (24 / 9.06^2) (1 + 9.06 / \sqrt{Re})^2$; net weight against drag tells the velocity.
    #[test]
    fn velocities_without_bounds_balance_weight_and_abrahams_drag() {
        for (name, ratio) in [("E1", 0.947), ("E4", 0.955)] {
            let of = experiment(name).expect("a row");
            assert!((of.fluid_density * of.unbounded * of.diameter / of.viscosity / of.reynolds - 1.0).abs() < 1e-6);
            let drag = 24.0 / 9.06_f64.powi(2) * (1.0 + 9.06 / of.reynolds.sqrt()).powi(2);
            let square = 4.0 / 3.0 * (of.solid_density / of.fluid_density - 1.0) * 9.81 * of.diameter / drag;
            assert!((square.sqrt() / of.unbounded - 1.0).abs() < 1e-3, "{name} {}", square.sqrt());
            // The ratio is printed to three digits, the velocity as well.
            assert!((of.fastest / of.unbounded / ratio - 1.0).abs() < 2e-3, "{name}");
        }
        assert_eq!(experiment("E2"), None);
    }
}
