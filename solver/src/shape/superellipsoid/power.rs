//! Powers whose exponent is known when the scene is built: the general power is left out where products do.
//!
//! Any exponent of moderate size is tabulated. With $x = 2^k m$ and $c$ the middle of that part of $1 \le m < 2$ in which $m$ lies, $x^p = 2^{kp} c^p (1 +
//! (m - c)/c)^p$: a number looked up times a binomial series, whose terms beyond the seventh are left out (the first two of them are economised: replaced by
//! the lower powers that are nearest to them in Chebyshev's sense). The number of parts is the smallest for which what is left out is below rounding.

/// A power with a fixed exponent, of numbers that are not negative.
#[derive(Debug, Clone, PartialEq)]
pub enum Power {
    /// The square.
    Two,
    /// The square root.
    Half,
    /// A small whole exponent, by repeated squaring.
    Integer(i32),
    /// An exponent of moderate size, by series in a table.
    Tabulated(Box<Table>),
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
            Table::new(exponent).map_or(Power::General(exponent), |table| Power::Tabulated(Box::new(table)))
        }
    }

    /// The power of a number that is not negative.
    #[inline]
    pub fn of(&self, base: f64) -> f64 {
        match self {
            Power::Two => base * base,
            Power::Half => base.sqrt(),
            Power::Integer(exponent) => base.powi(*exponent),
            Power::Tabulated(table) => table.of(base),
            Power::General(exponent) => base.powf(*exponent),
        }
    }
}

/// Terms of a series.
const TERMS: usize = 8;
/// Parts of the numbers from one to two, as powers of two.
const FEWEST_PARTS: u32 = 3;
const MOST_PARTS: u32 = 7;
/// Powers of two in the table: from so low to two.
const LOWEST: i32 = -63;
const BIAS: i32 = 1023;
const MANTISSA_BITS: u32 = 52;
const MANTISSA: u64 = (1 << MANTISSA_BITS) - 1;

/// A power by series about the middles of equal parts of the numbers from one to two.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    exponent: f64,
    /// By how many bits a mantissa is shifted to give the number of its part.
    shift: u32,
    /// Powers of the powers of two from [`LOWEST`] on.
    of_two: Vec<f64>,
    /// Coefficients of the series in m - c, part by part.
    series: Vec<[f64; TERMS]>,
}

impl Table {
    /// `None` for an exponent so large that the largest table leaves out more than rounding.
    fn new(exponent: f64) -> Option<Table> {
        // A part reaches from its middle at most as far as this, over the middle.
        let reach = |parts: u32| 0.5 / f64::from(1_u32 << parts);
        // Once economised, the first two terms left out are smaller by 2^7 and 2^8; the next one is not.
        let left_out = |parts: u32| {
            let term = |place: i32| (binomial(exponent, place) * reach(parts).powi(place)).abs();
            term(8) / 128.0 + term(9) / 256.0 + term(10)
        };
        let parts = (FEWEST_PARTS..=MOST_PARTS).find(|parts| left_out(*parts) <= 0.5 * f64::EPSILON)?;
        let number = 1_usize << parts;
        let series = (0..number).map(|part| series_about(1.0 + (part as f64 + 0.5) / number as f64, 0.5 / number as f64, exponent));
        let of_two = (LOWEST..=1).map(|two| 2.0_f64.powi(two).powf(exponent));
        Some(Table { exponent, shift: MANTISSA_BITS - parts, of_two: of_two.collect(), series: series.collect() })
    }

    /// The power of a number that is not negative.
    #[inline]
    fn of(&self, base: f64) -> f64 {
        let bits = base.to_bits();
        let of_two = (bits >> MANTISSA_BITS).wrapping_sub((LOWEST + BIAS) as u64) as usize;
        let part = (bits & MANTISSA) >> self.shift;
        let (Some(of_two), Some(series)) = (self.of_two.get(of_two), self.series.get(part as usize)) else {
            // Beyond the table, and zero.
            return base.powf(self.exponent);
        };
        let one = (BIAS as u64) << MANTISSA_BITS;
        let middle = f64::from_bits(one | (2 * part + 1) << (self.shift - 1));
        of_two * sum(series, f64::from_bits(one | bits & MANTISSA) - middle)
    }
}

/// Sum of a series, in pairs, which do not wait for each other.
#[inline]
fn sum(series: &[f64; TERMS], x: f64) -> f64 {
    let [a, b, c, d, e, f, g, h] = series;
    let (square, fourth) = (x * x, (x * x) * (x * x));
    ((a + b * x) + (c + d * x) * square) + ((e + f * x) + (g + h * x) * square) * fourth
}

/// The coefficient $p (p - 1) \dots / n!$.
fn binomial(exponent: f64, place: i32) -> f64 {
    (0..place).map(|factor| (exponent - f64::from(factor)) / f64::from(factor + 1)).product()
}

/// Series of a power about a middle, good up to a reach, with the ninth and tenth term economised.
fn series_about(middle: f64, reach: f64, exponent: f64) -> [f64; TERMS] {
    let coefficient = |place: i32| binomial(exponent, place) * middle.powf(exponent - f64::from(place));
    let mut series: [f64; TERMS] = std::array::from_fn(|place| coefficient(place as i32));
    // Chebyshev's polynomials of degree eight and nine over their leading coefficients, without it and with the sign turned.
    const OF_EIGHT: [(i32, f64); 4] = [(0, -1.0 / 128.0), (2, 0.25), (4, -1.25), (6, 2.0)];
    const OF_NINE: [(i32, f64); 4] = [(1, -9.0 / 256.0), (3, 15.0 / 32.0), (5, -27.0 / 16.0), (7, 2.25)];
    for (degree, lower) in [(8, OF_EIGHT), (9, OF_NINE)] {
        for (place, share) in lower {
            series[place as usize] += coefficient(degree) * share * reach.powi(degree - place);
        }
    }
    series
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_tabulated(exponent: f64) -> bool {
        matches!(Power::new(exponent), Power::Tabulated(_))
    }

    #[test]
    fn every_exponent_goes_its_cheapest_way() {
        assert_eq!([2.0, 0.5, 20.0, 2.0 / 0.1].map(Power::new), [Power::Two, Power::Half, Power::Integer(20), Power::Integer(20)]);
        assert!([2.0 / 0.7, 0.7 / 2.0, 0.05, 1.05, 20.2].into_iter().all(is_tabulated));
        assert_eq!([41.0, f64::INFINITY].map(Power::new), [Power::General(41.0), Power::General(f64::INFINITY)]);
    }

    #[test]
    fn every_way_gives_the_general_power() {
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

    /// Rounding: the number looked up, the first term, their product and the sum by half a unit each, and what is left out by another half.
    #[test]
    fn a_table_is_as_good_as_rounding_in_every_part_and_at_every_power_of_two() {
        for exponent in (1..400).map(|step| 0.05 * f64::from(step) + 0.003) {
            assert!(is_tabulated(exponent), "{exponent}");
            let power = Power::new(exponent);
            let inside = (0..1024).map(|place| 1.0 + f64::from(place) / 1024.0 + 1e-5);
            let at_ends = (0..128).flat_map(|part| [0.0, -f64::EPSILON].map(|off| 1.0 + f64::from(part) / 128.0 + off));
            for (place, mantissa) in inside.chain(at_ends).enumerate() {
                let base = mantissa * 2.0_f64.powi(-((place % 66) as i32));
                let (found, expected) = (power.of(base), base.powf(exponent));
                let bound = 3.0 * f64::EPSILON * expected + f64::MIN_POSITIVE;
                assert!((found - expected).abs() <= bound, "{base:e}^{exponent}: {found:e} {expected:e}");
            }
            let ends = [0.0, f64::MIN_POSITIVE, 0.5_f64.powi(64), 2.0, 3.9, 1e300].map(|base| (power.of(base), base.powf(exponent)));
            assert!(
                ends.iter().all(|(found, expected)| (found / expected - 1.0).abs() <= 3.0 * f64::EPSILON || found == expected),
                "{ends:?}"
            );
        }
    }
}
