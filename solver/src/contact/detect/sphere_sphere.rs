//! Two balls.

use crate::Vector;
use crate::contact::Touch;

/// Contact of two balls, from the position of the second relative to the first; `None` if they do not overlap.
///
/// Concentric balls get the normal along x and are flagged.
#[inline(always)]
pub fn sphere_sphere(relative_position: Vector, radius_of_first: f64, radius_of_second: f64) -> Option<Touch> {
    let reach = radius_of_first + radius_of_second;
    let squared = relative_position.norm_squared();
    if squared >= reach * reach {
        return None;
    }
    let distance = squared.sqrt();
    let is_concentric = distance == 0.0;
    let normal = if is_concentric { Vector::x() } else { relative_position * (1.0 / distance) };
    // Rounding may leave nothing of an overlap.
    let overlap = (reach - distance).max(f64::MIN_POSITIVE);
    Some(Touch {
        overlap,
        normal,
        arm_of_first: normal * (radius_of_first - 0.5 * overlap),
        arm_of_second: normal * (0.5 * overlap - radius_of_second),
        is_deep: is_concentric,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_points_from_first_to_second_and_both_arms_meet() {
        let relative = Vector::new(0.6, 0.0, 0.8) * 2.9;
        let touch = sphere_sphere(relative, 1.0, 2.0).expect("these balls overlap by 0.1");
        assert!((touch.overlap - 0.1).abs() < 8.0 * f64::EPSILON);
        assert!((touch.normal - Vector::new(0.6, 0.0, 0.8)).norm() < 4.0 * f64::EPSILON);
        assert!((touch.arm_of_first - (relative + touch.arm_of_second)).norm() < 8.0 * f64::EPSILON);
        assert!((touch.arm_of_first.norm() - 0.95).abs() < 8.0 * f64::EPSILON);
    }

    #[test]
    fn touching_is_not_overlapping_and_concentric_is_flagged() {
        assert_eq!(sphere_sphere(Vector::x() * 3.0, 1.0, 2.0), None);
        let touch = sphere_sphere(Vector::zeros(), 1.0, 2.0).expect("concentric balls overlap");
        assert!(touch.is_deep && touch.overlap == 3.0 && touch.normal.norm() == 1.0);
    }
}
