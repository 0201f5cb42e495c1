//! The surface of a box.

use super::outline::intervals;
use super::{Foot, Surface};
use crate::Vector;
use crate::shape::Cuboid;

impl Surface for Cuboid {
    fn foot(&self, point: &Vector) -> Foot {
        let side = point.map(|along| if along < 0.0 { -1.0 } else { 1.0 });
        let beyond = point.abs() - self.half_lengths();
        let outside = beyond.map(|along| along.max(0.0));
        let distance = outside.norm();
        if distance > 0.0 {
            return Foot { distance, normal: outside.component_mul(&side) / distance };
        }
        let direction = beyond.imax();
        let mut normal = Vector::zeros();
        normal[direction] = side[direction];
        Foot { distance: beyond[direction], normal }
    }

    fn bounding_radius(&self) -> f64 {
        self.half_lengths().norm()
    }

    /// A lattice of rectangles on each face, corners and edges among its points (R section 7.3.4).
    fn points(&self, spacing: f64) -> Vec<Vector> {
        let parts: [usize; 3] = std::array::from_fn(|direction| intervals(self.lengths[direction], spacing));
        let place = |cell: [usize; 3]| {
            let along = |direction: usize| self.lengths[direction] * (cell[direction] as f64 / parts[direction] as f64 - 0.5);
            Vector::from_fn(|direction, _| along(direction))
        };
        let mut points = Vec::new();
        for k in 0..=parts[2] {
            for j in 0..=parts[1] {
                let is_side = k == 0 || k == parts[2] || j == 0 || j == parts[1];
                let row = (0..=parts[0]).filter(|i| is_side || *i == 0 || *i == parts[0]);
                points.extend(row.map(|i| place([i, j, k])));
            }
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coupling::resolved::surface::checks::{assert_feet_are_nearest, assert_points_are_spread, assert_volume_inside};

    const BRICK: Cuboid = Cuboid { lengths: Vector::new(1.0, 0.7, 0.4) };

    #[test]
    fn feet_on_a_box_are_nearest() {
        assert_feet_are_nearest(&BRICK, 0.01);
        assert_volume_inside(&BRICK, 0.28);
        let middle = BRICK.foot(&Vector::new(0.0, 0.0, -0.1));
        assert_eq!((middle.distance, middle.normal), (-0.1, -Vector::z()));
    }

    #[test]
    fn points_of_a_box_are_evenly_spread() {
        for spacing in [0.1, 0.06, 0.033] {
            assert_points_are_spread(&BRICK, spacing);
        }
    }
}
