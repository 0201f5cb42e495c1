//! Distance of curved sets to rounding error: Newton's method on the direction, with a certificate.
//!
//! For a unit direction $n$ the gap between the supporting planes of two convex sets, $f(n) = -h_1(n) - h_2(-n)$, never exceeds their
//! distance and equals it for the right direction (von Neumann's minimum-norm duality). Near the answer each set shows one *piece*: a corner or
//! rim; a straight line of its surface, which holds the direction at right angles to that line; or a face, which fixes it. For known pieces
//! the direction is a closed form or a few steps of Newton's method (file `direction`), where GJK needs dozens, and fails.
//!
//! The certificate: a point of each set whose distance is an upper bound, and a direction whose gap is a lower one. A result is only accepted
//! if both agree.

mod direction;
pub mod smooth;
mod witness;

use super::core::Core;
use super::simplex::{Corner, Foot, Simplex};
use super::{Known, Outcome, Relative, Separation};
use crate::Vector;
use direction::{Approach, approach};
use witness::Witness;

/// A certified distance, in the frame of the first set.
#[derive(Debug, Clone, Copy)]
pub struct Polished {
    /// Unit direction from the first set to the second.
    pub normal: Vector,
    /// Upper bound of the distance in m: that of two points of the sets.
    pub distance: f64,
    /// Upper less lower bound, in m.
    pub gap: f64,
    /// Point of the first set.
    pub on_first: Vector,
    /// Point of the second set: the certificate allows the line between both to lean by much more than either point may leave its set.
    pub on_second: Vector,
}

impl Polished {
    pub(super) fn answer(&self, relative: &Relative, corners: u32) -> Separation {
        Separation {
            distance: self.distance,
            normal: self.normal,
            on_first: self.on_first,
            on_second: self.on_second - relative.position,
            gap: self.gap,
            outcome: Outcome::Polished,
            known: Known::Nothing,
            corners,
        }
    }
}

/// What a set shows near the direction that is sought: points `base + radius * (direction across axis) + s * line`.
#[derive(Debug, Clone, Copy)]
struct Piece {
    base: Vector,
    /// Axis and radius of a curved piece.
    curved: Option<(Vector, f64)>,
    /// Unit vector along a straight line of the surface, and half its length.
    line: Option<(Vector, f64)>,
    /// Outward normal of a flat face.
    face: Option<Vector>,
    kind: Kind,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Side,
    Rim,
    Face,
    OfPolytope,
}

const LARGEST_NUMBER_OF_PIECES: usize = 8;
/// A direction closer to the plane across the axis than this is tried as that of a side first, closer to the axis as that of a face.
const NEAR: f64 = 0.02;

/// One of the two sets, with its sign: the outward direction of the second is against the normal.
struct Body<'a> {
    core: &'a Core,
    sign: f64,
    centre: Vector,
    axis: Vector,
    points: Points,
}

/// Up to four points without a heap.
#[derive(Clone, Copy)]
struct Points {
    points: [Vector; 4],
    count: usize,
}

impl Points {
    /// The distinct corners of a polytope that a search has found; none for a curved set.
    fn of_search(core: &Core, simplex: Option<&Simplex>, is_second: bool) -> Points {
        let mut kept = Points { points: [Vector::zeros(); 4], count: 0 };
        let Some(simplex) = simplex.filter(|_| !core.is_curved()) else { return kept };
        for corner in simplex.corners() {
            let point = if is_second { corner.difference + corner.on_first } else { corner.on_first };
            // Points of the second set come out of a difference: the same corner may differ in the last bit.
            let is_known = kept.points[..kept.count].iter().any(|known| (known - point).norm_squared() <= 1e-24 * point.norm_squared());
            if !is_known {
                kept.points[kept.count] = point;
                kept.count += 1;
            }
        }
        kept
    }

    /// The same points seen otherwise.
    fn mapped(mut self, map: impl Fn(&Vector) -> Vector) -> Points {
        self.points.iter_mut().take(self.count).for_each(|point| *point = map(point));
        self
    }
}

/// Distance from a guess of the direction in the frame of the first set. The simplex of a search tells the corners of polytopes; without it both
/// sets must be cylinders. `None` if the result cannot be certified to a gap of `tolerance` in m.
pub fn polish(
    first: &Core,
    second: &Core,
    relative: &Relative,
    guess: &Vector,
    simplex: Option<&Simplex>,
    tolerance: f64,
) -> Option<Polished> {
    let axis_of_second = relative.rotation.column(2).into_owned();
    let bodies = [
        Body { core: first, sign: 1.0, centre: Vector::zeros(), axis: Vector::z(), points: Points::of_search(first, simplex, false) },
        Body {
            core: second,
            sign: -1.0,
            centre: relative.position,
            axis: axis_of_second,
            points: Points::of_search(second, simplex, true),
        },
    ];
    let normal = guess.normalize();
    let mut pieces = [bodies[0].piece_at(&normal)?, bodies[1].piece_at(&normal)?];
    let mut starts = match simplex {
        Some(simplex) => {
            let Foot { difference, on_first } = simplex.nearest();
            [on_first - pieces[0].base, pieces[1].base - on_first - difference]
        }
        None => [normal; 2],
    };
    for _ in 0..LARGEST_NUMBER_OF_PIECES {
        let found = approach(&pieces, &starts)?;
        let normal = found.normal;
        let witness = Witness::new(&pieces, &found, &bodies);
        let lower = -first.support(&normal).dot(&normal) + relative.support(second, &-normal).dot(&normal);
        let distance = (witness.on_second - witness.on_first).norm();
        let gap = distance - lower;
        if gap.abs() <= tolerance && lower > -tolerance {
            return Some(Polished { normal, distance, gap: gap.max(0.0), on_first: witness.on_first, on_second: witness.on_second });
        }
        let next = [0, 1].map(|place| bodies[place].next_piece(&pieces[place], &found, witness.beyond[place], place));
        starts = [witness.on_first - pieces[0].base, pieces[1].base - witness.on_second];
        pieces = match next {
            [None, None] => whole_again(&pieces, &bodies)?,
            [one, other] => [one.unwrap_or(pieces[0]), other.unwrap_or(pieces[1])],
        };
    }
    None
}

/// The pieces with an edge in the place of the corner that it was left for, which may have been the fault of the other set.
fn whole_again(pieces: &[Piece; 2], bodies: &[Body<'_>; 2]) -> Option<[Piece; 2]> {
    let has_lost_its_line =
        |place: usize| pieces[place].kind == Kind::OfPolytope && pieces[place].line.is_none() && bodies[place].points.count == 2;
    let whole = |place: usize| if has_lost_its_line(place) { bodies[place].piece_of_polytope() } else { Some(pieces[place]) };
    if has_lost_its_line(0) || has_lost_its_line(1) { Some([whole(0)?, whole(1)?]) } else { None }
}

impl Body<'_> {
    /// The piece that a set shows in a direction.
    fn piece_at(&self, normal: &Vector) -> Option<Piece> {
        match self.core {
            Core::Cylinder { .. } => {
                let along = self.sign * normal.dot(&self.axis);
                Some(if along.abs() < NEAR {
                    self.side()?
                } else if 1.0 - along.abs() < 0.5 * NEAR * NEAR {
                    self.end_face(along)?
                } else {
                    self.rim(along)?
                })
            }
            _ => self.piece_of_polytope(),
        }
    }

    fn cylinder(&self) -> Option<(f64, f64)> {
        match self.core {
            Core::Cylinder { radius, half_length } => Some((*radius, *half_length)),
            _ => None,
        }
    }

    fn side(&self) -> Option<Piece> {
        let (radius, half_length) = self.cylinder()?;
        let line = Some((self.axis, half_length));
        Some(Piece { base: self.centre, curved: Some((self.axis, radius)), line, face: None, kind: Kind::Side })
    }

    fn rim(&self, end: f64) -> Option<Piece> {
        let (radius, half_length) = self.cylinder()?;
        let base = self.centre + self.axis * half_length.copysign(end);
        Some(Piece { base, curved: Some((self.axis, radius)), line: None, face: None, kind: Kind::Rim })
    }

    fn end_face(&self, end: f64) -> Option<Piece> {
        let (radius, half_length) = self.cylinder()?;
        let outward = self.axis * 1.0_f64.copysign(end);
        let base = self.centre + outward * half_length;
        Some(Piece { base, curved: Some((self.axis, radius)), line: None, face: Some(outward), kind: Kind::Face })
    }

    fn piece_of_polytope(&self) -> Option<Piece> {
        let Points { points, count } = self.points;
        let plain = |base| Piece { base, curved: None, line: None, face: None, kind: Kind::OfPolytope };
        match count {
            1 => Some(plain(points[0])),
            2 => {
                let edge = points[1] - points[0];
                let length = edge.norm();
                Some(Piece { line: Some((edge / length, 0.5 * length)), ..plain(0.5 * (points[0] + points[1])) })
            }
            3 => {
                let normal = (points[1] - points[0]).cross(&(points[2] - points[0])).try_normalize(0.0)?;
                let outward = if normal.dot(&(points[0] - self.centre)) < 0.0 { -normal } else { normal };
                let middle = (points[0] + points[1] + points[2]) / 3.0;
                Some(Piece { face: Some(outward), ..plain(middle) })
            }
            _ => None,
        }
    }

    /// The point nearest to a given one of the triangle of a polytope that the search has found.
    fn nearest_on_triangle(&self, point: &Vector) -> Vector {
        let corner = |place: usize| Corner { difference: self.points.points[place] - point, on_first: Vector::zeros(), numbers: [0; 2] };
        let mut triangle = Simplex::default();
        triangle.add(corner(0));
        triangle.add(corner(1));
        point + triangle.add(corner(2))
    }

    /// The piece to try after one that was not the right one, which was left by `beyond`; `None` if it may stay.
    fn next_piece(&self, piece: &Piece, found: &Approach, beyond: f64, place: usize) -> Option<Piece> {
        let along = self.sign * found.normal.dot(&self.axis);
        match piece.kind {
            Kind::Side if beyond != 0.0 => self.rim(beyond),
            Kind::Face if beyond != 0.0 => self.rim(along),
            Kind::Rim if (piece.base - self.centre).dot(&self.axis) * along < 0.0 => self.side(),
            Kind::Rim if found.inwards[place] => self.end_face(along),
            Kind::OfPolytope if beyond != 0.0 => {
                let (line, half_length) = piece.line?;
                Some(Piece { base: piece.base + line * half_length.copysign(beyond), line: None, ..*piece })
            }
            _ => None,
        }
    }
}

impl Piece {
    /// Unit vector across the axis of a curved piece nearest to a direction, and its sine to the axis.
    #[inline]
    fn across(axis: &Vector, normal: &Vector) -> (Vector, f64) {
        let across = normal - axis * normal.dot(axis);
        let length = across.norm();
        if length == 0.0 {
            return (Vector::zeros(), 0.0);
        }
        let unit = across / length;
        if length > SMALL {
            return (unit, length);
        }
        // What rounding has left along the axis is no longer small beside so little across it.
        ((unit - axis * unit.dot(axis)).normalize(), length)
    }
}

/// Sine between direction and axis below which the part across the axis is freed of rounding.
const SMALL: f64 = 1e-2;

#[cfg(test)]
mod tests {
    use super::super::{Pose, Query, separation};
    use super::*;
    use crate::Orientation;

    const CYLINDER: Core = Core::Cylinder { radius: 0.5, half_length: 1.0 };

    fn tilted(position: Vector, tilt: f64) -> Pose {
        Pose { position, rotation: *Orientation::from_axis_angle(&Vector::y_axis(), tilt).to_rotation_matrix().matrix() }
    }

    /// Distance of two cylinders, cold and warm, which must agree; both must be certified.
    fn distance(second: &Core, pose: &Pose) -> f64 {
        let first = tilted(Vector::zeros(), 0.0);
        let cold = separation((&CYLINDER, &first), (second, pose), &Query::cold());
        let guess = cold.normal + Vector::new(3e-4, -5e-4, 4e-4);
        let warm = separation((&CYLINDER, &first), (second, pose), &Query { guess: Some(guess.into()), cutoff: f64::INFINITY });
        assert!((cold.distance - warm.distance).abs() < 1e-12 && cold.gap < 1e-11 && warm.gap < 1e-11, "{cold:?} {warm:?}");
        warm.distance
    }

    /// With both axes in one plane the nearest points lie in it: those of two rectangles.
    #[test]
    fn cylinders_in_one_plane_are_as_far_as_rectangles() {
        for tilt in [1e-9_f64, 1e-5, 1e-3, 0.01, 0.1, 0.5, 1.0, 1.5] {
            let (sine, cosine) = tilt.sin_cos();
            // From its lowest corner at (-0.5 cosine - sine, 0.5 sine - cosine), or the other one, to the first's top.
            let lowest = -0.5 * sine - cosine;
            let corner = 0.5 * cosine - sine;
            let over_face = tilted(Vector::new(-corner + 0.1, 0.0, 1.25 - lowest), tilt);
            assert!((distance(&CYLINDER, &over_face) - 0.25).abs() < 1e-12, "{tilt}");
            let beside = tilted(Vector::new(0.5 - corner + 0.3, 0.0, 1.4 - lowest), tilt);
            let from_rim = if tilt < 0.3 { distance(&CYLINDER, &beside) } else { continue };
            assert!((0.4 - 1e-12..=0.5 + 1e-12).contains(&from_rim), "{tilt}: {from_rim}");
        }
    }

    #[test]
    fn sides_are_as_far_as_their_axes_less_their_radii() {
        let across = Pose { position: Vector::new(0.2, 1.5, 0.3), rotation: tilted(Vector::zeros(), 1.0).rotation };
        assert!((distance(&CYLINDER, &across) - 0.5).abs() < 1e-13);
        let parallel = tilted(Vector::new(1.5, 0.0, 0.7), 0.0);
        assert!((distance(&CYLINDER, &parallel) - 0.5).abs() < 1e-13);
    }

    #[test]
    fn corners_and_edges_of_polytopes_find_rims_sides_and_faces() {
        let cube = Core::Box { half_lengths: Vector::repeat(0.5) };
        let first = tilted(Vector::zeros(), 0.0);
        let quarter = std::f64::consts::FRAC_PI_4;
        let cases = [
            // Edge along y over the face; edge beside the side; corner region beyond the rim at (0.5, 0, 1).
            (tilted(Vector::new(0.1, 0.0, 1.25 + 0.5_f64.sqrt()), quarter), 0.25),
            (tilted(Vector::new(0.75 + 0.5_f64.sqrt(), 0.0, 0.2), quarter), 0.25),
            (tilted(Vector::new(1.3, 0.0, 1.9), 0.0), 0.5),
        ];
        for (pose, expected) in cases {
            let found = separation((&CYLINDER, &first), (&cube, &pose), &Query::cold());
            assert!((found.distance - expected).abs() < 1e-12, "{found:?}");
            let swapped = separation((&cube, &pose), (&CYLINDER, &first), &Query::cold());
            assert!((swapped.distance - expected).abs() < 1e-12, "{swapped:?}");
        }
    }
}
