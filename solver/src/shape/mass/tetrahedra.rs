//! Exact moments of the body inside a closed surface of flat faces.

use nalgebra::Matrix3;

use super::MassProperties;
use crate::Vector;

/// Volume, centre and second moments of the body whose surface consists of flat faces, each counterclockwise seen from outside.
///
/// The body is the sum of the tetrahedra over a fan of triangles of every face, with signs, whose common tip is the mean of the vertices. A
/// tetrahedron with tip 0 and corners `a, b, c` of determinant `d = det(a b c)` has the volume `d / 6`, the first moment `d / 24 s` and the
/// second moment `d / 120 (s s^T + a a^T + b b^T + c c^T)` with `s = a + b + c`.
pub(crate) fn surface_moments(vertices: &[Vector], faces: &[Vec<usize>]) -> MassProperties {
    let tip = vertices.iter().sum::<Vector>() / vertices.len() as f64;
    let (mut volume, mut first, mut second) = (0.0, Vector::zeros(), Matrix3::zeros());
    for face in faces {
        let Some((start, others)) = face.split_first() else { continue };
        for pair in others.windows(2) {
            let [a, b, c] = [*start, pair[0], pair[1]].map(|index| vertices[index] - tip);
            let (determinant, sum) = (a.dot(&b.cross(&c)), a + b + c);
            volume += determinant / 6.0;
            first += sum * (determinant / 24.0);
            let squares = sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose();
            second += squares * (determinant / 120.0);
        }
    }
    let mut properties = MassProperties::from_raw_moments(volume, first, second);
    properties.centre += tip;
    properties
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Independent: a square pyramid of side 2 and height 3: volume 4, centre 3/4 above its base, and from its square slices of side
    /// `2 (1 - z/3)`: mean of x^2 = 1/5, mean of (z - 3/4)^2 = 27/80.
    #[test]
    fn a_pyramid_has_the_moments_of_its_slices() {
        let place = |x: f64, y: f64, z: f64| Vector::new(x + 7.0, y - 2.0, z);
        let vertices = [place(1.0, 1.0, 0.0), place(-1.0, 1.0, 0.0), place(-1.0, -1.0, 0.0), place(1.0, -1.0, 0.0), place(0.0, 0.0, 3.0)];
        let faces = [vec![3, 2, 1, 0], vec![0, 1, 4], vec![1, 2, 4], vec![2, 3, 4], vec![3, 0, 4]];
        let moments = surface_moments(&vertices, &faces);
        assert!((moments.volume - 4.0).abs() < 8.0 * f64::EPSILON);
        assert!((moments.centre - Vector::new(7.0, -2.0, 0.75)).norm() < 16.0 * f64::EPSILON);
        let expected = Matrix3::from_diagonal(&Vector::new(0.8, 0.8, 1.35));
        assert!((moments.second_moments - expected).norm() < 16.0 * f64::EPSILON, "{}", moments.second_moments);
    }
}
