//! A surface of triangles, or other flat convex faces, open or closed, touched from both sides.
//!
//! A ball touches a surface where the distance to it has a minimum: in the faces over which its centre stands, at an edge or a corner only if no face that
//! has it comes nearer. So a ball that rolls over the seam of two faces of a plane has one contact with the normal of the plane, and a ball in a
//! groove two. Where two contacts have almost the same normal, in a groove so shallow that it stands for a smooth surface, the deeper one counts: the
//! potential of a spring is then that of the distance, which has no jump, instead of growing with the number of faces. Faces are neighbours if they share
//! vertices; where a vertex lies within an edge of another face, the rule of angles alone keeps contacts from counting twice.

use std::collections::BTreeMap;
use std::sync::Arc;

use nalgebra::Matrix3;

use super::tree::{Extent, Tree};
use super::{PlacedPiece, SphereTouch};
use crate::Vector;
use crate::distance::polygon::{Feature, NearestOnPolygon};
use crate::distance::{Core, Polygon, PolygonError, Pose, RoundedCore};

/// A surface of flat convex faces.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    faces: Vec<Face>,
    tree: Tree,
    /// Cosine of the angle between normals below which two contacts are one.
    smooth_cosine: f64,
    /// Largest coordinate, in m.
    size: f64,
}

#[derive(Debug, Clone, PartialEq)]
struct Face {
    polygon: Arc<Polygon>,
    core: RoundedCore,
    /// Mean of the corners, in m.
    centre: Vector,
    /// Numbers of its corners among the vertices of the mesh, equal ones under one number.
    vertices: Vec<u32>,
}

/// Why vertices and faces are not a surface. Both are counted from zero, in the order in which they were given.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// No face.
    #[error("needs at least one face")]
    Empty,
    /// More faces than can be numbered.
    #[error("has {count} faces; at most 2^32 - 1 can be numbered")]
    TooMany {
        /// How many there are.
        count: usize,
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
    /// A face that is none.
    #[error("face {face} {error}")]
    Degenerate {
        /// The face.
        face: usize,
        /// What is wrong with it.
        error: PolygonError,
    },
}

/// A contact that may be one.
struct Candidate {
    face: u32,
    found: NearestOnPolygon,
}

/// Distances that differ by less than this part of the coordinates are equal.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

impl Mesh {
    /// A surface from vertices in m and faces, each by the numbers of its vertices in order round its outline. Contacts whose normals enclose less than
    /// `smooth_below` (in rad) are one.
    ///
    /// # Errors
    ///
    /// An empty surface, and faces that are no flat convex polygons or have vertices that do not exist.
    pub fn new(vertices: &[Vector], faces: &[impl AsRef<[usize]>], smooth_below: f64) -> Result<Mesh, MeshError> {
        if faces.is_empty() {
            return Err(MeshError::Empty);
        }
        if faces.len() >= u32::MAX as usize {
            return Err(MeshError::TooMany { count: faces.len() });
        }
        let welded = weld(vertices);
        let place = |(face, corners): (usize, &[usize])| {
            if let Some(vertex) = corners.iter().find(|vertex| **vertex >= vertices.len()) {
                return Err(MeshError::NoSuchVertex { face, vertex: *vertex, count: vertices.len() });
            }
            let places: Vec<Vector> = corners.iter().map(|corner| vertices[*corner]).collect();
            let (polygon, centre) = Polygon::new(&places).map_err(|error| MeshError::Degenerate { face, error })?;
            let polygon = Arc::new(polygon);
            let core = RoundedCore { core: Core::Polygon(polygon.clone()), radius: 0.0 };
            Ok(Face { polygon, core, centre, vertices: corners.iter().map(|corner| welded[*corner]).collect() })
        };
        let faces = faces.iter().map(AsRef::as_ref).enumerate().map(place).collect::<Result<Vec<Face>, MeshError>>()?;
        let corners = |face: &Face| face.polygon.corners().iter().map(|corner| face.centre + corner).collect::<Vec<_>>();
        let extents: Vec<Extent> = faces.iter().map(|face| Extent::of(corners(face))).collect();
        let size = faces.iter().flat_map(corners).map(|corner| corner.amax()).fold(0.0, f64::max);
        Ok(Mesh { tree: Tree::new(&extents), faces, smooth_cosine: smooth_below.cos(), size })
    }

    /// Number of faces.
    pub fn len(&self) -> usize {
        self.faces.len()
    }

    /// Whether there is no face: never.
    pub fn is_empty(&self) -> bool {
        self.faces.is_empty()
    }

    fn nearest(&self, face: u32, point: &Vector) -> NearestOnPolygon {
        let face = &self.faces[face as usize];
        face.polygon.nearest(&(point - face.centre))
    }

    /// Distance in m of a point.
    pub fn distance(&self, point: &Vector) -> f64 {
        let mut least = f64::INFINITY;
        self.tree.within(point, f64::INFINITY, |face| {
            least = least.min(self.nearest(face, point).distance);
            least
        });
        least
    }

    /// Calls back with every face within reach of a point, and its nearest point.
    pub(super) fn each_within(&self, point: &Vector, reach: f64, mut call: impl FnMut(u32, NearestOnPolygon)) {
        self.tree.within(point, reach, |face| {
            let found = self.nearest(face, point);
            if found.distance <= reach {
                call(face, found);
            }
            reach
        });
    }

    /// A face as a convex set, for bodies of any shape.
    pub(super) fn as_core(&self, number: u32) -> PlacedPiece {
        let face = &self.faces[number as usize];
        PlacedPiece { rounded: face.core.clone(), pose: Pose { position: face.centre, rotation: Matrix3::identity() }, number }
    }

    /// Adds the contacts of a ball to a list, the deepest first.
    pub fn touch_sphere(&self, position: &Vector, radius: f64, touches: &mut Vec<SphereTouch>) {
        let mut candidates = Vec::new();
        self.each_within(position, radius, |face, found| candidates.push(Candidate { face, found }));
        if candidates.is_empty() {
            return;
        }
        candidates.sort_unstable_by(|one, other| one.found.distance.total_cmp(&other.found.distance).then(one.face.cmp(&other.face)));
        let rounding = ROUNDING * (self.size + position.amax() + radius);
        let before = touches.len();
        for (place, candidate) in candidates.iter().enumerate() {
            let found = &candidate.found;
            let Some(touch) = SphereTouch::at(found.distance, found.direction, radius) else { break };
            let is_known = touches[before..].iter().any(|known| known.normal.dot(&touch.normal) > self.smooth_cosine);
            if !is_known && self.is_minimum(candidate, &candidates[..place], rounding) {
                touches.push(SphereTouch { is_deep: found.distance <= rounding, ..touch });
            }
        }
    }

    /// Whether no face that has the same edge or corner comes nearer than rounding can tell.
    fn is_minimum(&self, candidate: &Candidate, nearer: &[Candidate], rounding: f64) -> bool {
        let vertices = &self.faces[candidate.face as usize].vertices;
        let has = |face: &Face| match candidate.found.feature {
            Feature::Face => false,
            Feature::Edge(from) => {
                face.vertices.contains(&vertices[from]) && face.vertices.contains(&vertices[(from + 1) % vertices.len()])
            }
            Feature::Corner(corner) => face.vertices.contains(&vertices[corner]),
        };
        let comes_nearer =
            |other: &Candidate| other.found.distance < candidate.found.distance - rounding && has(&self.faces[other.face as usize]);
        !nearer.iter().any(comes_nearer)
    }
}

/// For each vertex the number of the first one at the same place: files that list each face on its own repeat vertices.
fn weld(vertices: &[Vector]) -> Vec<u32> {
    let mut known = BTreeMap::new();
    let mut number = |(index, vertex): (usize, &Vector)| {
        // Plus zero, so that zeros of either sign are one.
        let key: [u64; 3] = std::array::from_fn(|axis| (vertex[axis] + 0.0).to_bits());
        *known.entry(key).or_insert(index as u32)
    };
    vertices.iter().enumerate().map(&mut number).collect()
}

#[cfg(test)]
mod tests;
