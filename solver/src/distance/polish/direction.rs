//! Direction of the nearest approach of two pieces: closed forms, and Newton's method on the angles of rims.
//!
//! With `u` the unit vector of a rim across its axis and `t` its tangent, the points of two rims differ by `d = between - r1 u1 - r2 u2`. Half
//! the square of `d` is smallest where `t . d = 0` on both rims. Newton's method on that needs no root and stays regular where the gap vanishes
//! or the direction nears an axis. A straight line only adds freedom along itself: `d` is taken across it.

use super::{Kind, Piece};
use crate::Vector;
use crate::distance::closed_forms::{across, direction_between_lines, nearest_on_lines};

/// Newton's method doubles the digits: a last step as small as this leaves rounding error.
const LAST_STEP: f64 = 1e-8;
const LARGEST_NUMBER_OF_STEPS: usize = 40;
/// Largest change of an angle in one step, in radians.
const LARGEST_STEP: f64 = 0.7;

/// A direction, where it meets the rims, and which rims it leaves towards their axis, where the face is nearer.
#[derive(Debug, Clone, Copy)]
pub(super) struct Approach {
    pub(super) normal: Vector,
    pub(super) inwards: [bool; 2],
    /// Unit vectors across the axis towards the point of each rim; of the second against the normal. `None`: that of the normal.
    outward: [Option<Vector>; 2],
}

impl Approach {
    fn along(normal: Vector) -> Approach {
        Approach { normal, inwards: [false; 2], outward: [None; 2] }
    }

    /// The point of the first or second piece, in the middle of its line.
    #[inline]
    pub(super) fn foot(&self, piece: &Piece, place: usize) -> Vector {
        let Some((axis, radius)) = piece.curved else { return piece.base };
        let outward = self.outward[place].unwrap_or_else(|| Piece::across(&axis, &self.normal).0);
        if place == 0 { piece.base + outward * radius } else { piece.base - outward * radius }
    }
}

/// A rim while its angle is sought: everything across its axis.
#[derive(Clone, Copy)]
struct Rim {
    outward: Vector,
    tangent: Vector,
    radius: f64,
}

impl Rim {
    /// A rim from a first guess of its outward direction.
    fn new(piece: &Piece, start: &Vector) -> Option<Rim> {
        let (axis, radius) = piece.curved?;
        let (across, length) = Piece::across(&axis, start);
        let outward = if length > 0.0 { across } else { axis.cross(&Vector::new(axis.y, axis.z, -axis.x)).try_normalize(0.0)? };
        Some(Rim { outward, tangent: axis.cross(&outward), radius })
    }

    /// Turned by about an arc in m over the radius; returns the angle. Without a root, exact to the third order.
    #[inline]
    fn turn(&mut self, arc: f64) -> f64 {
        let angle = (arc / self.radius).clamp(-LARGEST_STEP, LARGEST_STEP);
        let half = 0.5 * angle;
        let scale = 1.0 / (1.0 + half * half);
        let (sine, cosine) = (2.0 * half * scale, (1.0 - half * half) * scale);
        let outward = self.outward * cosine + self.tangent * sine;
        self.tangent = self.tangent * cosine - self.outward * sine;
        self.outward = outward;
        angle.abs()
    }

    fn flip(&mut self) {
        self.outward = -self.outward;
        self.tangent = -self.tangent;
    }
}

/// The direction in which two pieces are nearest. `starts` are guesses of it, or of the direction from the middle of a rim to its point.
pub(super) fn approach(pieces: &[Piece; 2], starts: &[Vector; 2]) -> Option<Approach> {
    if let Some(outward) = pieces[0].face {
        return Some(Approach::along(outward));
    }
    if let Some(outward) = pieces[1].face {
        return Some(Approach::along(-outward));
    }
    let between = pieces[1].base - pieces[0].base;
    let is_rim = |place: usize| pieces[place].kind == Kind::Rim;
    match (is_rim(0), is_rim(1)) {
        (true, true) => two_rims(&between, Rim::new(&pieces[0], &starts[0])?, Rim::new(&pieces[1], &starts[1])?),
        (false, false) => Some(Approach::along(straight(pieces, &between)?)),
        (is_first, _) => {
            let (rim, other) = if is_first { (0, 1) } else { (1, 0) };
            let (normal, inwards, outward) = match pieces[other].line {
                Some((line, _)) => rim_and_line(&between, Rim::new(&pieces[rim], &starts[rim])?, &line)?,
                None => rim_and_point(&between, &pieces[rim])?,
            };
            let mut approach = Approach::along(normal);
            (approach.inwards[rim], approach.outward[rim]) = (inwards, Some(outward));
            Some(approach)
        }
    }
}

/// Two pieces of which none is a rim or a face.
fn straight(pieces: &[Piece; 2], between: &Vector) -> Option<Vector> {
    match (pieces[0].line, pieces[1].line) {
        (Some(one), Some(other)) => direction_between_lines(between, one, other, nearest_on_lines(between, one, other)),
        (Some((line, _)), None) | (None, Some((line, _))) => across(between, &line),
        (None, None) => between.try_normalize(0.0),
    }
}

fn rim_and_point(between: &Vector, rim: &Piece) -> Option<(Vector, bool, Vector)> {
    let (axis, radius) = rim.curved?;
    let (across, length) = Piece::across(&axis, between);
    Some(((between - across * radius).try_normalize(0.0)?, length < radius, across))
}

fn rim_and_line(between: &Vector, mut rim: Rim, line: &Vector) -> Option<(Vector, bool, Vector)> {
    let mut has_flipped = false;
    loop {
        let mut vector = Vector::zeros();
        for _ in 0..LARGEST_NUMBER_OF_STEPS {
            vector = between - rim.outward * rim.radius;
            vector -= line * vector.dot(line);
            let along = rim.tangent.dot(line);
            let stiffness = (1.0 - along * along).max(0.0) + (rim.outward.dot(&vector) / rim.radius).max(0.0);
            if rim.turn(rim.tangent.dot(&vector) / stiffness.max(f64::EPSILON)) <= LAST_STEP {
                break;
            }
        }
        let inwards = rim.outward.dot(&vector) < 0.0;
        if !inwards || has_flipped {
            let vector = between - rim.outward * rim.radius;
            return Some((across(&vector, line)?, inwards, rim.outward));
        }
        // A line over a disc is near its rim twice; only one of both points can be the nearest of the disc.
        rim.flip();
        has_flipped = true;
    }
}

fn two_rims(between: &Vector, mut one: Rim, mut other: Rim) -> Option<Approach> {
    let mut has_flipped = false;
    loop {
        let mut vector = Vector::zeros();
        for _ in 0..LARGEST_NUMBER_OF_STEPS {
            vector = between - one.outward * one.radius - other.outward * other.radius;
            let stiffness_of_one = 1.0 + (one.outward.dot(&vector) / one.radius).max(0.0);
            let stiffness_of_other = 1.0 + (other.outward.dot(&vector) / other.radius).max(0.0);
            let coupling = one.tangent.dot(&other.tangent);
            let (slope_of_one, slope_of_other) = (one.tangent.dot(&vector), other.tangent.dot(&vector));
            let scale = 1.0 / (stiffness_of_one * stiffness_of_other - coupling * coupling).max(f64::EPSILON);
            let angle = one.turn((stiffness_of_other * slope_of_one - coupling * slope_of_other) * scale);
            if other.turn((stiffness_of_one * slope_of_other - coupling * slope_of_one) * scale).max(angle) <= LAST_STEP {
                break;
            }
        }
        let inwards = [one.outward.dot(&vector) < 0.0, other.outward.dot(&vector) < 0.0];
        if inwards == [false; 2] || has_flipped {
            let vector = between - one.outward * one.radius - other.outward * other.radius;
            return Some(Approach { normal: vector.try_normalize(0.0)?, inwards, outward: [Some(one.outward), Some(other.outward)] });
        }
        if inwards[0] {
            one.flip();
        }
        if inwards[1] {
            other.flip();
        }
        has_flipped = true;
    }
}
