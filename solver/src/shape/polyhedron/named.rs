//! Regular polyhedra by their edge length.

use super::{Polyhedron, PolyhedronError};
use crate::Vector;

impl Polyhedron {
    /// The regular tetrahedron.
    ///
    /// # Errors
    ///
    /// If the edge (in m) is not a positive number.
    pub fn tetrahedron(edge: f64) -> Result<Polyhedron, PolyhedronError> {
        let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        of_triangles(corners.map(Vector::from).to_vec(), 8.0_f64.sqrt(), edge)
    }

    /// The regular octahedron.
    ///
    /// # Errors
    ///
    /// If the edge (in m) is not a positive number.
    pub fn octahedron(edge: f64) -> Result<Polyhedron, PolyhedronError> {
        let corners = [Vector::x(), Vector::y(), Vector::z()].into_iter().flat_map(|axis| [axis, -axis]);
        of_triangles(corners.collect(), 2.0_f64.sqrt(), edge)
    }

    /// The regular icosahedron.
    ///
    /// # Errors
    ///
    /// If the edge (in m) is not a positive number.
    pub fn icosahedron(edge: f64) -> Result<Polyhedron, PolyhedronError> {
        let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
        let rectangle = [(1.0, golden), (1.0, -golden), (-1.0, golden), (-1.0, -golden)];
        let corners = rectangle
            .into_iter()
            .flat_map(|(short, long)| [Vector::new(0.0, short, long), Vector::new(short, long, 0.0), Vector::new(long, 0.0, short)]);
        of_triangles(corners.collect(), 2.0, edge)
    }
}

/// The polyhedron whose faces are all triangles of corners that are neighbours, scaled to another edge.
fn of_triangles(corners: Vec<Vector>, edge: f64, wanted: f64) -> Result<Polyhedron, PolyhedronError> {
    if !(wanted > 0.0 && wanted.is_finite()) {
        return Err(PolyhedronError::Flat);
    }
    let neighbours = |one: usize, other: usize| ((corners[one] - corners[other]).norm() / edge - 1.0).abs() < 0.01;
    let mut faces = Vec::new();
    for first in 0..corners.len() {
        for second in (first + 1..corners.len()).filter(|second| neighbours(first, *second)) {
            for third in (second + 1..corners.len()).filter(|third| neighbours(first, *third) && neighbours(second, *third)) {
                let outwards = corners[first].dot(&corners[second].cross(&corners[third])) > 0.0;
                faces.push(if outwards { vec![first, second, third] } else { vec![first, third, second] });
            }
        }
    }
    Polyhedron::from_faces(corners.iter().map(|corner| corner * (wanted / edge)).collect(), faces)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volumes and radii of the inner balls from any handbook; moments of inertia about any axis `m a^2` times 1/20, 1/10, (3 + sqrt 5)/20.
    #[test]
    fn regular_solids_have_their_handbook_values() {
        let root = |number: f64| number.sqrt();
        let solids = [
            (Polyhedron::tetrahedron(0.7), 4, root(2.0) / 12.0, root(6.0) / 12.0, 0.05),
            (Polyhedron::octahedron(0.7), 8, root(2.0) / 3.0, root(6.0) / 6.0, 0.1),
            (
                Polyhedron::icosahedron(0.7),
                20,
                5.0 / 12.0 * (3.0 + root(5.0)),
                (3.0 * root(3.0) + root(15.0)) / 12.0,
                (3.0 + root(5.0)) / 20.0,
            ),
        ];
        for (solid, faces, volume, inner, inertia) in solids {
            let solid = solid.unwrap();
            assert_eq!(solid.faces().len(), faces);
            let moments = solid.mass_properties();
            assert!((moments.volume / (volume * 0.343) - 1.0).abs() < 8.0 * f64::EPSILON);
            assert!((solid.inner_radius() / (inner * 0.7) - 1.0).abs() < 8.0 * f64::EPSILON);
            let (specific, axes) = moments.principal();
            assert!((specific / (inertia * 0.49) - Vector::repeat(1.0)).norm() < 16.0 * f64::EPSILON, "{faces} {specific}");
            assert_eq!(axes, crate::Orientation::identity());
        }
    }

    #[test]
    fn edges_that_are_no_lengths_are_refused() {
        for edge in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(Polyhedron::octahedron(edge), Err(PolyhedronError::Flat));
        }
    }
}
