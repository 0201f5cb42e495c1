//! The norm $(|u|^k + |v|^k)^{1/k}$ of a pair of numbers, and the pair that is dual to it.
//!
//! A superellipsoid is two such norms, one inside the other: its surface, its normals and its support map all come out of them. Everything is scaled by
//! the larger number, so that no power overflows and none is taken of a negative number.

use super::power::Power;

/// The norm of an exponent above one, which may be infinite.
#[derive(Debug, Clone, PartialEq)]
pub struct Norm {
    exponent: f64,
    power: Power,
    root: Power,
}

/// A pair of numbers under a norm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormedPair {
    /// Its norm.
    pub norm: f64,
    /// The pair over its norm.
    pub own: [f64; 2],
    /// The dual pair $\mathrm{sgn}(u) |u|^{k-1}$ of the pair over its norm: the gradient of the norm.
    pub dual: [f64; 2],
    /// Each dual number over its own, zero for zeros.
    dual_over_own: [f64; 2],
}

impl Norm {
    /// The norm of an exponent.
    pub fn new(exponent: f64) -> Norm {
        Norm { exponent, power: Power::new(exponent), root: Power::new(1.0 / exponent) }
    }

    /// The exponent.
    pub fn exponent(&self) -> f64 {
        self.exponent
    }

    /// Whether it is the usual length of a pair.
    #[inline]
    fn is_of_squares(&self) -> bool {
        matches!(self.power, Power::Two)
    }

    /// The norm of a pair.
    #[inline]
    pub fn of(&self, one: f64, other: f64) -> f64 {
        let (one, other) = (one.abs(), other.abs());
        let (large, small) = if one >= other { (one, other) } else { (other, one) };
        if large == 0.0 {
            return 0.0;
        }
        if self.is_of_squares() {
            return (large * large + small * small).sqrt();
        }
        large * self.root.of(1.0 + self.power.of(small / large))
    }

    /// The norm of a pair and what belongs to it; zeros for a pair of zeros.
    #[inline]
    pub fn pair(&self, one: f64, other: f64) -> NormedPair {
        if self.is_of_squares() {
            let norm = (one * one + other * other).sqrt();
            let scale = if norm > 0.0 { 1.0 / norm } else { 0.0 };
            let own = [one * scale, other * scale];
            return NormedPair { norm, own, dual: own, dual_over_own: [1.0; 2] };
        }
        let is_first = one.abs() >= other.abs();
        let (large, small) = if is_first { (one, other) } else { (other, one) };
        if large == 0.0 {
            return NormedPair { norm: 0.0, own: [0.0; 2], dual: [0.0; 2], dual_over_own: [0.0; 2] };
        }
        let ratio = (small / large).abs();
        let power = self.power.of(ratio);
        let sum = 1.0 + power;
        let root = self.root.of(sum);
        let of_large = root * root / sum;
        let of_small = if ratio > 0.0 { of_large * power / ratio / ratio } else { 0.0 };
        let dual_over_own = if is_first { [of_large, of_small] } else { [of_small, of_large] };
        let norm = large.abs() * root;
        let own = [one / norm, other / norm];
        NormedPair { norm, own, dual: [own[0] * dual_over_own[0], own[1] * dual_over_own[1]], dual_over_own }
    }

    /// Derivative of each dual number by its own: $(k - 1) |u|^{k-2}$.
    #[inline]
    pub fn slopes(&self, pair: &NormedPair) -> [f64; 2] {
        let [one, other] = pair.dual_over_own;
        [(self.exponent - 1.0) * one, (self.exponent - 1.0) * other]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Independent: the plain formulas.
    #[test]
    fn norms_and_duals_are_what_the_formulas_say() {
        for exponent in [1.05, 1.5, 2.0, 20.0 / 7.0, 20.0] {
            let norm = Norm::new(exponent);
            for (one, other) in [(0.3, -0.8_f64), (-2.0, 0.1), (1.0, 0.0), (0.7, 0.7)] {
                let pair = norm.pair(one, other);
                let expected = (one.abs().powf(exponent) + other.abs().powf(exponent)).powf(1.0 / exponent);
                assert!((pair.norm / expected - 1.0).abs() < 1e-14 && (norm.of(one, other) / expected - 1.0).abs() < 1e-14);
                for (given, (own, dual)) in [one, other].into_iter().zip(pair.own.into_iter().zip(pair.dual)) {
                    assert!((own - given / expected).abs() < 1e-14);
                    let power = (given / expected).abs().powf(exponent - 1.0).copysign(given);
                    assert!((dual - power).abs() < 1e-14 || given == 0.0, "{exponent} {given}: {dual} {power}");
                }
                // Hölder's equality.
                assert!((pair.own[0] * pair.dual[0] + pair.own[1] * pair.dual[1] - 1.0).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn nothing_overflows_and_an_infinite_exponent_is_the_largest() {
        let steep = Norm::new(20.0);
        assert!((steep.pair(1e200, 1e200).norm / 1e200 - 2.0_f64.powf(0.05)).abs() < 1e-14);
        let [one, other] = steep.pair(1e-200, 0.0).own;
        assert!((one - 1.0).abs() <= 2.0 * f64::EPSILON && other == 0.0, "{one}");
        let largest = Norm::new(f64::INFINITY);
        assert_eq!((largest.of(0.3, -0.8), largest.pair(0.3, -0.8).dual), (0.8, [0.0, -1.0]));
    }
}
