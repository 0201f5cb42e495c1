//! The surface of a superellipsoid by a parameter that is smooth everywhere: what Newton's method on two such surfaces needs.
//!
//! Points are powers of angles with exponent $\varepsilon$, normals with $2 - \varepsilon$: where one changes slowly, the other runs. On a box-like
//! shape a point tells its normal smoothly (and a normal hardly tells the point of a flat face); on a pointed one it is the other way round. So each of
//! the two norms of the shape takes as parameter whichever is smooth: its points for $\varepsilon \le 1$, its normals above. A parameter is a vector of
//! any length; to its direction belong one point and one normal.

use nalgebra::{Matrix3x2, Vector2};

use super::{Curve, Norm, Superellipsoid};
use crate::Vector;

/// A point of a surface with its outward normal, and how both change as the parameter moves along two directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Point in m, in the own frame.
    pub point: Vector,
    /// Derivatives of the point.
    pub slope_of_point: Matrix3x2<f64>,
    /// Outward unit normal.
    pub normal: Vector,
    /// Derivatives of the unit normal.
    pub slope_of_normal: Matrix3x2<f64>,
}

/// A number and its derivatives.
#[derive(Clone, Copy)]
struct Varying {
    value: f64,
    slope: Vector2<f64>,
}

impl Varying {
    #[inline]
    fn times(self, other: Varying) -> Varying {
        Varying { value: self.value * other.value, slope: self.slope * other.value + other.slope * self.value }
    }

    #[inline]
    fn scaled(self, factor: f64) -> Varying {
        Varying { value: self.value * factor, slope: self.slope * factor }
    }
}

/// A pair of numbers on a curve and the pair dual to it: coordinates of a point and of its normal.
struct OnCurve {
    points: [Varying; 2],
    normals: [Varying; 2],
    norm: Varying,
}

impl Curve {
    /// The norm that the parameter is taken by.
    #[inline]
    fn norm_of_parameter(&self) -> &Norm {
        if self.is_angular() { &self.of_normals } else { &self.of_points }
    }

    #[inline]
    fn at(&self, one: Varying, other: Varying) -> OnCurve {
        let norm = self.norm_of_parameter();
        let pair = norm.pair(one.value, other.value);
        // The pair on the curve moves along the tangent, which is across the dual pair, by as much as the given pair turns (Hölder's equality).
        let turn = (other.slope * pair.own[0] - one.slope * pair.own[1]) * (1.0 / pair.norm);
        let own = [Varying { value: pair.own[0], slope: turn * -pair.dual[1] }, Varying { value: pair.own[1], slope: turn * pair.dual[0] }];
        let slopes = norm.slopes(&pair);
        let dual = [
            Varying { value: pair.dual[0], slope: own[0].slope * slopes[0] },
            Varying { value: pair.dual[1], slope: own[1].slope * slopes[1] },
        ];
        let norm = Varying { value: pair.norm, slope: one.slope * pair.dual[0] + other.slope * pair.dual[1] };
        let (points, normals) = if self.is_angular() { (dual, own) } else { (own, dual) };
        OnCurve { points, normals, norm }
    }
}

/// A parameter over the pole has no direction: it is given this part of its length.
const OFF_THE_POLE: f64 = 1e-100;

impl Superellipsoid {
    /// The patch that belongs to a parameter, which must not vanish, and its derivatives along two directions.
    #[inline(always)]
    pub fn patch(&self, parameter: &Vector, along: &Matrix3x2<f64>) -> Patch {
        let row = |axis: usize| Vector2::new(along[(axis, 0)], along[(axis, 1)]);
        let (point, gradient) = if self.is_ellipsoid() { of_ellipsoid(parameter, row) } else { self.of_general(parameter, row) };
        let axes = &self.semi_axes;
        let point = [point[0].scaled(axes.x), point[1].scaled(axes.y), point[2].scaled(axes.z)];
        let inverse = &self.inverse_semi_axes;
        let gradient = [gradient[0].scaled(inverse.x), gradient[1].scaled(inverse.y), gradient[2].scaled(inverse.z)];
        let (point, slope_of_point) = rows(&point);
        let (gradient, slope) = rows(&gradient);
        let inverse_length = 1.0 / gradient.norm();
        let normal = gradient * inverse_length;
        let along_normal = slope.tr_mul(&normal);
        Patch { point, slope_of_point, normal, slope_of_normal: (slope - normal * along_normal.transpose()) * inverse_length }
    }

    /// Points and normals of the shape with semi-axes of one.
    #[inline]
    fn of_general(&self, parameter: &Vector, row: impl Fn(usize) -> Vector2<f64>) -> ([Varying; 3], [Varying; 3]) {
        let at_pole = parameter.x == 0.0 && parameter.y == 0.0;
        let x = if at_pole { OFF_THE_POLE * parameter.z.abs() } else { parameter.x };
        let varying = |value: f64, axis: usize| Varying { value, slope: row(axis) };
        let inner = self.inner.at(varying(x, 0), varying(parameter.y, 1));
        let outer = self.outer.at(inner.norm, varying(parameter.z, 2));
        let of = |inner: &[Varying; 2], outer: &[Varying; 2]| [inner[0].times(outer[0]), inner[1].times(outer[0]), outer[1]];
        (of(&inner.points, &outer.points), of(&inner.normals, &outer.normals))
    }

    /// The parameter of a point near the surface whose normal is about the one given: the point counts where it tells more, the normal elsewhere.
    #[inline]
    pub fn parameter(&self, point: &Vector, normal: &Vector) -> Vector {
        let (point, normal) = (point.component_div(&self.semi_axes), normal.component_mul(&self.semi_axes));
        let of_inner = if self.inner.is_angular() { normal } else { point };
        let of_outer = if self.outer.is_angular() {
            (self.inner.of_normals.of(normal.x, normal.y), normal.z)
        } else {
            (self.inner.of_points.of(point.x, point.y), point.z)
        };
        let norm = self.inner.norm_of_parameter().of(of_inner.x, of_inner.y);
        let scale = if norm > 0.0 { of_outer.0 / norm } else { 0.0 };
        Vector::new(of_inner.x * scale, of_inner.y * scale, of_outer.1)
    }
}

/// On a ball points and normals are the parameter over its length.
#[inline]
fn of_ellipsoid(parameter: &Vector, row: impl Fn(usize) -> Vector2<f64>) -> ([Varying; 3], [Varying; 3]) {
    let inverse = 1.0 / parameter.norm();
    let unit = parameter * inverse;
    let slope_of_length = row(0) * unit.x + row(1) * unit.y + row(2) * unit.z;
    let on_ball = [0, 1, 2].map(|axis| Varying { value: unit[axis], slope: (row(axis) - slope_of_length * unit[axis]) * inverse });
    (on_ball, on_ball)
}

#[inline]
fn rows(numbers: &[Varying; 3]) -> (Vector, Matrix3x2<f64>) {
    let [x, y, z] = numbers;
    let slope = Matrix3x2::new(x.slope.x, x.slope.y, y.slope.x, y.slope.y, z.slope.x, z.slope.y);
    (Vector::new(x.value, y.value, z.value), slope)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{directions, samples};
    use super::*;

    const X_AND_Y: Matrix3x2<f64> = Matrix3x2::new(1.0, 0.0, 0.0, 1.0, 0.0, 0.0);
    const Z_AND_X: Matrix3x2<f64> = Matrix3x2::new(0.0, 1.0, 0.0, 0.0, 1.0, 0.0);

    #[test]
    fn a_patch_is_where_its_normal_is_supported() {
        for shape in samples() {
            for parameter in directions() {
                let patch = shape.patch(&parameter, &X_AND_Y);
                assert!((shape.gauge(&patch.point) - 1.0).abs() < 1e-13);
                let reach = patch.point.dot(&patch.normal);
                let supported = shape.support(&patch.normal).dot(&patch.normal);
                assert!((reach - supported).abs() < 1e-12 * supported, "{:?} {parameter}: {reach} {supported}", shape.exponents());
                let again = shape.parameter(&patch.point, &patch.normal).normalize();
                assert!((again - parameter.normalize()).norm() < 1e-12, "{:?} {parameter} {again}", shape.exponents());
            }
        }
    }

    /// Independent: central differences.
    #[test]
    fn slopes_are_those_of_the_patch() {
        for shape in samples() {
            for parameter in directions().step_by(3).filter(|parameter| parameter.abs().min() > 0.05) {
                for along in [X_AND_Y, Z_AND_X] {
                    let (patch, step) = (shape.patch(&parameter, &along), 1e-6);
                    for way in 0..2 {
                        let offset = along.column(way) * step;
                        let [above, below] = [parameter + offset, parameter - offset].map(|parameter| shape.patch(&parameter, &along));
                        let of_point = (above.point - below.point) / (2.0 * step);
                        let of_normal = (above.normal - below.normal) / (2.0 * step);
                        let (size, scale) = (shape.bounding_radius(), 1.0 + patch.slope_of_normal.norm());
                        let who = format!("{:?} {parameter}", shape.exponents());
                        assert!((of_point - patch.slope_of_point.column(way)).norm() < 1e-6 * size, "{who}");
                        assert!((of_normal - patch.slope_of_normal.column(way)).norm() < 1e-6 * scale, "{who}");
                    }
                }
            }
        }
    }

    #[test]
    fn poles_and_equators_are_points_like_others() {
        for shape in samples() {
            for parameter in [Vector::z(), -Vector::z(), Vector::x(), -Vector::y(), Vector::new(1.0, 0.0, 1e-200)] {
                let patch = shape.patch(&parameter, &X_AND_Y);
                assert!(patch.slope_of_point.iter().chain(patch.slope_of_normal.iter()).all(|slope| slope.is_finite()));
                assert!((patch.normal - parameter).norm() < 1e-12 && (shape.gauge(&patch.point) - 1.0).abs() < 1e-14, "{patch:?}");
            }
        }
    }
}
