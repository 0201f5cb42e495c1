//! Friction factor of cubic arrays of spheres in creeping flow: independently computed (`reference-data/zick_homsy`) and by series.

use std::f64::consts::PI;

const TABLE: &str = include_str!("../../../reference-data/zick_homsy/data.csv");

/// A cubic lattice, by the spheres of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lattice {
    /// One.
    SimpleCubic,
    /// Two.
    BodyCentred,
    /// Four.
    FaceCentred,
}

impl Lattice {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Lattice::SimpleCubic => "simple cubic",
            Lattice::BodyCentred => "body-centred cubic",
            Lattice::FaceCentred => "face-centred cubic",
        }
    }

    /// In the table.
    fn key(self) -> &'static str {
        match self {
            Lattice::SimpleCubic => "SC",
            Lattice::BodyCentred => "BCC",
            Lattice::FaceCentred => "FCC",
        }
    }

    /// Centres in a cell of edge one.
    pub fn centres(self) -> &'static [[f64; 3]] {
        match self {
            Lattice::SimpleCubic => &[[0.5, 0.5, 0.5]],
            Lattice::BodyCentred => &[[0.25, 0.25, 0.25], [0.75, 0.75, 0.75]],
            Lattice::FaceCentred => &[[0.25, 0.25, 0.25], [0.25, 0.75, 0.75], [0.75, 0.25, 0.75], [0.75, 0.75, 0.25]],
        }
    }

    /// Distance of nearest centres in edges of the cell.
    pub fn nearest(self) -> f64 {
        match self {
            Lattice::SimpleCubic => 1.0,
            Lattice::BodyCentred => 0.75_f64.sqrt(),
            Lattice::FaceCentred => 0.5_f64.sqrt(),
        }
    }

    /// Diameter of the spheres in edges of the cell.
    pub fn diameter(self, solid_fraction: f64) -> f64 {
        (6.0 * solid_fraction / (PI * self.centres().len() as f64)).cbrt()
    }
}

/// A friction factor and its uncertainty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionFactor {
    /// $K = F / (6 \pi \mu a U)$.
    pub value: f64,
    /// Of the value.
    pub uncertainty: f64,
}

/// The tabulated friction factor of an array at a solid fraction; `None` if it is not in the table.
pub fn friction_factor(lattice: Lattice, solid_fraction: f64) -> Option<FrictionFactor> {
    rows(lattice).find(|row| row[0] == solid_fraction).map(|row| FrictionFactor { value: row[1], uncertainty: row[2] })
}

/// Solid fraction, value, uncertainty and printed value, not a number where none was printed, of each row of a lattice.
fn rows(lattice: Lattice) -> impl Iterator<Item = [f64; 4]> + Clone {
    TABLE.lines().skip(1).filter_map(move |line| {
        let mut words = line.split(',');
        let is_of_lattice = words.next() == Some(lattice.key());
        let mut numbers = words.map(|word| word.parse().unwrap_or(f64::NAN));
        is_of_lattice.then_some([numbers.next()?, numbers.next()?, numbers.next()?, numbers.next()?])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The leading terms of Hasimoto (1959), $1/K = 1 - A c^{1/3} + c - B c^2$, for spheres that are few: the next term, of the power 8/3, is the uncertainty.
    fn hasimoto(lattice: Lattice, solid_fraction: f64) -> FrictionFactor {
        let [first, second] = match lattice {
            Lattice::SimpleCubic => [1.760_119, 1.5593],
            Lattice::BodyCentred => [1.791_859, 0.3288],
            Lattice::FaceCentred => [1.791_747, 0.3017],
        };
        let value = 1.0 / (1.0 - first * solid_fraction.cbrt() + solid_fraction - second * solid_fraction.powi(2));
        // Four is the coefficient of the simple cubic lattice, whose spheres are nearest.
        FrictionFactor { value, uncertainty: 4.0 * solid_fraction.powf(8.0 / 3.0) * value * value }
    }

    #[test]
    fn computed_values_agree_with_the_printed_ones_to_their_digits() {
        assert_eq!(rows(Lattice::SimpleCubic).count(), 10);
        for [_, value, uncertainty, printed] in rows(Lattice::SimpleCubic) {
            let last_digit = 10.0_f64.powf(printed.log10().floor() - 3.0);
            // Those above fifteen have three digits.
            let digit = if printed > 15.0 { 10.0 * last_digit } else { last_digit };
            assert!((value - printed).abs() < 0.51 * digit + uncertainty, "{value} {printed}");
        }
    }

    /// The series of Sangani and Acrivos (1982) in powers of the diameter over that of spheres that touch.
    #[test]
    fn computed_values_agree_with_the_series_of_thirty_powers() {
        const POWERS: [f64; 31] = [
            1.0, 1.418649, 2.012564, 2.331523, 2.564809, 2.584787, 2.873609, 3.340163, 3.536763, 3.504092, 3.253622, 2.689757, 2.037769,
            1.809341, 1.877347, 1.534685, 0.9034708, 0.2857896, -0.5512626, -1.278724, 1.01335, 5.492491, 4.615388, -0.5736023, -2.865924,
            -4.709215, -6.870076, 0.1455304, 12.51891, 9.742811, -5.566269,
        ];
        for [fraction, value, uncertainty, _] in rows(Lattice::SimpleCubic).filter(|row| row[0] < 0.2) {
            let diameter = Lattice::SimpleCubic.diameter(fraction);
            let series: f64 = POWERS.iter().rev().fold(0.0, |sum, factor| sum * diameter + factor);
            // The coefficients have seven digits; where the next power counts the table ends.
            let next = 10.0 * diameter.powi(31);
            assert!((value - series).abs() < uncertainty + 1e-6 * value + next, "{fraction}: {value} {series}");
        }
    }

    #[test]
    fn dilute_values_follow_the_leading_terms() {
        for lattice in [Lattice::SimpleCubic, Lattice::BodyCentred, Lattice::FaceCentred] {
            let dilute = rows(lattice).filter(|row| row[0] <= 0.064);
            assert!(dilute.clone().count() > 0);
            for [fraction, value, _, _] in dilute {
                let leading = hasimoto(lattice, fraction);
                assert!((value - leading.value).abs() < 1.2 * leading.uncertainty + 1e-5, "{lattice:?} {fraction} {value} {leading:?}");
            }
        }
    }

    #[test]
    fn spheres_of_a_lattice_touch_at_its_close_packing() {
        for (lattice, packing) in [
            (Lattice::SimpleCubic, PI / 6.0),
            (Lattice::BodyCentred, PI * 3.0_f64.sqrt() / 8.0),
            (Lattice::FaceCentred, PI / 18.0_f64.sqrt()),
        ] {
            let nearest = lattice.nearest();
            assert!((lattice.diameter(packing) - nearest).abs() < 1e-15);
            let distances = lattice.centres().iter().skip(1).map(|other| {
                let apart = (0..3).map(|a| other[a] - lattice.centres()[0][a]).map(|along| along - along.round());
                apart.map(|along| along * along).sum::<f64>().sqrt()
            });
            assert!((distances.fold(1.0, f64::min) - nearest).abs() < 1e-15);
        }
    }
}
