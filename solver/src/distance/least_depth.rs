//! The least depth of two smooth sets that overlap: which of several common normals is the contact's.
//!
//! Depth of an overlap is the least translation that parts the sets: over all unit directions the least $h_1(n) + h_2(-n) - n \cdot r$, the distance of
//! the origin from the surface of the difference of both sets. It is a continuous function of the poses alone, so a force that depends on it has a
//! potential. Every common normal whose radii of curvature surpass the depth is a local minimum, and near an edge or a tip there are several: a tip that
//! was pushed in along one direction may part sooner along the faces beside it.
//!
//! A warm look may therefore follow the common normal that it comes from only as long as that is the least. Two checks tell most answers to be so: a
//! ball that rolls inside one of both sets where they touch, and a cross of points in the overlap, wider than it is deep, which no direction far from the normal can part
//! by less. Where both fail, a polytope inside the difference is expanded (van den Bergen 2001) until none of its faces is nearer to the origin than
//! the best depth, which Newton's method polishes on the way.

use super::common_normal::{self, Start, basis};
use super::core::Core;
use super::{CERTIFIED_GAP, Known, Outcome, Relative, Separation};
use crate::Vector;
use crate::shape::Superellipsoid;

/// Whether two superellipsoids or points that overlap as found, in the frame of the first, may have less depth along another direction.
#[inline]
pub(super) fn is_doubtful(first: &Core, second: &Core, relative: &Relative, found: &Separation) -> bool {
    let depth = -found.distance;
    let Some(one) = rolling_radius_near(first, &found.on_first, depth) else { return false };
    let Some(other) = rolling_radius_near(second, &relative.rotation.tr_mul(&found.on_second), depth) else { return false };
    found.outcome != Outcome::Polished || (depth > one + other && !holds_a_cross(first, second, relative, found))
}

/// The least depth of two superellipsoids or points that overlap as found, in the frame of the first.
#[cold]
pub(super) fn least(first: &Core, second: &Core, relative: &Relative, found: Separation) -> Separation {
    Expansion::new(first, second, relative, found).least()
}

/// Radius in m of a ball that rolls inside a set, about a point of its own frame as far as an overlap of some depth matters; `None` for sets without
/// a common normal. It rolls over no ridge or tip that is nearer than a few depths.
#[inline]
fn rolling_radius_near(core: &Core, point: &Vector, depth: f64) -> Option<f64> {
    match core {
        Core::Superellipsoid(shape) if is_near_a_ridge(shape, point, RIDGE_IS_NEAR * depth) => Some(0.0),
        Core::Superellipsoid(shape) => Some(rolling_radius(shape)),
        Core::Point => Some(0.0),
        _ => None,
    }
}

/// The square of a norm with exponent $1 < q \le 2$ bends at least as $q - 1$ squares of that norm (Ball, Carlen and Lieb 1994), and $h$ is such a
/// norm of the direction times the semi-axes, with $q - 1 = \varepsilon / (2 - \varepsilon)$. Exponents above one count as one: away from the ridges
/// that they make, the surface is flatter.
#[inline]
fn rolling_radius(shape: &Superellipsoid) -> f64 {
    let [one, other] = shape.exponents();
    let (least, thinnest) = (one.min(other).min(1.0), shape.semi_axes().min());
    least * thinnest * thinnest / ((2.0 - least) * shape.bounding_radius())
}

/// Distance over the depth at which a ridge still matters.
const RIDGE_IS_NEAR: f64 = 12.0;

/// Exponents above one make ridges where a coordinate vanishes: the first one the equator and the tips on z, the second one the meridians through
/// x and y.
#[inline]
fn is_near_a_ridge(shape: &Superellipsoid, point: &Vector, near: f64) -> bool {
    let [upwards, about] = shape.exponents();
    let (x, y, z) = (point.x.abs(), point.y.abs(), point.z.abs());
    (about > 1.0 && x.min(y) < near) || (upwards > 1.0 && (z < near || x.max(y) < near))
}

/// Half the width of the cross over the depth.
const HALF_WIDTH: f64 = 2.0;

/// Whether the overlap holds a cross of points about its middle, across its normal. Both sets being convex, no direction but those close to
/// the normal can part them by less than the width of the cross.
fn holds_a_cross(first: &Core, second: &Core, relative: &Relative, found: &Separation) -> bool {
    let half_width = -found.distance * HALF_WIDTH;
    let middle = 0.5 * (found.on_first + found.on_second + relative.position);
    let across = basis(&found.normal) * half_width;
    let is_inside = |offset: Vector| {
        let point = middle + offset;
        holds(first, &point) && holds(second, &relative.rotation.tr_mul(&(point - relative.position)))
    };
    let [one, other] = [across.column(0), across.column(1)];
    is_inside(one.into()) && is_inside(-one) && is_inside(other.into()) && is_inside(-other)
}

fn holds(core: &Core, point: &Vector) -> bool {
    matches!(core, Core::Superellipsoid(shape) if shape.contains(point))
}

/// A triangle of the polytope.
#[derive(Clone, Copy)]
struct Face {
    corners: [usize; 3],
    /// Outward unit normal.
    normal: Vector,
    /// Distance of its plane from the origin in m, negative if the origin lies outside.
    distance: f64,
    /// Whether the difference of the sets reaches no farther.
    is_outermost: bool,
}

/// A polytope inside the difference of two sets, and the least depth so far.
struct Expansion<'a> {
    first: &'a Core,
    second: &'a Core,
    relative: &'a Relative,
    size: f64,
    best: Separation,
    points: Vec<Vector>,
    faces: Vec<Face>,
}

/// Points of a polytope: some ten for each doubling of its resolution.
const LARGEST_NUMBER_OF_POINTS: usize = 400;
/// Two depths that differ by less, relatively, count as equal.
const TIE: f64 = 1e-6;
/// The same where the polytope alone tells the depth.
const TIE_OF_UNPOLISHED: f64 = 1e-10;
/// Length over the size by which a point must lie beyond a face to be seen from it.
const BEYOND: f64 = 1e-14;

impl<'a> Expansion<'a> {
    fn new(first: &'a Core, second: &'a Core, relative: &'a Relative, best: Separation) -> Expansion<'a> {
        let size = first.reach() + second.reach();
        Expansion { first, second, relative, size, best, points: Vec::new(), faces: Vec::new() }
    }

    /// Farthest point of the first set less that of the second, in a direction.
    fn farthest(&mut self, direction: &Vector) -> Vector {
        self.best.corners += 1;
        self.first.support(direction) - self.relative.support(self.second, &-direction)
    }

    fn least(mut self) -> Separation {
        self.begin();
        while self.points.len() < LARGEST_NUMBER_OF_POINTS {
            let Some((normal, distance)) = self.nearest_face() else { break };
            let point = self.farthest(&normal);
            let depth = point.dot(&normal);
            if depth < -self.best.distance {
                self.polish(&normal, depth);
            }
            if depth - distance > BEYOND * self.size {
                self.expand(point);
            }
        }
        self.best
    }

    /// Normal and distance of the face that is nearest to the origin, of those that may hide less depth. It is looked at once: either it gives way to a
    /// farther point or it stays.
    fn nearest_face(&mut self) -> Option<(Vector, f64)> {
        let tie = if self.best.outcome == Outcome::Polished { TIE } else { TIE_OF_UNPOLISHED };
        let enough = -self.best.distance * (1.0 - tie);
        let may_hide = |face: &&mut Face| !face.is_outermost && face.distance < enough;
        let nearest = self.faces.iter_mut().filter(may_hide).min_by(|one, other| one.distance.total_cmp(&other.distance))?;
        nearest.is_outermost = true;
        Some((nearest.normal, nearest.distance))
    }

    /// A tetrahedron: two points far apart, one far from the line between them, one far from the plane of the three.
    fn begin(&mut self) {
        let normal = self.best.normal;
        let (top, bottom) = (self.farthest(&normal), self.farthest(&-normal));
        let along = (top - bottom).normalize();
        let across = basis(&along);
        let [one, other] = [0, 1].map(|way| self.farther_of(across.column(way).into(), &top));
        let aside = |point: &Vector| (point - top).cross(&along).norm();
        let side = if aside(&one) >= aside(&other) { one } else { other };
        let last = self.farther_of((top - bottom).cross(&(side - bottom)).normalize(), &top);
        self.points = vec![top, bottom, side, last];
        let inside = 0.25 * (top + bottom + side + last);
        for corners in [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]] {
            let [a, b, c] = corners.map(|corner| self.points[corner]);
            let faces_out = (b - a).cross(&(c - a)).dot(&(a - inside)) > 0.0;
            self.add_face(if faces_out { corners } else { [corners[0], corners[2], corners[1]] });
        }
    }

    /// Of the farthest points in a direction and against it, the one that is farther from a point.
    fn farther_of(&mut self, direction: Vector, from: &Vector) -> Vector {
        let (ahead, behind) = (self.farthest(&direction), self.farthest(&-direction));
        if (ahead - from).dot(&direction) >= (from - behind).dot(&direction) { ahead } else { behind }
    }

    fn add_face(&mut self, corners: [usize; 3]) {
        let [a, b, c] = corners.map(|corner| self.points[corner]);
        // Slivers have no direction and no inside either.
        let Some(normal) = (b - a).cross(&(c - a)).try_normalize(0.0) else { return };
        self.faces.push(Face { corners, normal, distance: normal.dot(&a), is_outermost: false });
    }

    /// Replaces the faces that see a point by those between it and their outline.
    fn expand(&mut self, point: Vector) {
        let least = BEYOND * self.size;
        let mut outline: Vec<[usize; 2]> = Vec::with_capacity(16);
        self.faces.retain(|face| {
            if face.normal.dot(&point) - face.distance <= least {
                return true;
            }
            for [from, to] in [[0, 1], [1, 2], [2, 0]].map(|edge| edge.map(|place| face.corners[place])) {
                // An edge between two faces that go comes once each way.
                match outline.iter().position(|known| *known == [to, from]) {
                    Some(place) => drop(outline.swap_remove(place)),
                    None => outline.push([from, to]),
                }
            }
            false
        });
        let new = self.points.len();
        self.points.push(point);
        outline.into_iter().for_each(|[from, to]| self.add_face([from, to, new]));
    }

    /// Takes a direction of less depth, or the common normal near it if that is of less depth still.
    fn polish(&mut self, normal: &Vector, depth: f64) {
        let (on_first, on_second) = (self.first.support(normal), self.relative.support(self.second, &-normal));
        let from = Start::Points(*normal, [on_first, on_second - self.relative.position]);
        let smooth = common_normal::separation(self.first, self.second, self.relative, &from, CERTIFIED_GAP * self.size);
        let corners = self.best.corners;
        if let Some(smooth) = smooth.filter(|smooth| smooth.distance >= -depth - CERTIFIED_GAP * self.size) {
            self.best = Separation { corners, ..smooth };
            return;
        }
        let middle = 0.5 * (on_first + on_second);
        let on_first = middle + normal * (on_first - middle).dot(normal);
        let on_second = on_first - normal * depth - self.relative.position;
        let (outcome, known) = (Outcome::Overlapping, Known::Nothing);
        self.best = Separation { distance: -depth, normal: *normal, on_first, on_second, gap: 0.0, outcome, known, corners };
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::{Guess, Pose, Query, separation};
    use super::*;
    use crate::Orientation;
    use crate::shape::superellipsoid::tests::{directions, samples};

    fn core(semi_axes: [f64; 3], exponents: [f64; 2]) -> Core {
        Core::Superellipsoid(Arc::new(Superellipsoid::new(semi_axes.into(), exponents).unwrap()))
    }

    fn pose(position: [f64; 3], angles: [f64; 3]) -> Pose {
        let turn = Orientation::from_euler_angles(angles[0], angles[1], angles[2]);
        Pose { position: position.into(), rotation: *turn.to_rotation_matrix().matrix() }
    }

    /// Semi-axes and exponents of both, place and Euler angles of the second seen from the first, least depth.
    type Row = ([[f64; 3]; 2], [[f64; 2]; 2], [f64; 3], [f64; 3], f64);

    /// Pairs that were moved together along one common normal and part sooner along another, or almost as soon. Depths by an
    /// independent computation: the best of 4000 directions and descent without derivatives, good to 1e-10.
    #[rustfmt::skip]
    const PAIRS_WITH_SEVERAL_COMMON_NORMALS: [Row; 12] = [
        ([[1.0, 0.464564, 0.157616], [1.0, 0.136778, 0.123034]], [[1.739571, 1.521527], [1.661381, 1.42577]], [-1.642385, -0.697074, -0.001568], [-0.494747, 0.007703, 0.844248], 0.001647221476),
        ([[1.0, 0.192933, 0.269367], [1.0, 0.119044, 0.324749]], [[0.616834, 1.50551], [0.32228, 1.864614]], [-1.827848, 0.432884, 0.268114], [0.321586, 0.134594, 2.768208], 0.001785966457),
        ([[1.0, 0.168892, 0.132782], [1.0, 0.178066, 0.212246]], [[0.177463, 1.842954], [1.573845, 1.501794]], [1.849183, -0.412543, 0.206929], [-2.462174, 0.314863, 2.691771], 0.001682376899),
        ([[1.0, 0.112163, 0.221064], [1.0, 0.334644, 0.164543]], [[1.594048, 1.498745], [1.720564, 0.464437]], [1.273364, 0.844394, 0.408953], [-2.205598, -0.626077, 1.409106], 0.001429712454),
        ([[1.0, 0.276407, 0.12937], [1.0, 0.429266, 0.230738]], [[0.20729, 1.790261], [1.597703, 1.733896]], [1.895347, -0.411311, -0.212022], [0.487672, -0.116272, 2.713941], 0.00173417781),
        ([[1.0, 0.134556, 0.339128], [1.0, 0.192283, 0.371318]], [[1.784846, 0.427365], [0.85466, 1.762562]], [1.060321, 0.796859, 0.370558], [-2.429643, -0.231886, 1.710787], 0.001784249827),
        ([[1.0, 0.14417, 0.130606], [1.0, 0.246933, 0.102828]], [[1.661115, 1.526235], [1.595243, 0.596842]], [-1.585344, 0.545296, 0.595801], [0.412185, -0.626642, 2.355333], 0.002000138321),
        ([[1.0, 0.101074, 0.311301], [1.0, 0.170247, 0.231771]], [[1.735634, 0.668225], [0.255322, 1.620692]], [-1.224873, -0.929801, 0.290891], [-2.226047, -0.182963, -1.652522], 0.001827832451),
        ([[1.0, 0.209166, 0.895287], [1.0, 0.715644, 0.234389]], [[0.261513, 1.836154], [1.624149, 1.804152]], [1.805572, -0.511652, -0.451644], [-2.957022, -0.23757, -0.554743], 0.001327087694),
        ([[1.0, 0.149583, 0.276489], [1.0, 0.408832, 0.101384]], [[1.879571, 1.460095], [1.636784, 1.330268]], [0.513274, 0.618074, 0.804588], [-0.406426, 0.558487, -2.33339], 0.00156243528),
        ([[1.0, 0.245448, 0.750061], [1.0, 0.112638, 0.6504]], [[1.736602, 1.584031], [0.877489, 1.861627]], [-0.116482, 0.291854, -1.498892], [-0.274445, 0.4901, 2.447129], 0.001605973555),
        ([[1.0, 0.445252, 0.276913], [1.0, 0.451938, 0.379922]], [[1.893744, 1.821545], [1.848149, 1.272475]], [1.546049, -0.090047, 0.438505], [2.96326, 0.663522, 2.44297], 0.002000045913),
    ];

    #[test]
    fn of_several_common_normals_the_least_depth_is_found_cold_and_warm() {
        let origin = pose([0.0; 3], [0.0; 3]);
        for (index, (axes, exponents, place, angles, depth)) in PAIRS_WITH_SEVERAL_COMMON_NORMALS.into_iter().enumerate() {
            let (one, other) = (core(axes[0], exponents[0]), core(axes[1], exponents[1]));
            let second = pose(place, angles);
            let look = |guess: Option<Guess>| separation((&one, &origin), (&other, &second), &Query { guess, cutoff: f64::INFINITY });
            let cold = look(None);
            let parted = Pose { position: second.position + cold.normal * (depth + 1e-9), ..second };
            assert!(separation((&one, &origin), (&other, &parted), &Query::cold()).distance > 0.0, "{index}: {cold:?}");
            let aside = [Vector::x(), Vector::y(), Vector::z()].map(|axis| look(Some((cold.normal + axis * 0.4).into())));
            for found in [cold, look(Some(cold.guess())), aside[0], aside[1], aside[2]] {
                assert!((found.distance + depth).abs() < 1e-9 && found.outcome == Outcome::Polished, "{index}: {found:?}");
                assert!((found.normal - cold.normal).norm() < 1e-8, "{index}: {found:?} {cold:?}");
            }
        }
    }

    /// Exact: a point under a tip of an octahedron is as deep as the nearest of the faces beside it, a point in a box as the nearest side.
    #[test]
    fn a_point_under_a_tip_is_as_deep_as_its_nearest_face() {
        let octahedron = core([1.0; 3], [2.0, 2.0]);
        let origin = pose([0.0; 3], [0.0; 3]);
        for place in [[0.002, 0.001, 0.99], [-0.01, 0.96, 0.02], [0.3, 0.2, 0.1], [0.9, -0.001, -0.03]] {
            let depth = (1.0 - place.iter().map(|along: &f64| along.abs()).sum::<f64>()) / 3.0_f64.sqrt();
            for guess in [None, Some(Vector::from(place).into())] {
                let query = Query { guess, cutoff: f64::INFINITY };
                let found = separation((&octahedron, &origin), (&Core::Point, &pose(place, [0.0; 3])), &query);
                assert!((found.distance + depth).abs() < 1e-12, "{place:?}: {found:?} {depth}");
            }
        }
    }

    /// The ball touches the surface from inside and reaches in no direction beyond it: anywhere on shapes without ridges, elsewhere near by.
    #[test]
    fn a_ball_of_the_rolling_radius_rolls_everywhere_but_over_ridges() {
        let mut rolled = 0;
        for shape in samples() {
            let has_ridges = shape.exponents().iter().any(|exponent| *exponent > 1.0);
            let depth = if has_ridges { 1e-3 } else { rolling_radius(&shape) };
            let core = Core::Superellipsoid(Arc::new(shape.clone()));
            for normal in directions().step_by(3) {
                let point = shape.support(&normal);
                let radius = rolling_radius_near(&core, &point, depth).unwrap();
                assert!(has_ridges || radius == rolling_radius(&shape));
                let centre = point - normal * radius.min(depth);
                let beyond = |other: Vector| centre.dot(&other) + radius.min(depth) - shape.support(&other).dot(&other);
                let beyond = directions().map(beyond).fold(0.0, f64::max);
                assert!(beyond < 1e-12, "{:?} {normal}: {beyond}", shape.exponents());
                rolled += u32::from(radius > 0.0);
            }
        }
        assert!(rolled > 1000, "{rolled}");
        // Exact: an ellipsoid is bent most at the end of its longest axis.
        let ellipsoid = Superellipsoid::new(Vector::new(1.0, 2.0, 3.0), [1.0, 1.0]).unwrap();
        assert!((rolling_radius(&ellipsoid) - 1.0 / 3.0).abs() < 1e-15);
    }
}
