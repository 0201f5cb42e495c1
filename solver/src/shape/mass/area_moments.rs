//! Area and moments of flat regions, and the prisms over them.

use nalgebra::{Matrix2, Matrix3, Vector2};

use super::MassProperties;
use crate::Vector;

/// A point or vector in the plane.
pub type Point = Vector2<f64>;

/// Area and moments of a flat region of unit density per area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AreaMoments {
    /// Area in m^2.
    pub area: f64,
    /// $\int x\,dA$ in m^3.
    pub first: Point,
    /// $\int x x^T\,dA$ in m^4.
    pub second: Matrix2<f64>,
}

impl AreaMoments {
    pub(super) fn nothing() -> AreaMoments {
        AreaMoments { area: 0.0, first: Point::zeros(), second: Matrix2::zeros() }
    }

    pub(super) fn add(&mut self, other: &AreaMoments) {
        self.area += other.area;
        self.first += other.first;
        self.second += other.second;
    }

    /// The same region elsewhere.
    pub(super) fn moved(&self, by: &Point) -> AreaMoments {
        let mixed = self.first * by.transpose();
        AreaMoments {
            area: self.area,
            first: self.first + by * self.area,
            second: self.second + mixed + mixed.transpose() + by * by.transpose() * self.area,
        }
    }

    /// The prism over the region between two heights in m: the plane is that of x and y, heights are along z.
    pub fn prism(&self, lower: f64, upper: f64) -> MassProperties {
        let (length, middle) = (upper - lower, 0.5 * (lower + upper));
        let first = Vector::new(self.first.x, self.first.y, self.area * middle) * length;
        let mut second = Matrix3::zeros();
        second.fixed_view_mut::<2, 2>(0, 0).copy_from(&(self.second * length));
        for axis in 0..2 {
            second[(axis, 2)] = self.first[axis] * middle * length;
            second[(2, axis)] = second[(axis, 2)];
        }
        second[(2, 2)] = self.area * length * (middle * middle + length * length / 12.0);
        MassProperties::from_raw_moments(self.area * length, first, second)
    }
}

/// Moments of the triangle between the origin and two points, negative if they are clockwise.
pub(super) fn triangle(from: Point, to: Point) -> AreaMoments {
    let (determinant, sum) = (from.perp(&to), from + to);
    let squares = sum * sum.transpose() + from * from.transpose() + to * to.transpose();
    AreaMoments { area: 0.5 * determinant, first: sum * (determinant / 6.0), second: squares * (determinant / 24.0) }
}

/// Moments of the sector of a disc about the origin, between two angles.
pub(super) fn circular_sector(radius: f64, from: f64, to: f64) -> AreaMoments {
    let ((sine_from, cosine_from), (sine_to, cosine_to)) = (from.sin_cos(), to.sin_cos());
    let angle = to - from;
    let twist = 0.5 * (sine_to * cosine_to - sine_from * cosine_from);
    let mixed = 0.5 * (sine_to * sine_to - sine_from * sine_from);
    AreaMoments {
        area: 0.5 * radius * radius * angle,
        first: Point::new(sine_to - sine_from, cosine_from - cosine_to) * (radius.powi(3) / 3.0),
        second: Matrix2::new(0.5 * angle + twist, mixed, mixed, 0.5 * angle - twist) * (0.25 * radius.powi(4)),
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// Half a disc of radius 1 and a triangle, from integrals that any handbook has; moved, to see the shift of moments.
    #[test]
    fn a_half_disc_and_a_triangle() {
        let half = circular_sector(1.0, 0.0, PI);
        assert!((half.area - 0.5 * PI).abs() < f64::EPSILON && (half.first - Point::new(0.0, 2.0 / 3.0)).norm() < f64::EPSILON);
        assert!((half.second - Matrix2::identity() * (PI / 8.0)).norm() < f64::EPSILON);
        let corner = triangle(Point::new(3.0, 0.0), Point::new(0.0, 2.0));
        assert_eq!((corner.area, corner.first), (3.0, Point::new(3.0, 2.0)));
        assert!((corner.second - Matrix2::new(4.5, 1.5, 1.5, 2.0)).norm() < 4.0 * f64::EPSILON);
        let moved = corner.moved(&Point::new(1.0, 0.0));
        assert!((moved.second - Matrix2::new(4.5 + 6.0 + 3.0, 3.5, 3.5, 2.0)).norm() < 8.0 * f64::EPSILON);
    }

    #[test]
    fn a_prism_over_a_disc_is_a_cylinder() {
        let prism = circular_sector(0.5, 0.0, 2.0 * PI).moved(&Point::new(2.0, 1.0)).prism(-1.0, 2.0);
        let cylinder = crate::shape::Cylinder { radius: 0.5, length: 3.0 };
        let expected = MassProperties::centred(cylinder.volume(), cylinder.mean_squares());
        assert!((prism.centre - Vector::new(2.0, 1.0, 0.5)).norm() < 8.0 * f64::EPSILON);
        assert!((prism.volume - expected.volume).abs() < 8.0 * f64::EPSILON);
        assert!((prism.second_moments - expected.second_moments).norm() < 64.0 * f64::EPSILON);
    }
}
