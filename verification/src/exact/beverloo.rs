//! Beverloo's law: how fast grains flow through a circular hole in a flat bottom. A correlation, not a theory; two sets of constants tell how far to trust it.

/// Constants of the law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beverloo {
    /// C.
    pub rate_constant: f64,
    /// k: the hole acts as if it were narrower by so many grain diameters.
    pub size_constant: f64,
}

/// Of Beverloo's own measurements.
pub const MEASURED: Beverloo = Beverloo { rate_constant: 0.58, size_constant: 1.4 };
/// Of simulated spheres with a friction of 0.3.
pub const SIMULATED: Beverloo = Beverloo { rate_constant: 0.548, size_constant: 1.57 };

impl Beverloo {
    /// $W / (\rho_b \sqrt{g d^5}) = C (D/d - k)^{5/2}$: mass flow over bulk density, gravity and grain size, for a hole of so many grain diameters. Zero where
    /// the law has the hole blocked.
    pub fn rate(&self, diameters: f64) -> f64 {
        self.rate_constant * (diameters - self.size_constant).max(0.0).powf(2.5)
    }
}

/// The middle of both laws, and how far either is from it as a part of it.
pub fn middle(diameters: f64) -> (f64, f64) {
    let [one, other] = [MEASURED, SIMULATED].map(|law| law.rate(diameters));
    (0.5 * (one + other), (one - other).abs() / (one + other))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = include_str!("../../../reference-data/beverloo/data.csv");

    #[test]
    fn constants_are_those_of_the_table() {
        let rows: Vec<Vec<&str>> = TABLE.lines().skip(1).map(|line| line.split(',').collect()).collect();
        for (law, row) in [MEASURED, SIMULATED].iter().zip(&rows) {
            assert_eq!([row[1], row[2]].map(|number| number.parse().ok()), [Some(law.rate_constant), Some(law.size_constant)]);
        }
        assert_eq!(rows.len(), 2);
    }

    /// By hand: 4.6^2.5 = 45.383, 4.43^2.5 = 41.306.
    #[test]
    fn rates_are_those_computed_by_hand() {
        assert!((MEASURED.rate(6.0) - 0.58 * 45.3833).abs() < 1e-3);
        assert!((SIMULATED.rate(6.0) - 0.548 * 41.3058).abs() < 1e-3);
        assert_eq!(MEASURED.rate(1.0), 0.0);
        let (rate, part) = middle(6.0);
        assert!((rate * (1.0 + part) - MEASURED.rate(6.0)).abs() < 1e-12 && (rate * (1.0 - part) - SIMULATED.rate(6.0)).abs() < 1e-12);
        assert!((0.05..0.09).contains(&part) && middle(12.0).1 < part);
    }
}
