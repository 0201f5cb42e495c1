//! A superellipsoid: the shape of source S (sections 2.1 and 2.2).
//!
//! Its surface is $(|x/a_1|^{2/\varepsilon_2} + |y/a_2|^{2/\varepsilon_2})^{\varepsilon_2/\varepsilon_1} + |z/a_3|^{2/\varepsilon_1} = 1$ (S eq. 2.1, where
//! the modulus is missing: as printed it is not a number for negative coordinates). In other words: the norm of exponent $2/\varepsilon_1$ of ($r$,
//! $z/a_3$) is one, where $r$ is the norm of exponent $2/\varepsilon_2$ of ($x/a_1$, $y/a_2$). It is convex for exponents up to two.
//!
//! # Reading order
//!
//! [`power`] -> [`norm`] -> this file -> [`chart`] (the surface by a parameter without singular points) -> [`vertices`] (S's discrete surface).

pub mod chart;
pub mod norm;
pub mod power;
pub mod vertices;

use crate::Vector;
use norm::Norm;

/// A superellipsoid centred at the origin.
#[derive(Debug, Clone, PartialEq)]
pub struct Superellipsoid {
    semi_axes: Vector,
    inverse_semi_axes: Vector,
    exponents: [f64; 2],
    bounding_radius: f64,
    inner_radius: f64,
    /// In the plane of x and y; inside of `outer`.
    inner: Curve,
    /// Between that plane and z.
    outer: Curve,
}

/// The two norms of a curve $|u|^p + |v|^p = 1$: of its points and of its normals.
#[derive(Debug, Clone, PartialEq)]
struct Curve {
    of_points: Norm,
    of_normals: Norm,
}

impl Curve {
    fn new(exponent: f64) -> Curve {
        Curve { of_points: Norm::new(2.0 / exponent), of_normals: Norm::new(2.0 / (2.0 - exponent)) }
    }

    /// Whether points vary more smoothly with normals than the other way round.
    fn is_angular(&self) -> bool {
        self.of_points.exponent() < 2.0
    }
}

/// How far a shape reaches in a direction, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Its outline in the plane of x and y.
    pub of_outline: f64,
    /// The whole shape.
    pub of_all: f64,
}

/// Why numbers are not a superellipsoid.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SuperellipsoidError {
    /// A semi-axis that is not a positive number.
    #[error("semi-axes must be above zero, one is {0} m")]
    SemiAxis(f64),
    /// An exponent outside (0, 2].
    #[error("exponents must be above 0 and at most 2, where the shape is convex; one is {0}")]
    Exponent(f64),
}

impl Superellipsoid {
    /// From semi-axes in m and the exponents $\varepsilon_1$ (towards z) and $\varepsilon_2$ (in the plane of x and y).
    ///
    /// # Errors
    ///
    /// A semi-axis that is not above zero, an exponent outside (0, 2].
    pub fn new(semi_axes: Vector, exponents: [f64; 2]) -> Result<Superellipsoid, SuperellipsoidError> {
        if let Some(axis) = semi_axes.iter().find(|axis| !(axis.is_finite() && **axis > 0.0)) {
            return Err(SuperellipsoidError::SemiAxis(*axis));
        }
        if let Some(exponent) = exponents.iter().find(|exponent| !(**exponent > 0.0 && **exponent <= 2.0)) {
            return Err(SuperellipsoidError::Exponent(*exponent));
        }
        let inverse_semi_axes = semi_axes.map(f64::recip);
        let (outer, inner) = (Curve::new(exponents[0]), Curve::new(exponents[1]));
        let in_plane = |axes: &Vector, norm: fn(&Curve) -> &Norm| {
            farthest(norm(&outer).exponent(), farthest(norm(&inner).exponent(), axes.x, axes.y), axes.z)
        };
        let bounding_radius = in_plane(&semi_axes, |curve| &curve.of_points);
        // By the dual shape, which is as far as this one is near.
        let inner_radius = 1.0 / in_plane(&inverse_semi_axes, |curve| &curve.of_normals);
        Ok(Superellipsoid { semi_axes, inverse_semi_axes, exponents, bounding_radius, inner_radius, outer, inner })
    }

    /// Semi-axes in m.
    pub fn semi_axes(&self) -> &Vector {
        &self.semi_axes
    }

    /// The exponents $\varepsilon_1$ and $\varepsilon_2$.
    pub fn exponents(&self) -> [f64; 2] {
        self.exponents
    }

    /// Whether both exponents are one, where powers are left out.
    #[inline]
    pub fn is_ellipsoid(&self) -> bool {
        self.exponents == [1.0, 1.0]
    }

    /// The same shape, larger by a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Superellipsoid {
        Superellipsoid {
            semi_axes: self.semi_axes * factor,
            inverse_semi_axes: self.inverse_semi_axes / factor,
            bounding_radius: self.bounding_radius * factor,
            inner_radius: self.inner_radius * factor,
            ..self.clone()
        }
    }

    /// By how much the shape must grow to reach a point of its own frame: below one inside, above one outside.
    #[inline]
    pub fn gauge(&self, point: &Vector) -> f64 {
        let point = point.component_mul(&self.inverse_semi_axes);
        self.outer.of_points.of(self.inner.of_points.of(point.x, point.y), point.z)
    }

    /// Whether a point of the own frame lies inside or on the surface.
    #[inline]
    pub fn contains(&self, point: &Vector) -> bool {
        if self.is_ellipsoid() { point.component_mul(&self.inverse_semi_axes).norm_squared() <= 1.0 } else { self.gauge(point) <= 1.0 }
    }

    /// The inside-outside function of S eq. 2.1 at a point of the own frame.
    pub fn inside_outside(&self, point: &Vector) -> f64 {
        self.gauge(point).powf(2.0 / self.exponents[0])
    }

    /// Gradient of the inside-outside function in 1/m (S eq. 2.28, whose exponents and last factors are wrong as printed).
    pub fn gradient(&self, point: &Vector) -> Vector {
        let exponent = 2.0 / self.exponents[0];
        self.gradient_of_gauge(point) * (exponent * self.gauge(point).powf(exponent - 1.0))
    }

    /// Gradient of the gauge in 1/m: along the outward normal of the scaled surface through a point.
    pub fn gradient_of_gauge(&self, point: &Vector) -> Vector {
        let point = point.component_mul(&self.inverse_semi_axes);
        let inner = self.inner.of_points.pair(point.x, point.y);
        let outer = self.outer.of_points.pair(inner.norm, point.z);
        Vector::new(inner.dual[0] * outer.dual[0], inner.dual[1] * outer.dual[0], outer.dual[1]).component_mul(&self.inverse_semi_axes)
    }

    /// Farthest point in a direction, both in the own frame: a closed form, by the duals of both norms.
    #[inline]
    pub fn support(&self, direction: &Vector) -> Vector {
        let direction = direction.component_mul(&self.semi_axes);
        if self.is_ellipsoid() {
            let length = direction.norm();
            return direction.component_mul(&self.semi_axes) * if length > 0.0 { 1.0 / length } else { 0.0 };
        }
        let inner = self.inner.of_normals.pair(direction.x, direction.y);
        let outer = self.outer.of_normals.pair(inner.norm, direction.z);
        Vector::new(inner.dual[0] * outer.dual[0], inner.dual[1] * outer.dual[0], outer.dual[1]).component_mul(&self.semi_axes)
    }

    /// How far the shape reaches in a direction of unit length.
    #[inline]
    pub fn reach(&self, direction: &Vector) -> Reach {
        let direction = direction.component_mul(&self.semi_axes);
        if self.is_ellipsoid() {
            return Reach { of_outline: direction.xy().norm(), of_all: direction.norm() };
        }
        let of_outline = self.inner.of_normals.of(direction.x, direction.y);
        Reach { of_outline, of_all: self.outer.of_normals.of(of_outline, direction.z) }
    }

    /// The surface by the two angles of S eq. 2.2 in radians: about z from -pi to pi, and from the plane of x and y from -pi/2 to pi/2.
    pub fn surface_point(&self, about: f64, upwards: f64) -> Vector {
        let signed_power = |base: f64, exponent: f64| base.abs().powf(exponent).copysign(base);
        let [outer, inner] = self.exponents;
        let across = signed_power(upwards.cos(), outer);
        Vector::new(
            signed_power(about.cos(), inner) * across,
            signed_power(about.sin(), inner) * across,
            signed_power(upwards.sin(), outer),
        )
        .component_mul(&self.semi_axes)
    }

    /// Volume in m^3 (S eq. 2.3).
    pub fn volume(&self) -> f64 {
        let [outer, inner] = self.exponents;
        2.0 * self.semi_axes.product() * outer * inner * beta(0.5 * outer + 1.0, outer) * beta(0.5 * inner, 0.5 * inner)
    }

    /// Mean squares of the coordinates over the volume, in m^2 (S eq. 2.4, whose prefactor is printed as one over the density).
    pub fn mean_squares(&self) -> Vector {
        let [outer, inner] = self.exponents;
        let across = beta(1.5 * inner, 0.5 * inner) * beta(0.5 * outer, 2.0 * outer + 1.0);
        let along = 4.0 * beta(0.5 * inner, 0.5 * inner + 1.0) * beta(1.5 * outer, outer + 1.0);
        let scale = 0.5 * self.semi_axes.product() * outer * inner / self.volume();
        self.semi_axes.component_mul(&self.semi_axes).component_mul(&Vector::new(across, across, along)) * scale
    }

    /// Radius in m of the smallest ball about the centre that holds the shape.
    #[inline]
    pub fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }

    /// Radius in m of the largest ball about the centre that fits into the shape.
    pub fn inner_radius(&self) -> f64 {
        self.inner_radius
    }
}

/// Largest $\sqrt{(a u)^2 + (b v)^2}$ on the curve $|u|^p + |v|^p = 1$.
fn farthest(exponent: f64, a: f64, b: f64) -> f64 {
    let (large, small) = (a.max(b), a.min(b));
    if exponent <= 2.0 {
        return large;
    }
    // Hölder's inequality for squares: the exponent dual to p / 2.
    let dual = if exponent.is_finite() { exponent / (exponent - 2.0) } else { 1.0 };
    large * (1.0 + (small / large).powf(2.0 * dual)).powf(0.5 / dual)
}

/// The Beta function (S eq. 2.6).
fn beta(one: f64, other: f64) -> f64 {
    libm::tgamma(one) * libm::tgamma(other) / libm::tgamma(one + other)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Shapes of every kind of exponent: smaller and larger than one, equal and not.
    pub(crate) fn samples() -> Vec<Superellipsoid> {
        let exponents = [[1.0, 1.0], [0.2, 0.3], [1.5, 0.6], [0.1, 1.0], [0.5, 1.7], [1.9, 1.9], [1.0, 0.1], [0.1, 1.9]];
        let axes = [Vector::new(1.0, 2.0, 3.0), Vector::new(1.0, 1.5, 0.7), Vector::new(4.0, 4.0, 2.65)];
        let all = axes.into_iter().flat_map(|axes| exponents.map(|exponents| Superellipsoid::new(axes, exponents).unwrap()));
        all.collect()
    }

    pub(crate) fn directions() -> impl Iterator<Item = Vector> {
        (0..400).map(|index| {
            let (height, angle) = (-0.9975 + 0.005 * f64::from(index), 2.4 * f64::from(index));
            let across = (1.0 - height * height).sqrt();
            Vector::new(across * angle.cos(), across * angle.sin(), height)
        })
    }

    /// Independent: tanh-sinh quadrature, as `reference-facts` gives it.
    #[test]
    fn volume_and_inertia_match_quadrature() {
        let known = [
            ([1.0, 1.5, 0.7], [0.2, 0.3], [7.930_549_890_13, 6.786_985_651_24, 3.703_918_847_83, 8.015_973_688_88]),
            ([1.0, 1.5, 0.7], [1.5, 0.6], [3.628_987_453_27, 1.893_569_884_51, 0.981_972_320_747, 2.370_153_665_79]),
            ([4.0, 4.0, 2.65], [0.1, 1.0], [264.437_816_023, 1_661.572_395_18, 1_661.572_395_18, 2_101.720_647_64]),
            ([1.0, 1.0, 1.0], [2.0, 2.0], [1.333_333_333_33, 0.266_666_666_667, 0.266_666_666_667, 0.266_666_666_667]),
            ([1.0, 2.0, 0.5], [0.5, 1.7], [4.047_585_008_02, 3.074_282_651_93, 0.976_642_802_709, 3.496_066_415_37]),
        ];
        for (axes, exponents, expected) in known {
            let shape = Superellipsoid::new(axes.into(), exponents).unwrap();
            let squares = shape.mean_squares() * shape.volume();
            let inertia = [squares.y + squares.z, squares.z + squares.x, squares.x + squares.y];
            for (found, expected) in [shape.volume()].into_iter().chain(inertia).zip(expected) {
                // Twelve digits are given.
                assert!((found / expected - 1.0).abs() < 1e-11, "{exponents:?}: {found} {expected}");
            }
        }
    }

    #[test]
    fn the_gradient_is_the_slope_of_the_function() {
        for shape in samples() {
            for direction in directions().step_by(7) {
                let point = direction * (0.9 / shape.gauge(&direction));
                let gradient = shape.gradient(&point);
                let step = 1e-6 * shape.inner_radius();
                let slope = Vector::from_fn(|axis, _| {
                    let offset = Vector::ith(axis, step);
                    (shape.inside_outside(&(point + offset)) - shape.inside_outside(&(point - offset))) / (2.0 * step)
                });
                // Steep exponents bend on the scale of the distance to a plane of symmetry; such points are left out.
                if point.component_div(shape.semi_axes()).abs().min() > 0.02 {
                    assert!((slope - gradient).norm() < 2e-6 * gradient.norm(), "{:?} {point}: {slope} {gradient}", shape.exponents());
                }
            }
        }
    }

    #[test]
    fn the_support_is_on_the_surface_and_no_surface_point_reaches_farther() {
        for shape in samples() {
            let surface: Vec<_> = directions().map(|direction| direction / shape.gauge(&direction)).collect();
            for direction in directions() {
                let support = shape.support(&direction);
                assert!((shape.gauge(&support) - 1.0).abs() < 1e-13);
                let reach = support.dot(&direction);
                assert!((shape.reach(&direction).of_all / reach - 1.0).abs() < 1e-13);
                assert!(surface.iter().all(|point| point.dot(&direction) <= reach + 1e-12));
                let normal = shape.gradient_of_gauge(&support).normalize();
                // Where the point does not tell its normal, as on a corner of exponents near two, the reach does.
                let by_normal = shape.support(&normal).dot(&direction);
                assert!((reach - by_normal).abs() < 1e-10 * reach, "{:?} {direction}: {reach} {by_normal}", shape.exponents());
            }
        }
    }

    #[test]
    fn both_balls_and_the_box_bound_and_touch() {
        for shape in samples() {
            let (outer, inner) = (shape.bounding_radius(), shape.inner_radius());
            let (mut farthest, mut nearest) = (0.0_f64, f64::INFINITY);
            for index in 0..100_u32 {
                for other in 0..100_u32 {
                    let (about, upwards) = (f64::from(index) * 0.0157, f64::from(other) * 0.0157);
                    let direction = Vector::new(about.cos() * upwards.cos(), about.sin() * upwards.cos(), upwards.sin());
                    let radius = 1.0 / shape.gauge(&direction);
                    assert!(radius <= outer * (1.0 + 1e-14) && radius >= inner * (1.0 - 1e-14));
                    (farthest, nearest) = (farthest.max(radius), nearest.min(radius));
                }
            }
            assert!(farthest > 0.97 * outer && nearest < 1.03 * inner, "{:?}: {farthest} {outer} {nearest} {inner}", shape.exponents());
        }
    }

    #[test]
    fn angles_lead_to_the_surface() {
        for shape in samples() {
            for index in 0..300 {
                let (about, upwards) = (0.0205 * f64::from(index) - 3.1, 0.01 * f64::from(index) - 1.5);
                assert!((shape.gauge(&shape.surface_point(about, upwards)) - 1.0).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn what_is_not_convex_or_flat_is_refused() {
        let shape = |axes: [f64; 3], exponents| Superellipsoid::new(axes.into(), exponents).err();
        assert_eq!(shape([1.0, 0.0, 1.0], [1.0, 1.0]), Some(SuperellipsoidError::SemiAxis(0.0)));
        assert_eq!(shape([1.0, 1.0, 1.0], [1.0, 2.1]), Some(SuperellipsoidError::Exponent(2.1)));
        assert_eq!(shape([1.0, 1.0, 1.0], [0.0, 1.0]), Some(SuperellipsoidError::Exponent(0.0)));
        assert!(shape([1.0, f64::NAN, 1.0], [1.0, 1.0]).is_some() && shape([1.0; 3], [f64::NAN, 1.0]).is_some());
        assert_eq!(shape([1.0; 3], [2.0, 2.0]), None);
    }
}
