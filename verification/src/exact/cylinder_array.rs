//! Drag of a square array of endless cylinders in creeping flow along and across them, by polar harmonics collocated on the sides of a cell.
//!
//! Every harmonic meets the flow's equations and does not slip on the cylinder; only the symmetry of the cell is asked for, at Gauss points of one eighth or
//! one quarter of its sides, by least squares. Along: Sparrow and Loeffler, AIChE Journal 5 (1959). Across: Sangani and Acrivos, International Journal of
//! Multiphase Flow 8 (1982). Edge of the cell, viscosity and mean velocity are one.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use nalgebra::{DMatrix, DVector};

/// Force on a length of cylinder over viscosity, mean velocity of the whole cell and that length; that of the mean pressure gradient is part of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drag {
    /// The value.
    pub value: f64,
    /// What fewer harmonics change, at least rounding.
    pub uncertainty: f64,
}

/// Harmonics that are collocated; the uncertainty is what two thirds of them change.
const HARMONICS: usize = 36;

/// Flow along the cylinders.
pub fn along(solid_fraction: f64) -> Drag {
    settled(|harmonics| along_by(solid_fraction, harmonics))
}

/// Flow across the cylinders, along an edge of the cell.
pub fn across(solid_fraction: f64) -> Drag {
    settled(|harmonics| across_by(solid_fraction, harmonics))
}

fn settled(drag: impl Fn(usize) -> f64) -> Drag {
    let value = drag(HARMONICS);
    Drag { value, uncertainty: (value - drag(2 * HARMONICS / 3)).abs().max(1e-12 * value) }
}

/// Radius of a cylinder of a cell of edge one.
pub fn radius(solid_fraction: f64) -> f64 {
    (solid_fraction / PI).sqrt()
}

/// Radius in which growing harmonics are measured: that of the corners of the cell.
const OUTER: f64 = FRAC_1_SQRT_2;

/// Under a unit pressure gradient $w = (a^2 - r^2) / 4 + \ln(r / a) / 2 \pi + \sum B_n (r^{4n} - a^{8n} r^{-4n}) \cos 4 n \theta$: the logarithm carries the
/// whole force, one. The mean is an integral over the sides, by Green's identity with $r^2 / 4$, whose Laplacian is one.
fn along_by(solid_fraction: f64, harmonics: usize) -> f64 {
    let a = radius(solid_fraction);
    let points = half_side(2 * harmonics);
    let power = |column: usize| 4.0 * (column + 1) as f64;
    let shrink = |power: f64| (a / OUTER).powf(power) * a.powf(power);
    let slope = |row: usize, column: usize| {
        let (place, power) = (Polar::new(0.5, points[row][0]), power(column));
        place.cosine_slope(power, power) / OUTER.powf(power) - shrink(power) * place.cosine_slope(-power, power)
    };
    let matrix = DMatrix::from_fn(points.len(), harmonics, slope);
    let of_mean = |place: &Polar| -0.5 * place.x + place.x / (2.0 * PI * place.r * place.r);
    let right = DVector::from_iterator(points.len(), points.iter().map(|point| -of_mean(&Polar::new(0.5, point[0]))));
    let factors = least_squares(matrix, &right);
    let velocity = |height: f64| {
        let place = Polar::new(0.5, height);
        let waves = factors.iter().enumerate().map(|(column, factor)| {
            let power = power(column);
            factor * ((place.r / OUTER).powf(power) - shrink(power) * place.r.powf(-power)) * (power * place.angle).cos()
        });
        0.25 * (a * a - place.r * place.r) + (place.r / a).ln() / (2.0 * PI) + waves.sum::<f64>()
    };
    let side: f64 = points.iter().map(|[height, weight]| weight * velocity(*height)).sum();
    let mean = 0.25 * 8.0 * side + 0.25 * a * a * (1.0 - solid_fraction) - 1.0 / 24.0 + 0.125 * PI * a.powi(4);
    1.0 / mean
}

/// The stream function is a sum of $r^m, r^{m+2}, r^{-m}, r^{2-m}$ (for $m = 1$: $r \ln r$) times $\sin m \theta$, $m$ odd, the last two so that nothing slips.
/// On the side along the flow it is half the flow and the vorticity vanishes; on that across it, its slope and that of the vorticity. The logarithm's factor
/// carries the force.
fn across_by(solid_fraction: f64, harmonics: usize) -> f64 {
    let a = radius(solid_fraction);
    let points = half_side(2 * harmonics);
    let count = points.len();
    let row = |row: usize| {
        let [height, _] = points[row % count];
        let place = if row < 2 * count { Polar::new(height, 0.5) } else { Polar::new(0.5, height) };
        (row / count, place)
    };
    let waves: Vec<Wave> = (0..harmonics).flat_map(|number| [0.0, 2.0].map(|more| Wave::new(2.0 * number as f64 + 1.0, more, a))).collect();
    let mut matrix = DMatrix::from_fn(4 * count, waves.len(), |number, column| {
        let (condition, place) = row(number);
        waves[column].at(&place)[condition]
    });
    let sizes: Vec<f64> = matrix.column_iter().map(|column| column.amax()).collect();
    matrix.column_iter_mut().zip(&sizes).for_each(|(mut column, size)| column /= *size);
    let right = DVector::from_fn(4 * count, |number, _| if number < count { 0.5 } else { 0.0 });
    let factors = least_squares(matrix, &right);
    let logarithm: f64 = (0..2).map(|column| factors[column] / sizes[column] * waves[column].last).sum();
    4.0 * PI * logarithm
}

/// A wave of the stream function that does not slip.
struct Wave {
    number: f64,
    /// Power of the growing part.
    power: f64,
    /// Factor of the growing part.
    growing: f64,
    /// Factor of $r^{-m}$.
    first: f64,
    /// Factor of $r^{2-m}$, or of $r \ln (r / a)$.
    last: f64,
    /// $a$, the radius of the cylinder.
    surface: f64,
}

impl Wave {
    fn new(number: f64, more: f64, surface: f64) -> Wave {
        let power = number + more;
        let growing = OUTER.powf(-power);
        let size = growing * surface.powf(power);
        // So that value and slope vanish at the surface.
        let (first, last) = if number == 1.0 {
            (-size, -(power + 1.0) * size / surface)
        } else {
            (size * (0.5 * (power + number) - 1.0), -0.5 * (power + number) * size * surface.powf(number - 2.0))
        };
        Wave { number, power, growing, first: first * surface.powf(number), last, surface }
    }

    /// Stream function, its Laplacian, and the slopes of both along x.
    fn at(&self, place: &Polar) -> [f64; 4] {
        let Wave { number, power, growing, first, last, surface } = *self;
        let value = |power: f64| place.r.powf(power) * (number * place.angle).sin();
        let slope = |power: f64| place.sine_slope(power, number);
        let (of_last, slope_of_last, in_laplacian) = if number == 1.0 {
            (place.y * (place.r / surface).ln(), place.x * place.y / (place.r * place.r), 2.0)
        } else {
            (value(2.0 - number), slope(2.0 - number), 4.0 - 4.0 * number)
        };
        let of_growing = growing * (power * power - number * number);
        [
            growing * value(power) + first * value(-number) + last * of_last,
            of_growing * value(number) + last * in_laplacian * value(-number),
            growing * slope(power) + first * slope(-number) + last * slope_of_last,
            of_growing * slope(number) + last * in_laplacian * slope(-number),
        ]
    }
}

/// A point by both kinds of coordinates.
struct Polar {
    x: f64,
    y: f64,
    r: f64,
    angle: f64,
}

impl Polar {
    fn new(x: f64, y: f64) -> Polar {
        Polar { x, y, r: x.hypot(y), angle: y.atan2(x) }
    }

    /// Slope along x of $r^p \cos n \theta$.
    fn cosine_slope(&self, power: f64, number: f64) -> f64 {
        let (sine, cosine) = (number * self.angle).sin_cos();
        self.r.powf(power - 1.0) * (power * cosine * self.angle.cos() + number * sine * self.angle.sin())
    }

    /// Slope along x of $r^p \sin n \theta$.
    fn sine_slope(&self, power: f64, number: f64) -> f64 {
        let (sine, cosine) = (number * self.angle).sin_cos();
        self.r.powf(power - 1.0) * (power * sine * self.angle.cos() - number * cosine * self.angle.sin())
    }
}

/// Gauss points of half a side of the cell, from its middle to its corner, and their weights: roots of Legendre's polynomial by Newton.
fn half_side(count: usize) -> Vec<[f64; 2]> {
    let legendre = |x: f64| {
        let (mut last, mut value) = (1.0, x);
        for degree in 2..=count {
            let degree = degree as f64;
            (last, value) = (value, ((2.0 * degree - 1.0) * x * value - (degree - 1.0) * last) / degree);
        }
        (value, count as f64 * (x * value - last) / (x * x - 1.0))
    };
    let point = |number: usize| {
        let mut x = (PI * (number as f64 + 0.75) / (count as f64 + 0.5)).cos();
        for _ in 0..8 {
            let (value, slope) = legendre(x);
            x -= value / slope;
        }
        let slope = legendre(x).1;
        [0.25 * (x + 1.0), 0.25 * 2.0 / ((1.0 - x * x) * slope * slope)]
    };
    (0..count).map(point).collect()
}

fn least_squares(matrix: DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
    let columns = matrix.ncols();
    let factored = matrix.qr();
    let rotated = factored.q().tr_mul(right);
    factored.r().solve_upper_triangular(&rotated).unwrap_or_else(|| DVector::repeat(columns, f64::NAN))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Drummond and Tahir (1984): $F / \mu U = 4 \pi / (\ln(1 / c) - 1.476 + 2 c - c^2 / 2 - 0.0509 c^4 + ...)$, the constant to its digits.
    #[test]
    fn flow_along_few_cylinders_is_that_of_the_series() {
        for fraction in [0.01_f64, 0.05, 0.1, 0.2, 0.3] {
            let series = (1.0 / fraction).ln() - 1.476 + 2.0 * fraction - 0.5 * fraction.powi(2) - 0.0509 * fraction.powi(4);
            let found = along(fraction);
            let digit = 5e-4 / series;
            assert!((found.value * series / (4.0 * PI) - 1.0).abs() < digit + fraction.powi(8), "{fraction} {found:?}");
            assert!(found.uncertainty < 1e-9 * found.value, "{found:?}");
        }
    }

    /// Sangani and Acrivos (1982): $F / \mu U = 4 \pi / (\ln c^{-1/2} - 0.738 + c - 0.887 c^2 + 2.038 c^3)$.
    #[test]
    fn flow_across_few_cylinders_is_that_of_the_series() {
        for fraction in [0.01_f64, 0.05, 0.1, 0.15] {
            let series = -0.5 * fraction.ln() - 0.738 + fraction - 0.887 * fraction.powi(2) + 2.038 * fraction.powi(3);
            let found = across(fraction);
            // The next power, with the coefficient of the last.
            let next = (5e-4 + 3.0 * fraction.powi(4)) / series;
            assert!((found.value * series / (4.0 * PI) - 1.0).abs() < next, "{fraction} {found:?} {}", 4.0 * PI / series);
            assert!(found.uncertainty < 1e-9 * found.value, "{found:?}");
        }
    }

    /// Sangani and Acrivos (1982), as public codes quote their table: fraction, value, unit of the last digit. At 0.3 they quote 102.90, which is 102.88 here.
    #[test]
    fn flow_across_is_that_of_the_printed_table() {
        for (fraction, printed, digit) in [
            (0.05, 15.56, 0.01),
            (0.1, 24.83, 0.01),
            (0.2, 51.53, 0.01),
            (0.3, 102.9, 0.1),
            (0.4, 217.89, 0.01),
            (0.5, 532.55, 0.01),
            (0.6, 1763.0, 1.0),
            (0.7, 13_520.0, 10.0),
        ] {
            let found = across(fraction);
            assert!((found.value - printed).abs() < 0.6 * digit + found.uncertainty, "{fraction} {found:?}");
        }
    }

    /// Lubrication in the gaps: $F / \mu U = 9 \pi / (2 \sqrt 2) \; (1 - 2 a)^{-5/2}$ as they close.
    #[test]
    fn cylinders_that_nearly_touch_are_held_by_the_gaps() {
        let ratio = |fraction: f64| across(fraction).value / (4.5 * PI / 2.0_f64.sqrt() * (1.0 - 2.0 * radius(fraction)).powf(-2.5));
        assert!((ratio(0.7) - 1.0).abs() < 0.1);
    }
}
