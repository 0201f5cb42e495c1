//! Closed forms for two or three equal cylinders that cross at right angles in their middle: the crosses of R (figure 3.12).

use std::f64::consts::SQRT_2;

use nalgebra::Matrix3;

use super::MassProperties;
use crate::Vector;
use crate::shape::Cylinder;

/// The union of two cylinders along x and y, centred at the origin. `None` if they are so short (length less than the diameter) that their ends
/// cut the crossing.
pub fn cross_in_plane(radius: f64, length: f64) -> Option<MassProperties> {
    let union = || cylinder(0, radius, length) + cylinder(1, radius, length) - bicylinder(2, radius);
    (length >= 2.0 * radius).then(|| union().properties())
}

/// The union of three cylinders along x, y and z, centred at the origin; `None` if their ends cut the crossing.
///
/// By inclusion and exclusion: three cylinders, less the three bicylinders that two of them share, plus the tricylinder that all three share.
pub fn cross_in_space(radius: f64, length: f64) -> Option<MassProperties> {
    let single_less_double = |axis| cylinder(axis, radius, length) - bicylinder(axis, radius);
    let union = || single_less_double(0) + single_less_double(1) + single_less_double(2) + tricylinder(radius);
    (length >= 2.0 * radius).then(|| union().properties())
}

/// A body that is symmetric about all planes of coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Moments {
    /// In m^3.
    volume: f64,
    /// Integrals of x^2, y^2 and z^2, in m^5.
    squares: Vector,
}

/// A cylinder along an axis.
fn cylinder(axis: usize, radius: f64, length: f64) -> Moments {
    let cylinder = Cylinder { radius, length };
    let mut squares = cylinder.mean_squares() * cylinder.volume();
    squares.swap_rows(axis, 2);
    Moments { volume: cylinder.volume(), squares }
}

/// What two cylinders share whose axes are at right angles to each other and to `axis`: the bicylinder of Steinmetz.
///
/// At the height z it is a square of half edge `s`, `s^2 = r^2 - z^2`, so that the integrals over z of `4 s^2`, `4 s^2 z^2` and `4 s^4 / 3`
/// give the volume `16/3 r^3`, `16/15 r^5` along the axis and `64/45 r^5` across it.
fn bicylinder(axis: usize, radius: f64) -> Moments {
    let mut squares = Vector::repeat(64.0 / 45.0);
    squares[axis] = 16.0 / 15.0;
    Moments { volume: 16.0 / 3.0 * radius.powi(3), squares: squares * radius.powi(5) }
}

/// What three cylinders along x, y and z share.
///
/// It is a cube of half edge `a = r / sqrt 2` with a cap on each face, whose sections are squares of half edge `s`, `s^2 = r^2 - z^2`. The
/// integral of x^2 is `8/3 a^5` for the cube, that of `4 s^2 x^2` from a to r for two caps, `2/15 - 7 sqrt 2 / 120` times 4, and that of
/// `4/3 s^4` for four, `8/15 - 43 sqrt 2 / 120` times 4/3, for r = 1.
fn tricylinder(radius: f64) -> Moments {
    let square = (176.0 - 92.0 * SQRT_2) / 45.0;
    Moments { volume: 8.0 * (2.0 - SQRT_2) * radius.powi(3), squares: Vector::repeat(square * radius.powi(5)) }
}

impl Moments {
    fn properties(&self) -> MassProperties {
        MassProperties { volume: self.volume, centre: Vector::zeros(), second_moments: Matrix3::from_diagonal(&self.squares) }
    }
}

impl std::ops::Add for Moments {
    type Output = Moments;

    fn add(self, other: Moments) -> Moments {
        Moments { volume: self.volume + other.volume, squares: self.squares + other.squares }
    }
}

impl std::ops::Sub for Moments {
    type Output = Moments;

    fn sub(self, other: Moments) -> Moments {
        Moments { volume: self.volume - other.volume, squares: self.squares - other.squares }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Independent: the bodies sliced along z. At each height the union of the cylinders along x and y is a cross of two strips (half width s
    /// and half length h), and the cylinder along z adds a disc, of which the part outside of the cross is integrated along x.
    ///
    /// Returns volume and integrals of x^2, y^2, z^2 by the midpoint rule in the angle of z = r sin(t), which has no square root to smooth.
    fn by_slices(radius: f64, half_length: f64, third: bool) -> [f64; 4] {
        let mut sums = [0.0; 4];
        let mut add = |weight: f64, area: f64, square_x: f64, square_y: f64, z: f64| {
            let values = [area, square_x, square_y, area * z * z];
            sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
        };
        let slices = 400;
        for slice in 0..slices {
            let angle = std::f64::consts::PI * ((f64::from(slice) + 0.5) / f64::from(slices) - 0.5);
            let (z, s) = (radius * angle.sin(), radius * angle.cos());
            let weight = std::f64::consts::PI / f64::from(slices) * s;
            // Two strips less their common square, by exact moments of rectangles.
            let (area, square) = (8.0 * s * half_length - 4.0 * s * s, |a: f64, b: f64| 4.0 * b * a.powi(3) / 3.0);
            let moment = square(half_length, s) + square(s, half_length) - square(s, s);
            add(weight, area, moment, moment, z);
            if third {
                let [corner, corner_moment] = corners_of_disc(radius, s);
                add(weight, corner, corner_moment, corner_moment, z);
            }
        }
        if third {
            // Beyond the others' radius the third cylinder is alone.
            let length = 2.0 * (half_length - radius);
            let disc = std::f64::consts::PI * radius * radius;
            let along = 2.0 / 3.0 * (half_length.powi(3) - radius.powi(3));
            let square = disc * radius * radius / 4.0 * length;
            sums.iter_mut().zip([disc * length, square, square, disc * along]).for_each(|(sum, value)| *sum += value);
        }
        sums
    }

    /// Area, and integral of x^2, of the four parts of a disc where |x| and |y| are both larger than s, by the midpoint rule in the angle.
    fn corners_of_disc(radius: f64, s: f64) -> [f64; 2] {
        let (start, end) = ((s / radius).asin(), (s / radius).acos());
        if end <= start {
            return [0.0; 2];
        }
        let steps = 2000;
        let step = (end - start) / f64::from(steps);
        let mut sums = [0.0; 2];
        for index in 0..steps {
            // x = r sin(t) from s to sqrt(r^2 - s^2); y from s to r cos(t).
            let angle = start + (f64::from(index) + 0.5) * step;
            let (x, height) = (radius * angle.sin(), radius * angle.cos() - s);
            let area = 4.0 * height * radius * angle.cos() * step;
            sums[0] += area;
            sums[1] += area * x * x;
        }
        sums
    }

    #[test]
    fn crosses_agree_with_their_slices() {
        let (radius, half_length) = (0.5, 0.8);
        // The integrand begins with the square of the distance from the ends, so that the first correction of the midpoint rule vanishes there;
        // the next is of the step to the fourth. For three cylinders the disc's corners end inside, and the first one stays.
        let step = std::f64::consts::PI / 400.0;
        for (found, third, floor) in [
            (cross_in_plane(radius, 2.0 * half_length), false, step.powi(4)),
            (cross_in_space(radius, 2.0 * half_length), true, step * step / 24.0),
        ] {
            let (found, expected) = (found.unwrap(), by_slices(radius, half_length, third));
            let squares = found.second_moments.diagonal();
            for (value, expected) in [found.volume, squares.x, squares.y, squares.z].iter().zip(expected) {
                assert!((value / expected - 1.0).abs() < 8.0 * floor, "{value} {expected} {}", value / expected - 1.0);
            }
        }
    }

    /// Independent: the caps by the midpoint rule.
    #[test]
    fn the_tricylinder_is_a_cube_with_six_caps() {
        let a = 0.5_f64.sqrt();
        let steps = 20_000;
        let step = (1.0 - a) / f64::from(steps);
        let (mut volume, mut square) = (8.0 * a.powi(3), 8.0 / 3.0 * a.powi(5));
        for index in 0..steps {
            let z = a + (f64::from(index) + 0.5) * step;
            let section = 4.0 * (1.0 - z * z);
            volume += 6.0 * section * step;
            square += (2.0 * section * z * z + 4.0 * section * section / 12.0) * step;
        }
        let body = tricylinder(1.0);
        let floor = step * step;
        assert!((body.volume - volume).abs() < 4.0 * floor && (body.squares.x - square).abs() < 4.0 * floor);
    }

    #[test]
    fn ends_that_cut_the_crossing_are_refused() {
        assert!(cross_in_plane(0.5, 0.999).is_none() && cross_in_space(0.5, 0.999).is_none());
        assert!(cross_in_plane(0.5, 1.0).is_some() && cross_in_space(0.5, 1.0).is_some());
    }
}
