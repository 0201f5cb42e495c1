//! The points that belong to two pieces and a direction: their distance is an upper bound.

use super::direction::Approach;
use super::{Body, Piece};
use crate::Vector;
use crate::distance::closed_forms::nearest_on_lines;

/// The point of each set that belongs to a direction.
pub(super) struct Witness {
    pub(super) on_first: Vector,
    pub(super) on_second: Vector,
    /// Not zero where the piece of a set was left: its sign tells at which end.
    pub(super) beyond: [f64; 2],
}

impl Witness {
    pub(super) fn new(pieces: &[Piece; 2], found: &Approach, bodies: &[Body<'_>; 2]) -> Witness {
        if pieces[0].face.is_some() || pieces[1].face.is_some() {
            return Witness::on_face(pieces, found, bodies);
        }
        let points = [found.foot(&pieces[0], 0), found.foot(&pieces[1], 1)];
        let between = points[1] - points[0];
        let wanted = match (pieces[0].line, pieces[1].line) {
            (None, None) => [0.0, 0.0],
            (Some((line, _)), None) => [between.dot(&line), 0.0],
            (None, Some((line, _))) => [0.0, -between.dot(&line)],
            (Some(one), Some(other)) => nearest_on_lines(&between, one, other),
        };
        let mut beyond = [0.0; 2];
        let mut place = |index: usize| {
            let Some((line, half_length)) = pieces[index].line else { return points[index] };
            if wanted[index].abs() >= half_length {
                beyond[index] = wanted[index];
            }
            points[index] + line * wanted[index].clamp(-half_length, half_length)
        };
        let (on_first, on_second) = (place(0), place(1));
        Witness { on_first, on_second, beyond }
    }

    /// One set shows a face: its point lies under the nearest point of the other.
    fn on_face(pieces: &[Piece; 2], found: &Approach, bodies: &[Body<'_>; 2]) -> Witness {
        let (flat, other) = if pieces[0].face.is_some() { (0, 1) } else { (1, 0) };
        let normal = &found.normal;
        let middle = pieces[flat].base;
        let mut beyond = [0.0; 2];
        let point = point_over(&middle, &pieces[other], found, other, &mut beyond[other]);
        let height = (point - middle).dot(normal);
        let foot = point - normal * height;
        let under = match pieces[flat].curved {
            Some((axis, radius)) => {
                let (across, length) = Piece::across(&axis, &(foot - middle));
                // A line may be left at its lower end only if that lies over the face.
                if length > radius {
                    (beyond[flat], beyond[other]) = (length - radius, 0.0);
                }
                middle + across * length.min(radius)
            }
            None => bodies[flat].nearest_on_triangle(&foot),
        };
        if flat == 0 {
            Witness { on_first: under, on_second: point, beyond }
        } else {
            Witness { on_first: point, on_second: under, beyond }
        }
    }
}

/// Cosine between a face's normal and a line, or sine between two faces, below which they count as parallel.
const PARALLEL: f64 = 1e-12;

/// The point of a piece nearest to the middle of a face that it lies over. `beyond` tells where to go on if the piece is not parallel to the face.
fn point_over(middle: &Vector, piece: &Piece, found: &Approach, place: usize, beyond: &mut f64) -> Vector {
    let normal = &found.normal;
    let toward_face = if place == 0 { 1.0 } else { -1.0 };
    if piece.face.is_some() {
        // If the other set lies flat as well, its point nearest to the middle of the face.
        let (axis, radius) = piece.curved.unwrap_or((*normal, 0.0));
        let tilt = Piece::across(&axis, normal).1;
        *beyond = if tilt > PARALLEL { tilt } else { 0.0 };
        let (across, length) = Piece::across(&axis, &(middle - piece.base));
        return piece.base + across * length.min(radius);
    }
    let foot = found.foot(piece, place);
    let Some((line, half_length)) = piece.line else { return foot };
    let slope = toward_face * line.dot(normal);
    if slope.abs() > PARALLEL {
        *beyond = half_length.copysign(slope);
        return foot + line * *beyond;
    }
    foot + line * (middle - foot).dot(&line).clamp(-half_length, half_length)
}
