//! Two ellipsoids, or an ellipsoid and a point: Newton's method on the direction alone.
//!
//! An ellipsoid reaches as far as $h(n) = \sqrt{n^T Q n}$ in a unit direction, with $Q = R\,\mathrm{diag}(a_i^2) R^T$, at the point $Q n / h$. The gap
//! between the supporting planes of two sets, $f(n) = n \cdot r - h_1(n) - h_2(n)$, is their distance at its largest, and less the depth of a shallow
//! overlap. Its gradient is the vector between both points, its second derivative $-(Q - h^{-2} Q n n^T Q) / h$ summed over both: two equations,
//! no powers. The general [common normal](super::common_normal) is the slow twin.

use nalgebra::{Matrix2, Matrix3};

use super::common_normal::{SHALLOW, basis};
use super::core::Core;
use super::{Known, Outcome, Relative, Separation};
use crate::Vector;

const LARGEST_NUMBER_OF_STEPS: usize = 12;

/// The matrix of a set that is an ellipsoid or a point, in its own frame.
fn squares(core: &Core) -> Option<Vector> {
    match core {
        Core::Superellipsoid(shape) if shape.is_ellipsoid() => Some(shape.semi_axes().component_mul(shape.semi_axes())),
        Core::Point => Some(Vector::zeros()),
        _ => None,
    }
}

/// A set seen along a direction: its point, how far it reaches, and its second derivative across two directions.
#[inline]
fn seen(matrix: &Matrix3<f64>, normal: &Vector, across: &nalgebra::Matrix3x2<f64>) -> (Vector, Matrix2<f64>) {
    let gradient = matrix * normal;
    let reach = normal.dot(&gradient).sqrt();
    if reach == 0.0 {
        return (Vector::zeros(), Matrix2::zeros());
    }
    let point = gradient / reach;
    let flat = across.tr_mul(&point);
    (point, (across.tr_mul(&(matrix * across)) - flat * flat.transpose()) / reach)
}

/// Signed distance of two ellipsoids or points, in the frame of the first, from a direction of any length but zero. `None` for other sets, and if
/// the result cannot be certified to a gap of `tolerance` in m.
#[inline]
pub fn separation(first: &Core, second: &Core, relative: &Relative, direction: &Vector, tolerance: f64) -> Option<Separation> {
    let own = Matrix3::from_diagonal(&squares(first)?);
    let scaled = relative.rotation * Matrix3::from_diagonal(&squares(second)?);
    let other = scaled * relative.rotation.transpose();
    let mut normal = direction.normalize();
    let mut last = f64::INFINITY;
    for _ in 0..LARGEST_NUMBER_OF_STEPS {
        let across = basis(&normal);
        let ((on_first, bend_of_first), (from_second, bend_of_second)) = (seen(&own, &normal, &across), seen(&other, &normal, &across));
        let between = relative.position - from_second - on_first;
        let distance = between.dot(&normal);
        let aside = across.tr_mul(&between);
        let error = aside.norm_squared();
        let bend = bend_of_first + bend_of_second + Matrix2::identity() * distance;
        let is_minimum = bend.m11 > 0.0 && bend.determinant() > 0.0;
        let scale = first.reach() + second.reach();
        // Apart, the vector between both points is as much longer than the gap between the planes as it leans aside.
        let gap = if distance > 0.0 { (distance * distance + error).sqrt() - distance } else { error.sqrt() };
        if gap <= tolerance && error.sqrt() <= CONVERGED * scale {
            let is_deep = -distance > SHALLOW * inner_radius(first).min(inner_radius(second));
            return (is_minimum && !is_deep).then(|| Separation {
                distance,
                normal,
                on_first,
                on_second: -from_second,
                gap,
                outcome: Outcome::Polished,
                known: Known::Nothing,
                corners: 0,
            });
        }
        if !is_minimum || error > last {
            return None;
        }
        last = error;
        let step = bend.try_inverse()? * aside;
        normal = (normal + across * step).normalize();
    }
    None
}

/// Distance across the normal over the size at which Newton's method has ended.
const CONVERGED: f64 = 1e-13;

fn inner_radius(core: &Core) -> f64 {
    match core {
        Core::Superellipsoid(shape) => shape.inner_radius(),
        _ => f64::INFINITY,
    }
}
