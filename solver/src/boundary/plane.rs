//! An infinite flat wall.

use super::SphereTouch;
use crate::Vector;

/// A flat wall at rest: bodies live on the side its normal points to.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    /// Any point of the wall, in m.
    pub point: Vector,
    /// Unit normal, out of the wall into the space where bodies are.
    pub normal: Vector,
}

impl Plane {
    /// The six walls of a rectangular box, for bodies inside, in the order -x, +x, -y, +y, -z, +z of the sides they stand at.
    pub fn of_box(lower: &Vector, upper: &Vector) -> [Plane; 6] {
        std::array::from_fn(|side| {
            let normal = Vector::ith(side / 2, if side % 2 == 0 { 1.0 } else { -1.0 });
            Plane { point: if side % 2 == 0 { *lower } else { *upper }, normal }
        })
    }

    /// Height of a point above the wall in m; negative inside the wall.
    #[inline]
    pub fn height(&self, point: &Vector) -> f64 {
        (point - self.point).dot(&self.normal)
    }

    /// Contact of a ball; `None` if they do not overlap.
    #[inline]
    pub fn touch_sphere(&self, position: &Vector, radius: f64) -> Option<SphereTouch> {
        SphereTouch::at(self.height(position), -self.normal, radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Inside, the least height is the distance from the nearest side; a ball in a corner touches three.
    #[test]
    fn the_walls_of_a_box_enclose_it() {
        let walls = Plane::of_box(&Vector::new(-1.0, -2.0, -3.0), &Vector::new(1.0, 3.0, 5.0));
        let heights = walls.each_ref().map(|wall| wall.height(&Vector::new(0.25, 0.5, 1.0)));
        assert_eq!(heights, [1.25, 0.75, 2.5, 2.5, 4.0, 4.0]);
        let corner = Vector::new(0.5, -1.5, 4.5);
        let touches: Vec<_> = walls.iter().filter_map(|wall| wall.touch_sphere(&corner, 0.75)).collect();
        assert_eq!(touches.iter().map(|touch| touch.normal).collect::<Vec<_>>(), [Vector::x(), -Vector::y(), Vector::z()]);
        assert!(touches.iter().all(|touch| touch.overlap == 0.25 && touch.arm == touch.normal * 0.625 && !touch.is_deep));
    }

    #[test]
    fn normal_points_into_the_wall_and_the_arm_to_the_middle_of_the_overlap() {
        let plane = Plane { point: Vector::new(5.0, 5.0, 1.0), normal: Vector::z() };
        let touch = plane.touch_sphere(&Vector::new(0.0, 0.0, 1.75), 1.0).expect("the ball is 0.25 into the wall");
        assert_eq!((touch.overlap, touch.normal, touch.arm), (0.25, -Vector::z(), Vector::new(0.0, 0.0, -0.875)));
        assert_eq!(plane.touch_sphere(&Vector::new(0.0, 0.0, 2.0), 1.0), None);
        // However deep, even with the centre inside the wall.
        assert_eq!(plane.touch_sphere(&Vector::zeros(), 1.0).map(|touch| touch.overlap), Some(2.0));
    }
}
