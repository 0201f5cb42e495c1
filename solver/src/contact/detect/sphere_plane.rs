//! A ball and a flat wall.

use crate::Vector;
use crate::boundary::Plane;
use crate::contact::Touch;

/// Contact of a ball with a flat wall; `None` if they do not overlap.
#[inline(always)]
pub fn sphere_plane(position: &Vector, radius: f64, plane: &Plane) -> Option<Touch> {
    plane.touch_sphere(position, radius).map(Touch::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_points_into_the_wall_and_the_arm_to_the_middle_of_the_overlap() {
        let plane = Plane { point: Vector::new(5.0, 5.0, 1.0), normal: Vector::z() };
        let touch = sphere_plane(&Vector::new(0.0, 0.0, 1.75), 1.0, &plane).expect("the ball is 0.25 into the wall");
        assert_eq!((touch.overlap, touch.normal), (0.25, -Vector::z()));
        assert_eq!(touch.arm_of_first, Vector::new(0.0, 0.0, -0.875));
        assert_eq!(sphere_plane(&Vector::new(0.0, 0.0, 2.0), 1.0, &plane), None);
    }
}
