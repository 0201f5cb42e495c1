//! Two superellipsoids: the points whose normals face each other along the line between them.
//!
//! At the nearest points of two smooth sets the outward normals are opposite and the line between both points lies along them. The same holds for the two
//! deepest points of a shallow overlap, where it defines depth and normal of the contact ("common normal", S section 2.4.5 names the method). That
//! is four equations for two parameters on each surface, solved by Newton's method with the [chart](crate::shape::superellipsoid::chart) of each.
//!
//! The result is certified: where sets are apart, the distance of the points is an upper bound and the supporting planes give a lower one; where they
//! overlap, depth must be a minimum over all directions near by.

use nalgebra::{Matrix3x2, Matrix4, Vector4};

use super::core::Core;
use super::{Guess, Known, Outcome, Relative, Separation};
use crate::Vector;
use crate::shape::Superellipsoid;
use crate::shape::superellipsoid::chart::Patch;

const LARGEST_NUMBER_OF_STEPS: usize = 24;
/// Longest step of a parameter, which has unit length.
const LONGEST_STEP: f64 = 0.3;
/// Sine between both normals, and distance across them over the size, below which Newton's method has ended.
const CONVERGED: f64 = 1e-13;
/// The same where rounding may let it get no smaller.
const ROUNDED: f64 = 1e-12;
/// Overlaps deeper than this part of the smaller shape's inner radius are not shallow: there are several common normals.
pub(super) const SHALLOW: f64 = 0.5;

/// A set with a smooth chart: a superellipsoid, or a point, whose normals are free.
enum Surface<'a> {
    Smooth(&'a Superellipsoid),
    Point,
}

impl<'a> Surface<'a> {
    fn of(core: &'a Core) -> Option<Surface<'a>> {
        match core {
            Core::Superellipsoid(shape) => Some(Surface::Smooth(shape)),
            Core::Point => Some(Surface::Point),
            _ => None,
        }
    }

    #[inline]
    fn patch(&self, parameter: &Vector, along: &Matrix3x2<f64>) -> Patch {
        match self {
            Surface::Smooth(shape) => shape.patch(parameter, along),
            // The parameter is the normal, which has unit length and moves across itself.
            Surface::Point => {
                Patch { point: Vector::zeros(), slope_of_point: Matrix3x2::zeros(), normal: *parameter, slope_of_normal: *along }
            }
        }
    }

    #[inline]
    fn parameter(&self, point: &Vector, normal: &Vector) -> Vector {
        match self {
            Surface::Smooth(shape) => shape.parameter(point, normal).normalize(),
            Surface::Point => *normal,
        }
    }

    fn inner_radius(&self) -> f64 {
        match self {
            Surface::Smooth(shape) => shape.inner_radius(),
            Surface::Point => f64::INFINITY,
        }
    }
}

/// Both surfaces at a pair of parameters, in the frame of the first.
struct Facing {
    parameters: [Vector; 2],
    bases: [Matrix3x2<f64>; 2],
    patches: [Patch; 2],
    /// From the point on the first to the point on the second.
    between: Vector,
    /// Mean of the first normal and the second one reversed.
    normal: Vector,
    across: Matrix3x2<f64>,
    residual: Vector4<f64>,
}

/// What Newton's method works on.
struct Problem<'a> {
    surfaces: [Surface<'a>; 2],
    relative: &'a Relative,
    size: f64,
}

impl Problem<'_> {
    #[inline]
    fn facing(&self, parameters: [Vector; 2]) -> Facing {
        let rotation = &self.relative.rotation;
        let bases = [basis(&parameters[0]), basis(&parameters[1])];
        let own = self.surfaces[0].patch(&parameters[0], &bases[0]);
        let seen = self.surfaces[1].patch(&parameters[1], &bases[1]);
        let other = Patch {
            point: self.relative.position + rotation * seen.point,
            slope_of_point: rotation * seen.slope_of_point,
            normal: rotation * seen.normal,
            slope_of_normal: rotation * seen.slope_of_normal,
        };
        let between = other.point - own.point;
        let normal = (own.normal - other.normal).normalize();
        let across = basis(&normal);
        let of_normals = across.tr_mul(&(own.normal + other.normal));
        let of_points = across.tr_mul(&between) / self.size;
        let residual = Vector4::new(of_normals.x, of_normals.y, of_points.x, of_points.y);
        Facing { parameters, bases, patches: [own, other], between, normal, across, residual }
    }

    /// Derivative of the residual by both parameters.
    #[inline]
    fn jacobian(&self, facing: &Facing) -> Matrix4<f64> {
        let distance = facing.between.dot(&facing.normal);
        let mut jacobian = Matrix4::zeros();
        for (place, sign) in [(0, -1.0), (1, 1.0)] {
            let patch = &facing.patches[place];
            let of_normal = facing.across.tr_mul(&patch.slope_of_normal);
            let of_point = facing.across.tr_mul(&patch.slope_of_point) * sign;
            // The plane across turns with the normals, and the distance in it.
            let of_distance = (of_point + of_normal * (0.5 * distance * sign)) / self.size;
            jacobian.fixed_view_mut::<2, 2>(0, 2 * place).copy_from(&of_normal);
            jacobian.fixed_view_mut::<2, 2>(2, 2 * place).copy_from(&of_distance);
        }
        jacobian
    }

    /// Newton's step of both parameters.
    #[inline]
    fn step(&self, facing: &Facing) -> Option<[Vector; 2]> {
        let step = -solved(&self.jacobian(facing), &facing.residual)?;
        let longest = step.fixed_rows::<2>(0).norm().max(step.fixed_rows::<2>(2).norm());
        if !longest.is_finite() {
            return None;
        }
        let step = if longest > LONGEST_STEP { step * (LONGEST_STEP / longest) } else { step };
        Some([facing.bases[0] * step.fixed_rows::<2>(0), facing.bases[1] * step.fixed_rows::<2>(2)])
    }

    /// Follows Newton's method from a pair of parameters.
    fn solve(&self, start: [Vector; 2]) -> Option<Facing> {
        let mut facing = self.facing(start);
        let mut error = facing.residual.norm_squared();
        for _ in 0..LARGEST_NUMBER_OF_STEPS {
            if error <= CONVERGED * CONVERGED {
                return Some(facing);
            }
            let step = self.step(&facing)?;
            let mut fraction = 1.0;
            let next = loop {
                let moved = [0, 1].map(|place| (facing.parameters[place] + step[place] * fraction).normalize());
                let next = self.facing(moved);
                if next.residual.norm_squared() < error * (1.0 - 0.1 * fraction) {
                    break next;
                }
                if error <= ROUNDED * ROUNDED {
                    return Some(facing);
                }
                fraction *= 0.5;
                if fraction < 1e-3 {
                    return None;
                }
            };
            error = next.residual.norm_squared();
            facing = next;
        }
        None
    }
}

/// Solution of four linear equations by elimination with row exchange.
#[inline]
fn solved(matrix: &Matrix4<f64>, right: &Vector4<f64>) -> Option<Vector4<f64>> {
    let mut rows: [[f64; 5]; 4] =
        std::array::from_fn(|row| std::array::from_fn(|column| if column < 4 { matrix[(row, column)] } else { right[row] }));
    for column in 0..4 {
        let pivot = (column..4).max_by(|one, other| rows[*one][column].abs().total_cmp(&rows[*other][column].abs()))?;
        rows.swap(column, pivot);
        let of_pivot = rows[column];
        for row in &mut rows[column + 1..] {
            let factor = row[column] / of_pivot[column];
            row.iter_mut().zip(of_pivot).for_each(|(number, above)| *number -= factor * above);
        }
    }
    let mut solution = Vector4::zeros();
    for row in (0..4).rev() {
        let known: f64 = (row + 1..4).map(|place| rows[row][place] * solution[place]).sum();
        solution[row] = (rows[row][4] - known) / rows[row][row];
    }
    Some(solution)
}

/// Two unit vectors that make a right-handed system with a unit vector.
#[inline]
pub(super) fn basis(normal: &Vector) -> Matrix3x2<f64> {
    // Duff and others (2017): without a branch and without a division by a small number.
    let sign = 1.0_f64.copysign(normal.z);
    let a = -1.0 / (sign + normal.z);
    let b = normal.x * normal.y * a;
    let one = Vector::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    let other = Vector::new(b, sign + normal.y * normal.y * a, -normal.y);
    Matrix3x2::from_columns(&[one, other])
}

/// Where Newton's method begins; everything but parameters is seen from the frame of the first set.
pub enum Start {
    /// What the last look has left.
    Guess(Guess),
    /// A direction of any length but zero, and a point near each surface, from the centre of its set.
    Points(Vector, [Vector; 2]),
}

impl Problem<'_> {
    /// Parameters of both surfaces to begin with.
    #[inline]
    fn parameters(&self, start: &Start, cores: [&Core; 2]) -> [Vector; 2] {
        let (direction, points) = match start {
            Start::Guess(Guess { known: Known::Parameters(parameters), .. }) => return *parameters,
            Start::Guess(guess) => (&guess.direction, None),
            Start::Points(direction, points) => (direction, Some(points)),
        };
        let normal = direction.normalize();
        let facing_back = -self.relative.rotation.tr_mul(&normal);
        let [on_first, on_second] = match points {
            Some([on_first, on_second]) => [*on_first, self.relative.rotation.tr_mul(on_second)],
            None => [cores[0].support(&normal), cores[1].support(&facing_back)],
        };
        [self.surfaces[0].parameter(&on_first, &normal), self.surfaces[1].parameter(&on_second, &facing_back)]
    }
}

/// Signed distance of two sets that are superellipsoids or points, in the frame of the first. `None` for other sets, and if the result cannot be certified to a gap of `tolerance` in m.
pub fn separation(first: &Core, second: &Core, relative: &Relative, start: &Start, tolerance: f64) -> Option<Separation> {
    let surfaces = [Surface::of(first)?, Surface::of(second)?];
    let problem = Problem { surfaces, relative, size: first.reach() + second.reach() };
    let start = problem.parameters(start, [first, second]);
    let facing = problem.solve(start)?;
    let distance = facing.between.dot(&facing.normal);
    let disagreement = (facing.patches[0].normal + facing.patches[1].normal).norm();
    let gap = if distance > 0.0 {
        // The first normal supports the first set exactly; the second set may reach beyond by as much as the normals disagree.
        let lower = facing.between.dot(&facing.patches[0].normal) - 2.0 * second.reach() * disagreement;
        facing.between.norm() - lower
    } else {
        let shallow = SHALLOW * problem.surfaces[0].inner_radius().min(problem.surfaces[1].inner_radius());
        // The determinant is that of the sum of both curvatures and the distance, which must be positive; the second normal is seen from behind, hence
        // the sign.
        let is_minimum = problem.jacobian(&facing).determinant() < 0.0;
        if !is_minimum || -distance > shallow {
            return None;
        }
        facing.residual.norm() * problem.size
    };
    (gap <= tolerance).then(|| Separation {
        distance,
        normal: facing.normal,
        on_first: facing.patches[0].point,
        on_second: facing.patches[1].point - relative.position,
        gap: gap.max(0.0),
        outcome: Outcome::Polished,
        known: Known::Parameters(facing.parameters),
        corners: 0,
    })
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use nalgebra::Matrix3;

    use super::super::{Pose, Query, separation};
    use super::*;
    use crate::Orientation;

    fn core(semi_axes: [f64; 3], exponents: [f64; 2]) -> Core {
        Core::Superellipsoid(Arc::new(Superellipsoid::new(semi_axes.into(), exponents).unwrap()))
    }

    fn pose(index: u32, distance: f64) -> Pose {
        let part = |stride: f64| (f64::from(index) * stride).fract() - 0.5;
        let direction = Vector::new(part(0.618_034), part(0.754_878), part(0.569_841)).normalize();
        let turn = Orientation::from_euler_angles(7.0 * part(0.324_718), 7.0 * part(0.220_744), 7.0 * part(0.856_675));
        Pose { position: direction * distance, rotation: *turn.to_rotation_matrix().matrix() }
    }

    /// Without the shortcut for ellipsoids, from a direction that is a little off.
    fn common_normal(one: &Core, first: &Pose, other: &Core, second: &Pose, normal: Vector) -> Separation {
        let relative = Relative::new(first, second);
        let start = Start::Guess(first.rotation.tr_mul(&(normal + Vector::new(0.02, -0.03, 0.01))).into());
        super::separation(one, other, &relative, &start, 1e-12).unwrap().turned(&first.rotation)
    }

    /// Exact: two balls of different radii, at any gap and any shallow overlap.
    #[test]
    fn balls_are_as_far_as_their_centres_less_their_radii() {
        let (one, other) = (core([1.0; 3], [1.0, 1.0]), core([0.4; 3], [1.0, 1.0]));
        for index in 1..200 {
            for gap in [1.0, 1e-3, 1e-9, -1e-9, -1e-3, -0.1] {
                let (first, second) = (Pose { position: Vector::zeros(), ..pose(index, 1.0) }, pose(2 * index, 1.4 + gap));
                let found = separation((&one, &first), (&other, &second), &Query::cold());
                assert!((found.distance - gap).abs() < 1e-13 && found.outcome == Outcome::Polished, "{index} {gap}: {found:?}");
                assert!((found.normal - second.position.normalize()).norm() < 1e-12);
                let twin = common_normal(&one, &first, &other, &second, found.normal);
                assert!((twin.distance - found.distance).abs() < 1e-13 && (twin.normal - found.normal).norm() < 1e-12);
                let balls = separation((&one, &first), (&Core::Point, &second), &Query::cold());
                assert!((balls.distance - gap - 0.4).abs() < 1e-13 && balls.outcome == Outcome::Polished, "{balls:?}");
            }
        }
    }

    /// Exact: two equal ellipsoids that are turned alike become balls when all lengths along each axis are scaled, which keeps touching.
    #[test]
    fn ellipsoids_turned_alike_touch_as_balls_do() {
        let axes = Vector::new(1.0, 0.3, 2.0);
        let body = core(axes.into(), [1.0, 1.0]);
        let origin = Pose { position: Vector::zeros(), rotation: Matrix3::identity() };
        for index in 1..200 {
            let way = pose(index, 2.0).position;
            let second = Pose { position: way.component_mul(&axes), ..origin };
            let found = separation((&body, &origin), (&body, &second), &Query::cold());
            let normal = way.component_div(&axes).normalize();
            let twin = common_normal(&body, &origin, &body, &second, normal);
            assert!(twin.distance.abs() < 1e-13 && (twin.normal - normal).norm() < 1e-11, "{index}: {twin:?} {normal}");
            assert!(found.distance.abs() < 1e-13 && (found.normal - normal).norm() < 1e-11, "{index}: {found:?} {normal}");
        }
    }

    #[test]
    fn general_shapes_are_certified_cold_and_warm_apart_and_overlapping() {
        let exponents = [0.1, 0.5, 1.0, 1.5, 1.9];
        let (mut others, mut total) = (Vec::new(), 0);
        for index in 1..2000_u32 {
            let pick = |place: u32| exponents[(index / 5_u32.pow(place) % 5) as usize];
            let one = core([1.0, 0.3 + 0.01 * f64::from(index % 70), 0.2], [pick(0), pick(1)]);
            let other = core([0.5, 0.5, 0.1 + 0.02 * f64::from(index % 60)], [pick(2), pick(3)]);
            let first = Pose { position: Vector::zeros(), ..pose(3 * index, 1.0) };
            let far = pose(index, 4.0);
            let cold = separation((&one, &first), (&other, &far), &Query::cold());
            for gap in [0.02, -0.002] {
                let near = Pose { position: far.position - cold.normal * (cold.distance - gap), ..far };
                let found = separation((&one, &first), (&other, &near), &Query::cold());
                total += 1;
                if found.outcome != Outcome::Polished {
                    others.push((index, gap, found.outcome, found.distance, found.gap));
                    continue;
                }
                let guess = Some((found.normal + Vector::new(4e-4, -6e-4, 7e-4)).into());
                let warm = separation((&one, &first), (&other, &near), &Query { guess, cutoff: f64::INFINITY });
                assert!(gap < 0.0 || (found.distance - gap).abs() < 1e-9, "{index} {gap}: {found:?}");
                assert!((warm.distance - found.distance).abs() < 1e-9, "{index} {gap}: {found:?} {warm:?}");
            }
        }
        // Sharp corners that overlap by more than they are round have their least depth beside their common normal.
        assert!(others.len() * 100 <= total && others.iter().all(|other| other.1 < 0.0), "{} of {total}: {others:?}", others.len());
    }
}
