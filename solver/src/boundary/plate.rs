//! A flat convex polygon of finite size and no thickness: what hoppers and gates are made of.

use std::sync::Arc;

use nalgebra::Matrix3;

use super::{PlacedPiece, SphereTouch};
use crate::Vector;
use crate::distance::polygon::NearestOnPolygon;
use crate::distance::{Core, Polygon, PolygonError, Pose, RoundedCore};

/// A flat convex polygon, touched on both faces, at its edges and at its corners.
#[derive(Debug, Clone, PartialEq)]
pub struct Plate {
    polygon: Arc<Polygon>,
    /// The same for search.
    core: RoundedCore,
    /// Mean of the corners, in m.
    centre: Vector,
}

impl Plate {
    /// A plate from its corners in m, in order round its outline.
    ///
    /// # Errors
    ///
    /// Corners that are no flat convex polygon.
    pub fn new(corners: &[Vector]) -> Result<Plate, PolygonError> {
        let (polygon, centre) = Polygon::new(corners)?;
        let polygon = Arc::new(polygon);
        Ok(Plate { core: RoundedCore { core: Core::Polygon(polygon.clone()), radius: 0.0 }, polygon, centre })
    }

    /// Mean of the corners, in m.
    pub fn centre(&self) -> &Vector {
        &self.centre
    }

    /// The polygon about the centre.
    pub fn polygon(&self) -> &Polygon {
        &self.polygon
    }

    /// Nearest point as seen from a point.
    #[inline]
    pub fn nearest(&self, point: &Vector) -> NearestOnPolygon {
        self.polygon.nearest(&(point - self.centre))
    }

    /// Distance in m of a point.
    pub fn distance(&self, point: &Vector) -> f64 {
        self.nearest(point).distance
    }

    /// Contact of a ball; `None` if they do not overlap. A plate is convex, so there is one.
    #[inline]
    pub fn touch_sphere(&self, position: &Vector, radius: f64) -> Option<SphereTouch> {
        let found = self.nearest(position);
        let touch = SphereTouch::at(found.distance, found.direction, radius)?;
        Some(SphereTouch { is_deep: found.distance == 0.0, ..touch })
    }

    /// The plate as a convex set, for bodies of any shape.
    pub fn as_core(&self) -> PlacedPiece {
        let pose = Pose { position: self.centre, rotation: Matrix3::identity() };
        PlacedPiece { rounded: self.core.clone(), pose, number: 0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A gate of 4 m by 2 m at a height of 10 m.
    fn gate() -> Plate {
        Plate::new(&[[0.0, 0.0, 10.0], [4.0, 0.0, 10.0], [4.0, 2.0, 10.0], [0.0, 2.0, 10.0]].map(Vector::from)).unwrap()
    }

    #[test]
    fn a_ball_touches_faces_edges_and_corners_at_one_point_each() {
        let touch = |x: f64, y: f64, z: f64| gate().touch_sphere(&Vector::new(x, y, z), 1.0);
        let above = touch(1.0, 1.0, 10.75).unwrap();
        assert_eq!((above.overlap, above.normal, above.arm), (0.25, -Vector::z(), Vector::z() * -0.875));
        let below = touch(1.0, 1.0, 9.25).unwrap();
        assert_eq!((below.overlap, below.normal), (0.25, Vector::z()));
        // 3-4-5: beyond an edge by 0.3 m, above it by 0.4 m.
        let edge = touch(1.0, 2.3, 10.4).unwrap();
        assert!((edge.overlap - 0.5).abs() < 1e-15 && (edge.normal - Vector::new(0.0, -0.6, -0.8)).norm() < 4e-15);
        assert!((edge.arm - edge.normal * 0.75).norm() < 1e-15);
        // 2-3-6-7 eighths beyond a corner.
        let corner = touch(4.25, -0.375, 10.75).unwrap();
        assert_eq!(corner.overlap, 0.125);
        assert!((corner.normal - Vector::new(-2.0, 3.0, -6.0) / 7.0).norm() < 4e-15);
        assert_eq!(touch(1.0, 1.0, 11.0), None);
        let on_it = touch(1.0, 1.0, 10.0).unwrap();
        assert!(on_it.is_deep && on_it.overlap == 1.0 && on_it.normal == -Vector::z());
    }

    /// Over the face, a plate is an infinite wall to the last bit but those of the coordinates, however far from the origin.
    #[test]
    fn far_away_a_plate_is_as_exact_as_its_coordinates() {
        for shift in [0.0, 1e3, 1e6, 1e9] {
            let corners: Vec<Vector> = gate().polygon().corners().iter().map(|corner| corner + Vector::repeat(shift)).collect();
            let plate = Plate::new(&corners).unwrap();
            let touch = plate.touch_sphere(&(Vector::repeat(shift) + Vector::new(0.3, 0.2, 0.75)), 1.0).unwrap();
            assert!((touch.overlap - 0.25).abs() <= 4.0 * f64::EPSILON * shift.max(1.0), "{shift}: {touch:?}");
            assert!((touch.normal + Vector::z()).norm() < 1e-15);
        }
    }
}
