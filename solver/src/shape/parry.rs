//! The bridge to parry: the only file that sees its types (they are glam's, ours are nalgebra's).
//!
//! Hulls are made by it. Distances are not: [`ParryPair`] is a second opinion and a measure of speed.

use std::panic::catch_unwind;

use nalgebra::{Matrix3, SymmetricEigen};
use parry3d_f64::math::{Pose as ParryPose, Rot3};
use parry3d_f64::query::details::closest_points_support_map_support_map_with_params;
use parry3d_f64::query::gjk::{GJKResult, VoronoiSimplex};
use parry3d_f64::shape::{self, SupportMap};
use parry3d_f64::transformation::try_convex_hull;

use super::Convex;
use crate::{Orientation, Vector};

/// Two shapes in a fixed place, ready to be asked for their distance by parry's GJK. Its tolerances are absolute: sizes should be about 1.
pub struct ParryPair {
    first: Box<dyn SupportMap>,
    second: Box<dyn SupportMap>,
    relative: ParryPose,
    /// From our frame of the first to parry's.
    to_own: Orientation,
}

impl ParryPair {
    /// Two boxes or cylinders, the second by its rotation and its place in m in the frame of the first; `None` for other shapes.
    pub fn new(first: &Convex, second: &Convex, rotation: &Matrix3<f64>, position: &Vector) -> Option<ParryPair> {
        let to_own = upright(first).inverse();
        let turn = Orientation::from_rotation_matrix(&nalgebra::Rotation3::from_matrix_unchecked(*rotation));
        let quaternion = (to_own * turn * upright(second)).coords;
        let rotation = Rot3::from_xyzw(quaternion.x, quaternion.y, quaternion.z, quaternion.w);
        Some(ParryPair {
            first: support_map(first)?,
            second: support_map(second)?,
            relative: ParryPose::from_parts((to_own * position).into(), rotation),
            to_own,
        })
    }

    /// Distance in m, from a guess of the direction in the frame of the first if there is one; `None` if parry sees an overlap or gives up.
    pub fn distance(&self, guess: Option<&Vector>) -> Option<f64> {
        let start = guess.map(|guess| (self.to_own * guess).into());
        let (first, second) = (self.first.as_ref(), self.second.as_ref());
        let mut simplex = VoronoiSimplex::new();
        match closest_points_support_map_support_map_with_params(&self.relative, first, second, f64::MAX, &mut simplex, start) {
            GJKResult::ClosestPoints(on_first, on_second, _) => Some((on_second - on_first).length()),
            _ => None,
        }
    }
}

/// From parry's frame of a shape to ours: its cylinders stand along y, ours along z.
fn upright(convex: &Convex) -> Orientation {
    match convex {
        Convex::Cylinder(_) => Orientation::from_axis_angle(&Vector::x_axis(), std::f64::consts::FRAC_PI_2),
        _ => Orientation::identity(),
    }
}

fn support_map(convex: &Convex) -> Option<Box<dyn SupportMap>> {
    match convex {
        Convex::Cuboid(cuboid) => Some(Box::new(shape::Cuboid::new(cuboid.half_lengths().into()))),
        Convex::Cylinder(cylinder) => Some(Box::new(shape::Cylinder::new(0.5 * cylinder.length, cylinder.radius))),
        _ => None,
    }
}

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
    use crate::shape::{Cuboid, Cylinder};

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

    /// Its search ends at a relative change of about the square root of ten machine epsilons.
    const PARRYS_ERROR: f64 = 1e-7;

    #[test]
    fn a_box_over_a_lying_and_a_standing_cylinder_is_as_far_as_their_heights_say() {
        let cuboid = Convex::Cuboid(Cuboid { lengths: Vector::new(1.0, 2.0, 3.0) });
        let cylinder = Convex::Cylinder(Cylinder { radius: 0.25, length: 4.0 });
        let lying = Orientation::from_axis_angle(&Vector::y_axis(), std::f64::consts::FRAC_PI_2);
        for (rotation, half_height) in [(lying, 0.25), (Orientation::identity(), 2.0)] {
            let (turn, above) = (*rotation.to_rotation_matrix().matrix(), Vector::new(0.1, 0.2, 4.0));
            let pair = ParryPair::new(&cuboid, &cylinder, &turn, &above).unwrap();
            for guess in [None, Some(&Vector::z())] {
                let distance = pair.distance(guess).unwrap();
                assert!((distance - (2.5 - half_height)).abs() < PARRYS_ERROR, "{distance} {half_height} {guess:?}");
            }
            let swapped = ParryPair::new(&cylinder, &cuboid, &turn.transpose(), &-(turn.transpose() * above)).unwrap();
            assert!((swapped.distance(Some(&(turn.transpose() * -Vector::z()))).unwrap() - (2.5 - half_height)).abs() < PARRYS_ERROR);
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
