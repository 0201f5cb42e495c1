//! A surface of triangles, open or closed, touched from both sides.
//!
//! A ball touches a surface where the distance to it has a minimum: in the faces over which its centre stands, at an edge or a corner only if no triangle that
//! has it comes nearer. So a ball that rolls over the seam of two triangles of a plane has one contact with the normal of the plane, and a ball in a
//! groove two. Where two contacts have almost the same normal, in a groove so shallow that it stands for a smooth surface, the deeper one counts: the
//! potential of a spring is then that of the distance, which has no jump, instead of growing with the number of triangles.

use std::collections::BTreeMap;
use std::sync::Arc;

use nalgebra::Matrix3;

use super::tree::{Extent, Tree};
use super::{PlacedPiece, SphereTouch};
use crate::Vector;
use crate::distance::polygon::{Feature, NearestOnPolygon};
use crate::distance::{Core, Polygon, PolygonError, Pose, RoundedCore};

/// A surface of triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    triangles: Vec<Triangle>,
    tree: Tree,
    /// Cosine of the angle between normals below which two contacts are one.
    smooth_cosine: f64,
    /// Largest coordinate, in m.
    size: f64,
}

#[derive(Debug, Clone, PartialEq)]
struct Triangle {
    polygon: Arc<Polygon>,
    core: RoundedCore,
    /// Mean of the corners, in m.
    centre: Vector,
    /// Numbers of its corners among the vertices of the mesh, equal ones under one number.
    vertices: [u32; 3],
}

/// Why vertices and triangles are not a surface. Both are counted from zero, in the order in which they were given.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// No triangle.
    #[error("needs at least one triangle")]
    Empty,
    /// More triangles than can be numbered.
    #[error("has {count} triangles; at most 2^32 - 1 can be numbered")]
    TooMany {
        /// How many there are.
        count: usize,
    },
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names vertex {vertex}, but there are only {count}, counted from 0")]
    NoSuchVertex {
        /// The triangle.
        triangle: usize,
        /// What it names.
        vertex: usize,
        /// How many there are.
        count: usize,
    },
    /// A triangle that is none.
    #[error("triangle {triangle} {error}")]
    Degenerate {
        /// The triangle.
        triangle: usize,
        /// What is wrong with it.
        error: PolygonError,
    },
}

/// A contact that may be one.
struct Candidate {
    triangle: u32,
    found: NearestOnPolygon,
}

/// Distances that differ by less than this part of the coordinates are equal.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

impl Mesh {
    /// A surface from vertices in m and triangles, each by three numbers of vertices. Contacts whose normals enclose less than `smooth_below` (in rad) are one.
    ///
    /// # Errors
    ///
    /// An empty surface, and triangles without area or with vertices that do not exist.
    pub fn new(vertices: &[Vector], triangles: &[[usize; 3]], smooth_below: f64) -> Result<Mesh, MeshError> {
        if triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        if triangles.len() >= u32::MAX as usize {
            return Err(MeshError::TooMany { count: triangles.len() });
        }
        let welded = weld(vertices);
        let place = |(triangle, corners): (usize, &[usize; 3])| {
            if let Some(vertex) = corners.iter().find(|vertex| **vertex >= vertices.len()) {
                return Err(MeshError::NoSuchVertex { triangle, vertex: *vertex, count: vertices.len() });
            }
            let made = Polygon::new(&corners.map(|corner| vertices[corner]));
            let (polygon, centre) = made.map_err(|error| MeshError::Degenerate { triangle, error })?;
            let polygon = Arc::new(polygon);
            let core = RoundedCore { core: Core::Polygon(polygon.clone()), radius: 0.0 };
            Ok(Triangle { polygon, core, centre, vertices: corners.map(|corner| welded[corner]) })
        };
        let triangles = triangles.iter().enumerate().map(place).collect::<Result<Vec<Triangle>, MeshError>>()?;
        let corners = |triangle: &Triangle| triangle.polygon.corners().iter().map(|corner| triangle.centre + corner).collect::<Vec<_>>();
        let extents: Vec<Extent> = triangles.iter().map(|triangle| Extent::of(corners(triangle))).collect();
        let size = triangles.iter().flat_map(corners).map(|corner| corner.amax()).fold(0.0, f64::max);
        Ok(Mesh { tree: Tree::new(&extents), triangles, smooth_cosine: smooth_below.cos(), size })
    }

    /// Number of triangles.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Whether there is no triangle: never.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    fn nearest(&self, triangle: u32, point: &Vector) -> NearestOnPolygon {
        let triangle = &self.triangles[triangle as usize];
        triangle.polygon.nearest(&(point - triangle.centre))
    }

    /// Distance in m of a point.
    pub fn distance(&self, point: &Vector) -> f64 {
        let mut least = f64::INFINITY;
        self.tree.within(point, f64::INFINITY, |triangle| {
            least = least.min(self.nearest(triangle, point).distance);
            least
        });
        least
    }

    /// Calls back with every triangle within reach of a point, and its nearest point.
    pub(super) fn each_within(&self, point: &Vector, reach: f64, mut call: impl FnMut(u32, NearestOnPolygon)) {
        self.tree.within(point, reach, |triangle| {
            let found = self.nearest(triangle, point);
            if found.distance <= reach {
                call(triangle, found);
            }
            reach
        });
    }

    /// A triangle as a convex set, for bodies of any shape.
    pub(super) fn as_core(&self, number: u32) -> PlacedPiece {
        let triangle = &self.triangles[number as usize];
        PlacedPiece { rounded: triangle.core.clone(), pose: Pose { position: triangle.centre, rotation: Matrix3::identity() }, number }
    }

    /// Adds the contacts of a ball to a list, the deepest first.
    pub fn touch_sphere(&self, position: &Vector, radius: f64, touches: &mut Vec<SphereTouch>) {
        let mut candidates = Vec::new();
        self.each_within(position, radius, |triangle, found| candidates.push(Candidate { triangle, found }));
        if candidates.is_empty() {
            return;
        }
        candidates
            .sort_unstable_by(|one, other| one.found.distance.total_cmp(&other.found.distance).then(one.triangle.cmp(&other.triangle)));
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

    /// Whether no triangle that has the same edge or corner comes nearer than rounding can tell.
    fn is_minimum(&self, candidate: &Candidate, nearer: &[Candidate], rounding: f64) -> bool {
        let vertices = &self.triangles[candidate.triangle as usize].vertices;
        let has = |triangle: &Triangle| match candidate.found.feature {
            Feature::Face => false,
            Feature::Edge(from) => triangle.vertices.contains(&vertices[from]) && triangle.vertices.contains(&vertices[(from + 1) % 3]),
            Feature::Corner(corner) => triangle.vertices.contains(&vertices[corner]),
        };
        let comes_nearer =
            |other: &Candidate| other.found.distance < candidate.found.distance - rounding && has(&self.triangles[other.triangle as usize]);
        !nearer.iter().any(comes_nearer)
    }
}

/// For each vertex the number of the first one at the same place: files that list each triangle on its own repeat vertices.
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
