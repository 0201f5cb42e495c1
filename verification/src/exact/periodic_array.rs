//! Friction factor of simple cubic arrays of spheres in creeping flow, computed independently (`reference-data/zick_homsy`).

const TABLE: &str = include_str!("../../../reference-data/zick_homsy/data.csv");

/// A friction factor and its uncertainty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionFactor {
    /// $K = F / (6 \pi \mu a U)$.
    pub value: f64,
    /// Of the value.
    pub uncertainty: f64,
}

/// The tabulated friction factor of a simple cubic array at a solid fraction; `None` if it is not in the table.
pub fn friction_factor(solid_fraction: f64) -> Option<FrictionFactor> {
    rows().find(|row| row[0] == solid_fraction).map(|row| FrictionFactor { value: row[1], uncertainty: row[2] })
}

/// Solid fraction, value, uncertainty and printed value of each row.
fn rows() -> impl Iterator<Item = [f64; 4]> {
    TABLE.lines().skip(1).filter_map(|line| {
        let mut numbers = line.split(',').skip(1).map(|word| word.parse().unwrap_or(f64::NAN));
        Some([numbers.next()?, numbers.next()?, numbers.next()?, numbers.next()?])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn computed_values_agree_with_the_printed_ones_to_their_digits() {
        assert_eq!(rows().count(), 10);
        for [_, value, uncertainty, printed] in rows() {
            let last_digit = 10.0_f64.powf(printed.log10().floor() - 3.0);
            // Two of the printed values have three digits.
            let digit = if printed > 20.0 { 10.0 * last_digit } else { last_digit };
            assert!((value - printed).abs() < 0.51 * digit + uncertainty, "{value} {printed}");
        }
    }

    #[test]
    fn dilute_values_follow_the_series_of_hasimoto() {
        for [fraction, value, uncertainty, _] in rows().filter(|row| row[0] <= 0.027) {
            // Coefficients of Hasimoto (1959) as fitted anew, and the two next ones of Sangani and Acrivos (1982).
            let terms = 1.0 - 1.760119 * fraction.cbrt() + fraction - 1.5593 * fraction.powi(2) + 3.9799 * fraction.powf(8.0 / 3.0)
                - 3.0734 * fraction.powf(10.0 / 3.0);
            assert!((value * terms - 1.0).abs() < uncertainty + 3e-5, "{fraction}");
        }
    }
}
