//! A superellipsoid and a set with corners, edges, rims or faces: the point of the smooth surface whose normal leads to the piece that faces it.
//!
//! The nearest point of the other set lies on one piece of it, which tells that point from the normal alone, but for where it lies along a straight line. So the
//! unknowns are the two parameters of the smooth surface ([chart](crate::shape::superellipsoid::chart)). At a corner or rim the normal must run through the point that the piece
//! shows it: two equations. Along a line it must stand at right angles to the line and run through it: two equations. A face prescribes the normal, which has one point. None of it
//! divides by the distance, so that touching sets are as well posed as distant ones, and shallow overlaps have the depth along their common normal.
//!
//! Which piece it is, the search tells. A wrong one fails the certificate, and the search goes on to a better simplex.

use nalgebra::{Matrix2, Matrix3x2, Vector2};

use super::{Body, Piece, Points};
use crate::Vector;
use crate::distance::common_normal::{ROUNDED, SHALLOW, basis};
use crate::distance::simplex::Simplex;
use crate::distance::{Core, Known, Outcome, Relative, Separation};
use crate::shape::Superellipsoid;
use crate::shape::superellipsoid::chart::Patch;

const LARGEST_NUMBER_OF_STEPS: usize = 24;
/// Longest step of a parameter, which has unit length.
const LONGEST_STEP: f64 = 0.3;
/// Sine of the normal, and distance beside it over the size, below which Newton's method has ended.
const CONVERGED: f64 = 1e-14;

/// Where a search stands: a direction from the first set to the second, a point near the first surface, from its centre, and the corners found, all in the frame of the first set.
pub struct Found<'a> {
    /// Any length but zero.
    pub direction: Vector,
    /// Nearest points, each from the centre of its set.
    pub points: [Vector; 2],
    /// Of the search.
    pub simplex: &'a Simplex,
    /// By how much the second set was moved for the search.
    pub moved: Vector,
}

/// Signed distance of a superellipsoid and any other set that has a piece of a kind, in the frame of the first. `None` if neither is a superellipsoid, and if the result
/// cannot be certified to a gap of `tolerance` in m: of bounds where the sets are apart, of the depths of points and supporting planes where they overlap.
pub fn separation(first: &Core, second: &Core, relative: &Relative, found: &Found<'_>, tolerance: f64) -> Option<Separation> {
    match (first, second) {
        (Core::Superellipsoid(smooth), other) => {
            let points = Points::of_search(other, Some(found.simplex), true).mapped(|point| point - found.moved);
            Problem::new(smooth, other, relative, points).nearest(&found.direction, &found.points[0], tolerance)
        }
        (other, Core::Superellipsoid(smooth)) => {
            // Everything from the frame of the smooth set.
            let (turned, inverse) = (|vector: &Vector| relative.rotation.tr_mul(vector), relative.inverse());
            let points = Points::of_search(other, Some(found.simplex), false).mapped(|point| turned(&(point - relative.position)));
            let from_smooth =
                Problem::new(smooth, other, &inverse, points).nearest(&-turned(&found.direction), &turned(&found.points[1]), tolerance)?;
            Some(from_smooth.swapped().turned(&relative.rotation))
        }
        _ => None,
    }
}

/// A smooth set in its own frame, and the set that it meets.
struct Problem<'a> {
    smooth: &'a Superellipsoid,
    other: Body<'a>,
    relative: &'a Relative,
    size: f64,
}

impl<'a> Problem<'a> {
    fn new(smooth: &'a Superellipsoid, core: &'a Core, relative: &'a Relative, points: Points) -> Problem<'a> {
        let axis = relative.rotation.column(2).into_owned();
        let other = Body { core, sign: -1.0, centre: relative.position, axis, points };
        Problem { smooth, other, relative, size: smooth.bounding_radius() + core.reach() }
    }

    /// The answer for the first piece that has a certified one.
    fn nearest(&self, direction: &Vector, near: &Vector, tolerance: f64) -> Option<Separation> {
        let normal = direction.normalize();
        let of_piece = |piece: Option<Piece>| self.of_piece(&piece?, &normal, near, tolerance);
        match self.other.core {
            Core::Cylinder { .. } => {
                let towards = -normal.dot(&self.other.axis);
                of_piece(self.other.rim(towards)).or_else(|| of_piece(self.other.side())).or_else(|| of_piece(self.other.end_face(towards)))
            }
            _ => of_piece(self.other.piece_of_polytope()),
        }
    }

    fn of_piece(&self, piece: &Piece, normal: &Vector, near: &Vector, tolerance: f64) -> Option<Separation> {
        let (point, normal) = match piece.face {
            Some(outward) => (self.smooth.support(&-outward), -outward),
            None => {
                let patch = self.solve(piece, self.smooth.parameter(near, normal).normalize())?;
                (patch.point, patch.normal)
            }
        };
        let on_other = self.point_on(piece, &point, &normal);
        self.certified(point, normal, on_other, tolerance)
    }

    /// The point of a piece that belongs to a point of the smooth set and its normal.
    fn point_on(&self, piece: &Piece, point: &Vector, normal: &Vector) -> Vector {
        if let Some(outward) = piece.face {
            let foot = point - outward * (point - piece.base).dot(&outward);
            return match piece.curved {
                Some((axis, radius)) => {
                    let (across, length) = Piece::across(&axis, &(foot - piece.base));
                    piece.base + across * length.min(radius)
                }
                None => self.other.nearest_on_triangle(&foot),
            };
        }
        let round = piece.curved.map_or_else(Vector::zeros, |(axis, radius)| Piece::across(&axis, normal).0 * -radius);
        let along = piece
            .line
            .map_or_else(Vector::zeros, |(line, half_length)| line * (point - piece.base).dot(&line).clamp(-half_length, half_length));
        piece.base + round + along
    }

    /// Points and normal as an answer, if they are right: apart, the distance of both points against the gap of the supporting planes; overlapping, the
    /// depth of the points against that of the planes, which is the least near by where the points face each other.
    fn certified(&self, point: Vector, normal: Vector, on_other: Vector, tolerance: f64) -> Option<Separation> {
        let between = on_other - point;
        let height = between.dot(&normal);
        let between_planes = (self.relative.support(self.other.core, &-normal) - point).dot(&normal);
        let (distance, gap) = if height > 0.0 {
            (between.norm(), between.norm() - between_planes)
        } else {
            (between_planes, (between - normal * between_planes).norm())
        };
        let is_deep = -distance > SHALLOW * self.smooth.inner_radius();
        (gap.abs() <= tolerance && !is_deep).then(|| Separation {
            distance,
            normal,
            on_first: point,
            on_second: on_other - self.relative.position,
            gap: gap.max(0.0),
            outcome: Outcome::Polished,
            known: Known::Nothing,
            corners: 0,
        })
    }

    /// Follows Newton's method from a parameter of the smooth surface.
    fn solve(&self, piece: &Piece, start: Vector) -> Option<Patch> {
        let look = |parameter: Vector| {
            let along = basis(&parameter);
            let patch = self.smooth.patch(&parameter, &along);
            let residual = self.residual(piece, &patch);
            (parameter, along, patch, residual)
        };
        let (mut parameter, mut along, mut patch, mut residual) = look(start);
        for _ in 0..LARGEST_NUMBER_OF_STEPS {
            let error = residual.value.norm();
            if error <= CONVERGED {
                return Some(patch);
            }
            let step = -(residual.slope.try_inverse()? * residual.value);
            let length = step.norm();
            if !length.is_finite() {
                return None;
            }
            let mut fraction = (LONGEST_STEP / length).min(1.0);
            let next = loop {
                let next = look((parameter + along * (step * fraction)).normalize());
                if next.3.value.norm() < error * (1.0 - 0.1 * fraction) {
                    break next;
                }
                if error <= ROUNDED {
                    return Some(patch);
                }
                fraction *= 0.5;
                if fraction < 1e-3 {
                    return None;
                }
            };
            (parameter, along, patch, residual) = next;
        }
        None
    }

    /// By how much the normal misses a piece that is no face.
    fn residual(&self, piece: &Piece, patch: &Patch) -> Residual {
        let inverse_size = 1.0 / self.size;
        let Patch { point, slope_of_point, normal, slope_of_normal } = patch;
        if let Some((line, _)) = piece.line {
            // At right angles to the line; through it, seen along both.
            let between = piece.base - point;
            let aside = normal.cross(&line);
            let slope_of_aside = Matrix3x2::from_columns(&[0, 1].map(|way| slope_of_normal.column(way).cross(&line)));
            let slope = slope_of_aside.tr_mul(&between) - slope_of_point.tr_mul(&aside);
            let of_line = slope_of_normal.tr_mul(&line);
            return Residual {
                value: Vector2::new(normal.dot(&line), aside.dot(&between) * inverse_size),
                slope: Matrix2::from_rows(&[of_line.transpose(), slope.transpose() * inverse_size]),
            };
        }
        let across = basis(normal);
        let (mut between, mut slope_of_between) = (piece.base - point, -slope_of_point);
        if let Some((axis, radius)) = piece.curved {
            let (outward, sine) = Piece::across(&axis, normal);
            let turn = slope_of_normal - axis * (axis.transpose() * slope_of_normal);
            between -= outward * radius;
            slope_of_between -= (turn - outward * (outward.transpose() * turn)) * (radius / sine.max(f64::MIN_POSITIVE));
        }
        // The plane across turns with the normal, and the distance in it.
        let slope = across.tr_mul(&slope_of_between) - across.tr_mul(slope_of_normal) * between.dot(normal);
        Residual { value: across.tr_mul(&between) * inverse_size, slope: slope * inverse_size }
    }
}

/// Two numbers that vanish at the answer, without a unit, and how they change with the parameter.
struct Residual {
    value: Vector2<f64>,
    slope: Matrix2<f64>,
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::Orientation;
    use crate::distance::{Pose, Query, separation};
    use crate::shape::Polyhedron;

    fn superellipsoid(semi_axes: [f64; 3], exponents: [f64; 2]) -> Core {
        Core::Superellipsoid(Arc::new(Superellipsoid::new(semi_axes.into(), exponents).unwrap()))
    }

    fn edged() -> [Core; 5] {
        [
            Core::Segment { half_length: 0.6 },
            Core::Box { half_lengths: Vector::new(0.5, 0.3, 0.4) },
            Core::Cylinder { radius: 0.4, half_length: 0.3 },
            Core::Polyhedron(Arc::new(Polyhedron::tetrahedron(1.0).unwrap())),
            Core::Polyhedron(Arc::new(Polyhedron::icosahedron(0.5).unwrap())),
        ]
    }

    fn pose(index: u32, distance: f64) -> Pose {
        let part = |stride: f64| (f64::from(index) * stride).fract() - 0.5;
        let direction = Vector::new(part(0.618_034), part(0.754_878), part(0.569_841)).normalize();
        let turn = Orientation::from_euler_angles(7.0 * part(0.324_718), 7.0 * part(0.220_744), 7.0 * part(0.856_675));
        Pose { position: direction * distance, rotation: *turn.to_rotation_matrix().matrix() }
    }

    /// The second put a gap apart along the normal.
    fn at_gap(first: (&Core, &Pose), second: (&Core, Pose), gap: f64) -> Pose {
        let far = separation(first, (second.0, &second.1), &Query::cold());
        Pose { position: second.1.position - far.normal * (far.distance - gap), ..second.1 }
    }

    /// Exact: a ball is as far as its centre, less its radius, along the same normal.
    #[test]
    fn balls_are_as_far_from_edged_sets_as_their_centres_less_their_radii() {
        let ball = superellipsoid([0.7; 3], [1.0, 1.0]);
        for other in edged() {
            for index in 1..200 {
                let (first, second) = (pose(0, 1.0), pose(index, 4.0));
                let second = at_gap((&ball, &first), (&other, second), [0.1, 1e-3, 1e-7][index as usize % 3]);
                let centre = separation((&Core::Point, &first), (&other, &second), &Query::cold());
                let found = separation((&ball, &first), (&other, &second), &Query::cold());
                assert!((found.distance - centre.distance + 0.7).abs() < 2e-12, "{other:?} {index}: {found:?} {centre:?}");
                assert!((found.normal - centre.normal).norm() < 1e-11, "{other:?} {index}: {found:?} {centre:?}");
                assert!((found.on_second - centre.on_second).norm() < 1e-11, "{other:?} {index}: {found:?} {centre:?}");
            }
        }
    }

    /// Bounded from both sides and polished, and the gap is the one at which the pair was put.
    #[test]
    fn superellipsoids_and_edged_sets_are_certified_at_any_gap() {
        let (mut polished, mut asked) = (0, 0);
        for exponents in [[1.0, 1.0], [0.6, 1.3], [0.3, 0.3], [1.5, 0.7], [0.2, 1.0]] {
            let smooth = superellipsoid([0.5, 0.35, 0.25], exponents);
            for other in edged() {
                for index in 1..200 {
                    let first = pose(0, 1.0);
                    let gap = [0.1, 1e-3, 1e-6][index as usize % 3];
                    let second = at_gap((&smooth, &first), (&other, pose(index, 4.0)), gap);
                    let found = separation((&smooth, &first), (&other, &second), &Query::cold());
                    assert!((found.distance - gap).abs() < 4e-11, "{exponents:?} {other:?} {index} {gap}: {found:?}");
                    polished += u32::from(found.outcome == Outcome::Polished);
                    asked += 1;
                }
            }
        }
        println!("{polished} of {asked}");
        assert!(polished * 1000 > asked * 995, "{polished} of {asked}");
    }
}
