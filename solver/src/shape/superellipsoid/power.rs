//! Powers whose exponent is known when the scene is built: the general power is left out where a few products do.

/// A power with a fixed exponent, of numbers that are not negative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Power {
    /// The square.
    Two,
    /// The square root.
    Half,
    /// A small whole exponent, by repeated squaring.
    Integer(i32),
    /// Any other exponent, which may be infinite.
    General(f64),
}

/// Above this, repeated squaring rounds more than the general power does.
const LARGEST_INTEGER: f64 = 40.0;

impl Power {
    /// The cheapest way to raise to an exponent. A whole exponent within rounding of a quotient such as 2 / 0.2 counts as whole.
    pub fn new(exponent: f64) -> Power {
        let nearest = exponent.round();
        let is_whole = (exponent - nearest).abs() <= 4.0 * f64::EPSILON * exponent;
        if exponent == 0.5 {
            Power::Half
        } else if is_whole && nearest == 2.0 {
            Power::Two
        } else if is_whole && (1.0..=LARGEST_INTEGER).contains(&nearest) {
            Power::Integer(nearest as i32)
        } else {
            Power::General(exponent)
        }
    }

    /// The power of a number that is not negative.
    #[inline]
    pub fn of(self, base: f64) -> f64 {
        match self {
            Power::Two => base * base,
            Power::Half => base.sqrt(),
            Power::Integer(exponent) => base.powi(exponent),
            Power::General(exponent) => base.powf(exponent),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_way_gives_the_general_power() {
        assert_eq!(
            [2.0, 0.5, 20.0, 2.0 / 0.1, 2.0 / 0.7].map(Power::new),
            [Power::Two, Power::Half, Power::Integer(20), Power::Integer(20), Power::General(2.0 / 0.7)]
        );
        for exponent in [1.0, 2.0, 0.5, 3.0, 20.0, 40.0, 1.05, 0.05, 41.0] {
            for base in [0.0, 1e-30, 0.3, 1.0, 1.7_f64] {
                let (found, expected) = (Power::new(exponent).of(base), base.powf(exponent));
                assert!(
                    (found - expected).abs() <= 2.0 * exponent.max(1.0) * f64::EPSILON * expected,
                    "{base}^{exponent}: {found} {expected}"
                );
            }
        }
    }
}
