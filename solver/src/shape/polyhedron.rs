//! A convex polyhedron.

use super::mass::MassProperties;
use crate::Vector;

/// A closed convex polyhedron, centred at its centre of mass.
#[derive(Debug, Clone, PartialEq)]
pub struct Polyhedron {
    vertices: Vec<Vector>,
    /// Vertices of each face, counterclockwise seen from outside.
    faces: Vec<Vec<usize>>,
    mass_properties: MassProperties,
}

/// Why vertices and faces are not a convex polyhedron.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PolyhedronError {
    /// No volume.
    #[error("has no volume")]
    Flat,
}

impl Polyhedron {
    /// Corners in m.
    pub fn vertices(&self) -> &[Vector] {
        &self.vertices
    }

    /// Vertices of each face by index, counterclockwise seen from outside.
    pub fn faces(&self) -> &[Vec<usize>] {
        &self.faces
    }

    /// Volume, centre (at the origin) and second moments, exact.
    pub fn mass_properties(&self) -> &MassProperties {
        &self.mass_properties
    }

    /// Distance in m of the farthest corner from the centre of mass.
    pub fn bounding_radius(&self) -> f64 {
        self.vertices.iter().map(|vertex| vertex.norm()).fold(0.0, f64::max)
    }

    /// Distance in m of the nearest face from the centre of mass.
    pub fn inner_radius(&self) -> f64 {
        todo!()
    }

    /// Whether a point lies inside or on the surface.
    pub fn contains(&self, _point: &Vector) -> bool {
        todo!()
    }
}
impl Polyhedron {
    pub(crate) fn face_normals(&self) -> impl Iterator<Item = Vector> + '_ { std::iter::empty() }
    pub(crate) fn inset(&self, _t: f64) -> Option<Polyhedron> { None }
    pub(crate) fn scaled(&self, _t: f64) -> Polyhedron { self.clone() }
}
