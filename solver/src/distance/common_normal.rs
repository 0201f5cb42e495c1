//! Two superellipsoids: the points whose normals face each other along the line between them.
//!
//! At the nearest points of two smooth sets the outward normals are opposite and the line between both points lies along them. The same holds for the two
//! deepest points of a shallow overlap, where it defines depth and normal of the contact ("common normal", S section 2.4.5 names the method). That
//! is four equations for two parameters on each surface, solved by Newton's method with the [chart](crate::shape::superellipsoid::chart) of each.
//!
//! The result is certified: where sets are apart, the distance of the points is an upper bound and the supporting planes give a lower one; where they
//! overlap, depth must be a minimum over all directions near by.

use nalgebra::{Matrix2, Matrix3, Matrix3x2, Vector2, Vector4};

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
pub(super) const ROUNDED: f64 = 1e-12;
/// By how much more the error after a step counts than quadratic convergence foretells.
const DOUBT: f64 = 10.0;
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

    #[inline(always)]
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

/// A surface at a parameter, in its own frame.
struct Side {
    parameter: Vector,
    basis: Matrix3x2<f64>,
    patch: Patch,
}

impl Side {
    /// The parameter after a step along the basis.
    #[inline]
    fn moved(&self, step: &Vector2<f64>) -> Vector {
        (self.parameter + self.basis * step).normalize()
    }

    /// How the normal and the point move across a direction, seen in this frame; the plane across turns with the normals, and the distance in it.
    #[inline]
    fn slopes(&self, across: &Matrix3x2<f64>, half_distance: f64) -> (Matrix2<f64>, Matrix2<f64>) {
        let of_normal = across.tr_mul(&self.patch.slope_of_normal);
        (of_normal, across.tr_mul(&self.patch.slope_of_point) + of_normal * half_distance)
    }
}

/// Both surfaces at a pair of parameters, in the frame of the first.
struct Facing {
    sides: [Side; 2],
    /// Outward normal of the second.
    normal_of_second: Vector,
    /// From the point on the first to the point on the second.
    between: Vector,
    /// Mean of the first normal and the second one reversed.
    normal: Vector,
    /// Along the normal.
    distance: f64,
    across: Matrix3x2<f64>,
    residual: Vector4<f64>,
}

/// What Newton's method works on.
struct Problem<'a> {
    surfaces: [Surface<'a>; 2],
    relative: &'a Relative,
    size: f64,
    inverse_size: f64,
    /// Error, over the size, that a step may leave without a further look.
    certified: f64,
}

impl Problem<'_> {
    #[inline(always)]
    fn side(&self, place: usize, parameter: Vector) -> Side {
        let basis = basis(&parameter);
        Side { parameter, basis, patch: self.surfaces[place].patch(&parameter, &basis) }
    }

    #[inline(never)]
    fn facing(&self, parameters: [Vector; 2]) -> Facing {
        let sides = [self.side(0, parameters[0]), self.side(1, parameters[1])];
        let (own, other) = (&sides[0].patch, &sides[1].patch);
        let normal_of_second = self.relative.rotation * other.normal;
        let between = self.relative.position + self.relative.rotation * other.point - own.point;
        let normal = (own.normal - normal_of_second).normalize();
        let across = basis(&normal);
        let of_normals = across.tr_mul(&(own.normal + normal_of_second));
        let of_points = across.tr_mul(&between) * self.inverse_size;
        let residual = Vector4::new(of_normals.x, of_normals.y, of_points.x, of_points.y);
        let distance = between.dot(&normal);
        Facing { sides, normal_of_second, between, normal, distance, across, residual }
    }

    /// Derivative of the residual by both parameters, row by row.
    #[inline]
    fn jacobian(&self, facing: &Facing) -> Rows {
        let half_distance = 0.5 * facing.distance;
        let (of_own_normal, of_own_point) = facing.sides[0].slopes(&facing.across, half_distance);
        let (of_normal, of_point) = facing.sides[1].slopes(&self.relative.rotation.tr_mul(&facing.across), half_distance);
        let (of_own_point, of_point) = (of_own_point * -self.inverse_size, of_point * self.inverse_size);
        let row = |own: &Matrix2<f64>, other: &Matrix2<f64>, row: usize| [own[(row, 0)], own[(row, 1)], other[(row, 0)], other[(row, 1)]];
        [
            row(&of_own_normal, &of_normal, 0),
            row(&of_own_normal, &of_normal, 1),
            row(&of_own_point, &of_point, 0),
            row(&of_own_point, &of_point, 1),
        ]
    }

    /// Newton's step of both parameters, along their bases.
    #[inline]
    fn step(&self, facing: &Facing, jacobian: &Rows) -> Option<Step> {
        let [a, b, c, d] = solved(jacobian, &facing.residual);
        let parts = [-Vector2::new(a, b), -Vector2::new(c, d)];
        let (of_first, of_second) = (parts[0].norm(), parts[1].norm());
        if !(of_first + of_second).is_finite() {
            return None;
        }
        let length = of_first.max(of_second);
        let is_full = length <= LONGEST_STEP;
        let scale = if is_full { 1.0 } else { LONGEST_STEP / length };
        Some(Step { parts: [parts[0] * scale, parts[1] * scale], length, is_full })
    }

    /// Follows Newton's method from a pair of parameters. The last step is left to do where it is sure to end within the certificate.
    fn solve(&self, start: [Vector; 2]) -> Option<Solution> {
        let mut facing = self.facing(start);
        let mut error = facing.residual.norm_squared();
        let mut length_before = None;
        for _ in 0..LARGEST_NUMBER_OF_STEPS {
            let jacobian = self.jacobian(&facing);
            if error <= CONVERGED * CONVERGED {
                return Some(Solution { facing, jacobian, last_step: None });
            }
            let step = self.step(&facing, &jacobian)?;
            let left = left_by(step.length, length_before);
            if facing.distance < 0.0 && left <= self.certified {
                return Some(Solution { facing, jacobian, last_step: Some((step.parts, left)) });
            }
            let mut fraction = 1.0;
            let next = loop {
                let [first, second] = &step.parts;
                let next = self.facing([facing.sides[0].moved(&(first * fraction)), facing.sides[1].moved(&(second * fraction))]);
                if next.residual.norm_squared() < error * (1.0 - 0.1 * fraction) {
                    break next;
                }
                if error <= ROUNDED * ROUNDED {
                    return Some(Solution { facing, jacobian, last_step: None });
                }
                fraction *= 0.5;
                if fraction < 1e-3 {
                    return None;
                }
            };
            length_before = (step.is_full && fraction == 1.0).then_some(step.length);
            error = next.residual.norm_squared();
            facing = next;
        }
        None
    }
}

/// A step of both parameters.
struct Step {
    parts: [Vector2<f64>; 2],
    /// Of the longer part, before it is cut.
    length: f64,
    is_full: bool,
}

/// Error that a step leaves, by the length of the full step before it: those of quadratic convergence are as long as a constant times the square of the one
/// before. The last two tell the constant, which is taken for no less than one. Infinite where nothing is known.
#[inline]
pub(super) fn left_by(length: f64, length_before: Option<f64>) -> f64 {
    let constant = |before: f64| (length / (before * before)).max(1.0);
    length_before.filter(|before| length < *before).map_or(f64::INFINITY, |before| DOUBT * constant(before) * length * length)
}

/// Where Newton's method has ended.
struct Solution {
    facing: Facing,
    jacobian: Rows,
    /// A step that is too short to look again, and the error that it leaves.
    last_step: Option<([Vector2<f64>; 2], f64)>,
}

/// Four rows of a matrix.
type Rows = [[f64; 4]; 4];

/// Solution of four linear equations by elimination with row exchange; not finite if there is none.
#[inline]
fn solved(matrix: &Rows, right: &Vector4<f64>) -> [f64; 4] {
    let with_right = |[a, b, c, d]: [f64; 4], right: f64| [a, b, c, d, right];
    let mut rows =
        [with_right(matrix[0], right.x), with_right(matrix[1], right.y), with_right(matrix[2], right.z), with_right(matrix[3], right.w)];
    for column in 0..4 {
        let mut pivot = column;
        for row in column + 1..4 {
            if rows[row][column].abs() > rows[pivot][column].abs() {
                pivot = row;
            }
        }
        rows.swap(column, pivot);
        let of_pivot = rows[column];
        let inverse = 1.0 / of_pivot[column];
        for row in &mut rows[column + 1..] {
            let factor = row[column] * inverse;
            row.iter_mut().zip(&of_pivot).for_each(|(number, above)| *number -= factor * above);
        }
    }
    let d = rows[3][4] / rows[3][3];
    let c = (rows[2][4] - rows[2][3] * d) / rows[2][2];
    let b = (rows[1][4] - rows[1][2] * c - rows[1][3] * d) / rows[1][1];
    let a = (rows[0][4] - rows[0][1] * b - rows[0][2] * c - rows[0][3] * d) / rows[0][0];
    [a, b, c, d]
}

/// By the minors of the first two rows and those of the last two (Laplace).
#[inline]
fn determinant(matrix: &Rows) -> f64 {
    let minor =
        |row: usize, one: usize, other: usize| matrix[row][one] * matrix[row + 1][other] - matrix[row][other] * matrix[row + 1][one];
    let product = |[one, other, third, fourth]: [usize; 4]| minor(0, one, other) * minor(2, third, fourth);
    product([0, 1, 2, 3]) - product([0, 2, 1, 3]) + product([0, 3, 1, 2]) + product([1, 2, 0, 3]) - product([1, 3, 0, 2])
        + product([2, 3, 0, 1])
}

/// Two unit vectors that make a right-handed system with a unit vector.
#[inline]
pub(crate) fn basis(normal: &Vector) -> Matrix3x2<f64> {
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
    let size = first.reach() + second.reach();
    let problem = Problem { surfaces, relative, size, inverse_size: 1.0 / size, certified: ROUNDED.min(tolerance / size) };
    let start = problem.parameters(start, [first, second]);
    let Solution { facing, jacobian, last_step } = problem.solve(start)?;
    let ([own, other], distance) = (&facing.sides, facing.distance);
    let disagreement = (own.patch.normal + facing.normal_of_second).norm();
    let gap = if distance > 0.0 {
        // The first normal supports the first set exactly; the second set may reach beyond by as much as the normals disagree.
        let lower = facing.between.dot(&own.patch.normal) - 2.0 * second.reach() * disagreement;
        facing.between.norm() - lower
    } else {
        let shallow = SHALLOW * problem.surfaces[0].inner_radius().min(problem.surfaces[1].inner_radius());
        // The determinant is that of the sum of both curvatures and the distance, which must be positive; the second normal is seen from behind, hence
        // the sign.
        let is_minimum = determinant(&jacobian) < 0.0;
        if !is_minimum || -distance > shallow {
            return None;
        }
        last_step.map_or_else(|| facing.residual.norm(), |(_, left)| left) * problem.size
    };
    let found = Separation {
        distance,
        normal: facing.normal,
        on_first: own.patch.point,
        on_second: own.patch.point + facing.between - relative.position,
        gap: gap.max(0.0),
        outcome: Outcome::Polished,
        known: Known::Parameters([own.parameter, other.parameter]),
        corners: 0,
    };
    (gap <= tolerance).then(|| last_step.map_or(found, |(step, _)| stepped(found, &facing, &step, &relative.rotation)))
}

/// An answer after a last step, by what the surfaces do to second order.
fn stepped(found: Separation, facing: &Facing, steps: &[Vector2<f64>; 2], rotation: &Matrix3<f64>) -> Separation {
    let [own, other] = &facing.sides;
    let (move_of_first, turn_of_first) = (own.patch.slope_of_point * steps[0], own.patch.slope_of_normal * steps[0]);
    let move_of_second = rotation * (other.patch.slope_of_point * steps[1]);
    let turn_of_second = rotation * (other.patch.slope_of_normal * steps[1]);
    let normal = (facing.normal + 0.5 * (turn_of_first - turn_of_second)).normalize();
    // A surface bends away from its tangent by half of how far it moves along how far it turns.
    let (bend_of_first, bend_of_second) = (0.5 * move_of_first.dot(&turn_of_first), 0.5 * move_of_second.dot(&turn_of_second));
    Separation {
        distance: (facing.between + move_of_second - move_of_first).dot(&normal) + bend_of_first + bend_of_second,
        normal,
        on_first: found.on_first + move_of_first - normal * bend_of_first,
        on_second: found.on_second + move_of_second + normal * bend_of_second,
        known: Known::Parameters([own.moved(&steps[0]), other.moved(&steps[1])]),
        ..found
    }
}

#[cfg(test)]
mod tests;
