//! What vertices and faces must be to be a convex polyhedron.

use std::collections::BTreeMap;

use super::PolyhedronError;
use crate::Vector;

/// Rounding errors that a coordinate may carry, in units of the last place of the largest one: what some turns and moves leave behind.
const ROUNDINGS: f64 = 256.0;

/// Distance in m that is nothing but rounding for points with such coordinates.
pub(super) fn rounding(points: &[Vector]) -> f64 {
    ROUNDINGS * f64::EPSILON * points.iter().map(|point| point.amax()).fold(0.0, f64::max)
}

/// Largest extent of points along an axis, in m.
pub(super) fn size(points: &[Vector]) -> f64 {
    let upper = points.iter().fold(Vector::repeat(f64::NEG_INFINITY), |upper, point| upper.sup(point));
    let lower = points.iter().fold(Vector::repeat(f64::INFINITY), |lower, point| lower.inf(point));
    (upper - lower).max()
}

/// Area vector of a face (along its outward normal, as long as its area, in m^2) and the middle of its corners.
pub(super) fn plane(vertices: &[Vector], face: &[usize]) -> (Vector, Vector) {
    let middle = face.iter().map(|index| vertices[*index]).sum::<Vector>() / face.len() as f64;
    let next = face.iter().cycle().skip(1);
    let twice = face.iter().zip(next).map(|(from, to)| (vertices[*from] - middle).cross(&(vertices[*to] - middle))).sum::<Vector>();
    (0.5 * twice, middle)
}

/// How far from the plane of a face of this area a point of a body of this size may seem to lie by rounding: the normal of a sliver is
/// known the worse, the thinner it is.
pub(super) fn plane_tolerance(rounding: f64, size: f64, area: f64) -> f64 {
    rounding * (size * size / area).max(1.0)
}

/// Two points that lie at one place, if there are any.
pub(super) fn coincident(points: &[Vector], tolerance: f64) -> Option<(usize, usize)> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|left, right| points[*left].x.total_cmp(&points[*right].x));
    for (position, first) in order.iter().enumerate() {
        let near = |second: &&usize| points[**second].x - points[*first].x <= tolerance;
        for second in order[position + 1..].iter().take_while(near) {
            if (points[*second] - points[*first]).norm() <= tolerance {
                return Some((*first.min(second), *first.max(second)));
            }
        }
    }
    None
}

/// Refuses whatever is not a closed convex polyhedron with flat faces.
pub(super) fn check(vertices: &[Vector], faces: &[Vec<usize>]) -> Result<(), PolyhedronError> {
    if vertices.len() < 4 || faces.len() < 4 {
        return Err(PolyhedronError::TooFew { vertices: vertices.len(), faces: faces.len() });
    }
    if let Some(vertex) = vertices.iter().position(|vertex| !vertex.iter().all(|coordinate| coordinate.is_finite())) {
        return Err(PolyhedronError::NotFinite { vertex });
    }
    let rounding = rounding(vertices);
    check_names(vertices.len(), faces)?;
    if let Some((first, second)) = coincident(vertices, rounding) {
        return Err(PolyhedronError::Coincident { first, second });
    }
    check_closed(faces)?;
    check_planes(vertices, faces, rounding)
}

/// Every face names at least three vertices that exist, each once; every vertex is named.
fn check_names(count: usize, faces: &[Vec<usize>]) -> Result<(), PolyhedronError> {
    let mut used = vec![false; count];
    for (face, corners) in faces.iter().enumerate() {
        if let Some(vertex) = corners.iter().copied().find(|corner| *corner >= count) {
            return Err(PolyhedronError::NoSuchVertex { face, vertex, count });
        }
        let mut distinct = corners.clone();
        distinct.sort_unstable();
        distinct.dedup();
        if distinct.len() < 3 || distinct.len() < corners.len() {
            return Err(PolyhedronError::TooFewCorners { face });
        }
        corners.iter().for_each(|corner| used[*corner] = true);
    }
    match used.iter().position(|used| !used) {
        Some(vertex) => Err(PolyhedronError::Unused { vertex }),
        None => Ok(()),
    }
}

/// Every edge is used once in each direction.
pub(super) fn check_closed(faces: &[Vec<usize>]) -> Result<(), PolyhedronError> {
    let mut uses: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for face in faces {
        for (from, to) in face.iter().zip(face.iter().cycle().skip(1)) {
            *uses.entry((*from, *to)).or_insert(0) += 1;
        }
    }
    for ((from, to), forth) in &uses {
        let back = uses.get(&(*to, *from)).copied().unwrap_or(0);
        if *forth != 1 || back != 1 {
            return Err(PolyhedronError::Open { from: *from, to: *to, forth: *forth, back });
        }
    }
    Ok(())
}

/// Every face is flat, looks outwards, and has all vertices on its inner side.
fn check_planes(vertices: &[Vector], faces: &[Vec<usize>], rounding: f64) -> Result<(), PolyhedronError> {
    let size = size(vertices);
    let middle = vertices.iter().sum::<Vector>() / vertices.len() as f64;
    let planes: Vec<(Vector, Vector)> = faces.iter().map(|face| plane(vertices, face)).collect();
    let volume: f64 = planes.iter().map(|(area, point)| area.dot(&(point - middle)) / 3.0).sum();
    if volume.abs() <= rounding * size * size {
        return Err(PolyhedronError::Flat);
    }
    for (face, (area, point)) in planes.iter().enumerate() {
        if area.norm() <= rounding * size {
            return Err(PolyhedronError::NoArea { face });
        }
        let (normal, tolerance) = (area.normalize(), plane_tolerance(rounding, size, area.norm()));
        let height = |vertex: usize| normal.dot(&(vertices[vertex] - point));
        let on_face = faces[face].iter().map(|vertex| (*vertex, height(*vertex)));
        if let Some((vertex, distance)) = highest(on_face.map(|(vertex, height)| (vertex, height.abs())), tolerance) {
            return Err(PolyhedronError::NotPlanar { face, vertex, distance });
        }
        if normal.dot(&(middle - point)) > 0.0 {
            return Err(PolyhedronError::Inward { face });
        }
        if let Some((vertex, distance)) = highest((0..vertices.len()).map(|vertex| (vertex, height(vertex))), tolerance) {
            return Err(PolyhedronError::NotConvex { face, vertex, distance });
        }
    }
    Ok(())
}

/// The vertex of the largest height, if that is more than a tolerance.
fn highest(heights: impl Iterator<Item = (usize, f64)>, tolerance: f64) -> Option<(usize, f64)> {
    heights.max_by(|left, right| left.1.total_cmp(&right.1)).filter(|(_, height)| *height > tolerance)
}

#[cfg(test)]
mod tests {
    use super::super::{Polyhedron, PolyhedronError};
    use crate::Vector;

    type Parts = (Vec<Vector>, Vec<Vec<usize>>);

    /// A square pyramid: four corners around, the tip last.
    fn pyramid() -> Parts {
        let vertices = vec![Vector::x(), Vector::y(), -Vector::x(), -Vector::y(), Vector::z()];
        (vertices, vec![vec![3, 2, 1, 0], vec![0, 1, 4], vec![1, 2, 4], vec![2, 3, 4], vec![3, 0, 4]])
    }

    fn refusal(spoil: impl Fn(&mut Parts)) -> PolyhedronError {
        let mut parts = pyramid();
        assert!(Polyhedron::from_faces(parts.0.clone(), parts.1.clone()).is_ok());
        spoil(&mut parts);
        Polyhedron::from_faces(parts.0, parts.1).unwrap_err()
    }

    #[test]
    fn broken_lists_are_refused() {
        assert_eq!(refusal(|parts| parts.0.truncate(3)), PolyhedronError::TooFew { vertices: 3, faces: 5 });
        assert_eq!(refusal(|parts| parts.0[2].y = f64::NAN), PolyhedronError::NotFinite { vertex: 2 });
        assert_eq!(refusal(|parts| parts.1[1][2] = 9), PolyhedronError::NoSuchVertex { face: 1, vertex: 9, count: 5 });
        assert_eq!(refusal(|parts| parts.1[1][2] = 1), PolyhedronError::TooFewCorners { face: 1 });
        assert_eq!(refusal(|parts| parts.1[4].truncate(2)), PolyhedronError::TooFewCorners { face: 4 });
        assert_eq!(refusal(|parts| parts.0[3] = Vector::x()), PolyhedronError::Coincident { first: 0, second: 3 });
        assert_eq!(refusal(|parts| parts.0.push(Vector::z() * 0.5)), PolyhedronError::Unused { vertex: 5 });
    }

    #[test]
    fn open_and_inside_out_surfaces_are_refused() {
        assert_eq!(refusal(|parts| drop(parts.1.remove(2))), PolyhedronError::Open { from: 1, to: 4, forth: 1, back: 0 });
        assert_eq!(refusal(|parts| parts.1[1].reverse()), PolyhedronError::Open { from: 0, to: 4, forth: 2, back: 0 });
        let twice = |parts: &mut Parts| parts.1.extend(parts.1.clone());
        assert_eq!(refusal(twice), PolyhedronError::Open { from: 0, to: 1, forth: 2, back: 2 });
        assert_eq!(refusal(|parts| parts.1.iter_mut().for_each(|face| face.reverse())), PolyhedronError::Inward { face: 0 });
    }

    #[test]
    fn flat_bent_and_dented_bodies_are_refused() {
        assert_eq!(refusal(|parts| parts.0[4].z = 0.0), PolyhedronError::Flat);
        // A rounding more is let pass, more than rounding is not.
        let mut nearly = pyramid();
        nearly.0[0].z = 1e-15;
        assert!(Polyhedron::from_faces(nearly.0, nearly.1).is_ok());
        assert!(matches!(refusal(|parts| parts.0[0].z = 1e-12), PolyhedronError::NotPlanar { face: 0, .. }));
        let dent = |parts: &mut Parts| {
            // The base as two triangles, one corner pushed out: the edge between the others is then a valley.
            parts.1[0] = vec![3, 2, 1];
            parts.1.push(vec![3, 1, 0]);
            parts.0[0].z = -0.1;
        };
        assert!(matches!(refusal(dent), PolyhedronError::NotConvex { face: 0, vertex: 0, .. }));
        let collinear = |parts: &mut Parts| {
            parts.0.push(Vector::new(0.5, 0.5, 0.0));
            parts.1[0] = vec![3, 2, 1, 5, 0];
            parts.1[1] = vec![0, 5, 1];
            parts.1.extend([vec![0, 1, 4]]);
        };
        assert_eq!(refusal(collinear), PolyhedronError::NoArea { face: 1 });
    }

    #[test]
    fn refusals_say_where_and_what() {
        let text = refusal(|parts| parts.1[1].reverse()).to_string();
        assert!(text.contains("from vertex 0 to vertex 4") && text.contains("counterclockwise"), "{text}");
    }
}
