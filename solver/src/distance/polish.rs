//! Distance of curved sets to rounding error: Newton's method on the direction, with a certificate.
//!
//! For a unit direction $n$ the gap between the supporting planes of two convex sets, $f(n) = -h_1(n) - h_2(-n)$, never exceeds their
//! distance and equals it for the right direction (von Neumann's minimum-norm duality). It is concave wherever it is positive, so a stationary point is the
//! answer. Near the answer each set shows one *piece*: a corner or rim, where $f$ is smooth; a straight line of its surface, which
//! holds the direction at right angles to that line; or a face, which fixes it. On smooth pieces Newton's method needs two to four
//! steps where GJK needs dozens, and fails.
//!
//! The certificate: a point of each set whose distance is an upper bound, and a direction whose gap is a lower one. A result is only accepted
//! if both agree.

use super::Relative;
use super::core::Core;
use super::simplex::{Corner, Simplex};
use crate::Vector;

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

const LARGEST_NUMBER_OF_STEPS: usize = 40;
const LARGEST_NUMBER_OF_PIECES: usize = 8;
/// A direction closer to the plane across the axis than this is tried as that of a side first, closer to the axis as that of a face.
const NEAR: f64 = 0.02;
/// The rim has been tried, and the direction came out this close to the axis: it must be the face.
const VERY_NEAR: f64 = 1e-6;

/// One of the two sets, with its sign: the outward direction of the second is against the normal.
struct Body<'a> {
    core: &'a Core,
    sign: f64,
    centre: Vector,
    axis: Vector,
    simplex_points: Vec3s,
}

/// Up to four points without a heap.
#[derive(Clone, Copy)]
struct Vec3s {
    points: [Vector; 4],
    count: usize,
}

impl Vec3s {
    fn distinct(points: impl Iterator<Item = Vector>) -> Vec3s {
        let mut kept = Vec3s { points: [Vector::zeros(); 4], count: 0 };
        for point in points {
            // Points of the second set come out of a difference: the same corner may differ in the last bit.
            let is_known = kept.points[..kept.count].iter().any(|known| (known - point).norm_squared() <= 1e-24 * point.norm_squared());
            if !is_known {
                kept.points[kept.count] = point;
                kept.count += 1;
            }
        }
        kept
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
    let points = |of_second: bool| {
        let corners = simplex.map_or(&[][..], |simplex| simplex.corners());
        Vec3s::distinct(corners.iter().map(move |corner| if of_second { corner.difference + corner.on_first } else { corner.on_first }))
    };
    let axis_of_second = relative.rotation.column(2).into_owned();
    let bodies = [
        Body { core: first, sign: 1.0, centre: Vector::zeros(), axis: Vector::z(), simplex_points: points(false) },
        Body { core: second, sign: -1.0, centre: relative.position, axis: axis_of_second, simplex_points: points(true) },
    ];
    let mut normal = guess.normalize();
    let mut pieces = [bodies[0].piece_at(&normal)?, bodies[1].piece_at(&normal)?];
    for _ in 0..LARGEST_NUMBER_OF_PIECES {
        normal = best_direction(&pieces, normal)?;
        let mut witness = Witness::new(&pieces, &normal, &bodies);
        let lower = -first.support(&normal).dot(&normal) + relative.support(second, &-normal).dot(&normal);
        let vector = witness.on_second - witness.on_first;
        let distance = vector.norm();
        let gap = distance - lower;
        if gap.abs() <= tolerance && lower > 0.0 {
            return Some(Polished { normal, distance, gap: gap.max(0.0), on_first: witness.on_first });
        }
        // If both lines were left, the one that was left farther is at fault.
        let blamed = usize::from(witness.beyond[1].abs() > witness.beyond[0].abs());
        witness.beyond[1 - blamed] = 0.0;
        let next = [bodies[0].next_piece(&pieces[0], &normal, &witness, 0), bodies[1].next_piece(&pieces[1], &normal, &witness, 1)];
        match next {
            [None, None] => return None,
            [one, other] => pieces = [one.unwrap_or(pieces[0]), other.unwrap_or(pieces[1])],
        }
    }
    None
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
        let Vec3s { points, count } = self.simplex_points;
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
        let corner = |place: usize| Corner { difference: self.simplex_points.points[place] - point, on_first: Vector::zeros() };
        let mut triangle = Simplex::new(corner(0));
        triangle.add(corner(1));
        point + triangle.add(corner(2))
    }

    /// The piece to try after one that was not the right one; `None` if it may stay.
    fn next_piece(&self, piece: &Piece, normal: &Vector, witness: &Witness, place: usize) -> Option<Piece> {
        let along = self.sign * normal.dot(&self.axis);
        let beyond = witness.beyond[place];
        match piece.kind {
            Kind::Side if beyond != 0.0 => self.rim(beyond),
            Kind::Face => self.rim(along),
            Kind::Rim => {
                let end = (piece.base - self.centre).dot(&self.axis);
                if end * along < 0.0 {
                    self.side()
                } else if Piece::across(&self.axis, normal).1 < VERY_NEAR {
                    self.end_face(along)
                } else {
                    None
                }
            }
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
        (if length > 0.0 { across / length } else { Vector::zeros() }, length)
    }
}

/// The direction of the largest gap between the two pieces.
fn best_direction(pieces: &[Piece; 2], start: Vector) -> Option<Vector> {
    if let Some(outward) = pieces[0].face {
        return Some(outward);
    }
    if let Some(outward) = pieces[1].face {
        return Some(-outward);
    }
    match (pieces[0].line, pieces[1].line) {
        (Some((one, _)), Some((other, _))) => {
            let between = pieces[1].base - pieces[0].base;
            match one.cross(&other).try_normalize(1e-9) {
                Some(normal) => Some(if normal.dot(&between) < 0.0 { -normal } else { normal }),
                None => newton(pieces, start, Some(one)),
            }
        }
        (Some((line, _)), None) | (None, Some((line, _))) => newton(pieces, start, Some(line)),
        (None, None) => newton(pieces, start, None),
    }
}

/// Maximises the gap over all unit directions, or over those at right angles to a line.
fn newton(pieces: &[Piece; 2], start: Vector, line: Option<Vector>) -> Option<Vector> {
    let between = pieces[1].base - pieces[0].base;
    let mut normal = match line {
        Some(line) => (start - line * start.dot(&line)).try_normalize(1e-12)?,
        None => start,
    };
    let mut size = between.norm();
    for (_, radius) in pieces.iter().filter_map(|piece| piece.curved) {
        size += radius;
    }
    let (mut last_slope, mut last_gap, mut last_normal, mut step) = (f64::INFINITY, f64::NEG_INFINITY, normal, Vector::zeros());
    for _ in 0..LARGEST_NUMBER_OF_STEPS {
        // Gradient of the gap, and the curvatures of the pieces along the one tangent in which each bends.
        let mut gradient = between;
        let mut bends = [(Vector::zeros(), 0.0); 2];
        for (bend, (axis, radius)) in bends.iter_mut().zip(pieces.iter().filter_map(|piece| piece.curved)) {
            let (across, sine) = Piece::across(&axis, &normal);
            gradient -= across * radius;
            *bend = (axis.cross(&across), radius / sine.max(1e-9));
        }
        let gap = gradient.dot(&normal);
        // A concave function is climbed: a step that goes down has crossed the edge of a rim and is halved.
        if gap < last_gap - f64::EPSILON * size {
            step *= 0.5;
            normal = (last_normal + step).normalize();
            continue;
        }
        let tangent = match line {
            Some(line) => {
                let along = line.cross(&normal);
                along * gradient.dot(&along)
            }
            None => gradient - normal * gap,
        };
        let slope = tangent.norm();
        // Quadratic convergence ends at rounding error; a step that does not reduce the slope any more is the last.
        if slope <= f64::EPSILON * size || (slope >= 0.5 * last_slope && slope <= 1e-13 * size) {
            return Some(normal);
        }
        (last_slope, last_gap, last_normal) = (slope, gap, normal);
        let stiffness = gap.max(1e-3 * slope);
        step = match line {
            Some(_) => {
                let unit = tangent / slope;
                tangent / (stiffness + bends.iter().map(|(bend, size)| size * bend.dot(&unit).powi(2)).sum::<f64>())
            }
            None => solve_in_tangent_plane(&normal, &tangent, stiffness, &bends),
        };
        let length = step.norm();
        if length > 0.5 {
            step *= 0.5 / length;
        }
        normal = (normal + step).normalize();
    }
    Some(normal)
}

/// Solves `(stiffness + sum of size * bend bend^T) step = tangent` in the plane at right angles to the normal.
fn solve_in_tangent_plane(normal: &Vector, tangent: &Vector, stiffness: f64, bends: &[(Vector, f64); 2]) -> Vector {
    let one = tangent.normalize();
    let other = normal.cross(&one);
    let (mut a, mut b, mut c) = (stiffness, 0.0, stiffness);
    for (bend, size) in bends {
        let (x, y) = (bend.dot(&one), bend.dot(&other));
        a += size * x * x;
        b += size * x * y;
        c += size * y * y;
    }
    let slope = tangent.norm();
    let determinant = a * c - b * b;
    (one * c - other * b) * (slope / determinant)
}

/// The point of each set that belongs to a direction.
struct Witness {
    on_first: Vector,
    on_second: Vector,
    /// By how much the unbounded piece of each set was left: its sign tells at which end.
    beyond: [f64; 2],
}

impl Witness {
    fn new(pieces: &[Piece; 2], normal: &Vector, bodies: &[Body<'_>; 2]) -> Witness {
        if pieces[0].face.is_some() || pieces[1].face.is_some() {
            return Witness::on_face(pieces, normal, bodies);
        }
        let points = [pieces[0].foot(normal, 1.0), pieces[1].foot(normal, -1.0)];
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
            let inside = wanted[index].clamp(-half_length, half_length);
            beyond[index] = wanted[index] - inside;
            points[index] + line * inside
        };
        let (on_first, on_second) = (place(0), place(1));
        Witness { on_first, on_second, beyond }
    }

    /// One set shows a face: its point lies under the nearest point of the other.
    fn on_face(pieces: &[Piece; 2], normal: &Vector, bodies: &[Body<'_>; 2]) -> Witness {
        let (flat, other) = if pieces[0].face.is_some() { (0, 1) } else { (1, 0) };
        let sign = bodies[other].sign;
        let middle = pieces[flat].base;
        let piece = &pieces[other];
        // If the other set lies flat as well, its point nearest to the middle of the face.
        let point = if piece.face.is_some() {
            let (axis, radius) = piece.curved.unwrap_or((*normal, 0.0));
            let (across, length) = Piece::across(&axis, &(middle - piece.base));
            piece.base + across * length.min(radius)
        } else {
            let foot = piece.foot(normal, sign);
            match piece.line {
                Some((line, half_length)) => foot + line * (middle - foot).dot(&line).clamp(-half_length, half_length),
                None => foot,
            }
        };
        let height = (point - middle).dot(normal);
        let foot = point - normal * height;
        let mut beyond = [0.0; 2];
        let under = match pieces[flat].curved {
            Some((axis, radius)) => {
                let (across, length) = Piece::across(&axis, &(foot - middle));
                beyond[flat] = (length - radius).max(0.0);
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

impl Piece {
    /// The point of the piece in a direction, in the middle of its line.
    fn foot(&self, normal: &Vector, sign: f64) -> Vector {
        match self.curved {
            Some((axis, radius)) => self.base + Piece::across(&axis, normal).0 * (sign * radius),
            None => self.base,
        }
    }
}

/// Places along two lines, given by unit vector and half length, of their nearest points. Parallel lines: in the middle of their common stretch.
fn nearest_on_lines(between: &Vector, (one, half_of_one): (Vector, f64), (other, half_of_other): (Vector, f64)) -> [f64; 2] {
    let cosine = one.dot(&other);
    let (along_one, along_other) = (between.dot(&one), between.dot(&other));
    let determinant = 1.0 - cosine * cosine;
    if determinant > 1e-16 {
        let on_one = (along_one - cosine * along_other) / determinant;
        let on_other = (cosine * along_one - along_other) / determinant;
        return [on_one, on_other];
    }
    let low = (-half_of_one).max(along_one - half_of_other);
    let high = half_of_one.min(along_one + half_of_other);
    let middle = 0.5 * (low + high);
    [middle, cosine.signum() * (middle - along_one)]
}
