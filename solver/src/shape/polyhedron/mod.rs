//! A convex polyhedron.

mod faces;
mod hull;
mod inset;
mod named;

use super::mass::MassProperties;
use super::mass::tetrahedra::surface_moments;
use crate::Vector;

/// A closed convex polyhedron, centred at its centre of mass.
#[derive(Debug, Clone, PartialEq)]
pub struct Polyhedron {
    vertices: Vec<Vector>,
    /// Vertices of each face, counterclockwise seen from outside.
    faces: Vec<Vec<usize>>,
    /// Unit normal of each face, pointing outwards.
    normals: Vec<Vector>,
    /// Distance of the plane of each face from the origin, along its normal.
    distances: Vec<f64>,
    bounding_radius: f64,
    mass_properties: MassProperties,
    offset: Vector,
}

/// Why vertices and faces are not a convex polyhedron. Vertices and faces are counted from zero, in the order in which they were given.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PolyhedronError {
    /// Fewer than four vertices.
    #[error("needs at least 4 vertices and 4 faces, has {vertices} and {faces}")]
    TooFew {
        /// How many vertices there are.
        vertices: usize,
        /// How many faces there are.
        faces: usize,
    },
    /// A coordinate that is not a finite number.
    #[error("vertex {vertex} has a coordinate that is not a finite number")]
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
    /// A face names a vertex that does not exist.
    #[error("face {face} names vertex {vertex}, but there are only {count}, counted from 0")]
    NoSuchVertex {
        /// The face.
        face: usize,
        /// What it names.
        vertex: usize,
        /// How many there are.
        count: usize,
    },
    /// A face of fewer than three vertices, or one that names a vertex twice.
    #[error("face {face} needs at least 3 vertices, each named once")]
    TooFewCorners {
        /// The face.
        face: usize,
    },
    /// Two vertices at one place.
    #[error("vertices {first} and {second} lie at the same place")]
    Coincident {
        /// The one.
        first: usize,
        /// The other.
        second: usize,
    },
    /// A vertex that no face names.
    #[error("vertex {vertex} belongs to no face")]
    Unused {
        /// The vertex.
        vertex: usize,
    },
    /// An edge that two faces do not share in opposite directions.
    #[error(
        "the edge from vertex {from} to vertex {to} must be used once in this direction and once back: it is used {forth} and {back} times; \
         faces must close, and each must list its vertices counterclockwise seen from outside"
    )]
    Open {
        /// Where the edge begins.
        from: usize,
        /// Where it ends.
        to: usize,
        /// How many faces use it in this direction.
        forth: usize,
        /// How many use it the other way.
        back: usize,
    },
    /// No volume.
    #[error("has no volume")]
    Flat,
    /// A face without area.
    #[error("face {face} has no area")]
    NoArea {
        /// The face.
        face: usize,
    },
    /// A face that looks inwards.
    #[error("face {face} looks inwards: its vertices must be listed counterclockwise seen from outside")]
    Inward {
        /// The face.
        face: usize,
    },
    /// A face that is not flat.
    #[error("face {face} is not flat: vertex {vertex} lies {distance:e} m from its plane")]
    NotPlanar {
        /// The face.
        face: usize,
        /// The vertex of it that lies farthest from its plane.
        vertex: usize,
        /// How far, in m.
        distance: f64,
    },
    /// A vertex on the outer side of a face.
    #[error("is not convex: vertex {vertex} lies {distance:e} m outside the plane of face {face}")]
    NotConvex {
        /// The face.
        face: usize,
        /// The vertex.
        vertex: usize,
        /// How far, in m.
        distance: f64,
    },
    /// Points whose convex hull could not be found.
    #[error("the convex hull of the points could not be found: some lie so close to its faces that rounding decides on which side")]
    NoHull,
}

impl Polyhedron {
    /// A convex polyhedron from its corners in m and, for each face, the indices of its corners counterclockwise seen from outside. It is
    /// moved so that its centre of mass lies at the origin; [`Polyhedron::offset`] tells by how much.
    ///
    /// # Errors
    ///
    /// Anything that is not a closed convex polyhedron with flat faces, to rounding, is refused; see [`PolyhedronError`].
    pub fn from_faces(vertices: Vec<Vector>, faces: Vec<Vec<usize>>) -> Result<Polyhedron, PolyhedronError> {
        faces::check(&vertices, &faces)?;
        let centre = surface_moments(&vertices, &faces).centre;
        let centred = vertices.iter().map(|vertex| vertex - centre).collect();
        let mut polyhedron = Polyhedron::assembled(centred, faces, centre);
        // The centre that is left is that of coordinates rounded once more.
        polyhedron.mass_properties.centre = Vector::zeros();
        Ok(polyhedron)
    }

    /// A polyhedron in the frame in which it is given, unchecked.
    fn assembled(vertices: Vec<Vector>, faces: Vec<Vec<usize>>, offset: Vector) -> Polyhedron {
        let planes = faces.iter().map(|face| faces::plane(&vertices, face));
        let (normals, distances) = planes.map(|(area, middle)| (area.normalize(), area.normalize().dot(&middle))).unzip();
        let mass_properties = surface_moments(&vertices, &faces);
        let bounding_radius = vertices.iter().map(|vertex| vertex.norm()).fold(0.0, f64::max);
        Polyhedron { vertices, faces, normals, distances, bounding_radius, mass_properties, offset }
    }

    /// The same polyhedron, smaller or larger about its origin.
    #[must_use]
    pub fn scaled(&self, ratio: f64) -> Polyhedron {
        let vertices = self.vertices.iter().map(|vertex| vertex * ratio).collect();
        Polyhedron::assembled(vertices, self.faces.clone(), self.offset)
    }

    /// Corners in m.
    pub fn vertices(&self) -> &[Vector] {
        &self.vertices
    }

    /// Vertices of each face by index, counterclockwise seen from outside.
    pub fn faces(&self) -> &[Vec<usize>] {
        &self.faces
    }

    /// Unit normals of the faces, pointing outwards.
    pub fn face_normals(&self) -> &[Vector] {
        &self.normals
    }

    /// Distance in m of the plane of each face from the origin, along its normal.
    pub fn face_distances(&self) -> &[f64] {
        &self.distances
    }

    /// Volume, centre (at the origin, unless it is an [inset](Polyhedron::inset)) and second moments, exact.
    pub fn mass_properties(&self) -> &MassProperties {
        &self.mass_properties
    }

    /// Where the origin, which is the centre of mass, lay in the coordinates that were given, in m.
    pub fn offset(&self) -> Vector {
        self.offset
    }

    /// Distance in m of the farthest corner from the origin.
    pub fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }

    /// Distance in m of the nearest face from the origin.
    pub fn inner_radius(&self) -> f64 {
        self.distances.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Whether a point lies inside or on the surface.
    pub fn contains(&self, point: &Vector) -> bool {
        self.normals.iter().zip(&self.distances).all(|(normal, distance)| normal.dot(point) <= *distance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Cuboid;

    /// A box with a corner at `corner`, by its eight corners and six faces.
    fn brick(corner: Vector, lengths: Vector) -> Result<Polyhedron, PolyhedronError> {
        let place = |index: usize| Vector::new((index & 1) as f64, ((index >> 1) & 1) as f64, (index >> 2) as f64);
        let vertices = (0..8).map(|index| corner + place(index).component_mul(&lengths)).collect();
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        Polyhedron::from_faces(vertices, faces.iter().map(|face| face.to_vec()).collect())
    }

    #[test]
    fn a_box_by_its_faces_is_the_box_by_its_lengths() {
        let lengths = Vector::new(2.0, 1.0, 3.0);
        let polyhedron = brick(Vector::new(5.0, -1.0, 0.5), lengths).unwrap();
        let cuboid = Cuboid { lengths };
        let expected = MassProperties::centred(cuboid.volume(), cuboid.mean_squares());
        let found = polyhedron.mass_properties();
        assert!((found.volume - expected.volume).abs() < 8.0 * f64::EPSILON * expected.volume);
        assert!((found.second_moments - expected.second_moments).norm() < 8.0 * f64::EPSILON * expected.second_moments.norm());
        assert!((polyhedron.offset() - Vector::new(6.0, -0.5, 2.0)).norm() < 8.0 * f64::EPSILON);
        assert!((polyhedron.bounding_radius() - 0.5 * 14.0_f64.sqrt()).abs() < 4.0 * f64::EPSILON);
        assert!((polyhedron.inner_radius() - 0.5).abs() < 4.0 * f64::EPSILON);
        assert!(polyhedron.contains(&Vector::new(0.99, 0.49, -1.49)) && !polyhedron.contains(&Vector::new(0.99, 0.51, -1.49)));
        assert_eq!(polyhedron.face_normals()[1], Vector::z());
        assert_eq!(polyhedron.face_distances()[1], 1.5);
    }

    /// Independent: the moments of the tetrahedron of the unit corner are integrals of x^a y^b z^c by Dirichlet's formula:
    /// volume 1/6, centre 1/4, mean of x^2 1/10, mean of xy 1/20.
    #[test]
    fn a_corner_tetrahedron_has_the_moments_of_dirichlet() {
        let vertices = vec![Vector::zeros(), Vector::x(), Vector::y(), Vector::z()];
        let faces = vec![vec![0, 2, 1], vec![0, 1, 3], vec![0, 3, 2], vec![1, 2, 3]];
        let corner = Polyhedron::from_faces(vertices, faces).unwrap();
        let moments = corner.mass_properties();
        assert!((corner.offset() - Vector::repeat(0.25)).norm() < 2.0 * f64::EPSILON && moments.centre == Vector::zeros());
        assert!((moments.volume - 1.0 / 6.0).abs() < f64::EPSILON);
        let expected = |row: usize, column: usize| (if row == column { 0.1 } else { 0.05 } - 0.0625) / 6.0;
        for (row, column) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)] {
            assert!((moments.second_moments[(row, column)] - expected(row, column)).abs() < f64::EPSILON, "{row} {column}");
        }
    }

    #[test]
    fn a_box_far_from_the_origin_is_still_a_box() {
        let lengths = Vector::new(2.0, 1.0, 3.0);
        let far = brick(Vector::repeat(1e4), lengths).unwrap();
        assert!((far.mass_properties().volume - 6.0).abs() < 1e4 * 16.0 * f64::EPSILON);
        assert!((far.offset() - Vector::new(10001.0, 10000.5, 10001.5)).norm() < 1e4 * 4.0 * f64::EPSILON);
    }
}
