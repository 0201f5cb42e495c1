//! A flat convex polygon without thickness: what plates, gates and the triangles of meshes are made of.

use crate::Vector;

/// A flat convex polygon about its own centre.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    corners: Vec<Vector>,
    /// For each edge, from a corner to the next, a vector at right angles to it, in the plane, to the inside.
    inwards: Vec<Vector>,
    normal: Vector,
}

/// Where on a polygon a nearest point lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Feature {
    /// Inside, off the edges.
    Face,
    /// On the edge from the corner of this number to the next.
    Edge(usize),
    /// At the corner of this number.
    Corner(usize),
}

/// The point of a polygon nearest to another point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestOnPolygon {
    /// Distance in m.
    pub distance: f64,
    /// Unit vector from the point to the polygon; against the normal where the point lies on the polygon.
    pub direction: Vector,
    /// Where it lies.
    pub feature: Feature,
}

/// Why corners are not a flat convex polygon. Corners are counted from zero.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PolygonError {
    /// Fewer than three corners.
    #[error("needs at least 3 corners, has {count}")]
    TooFew {
        /// How many there are.
        count: usize,
    },
    /// A coordinate that is not a finite number.
    #[error("corner {corner} has a coordinate that is not a finite number")]
    NotFinite {
        /// The corner.
        corner: usize,
    },
    /// No area.
    #[error("has no area: its corners lie on a line, or so nearly that rounding hides its normal")]
    NoArea,
    /// A corner off the plane of the others.
    #[error("is not flat: corner {corner} lies {distance:e} m from the plane of all")]
    NotFlat {
        /// The corner.
        corner: usize,
        /// How far, in m.
        distance: f64,
    },
    /// A corner that turns the wrong way, or an outline that crosses itself.
    #[error("is not convex at corner {corner}: corners must be listed round the outline, each turning the same way")]
    NotConvex {
        /// The corner.
        corner: usize,
    },
}

/// Sine, or height relative to size, that is rounding of coordinates as people write them (some twelve digits).
const ROUNDING: f64 = 1e-9;

impl Polygon {
    /// A polygon from its corners in m in order round its outline, and the centre that it was moved from: the mean of its corners. The normal is the
    /// one about which the corners run counterclockwise.
    ///
    /// # Errors
    ///
    /// Anything that is not a flat convex polygon, to rounding, is refused; see [`PolygonError`].
    pub fn new(corners: &[Vector]) -> Result<(Polygon, Vector), PolygonError> {
        let count = corners.len();
        if count < 3 {
            return Err(PolygonError::TooFew { count });
        }
        if let Some(corner) = corners.iter().position(|corner| !corner.iter().all(|value| value.is_finite())) {
            return Err(PolygonError::NotFinite { corner });
        }
        // Divided first, so that no sum of finite numbers is infinite.
        let centre = corners.iter().map(|corner| corner / count as f64).sum::<Vector>();
        let corners: Vec<Vector> = corners.iter().map(|corner| corner - centre).collect();
        let size = corners.iter().map(|corner| corner.amax()).fold(0.0, f64::max);
        // In units of the size, so that squares neither overflow nor vanish.
        let unit = |place: usize| corners[place % count] / size;
        let area = (0..count).map(|place| unit(place).cross(&unit(place + 1))).sum::<Vector>();
        // What rounding of the coordinates as they were given may make of the area.
        let rounding = ROUNDING.max(64.0 * f64::EPSILON * centre.amax() / size);
        if !(size > 0.0 && size.is_finite() && area.norm() > rounding) {
            return Err(PolygonError::NoArea);
        }
        let normal = area.normalize();
        for (corner, place) in corners.iter().enumerate() {
            let distance = place.dot(&normal).abs();
            if distance > rounding * size {
                return Err(PolygonError::NotFlat { corner, distance });
            }
        }
        Polygon::check_outline(&corners, &normal, rounding)?;
        let inwards = (0..count).map(|place| normal.cross(&(corners[(place + 1) % count] - corners[place]))).collect();
        Ok((Polygon { corners, inwards, normal }, centre))
    }

    /// Every corner must turn left, and all turns together must make one round.
    fn check_outline(corners: &[Vector], normal: &Vector, rounding: f64) -> Result<(), PolygonError> {
        let count = corners.len();
        let mut turned = 0.0;
        for corner in 0..count {
            let into = (corners[corner] - corners[(corner + count - 1) % count]).try_normalize(0.0);
            let out_of = (corners[(corner + 1) % count] - corners[corner]).try_normalize(0.0);
            let (Some(into), Some(out_of)) = (into, out_of) else { return Err(PolygonError::NotConvex { corner }) };
            let (sine, cosine) = (into.cross(&out_of).dot(normal), into.dot(&out_of));
            if sine < -rounding || (sine <= rounding && cosine < 0.0) {
                return Err(PolygonError::NotConvex { corner });
            }
            turned += sine.atan2(cosine);
        }
        // A star turns left at every corner too, but goes round more than once.
        if turned > 1.5 * std::f64::consts::TAU {
            return Err(PolygonError::NotConvex { corner: 0 });
        }
        Ok(())
    }

    /// Corners in m about the centre, counterclockwise about the normal.
    pub fn corners(&self) -> &[Vector] {
        &self.corners
    }

    /// Unit normal.
    pub fn normal(&self) -> &Vector {
        &self.normal
    }

    /// Distance in m of the farthest corner from the centre.
    pub fn bounding_radius(&self) -> f64 {
        self.corners.iter().map(|corner| corner.norm()).fold(0.0, f64::max)
    }

    /// The point of the polygon nearest to a point given from its centre.
    ///
    /// Over the face the distance is the height, to the last bit that of an infinite wall. Otherwise the nearest point lies on one of the edges that
    /// have the point on their outer side.
    pub fn nearest(&self, point: &Vector) -> NearestOnPolygon {
        let height = (point - self.corners[0]).dot(&self.normal);
        let count = self.corners.len();
        let mut best: Option<(f64, Vector, Feature)> = None;
        for (place, (from, inwards)) in self.corners.iter().zip(&self.inwards).enumerate() {
            let to_point = point - from;
            if inwards.dot(&to_point) >= 0.0 {
                continue;
            }
            let next = if place + 1 == count { 0 } else { place + 1 };
            let edge = self.corners[next] - from;
            let part = edge.dot(&to_point) / edge.norm_squared();
            let (feature, vector) = if part <= 0.0 {
                (Feature::Corner(place), -to_point)
            } else if part >= 1.0 {
                (Feature::Corner(next), self.corners[next] - point)
            } else {
                (Feature::Edge(place), edge * part - to_point)
            };
            let squared = vector.norm_squared();
            if best.is_none_or(|(least, ..)| squared < least) {
                best = Some((squared, vector, feature));
            }
        }
        match best {
            None => self.over_face(height),
            Some((squared, vector, feature)) => {
                let distance = squared.sqrt();
                let direction = if distance > 0.0 { vector / distance } else { -self.normal };
                NearestOnPolygon { distance, direction, feature }
            }
        }
    }

    fn over_face(&self, height: f64) -> NearestOnPolygon {
        let direction = if height >= 0.0 { -self.normal } else { self.normal };
        NearestOnPolygon { distance: height.abs(), direction, feature: Feature::Face }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A pentagon in a tilted plane, as the image of one in the plane of x and y.
    fn tilted(corners: &[[f64; 2]]) -> (Polygon, Vector, [Vector; 2]) {
        let (x, y) = (Vector::new(0.6, 0.8, 0.0), Vector::new(-0.48, 0.36, 0.8));
        let place = |corner: &[f64; 2]| Vector::new(3.0, -1.0, 2.0) + x * corner[0] + y * corner[1];
        let (polygon, centre) = Polygon::new(&corners.iter().map(place).collect::<Vec<_>>()).unwrap();
        (polygon, centre, [x, y])
    }

    const PENTAGON: [[f64; 2]; 5] = [[0.0, 0.0], [2.0, -0.5], [3.0, 1.0], [1.5, 2.5], [-0.5, 1.0]];

    /// Dykstra's alternating projections onto the half-spaces inside each edge (Boyle and Dykstra 1986): they close in on the nearest point of the
    /// intersection and know nothing of edges and corners.
    fn by_projections(polygon: &Polygon, point: &Vector) -> Vector {
        let corners = polygon.corners();
        let mut nearest = point - polygon.normal() * (point - corners[0]).dot(polygon.normal());
        let mut corrections = vec![Vector::zeros(); corners.len()];
        for _ in 0..4000 {
            for (place, correction) in corrections.iter_mut().enumerate() {
                let inwards = polygon.normal().cross(&(corners[(place + 1) % corners.len()] - corners[place])).normalize();
                let from = nearest + *correction;
                nearest = from + inwards * (-(from - corners[place]).dot(&inwards)).max(0.0);
                *correction = from - nearest;
            }
        }
        nearest
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        /// At the angles of this pentagon 4000 rounds of projections leave less than rounding.
        #[test]
        fn the_nearest_point_is_that_of_alternating_projections(x in -4.0..6.0f64, y in -4.0..6.0f64, height in -3.0..3.0f64) {
            let (polygon, _, axes) = tilted(&PENTAGON);
            let point = axes[0] * x + axes[1] * y + polygon.normal() * height;
            let found = polygon.nearest(&point);
            let expected = by_projections(&polygon, &point);
            prop_assert!((point + found.direction * found.distance - expected).norm() < 1e-13, "{found:?} {expected}");
            prop_assert!((found.direction.norm() - 1.0).abs() < 4.0 * f64::EPSILON);
        }
    }

    #[test]
    fn face_edge_and_corner_have_their_distances() {
        let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 2.0, 0.0], [0.0, 2.0, 0.0]].map(Vector::from);
        let (plate, centre) = Polygon::new(&corners).unwrap();
        assert_eq!((centre, *plate.normal()), (Vector::new(2.0, 1.0, 0.0), Vector::z()));
        let nearest = |x: f64, y: f64, z: f64| plate.nearest(&(Vector::new(x, y, z) - centre));
        let face = nearest(1.0, 1.0, -0.25);
        assert_eq!((face.distance, face.direction, face.feature), (0.25, Vector::z(), Feature::Face));
        let edge = nearest(3.0, 5.0, 4.0);
        assert_eq!((edge.distance, edge.direction, edge.feature), (5.0, Vector::new(0.0, -0.6, -0.8), Feature::Edge(2)));
        let corner = nearest(6.0, -2.0, 1.0);
        assert_eq!((corner.distance, corner.feature), (3.0, Feature::Corner(1)));
        assert!((corner.direction - Vector::new(-2.0, 2.0, -1.0) / 3.0).norm() < 1e-15);
        // On the plate itself the direction is a choice, and still a unit vector.
        assert_eq!((nearest(1.0, 1.0, 0.0).distance, nearest(1.0, 1.0, 0.0).direction), (0.0, -Vector::z()));
    }

    #[test]
    fn what_is_no_flat_convex_polygon_is_refused() {
        let of = |corners: &[[f64; 3]]| Polygon::new(&corners.iter().map(|corner| Vector::from(*corner)).collect::<Vec<_>>()).map(|_| ());
        let star: Vec<[f64; 3]> =
            (0..5).map(|place| (f64::from(place) * 0.8 * std::f64::consts::PI).sin_cos()).map(|(y, x)| [x, y, 0.0]).collect();
        assert_eq!(of(&[[0.0; 3], [1.0, 0.0, 0.0]]), Err(PolygonError::TooFew { count: 2 }));
        assert_eq!(of(&[[0.0; 3], [1.0, f64::NAN, 0.0], [0.0, 1.0, 0.0]]), Err(PolygonError::NotFinite { corner: 1 }));
        assert_eq!(of(&[[0.0; 3], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0]]), Err(PolygonError::NoArea));
        assert_eq!(of(&[[5.0; 3]; 4]), Err(PolygonError::NoArea));
        assert!(matches!(
            of(&[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.1], [0.0, 1.0, 0.0]]),
            Err(PolygonError::NotFlat { distance, .. }) if distance > 0.02
        ));
        let dented = [[0.0; 3], [1.0, 0.0, 0.0], [0.3, 0.3, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(of(&dented), Err(PolygonError::NotConvex { corner: 2 }));
        assert!(matches!(of(&star), Err(PolygonError::NotConvex { .. })));
        let doubled = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert!(matches!(of(&doubled), Err(PolygonError::NotConvex { .. })));
        // A corner in the middle of a straight edge is harmless.
        assert_eq!(of(&[[0.0; 3], [0.5, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]), Ok(()));
    }
}
