//! The surface of a convex polyhedron.

use super::outline::{INSET, intervals, triangular_lattice};
use super::{Foot, Surface};
use crate::Vector;
use crate::shape::Polyhedron;

impl Surface for Polyhedron {
    /// From inside the nearest plane of a face; from outside the nearest point of the faces that are seen, which those with edges and corners belong to.
    fn foot(&self, point: &Vector) -> Foot {
        let planes = self.face_normals().iter().zip(self.face_distances());
        let heights: Vec<f64> = planes.map(|(normal, distance)| normal.dot(point) - distance).collect();
        let mut nearest = Foot { distance: f64::NEG_INFINITY, normal: Vector::z() };
        for (height, normal) in heights.iter().zip(self.face_normals()) {
            if *height > nearest.distance {
                nearest = Foot { distance: *height, normal: *normal };
            }
        }
        // Seen from outside the highest plane may be met beyond its face: then it is only a lower bound.
        if nearest.distance <= 0.0 {
            return nearest;
        }
        nearest.distance = f64::INFINITY;
        for (face, height) in heights.iter().enumerate().filter(|(_, height)| **height > 0.0) {
            let normal = self.face_normals()[face];
            let on_plane = point - normal * *height;
            let beyond = nearest_of_edges(self, face, &on_plane).filter(|edge| !edge.is_within);
            let foot = beyond.map_or(Foot { distance: *height, normal }, |edge| {
                let away = point - edge.point;
                Foot { distance: away.norm(), normal: away.normalize() }
            });
            if foot.distance < nearest.distance {
                nearest = foot;
            }
        }
        nearest
    }

    fn bounding_radius(&self) -> f64 {
        Polyhedron::bounding_radius(self)
    }

    /// Corners, even parts of edges, and on each face a lattice of triangles within them. R lays squares on faces with four corners, to the same end.
    /// At corners sharper than 45 degrees points of two edges come nearer to each other.
    fn points(&self, spacing: f64) -> Vec<Vector> {
        let mut points = self.vertices().to_vec();
        for face in 0..self.faces().len() {
            for (from, to) in edges(self, face).filter(|(from, to)| from < to) {
                let (from, to) = (self.vertices()[from], self.vertices()[to]);
                let parts = intervals((to - from).norm(), spacing);
                points.extend((1..parts).map(|part| from.lerp(&to, part as f64 / parts as f64)));
            }
            add_points_of_face(self, face, spacing, &mut points);
        }
        points
    }
}

/// The nearest point of the edges of a face, seen from a point of its plane.
struct OnEdge {
    point: Vector,
    distance: f64,
    /// Whether the face holds the point that it is seen from.
    is_within: bool,
}

/// Corners where each edge of a face begins and ends, counterclockwise.
fn edges(polyhedron: &Polyhedron, face: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
    let corners = &polyhedron.faces()[face];
    corners.iter().copied().zip(corners.iter().copied().cycle().skip(1))
}

fn nearest_of_edges(polyhedron: &Polyhedron, face: usize, point: &Vector) -> Option<OnEdge> {
    let (vertices, normal) = (polyhedron.vertices(), polyhedron.face_normals()[face]);
    let on_edge = |(from, to): (usize, usize)| {
        let (from, along) = (vertices[from], vertices[to] - vertices[from]);
        let share = ((point - from).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        let nearest = from + along * share;
        OnEdge { point: nearest, distance: (point - nearest).norm(), is_within: normal.cross(&along).dot(&(point - from)) >= 0.0 }
    };
    let is_within = edges(polyhedron, face).all(|edge| on_edge(edge).is_within);
    let nearest = edges(polyhedron, face).map(on_edge).min_by(|one, other| one.distance.total_cmp(&other.distance))?;
    Some(OnEdge { is_within, ..nearest })
}

/// Adds the corners of triangles on a face that keep away from its edges.
fn add_points_of_face(polyhedron: &Polyhedron, face: usize, spacing: f64, points: &mut Vec<Vector>) {
    let corners: Vec<Vector> = polyhedron.faces()[face].iter().map(|corner| polyhedron.vertices()[*corner]).collect();
    let middle = corners.iter().sum::<Vector>() / corners.len() as f64;
    let reach = corners.iter().map(|corner| (corner - middle).norm()).fold(0.0, f64::max);
    let along = (corners[1] - corners[0]).normalize();
    let across = polyhedron.face_normals()[face].cross(&along);
    let places = triangular_lattice(spacing, reach).map(|place| middle + along * place.x + across * place.y);
    let is_clear =
        |place: &Vector| nearest_of_edges(polyhedron, face, place).is_some_and(|edge| edge.is_within && edge.distance >= INSET * spacing);
    points.extend(places.filter(is_clear));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coupling::resolved::surface::checks::{assert_feet_are_nearest, assert_points_are_spread, assert_volume_inside};
    use crate::shape::Cuboid;

    /// A wedge with faces of three and four corners, none at right angles to all others.
    fn wedge() -> Polyhedron {
        let corners = [[0.0, 0.0, 0.0], [1.1, 0.0, 0.0], [0.5, 1.0, 0.0], [0.0, 0.0, 0.8], [1.1, 0.0, 0.8], [0.5, 1.0, 0.8]];
        let faces = [vec![0, 2, 1], vec![3, 4, 5], vec![0, 1, 4, 3], vec![1, 2, 5, 4], vec![2, 0, 3, 5]];
        Polyhedron::from_faces(corners.map(Vector::from).to_vec(), faces.to_vec()).expect("a convex polyhedron")
    }

    #[test]
    fn feet_on_a_polyhedron_are_nearest() {
        assert_feet_are_nearest(&wedge(), 0.01);
        assert_volume_inside(&wedge(), 0.5 * 1.1 * 0.8);
    }

    #[test]
    fn a_box_by_its_faces_has_the_feet_of_a_box() {
        let brick = Cuboid { lengths: Vector::new(1.0, 0.7, 0.4) };
        let corner = |index: usize| Vector::new((index & 1) as f64, ((index >> 1) & 1) as f64, (index >> 2) as f64);
        let corners = (0..8).map(|index| (corner(index) - Vector::repeat(0.5)).component_mul(&brick.lengths)).collect();
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let faced = Polyhedron::from_faces(corners, faces.map(Vec::from).to_vec()).expect("a box");
        for number in 1..2000 {
            let wave = |factor: f64| 0.8 * (factor * f64::from(number)).sin();
            let point = Vector::new(wave(1.3), wave(2.1), wave(0.7));
            let (one, other) = (brick.foot(&point), faced.foot(&point));
            assert!((one.distance - other.distance).abs() < 1e-14, "{point} {one:?} {other:?}");
            assert!((one.normal - other.normal).norm() < 1e-6, "{point} {one:?} {other:?}");
        }
    }

    #[test]
    fn points_of_a_polyhedron_are_evenly_spread() {
        for spacing in [0.12, 0.07, 0.04] {
            assert_points_are_spread(&wedge(), spacing);
        }
    }
}
