//! What is left of a convex polyhedron when every face moves inwards.

use std::collections::BTreeMap;

use nalgebra::Matrix3;

use super::Polyhedron;
use super::faces::{coincident, rounding};
use super::hull::hull_faces;
use crate::Vector;

impl Polyhedron {
    /// All points at least `thickness` (in m) inside the plane of every face, in the frame of this polyhedron: it is not centred again. `None` if
    /// the thickness is not less than the [inner radius](Polyhedron::inner_radius), or if rounding hides what is left.
    ///
    /// As long as no edge has shrunk to nothing, each corner follows its faces. Otherwise the corners are found by polarity: the planes
    /// `n . x = d` about the origin are the points `n / d`, and the faces of their convex hull are the corners that are left.
    pub fn inset(&self, thickness: f64) -> Option<Polyhedron> {
        // Written so that a thickness that is not a number is refused as well.
        if !(thickness >= 0.0 && thickness < self.inner_radius()) {
            return None;
        }
        let distances: Vec<f64> = self.distances.iter().map(|distance| distance - thickness).collect();
        self.shrunk(&distances).or_else(|| self.by_polarity(&distances))
    }

    /// The same faces and corners, each corner where its moved faces meet; `None` if they do not meet or some corner is cut off.
    fn shrunk(&self, distances: &[f64]) -> Option<Polyhedron> {
        let mut faces_of = vec![Vec::new(); self.vertices.len()];
        for (face, corners) in self.faces.iter().enumerate() {
            corners.iter().for_each(|corner| faces_of[*corner].push(face));
        }
        let vertices: Vec<Vector> = faces_of.iter().map(|faces| self.meeting_point(faces, distances)).collect::<Option<_>>()?;
        let tolerance = rounding(&self.vertices);
        let height = |face: usize, vertex: &Vector| self.normals[face].dot(vertex) - distances[face];
        let inside = |vertex: &Vector| (0..self.faces.len()).all(|face| height(face, vertex) <= tolerance);
        let touches = |(vertex, faces): (&Vector, &Vec<usize>)| faces.iter().all(|face| height(*face, vertex) >= -tolerance);
        let whole = vertices.iter().all(inside) && vertices.iter().zip(&faces_of).all(touches);
        (whole && coincident(&vertices, tolerance).is_none())
            .then(|| self.inset_of(vertices, self.faces.clone(), self.normals.clone(), distances.to_vec()))
    }

    /// Polar dual of the hull of the polar dual: planes that no longer bound anything drop out, corners that split become several.
    fn by_polarity(&self, distances: &[f64]) -> Option<Polyhedron> {
        let duals: Vec<Vector> = self.normals.iter().zip(distances).map(|(normal, distance)| normal / *distance).collect();
        let corners = hull_faces(&duals).ok()?;
        let vertices: Vec<Vector> = corners.iter().map(|planes| self.meeting_point(planes, distances)).collect::<Option<_>>()?;
        // The corner that has the plane `from` and, next counterclockwise, the plane `to`.
        let mut corner_at: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for (corner, planes) in corners.iter().enumerate() {
            for (from, to) in planes.iter().zip(planes.iter().cycle().skip(1)) {
                corner_at.insert((*from, *to), corner);
            }
        }
        let bounding: Vec<usize> = (0..duals.len()).filter(|plane| corners.iter().any(|planes| planes.contains(plane))).collect();
        let faces = bounding.iter().map(|plane| around(*plane, &corners, &corner_at)).collect::<Option<_>>()?;
        let normals = bounding.iter().map(|plane| self.normals[*plane]).collect();
        Some(self.inset_of(vertices, faces, normals, bounding.iter().map(|plane| distances[*plane]).collect()))
    }

    /// Where three or more planes meet; if they do not meet in a point, the point closest to all of them.
    fn meeting_point(&self, planes: &[usize], distances: &[f64]) -> Option<Vector> {
        let normal = |plane: &usize| self.normals[*plane];
        let squares: Matrix3<f64> = planes.iter().map(|plane| normal(plane) * normal(plane).transpose()).sum();
        let inverse = squares.try_inverse()?;
        let start: Vector = inverse * planes.iter().map(|plane| normal(plane) * distances[*plane]).sum::<Vector>();
        // Once more for what rounding has left: the normal equations alone lose twice the digits.
        let left = planes.iter().map(|plane| normal(plane) * (distances[*plane] - normal(plane).dot(&start))).sum::<Vector>();
        Some(start + inverse * left)
    }

    /// An inset from its parts: planes are kept as they are, not found again from rounded corners.
    fn inset_of(&self, vertices: Vec<Vector>, faces: Vec<Vec<usize>>, normals: Vec<Vector>, distances: Vec<f64>) -> Polyhedron {
        Polyhedron { normals, distances, ..Polyhedron::assembled(vertices, faces, self.offset) }
    }
}

/// The corners around a plane, counterclockwise: at each the plane before this one leads on to the next corner.
fn around(plane: usize, corners: &[Vec<usize>], corner_at: &BTreeMap<(usize, usize), usize>) -> Option<Vec<usize>> {
    let start = corners.iter().position(|planes| planes.contains(&plane))?;
    let mut loop_of_corners = vec![start];
    while loop_of_corners.len() <= corners.len() {
        let planes = &corners[*loop_of_corners.last()?];
        let place = planes.iter().position(|other| *other == plane)?;
        let before = planes[(place + planes.len() - 1) % planes.len()];
        let next = *corner_at.get(&(plane, before))?;
        if next == start {
            return Some(loop_of_corners);
        }
        loop_of_corners.push(next);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::faces::plane;
    use super::*;

    fn volume(polyhedron: &Polyhedron) -> f64 {
        polyhedron.mass_properties().volume
    }

    /// A pyramid of four unequal slopes: its tip splits into two as soon as the planes move.
    fn skew_pyramid() -> Polyhedron {
        let base = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(|(x, y)| Vector::new(x, y, 0.0));
        Polyhedron::hull(&[&base[..], &[Vector::new(0.5, 0.2, 1.0)]].concat()).unwrap()
    }

    /// The planes of a regular solid all touch one ball: its inset is the same solid, smaller.
    #[test]
    fn regular_solids_shrink_in_proportion() {
        let solids = [Polyhedron::tetrahedron(2e-3), Polyhedron::octahedron(2e-3), Polyhedron::icosahedron(2e-3)];
        for solid in solids.map(Result::unwrap) {
            for share in [0.0, 0.02, 0.5, 0.97] {
                let inset = solid.inset(share * solid.inner_radius()).unwrap();
                assert_eq!(inset.faces(), solid.faces());
                let expected = (1.0 - share).powi(3) * volume(&solid);
                let floor = f64::EPSILON / (1.0 - share);
                assert!((volume(&inset) / expected - 1.0).abs() < 64.0 * floor, "{share} {}", volume(&inset) / expected - 1.0);
                for (whole, part) in solid.vertices().iter().zip(inset.vertices()) {
                    assert!((whole * (1.0 - share) - part).norm() < 16.0 * f64::EPSILON * solid.bounding_radius());
                }
            }
            assert_eq!(solid.inset(solid.inner_radius()), None);
            assert_eq!(solid.inset(f64::NAN), None);
            assert_eq!(solid.inset(-1.0), None);
        }
    }

    /// A roof over a 4 x 2 base with all slopes of 45 degrees has a ridge of length 2. Independent: what is left under planes moved by t is
    /// a roof whose base is narrower by `t (1 + sqrt 2)` on each side; the ridge stays as long.
    #[test]
    fn a_roof_keeps_its_ridge() {
        let points = [(2.0, 1.0), (-2.0, 1.0), (-2.0, -1.0), (2.0, -1.0)].map(|(x, y)| Vector::new(x, y, 0.0));
        let ridge = [Vector::new(1.0, 0.0, 1.0), Vector::new(-1.0, 0.0, 1.0)];
        let roof = Polyhedron::hull(&[&points[..], &ridge[..]].concat()).unwrap();
        let half = |thickness: f64| 1.0 - thickness * (1.0 + 2.0_f64.sqrt());
        let expected = |thickness: f64| 4.0 / 3.0 * half(thickness).powi(3) + 2.0 * half(thickness).powi(2);
        assert!((volume(&roof) - expected(0.0)).abs() < 1e-14);
        assert!((volume(&roof.inset(0.2).unwrap()) - expected(0.2)).abs() < 1e-14);
    }

    /// A box with one long edge cut off: the cut's plane bounds the less, the farther all planes move in, and at last nothing at all.
    #[test]
    fn a_plane_that_no_longer_bounds_drops_out_and_a_corner_that_splits_becomes_two() {
        let profile = [(-1.0, -1.0), (1.0, -1.0), (1.0, 0.9), (0.9, 1.0), (-1.0, 1.0)];
        let points: Vec<Vector> = profile.iter().flat_map(|(x, y)| [-1.5, 1.5].map(|z| Vector::new(*x, *y, z))).collect();
        let body = Polyhedron::hull(&points).unwrap();
        assert_eq!(body.faces().len(), 7);
        // The cut lies 0.05 sqrt 2 inside the edge, which itself moves in by t sqrt 2 under the planes beside it: they meet on the moved cut at
        // t sqrt 2 = 0.05 sqrt 2 + t.
        let end = 0.05 * (2.0 + 2.0_f64.sqrt());
        assert_eq!(body.inset(0.9 * end).unwrap().faces().len(), 7);
        let inset = body.inset(1.1 * end).unwrap();
        assert_eq!((inset.faces().len(), inset.vertices().len()), (6, 8));
        let sides = 2.0 * (1.0 - 1.1 * end);
        assert!((volume(&inset) / (sides * sides * (sides + 1.0)) - 1.0).abs() < 32.0 * f64::EPSILON);
        let skew = skew_pyramid();
        let left = skew.inset(0.1).unwrap();
        assert_eq!((left.faces().len(), left.vertices().len()), (5, 6));
        let deepest = |vertex: &Vector| {
            let heights = skew.face_normals().iter().zip(skew.face_distances()).map(|(normal, distance)| distance - normal.dot(vertex));
            heights.fold(f64::INFINITY, f64::min)
        };
        assert!(left.vertices().iter().all(|vertex| (deepest(vertex) - 0.1).abs() < 8.0 * f64::EPSILON));
    }

    /// Independent: between two thicknesses the volume changes by the integral of the area, which is a quadratic function of the thickness as long
    /// as no edge comes or goes: Simpson's rule is exact.
    #[test]
    fn volume_is_the_sum_of_the_areas_of_the_insets() {
        let body = skew_pyramid();
        let area = |inset: &Polyhedron| inset.faces().iter().map(|face| plane(inset.vertices(), face).0.norm()).sum::<f64>();
        let [outer, middle, inner] = [0.0, 0.1, 0.2].map(|thickness| body.inset(thickness).unwrap());
        let sum = 0.2 / 6.0 * (area(&outer) + 4.0 * area(&middle) + area(&inner));
        assert!((sum - (volume(&outer) - volume(&inner))).abs() < 16.0 * f64::EPSILON);
    }
}
