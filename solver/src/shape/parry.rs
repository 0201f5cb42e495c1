//! The bridge to parry: the only file that sees its types (they are glam's, ours are nalgebra's).

use std::panic::catch_unwind;

use nalgebra::{Matrix3, SymmetricEigen};
use parry3d_f64::transformation::try_convex_hull;

use crate::Vector;

/// Triangles of the convex hull of points, by index, counterclockwise seen from outside. `None` if parry finds none.
///
/// Points should be [spread out](spread_out) first. The caller must check the result: where many points lie in common planes, parry's quick
/// hull sometimes returns a surface that is dented or folded by as much as the size of the body.
pub(crate) fn hull_triangles(points: &[Vector]) -> Option<Vec<[usize; 3]>> {
    let images: Vec<_> = points.iter().map(|point| (*point).into()).collect();
    // Parry asserts its own bookkeeping, and on degenerate points that assertion can fail.
    let (vertices, triangles) = catch_unwind(|| try_convex_hull(&images)).ok()?.ok()?;
    let corners = vertices.iter().map(|vertex| images.iter().position(|image| image == vertex)).collect::<Option<Vec<usize>>>()?;
    Some(triangles.iter().map(|triangle| triangle.map(|corner| corners[corner as usize])).collect())
}

/// The points about their mean, stretched along their principal axes to unit variance; `None` if they lie in a plane.
///
/// A hull keeps its triangles under any linear map. After this one, parry's absolute tolerances mean the same for bodies of every size and
/// aspect ratio.
pub(crate) fn spread_out(points: &[Vector]) -> Option<Vec<Vector>> {
    let middle = points.iter().sum::<Vector>() / points.len() as f64;
    let scale = points.iter().map(|point| (point - middle).amax()).fold(0.0, f64::max);
    if !(scale > 0.0 && scale.is_finite()) {
        return None;
    }
    let centred: Vec<Vector> = points.iter().map(|point| (point - middle) / scale).collect();
    let covariance = centred.iter().map(|point| point * point.transpose()).sum::<Matrix3<f64>>() / points.len() as f64;
    let eigen = SymmetricEigen::new(covariance);
    if eigen.eigenvalues.min() <= SMALLEST_VARIANCE {
        return None;
    }
    let stretch = eigen.eigenvalues.map(|variance| 1.0 / variance.sqrt());
    let axes = eigen.eigenvectors.transpose();
    // A map that mirrors would turn the triangles inside out.
    let map = Matrix3::from_diagonal(&stretch) * axes * axes.determinant().signum();
    Some(centred.iter().map(|point| map * point).collect())
}

/// A variance, relative to the square of the extent, that is rounding: points in a plane.
const SMALLEST_VARIANCE: f64 = 64.0 * f64::EPSILON;

#[cfg(test)]
mod tests {
    use super::*;

    fn corners(lengths: Vector) -> Vec<Vector> {
        let place = |index: usize| Vector::new((index & 1) as f64, ((index >> 1) & 1) as f64, (index >> 2) as f64);
        (0..8).map(|index| place(index).component_mul(&lengths)).collect()
    }

    /// Volume inside the triangles.
    fn volume(points: &[Vector], triangles: &[[usize; 3]]) -> f64 {
        triangles.iter().map(|[a, b, c]| points[*a].dot(&points[*b].cross(&points[*c])) / 6.0).sum()
    }

    #[test]
    fn a_box_of_any_size_and_aspect_ratio_gives_twelve_triangles_around_its_volume() {
        for lengths in [Vector::repeat(1.0), Vector::repeat(1e-6), Vector::new(1.0, 2.0, 1e-5), Vector::new(1e3, 1e-1, 1e-1)] {
            let points = corners(lengths);
            let triangles = hull_triangles(&spread_out(&points).unwrap()).unwrap();
            assert_eq!(triangles.len(), 12);
            assert!((volume(&points, &triangles) / lengths.product() - 1.0).abs() < 8.0 * f64::EPSILON, "{lengths}");
        }
    }

    #[test]
    fn flat_points_cannot_be_spread_out() {
        let mut flat = corners(Vector::new(1.0, 2.0, 0.0));
        assert_eq!(spread_out(&flat), None);
        flat.truncate(2);
        assert_eq!(spread_out(&flat), None);
        assert_eq!(spread_out(&[Vector::zeros(); 5]), None);
    }
}
