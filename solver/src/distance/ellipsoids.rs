//! Two ellipsoids, or an ellipsoid and a point: Newton's method on the direction alone.
//!
//! An ellipsoid reaches as far as $h(n) = \sqrt{n^T Q n}$ in a unit direction, with $Q = R\,\mathrm{diag}(a_i^2) R^T$, at the point $Q n / h$. The gap
//! between the supporting planes of two sets, $f(n) = n \cdot r - h_1(n) - h_2(n)$, is their distance at its largest, and less the depth of a shallow
//! overlap. Its gradient is the vector between both points, its second derivative $-(Q - h^{-2} Q n n^T Q) / h$ summed over both: two equations,
//! no powers. The general [common normal](super::common_normal) is the slow twin.

use nalgebra::{Matrix2, Matrix3, Matrix3x2};

use super::common_normal::{ROUNDED, SHALLOW, basis, left_by};
use super::core::Core;
use super::{Known, Outcome, Relative, Separation};
use crate::Vector;

const LARGEST_NUMBER_OF_STEPS: usize = 12;

/// The semi-axes of a set that is an ellipsoid or a point.
fn semi_axes(core: &Core) -> Option<Vector> {
    match core {
        Core::Superellipsoid(shape) if shape.is_ellipsoid() => Some(*shape.semi_axes()),
        Core::Point => Some(Vector::zeros()),
        _ => None,
    }
}

/// A set seen along a direction: its point, how far it reaches, and its second derivative across two directions. With $Q = M M^T$ all of it follows from
/// the direction and the plane across as the unit ball sees them, $M^T n$ and $M^T A$, where `onto` is $M$.
#[inline]
fn seen(normal_of_ball: &Vector, across_of_ball: &Matrix3x2<f64>, onto: impl Fn(&Vector) -> Vector) -> (Vector, Matrix2<f64>) {
    let reach = normal_of_ball.norm();
    if reach == 0.0 {
        return (Vector::zeros(), Matrix2::zeros());
    }
    let inverse = 1.0 / reach;
    let of_ball = normal_of_ball * inverse;
    let flat = across_of_ball.tr_mul(&of_ball);
    (onto(&of_ball), (across_of_ball.tr_mul(across_of_ball) - flat * flat.transpose()) * inverse)
}

/// Signed distance of two ellipsoids or points, in the frame of the first, from a direction of any length but zero. `None` for other sets, and if
/// the result cannot be certified to a gap of `tolerance` in m.
#[inline]
pub fn separation(first: &Core, second: &Core, relative: &Relative, direction: &Vector, tolerance: f64) -> Option<Separation> {
    let (own, other) = (semi_axes(first)?, semi_axes(second)?);
    let other = Matrix3::from_columns(&[0, 1, 2].map(|axis| relative.rotation.column(axis) * other[axis]));
    let mut normal = direction.normalize();
    let scale = first.reach() + second.reach();
    let (mut last, mut length_before) = (f64::INFINITY, None);
    for _ in 0..LARGEST_NUMBER_OF_STEPS {
        let across = basis(&normal);
        let along_own = |vector: Vector| vector.component_mul(&own);
        let own_across = Matrix3x2::from_columns(&[along_own(across.column(0).into()), along_own(across.column(1).into())]);
        let (on_first, bend_of_first) = seen(&along_own(normal), &own_across, |point| along_own(*point));
        let (from_second, bend_of_second) = seen(&other.tr_mul(&normal), &other.tr_mul(&across), |point| other * point);
        let between = relative.position - from_second - on_first;
        let distance = between.dot(&normal);
        let aside = across.tr_mul(&between);
        let error = aside.norm_squared();
        let bend = bend_of_first + bend_of_second + Matrix2::identity() * distance;
        let determinant = bend.determinant();
        let is_minimum = bend.m11 > 0.0 && determinant > 0.0;
        // Apart, the vector between both points is as much longer than the gap between the planes as it leans aside.
        let gap = if distance > 0.0 { (distance * distance + error).sqrt() - distance } else { error.sqrt() };
        let answer = |found: Separation| {
            let is_deep = -distance > SHALLOW * inner_radius(first).min(inner_radius(second));
            (is_minimum && !is_deep).then_some(found)
        };
        let found = Separation {
            distance,
            normal,
            on_first,
            on_second: -from_second,
            gap,
            outcome: Outcome::Polished,
            known: Known::Nothing,
            corners: 0,
        };
        if gap <= tolerance && error.sqrt() <= CONVERGED * scale {
            return answer(found);
        }
        if !is_minimum || error > last {
            return None;
        }
        last = error;
        let step = Matrix2::new(bend.m22, -bend.m12, -bend.m21, bend.m11) * aside / determinant;
        let length = step.norm();
        let left = left_by(length, length_before);
        if left <= ROUNDED.min(tolerance / scale) && (distance <= 0.0 || gap <= tolerance) {
            let turn = across * step;
            return answer(Separation {
                // The gap between the planes grows by half its slope times the step.
                distance: distance + 0.5 * aside.dot(&step),
                normal: (normal + turn).normalize(),
                on_first: on_first + across * (bend_of_first * step),
                on_second: -from_second - across * (bend_of_second * step),
                gap: if distance > 0.0 { gap } else { left * scale },
                ..found
            });
        }
        length_before = Some(length);
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
