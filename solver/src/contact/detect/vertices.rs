//! Superellipsoids by the vertices of their surfaces (S sections 2.4 and 2.5): those of each body that lie inside the other tell the contact.
//!
//! Contact point: mean of the two mean places (S eq. 2.24, which leaves out the half). Normal: mean outward normal of the first body's vertices less that of
//! the second's (S eq. 2.29-2.32), each gradient made a unit vector first, or long gradients would count more; gradients are taken in the body's own
//! frame (S eq. 2.25 takes them in the other's). Overlap: largest distance along the normal (S eq. 2.33-2.34).

use std::sync::Arc;

use super::core_pair::Look;
use crate::Vector;
use crate::boundary::Plane;
use crate::contact::Touch;
use crate::distance::{Pose, Relative};
use crate::shape::Superellipsoid;
use crate::shape::superellipsoid::vertices::Vertices;

/// A surface and its vertices.
#[derive(Debug, Clone, PartialEq)]
pub struct VertexSurface {
    /// The surface.
    pub shape: Arc<Superellipsoid>,
    /// Its vertices, in its own frame.
    pub vertices: Vertices,
}

/// What to make of a contact that the vertices of one body see and those of the other do not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OneSided {
    /// By the vertices that see it, and how far they lie under the other surface.
    Resolved,
    /// Left out, as S section 2.4.5 does: bodies sink into each other until both sides see the contact.
    Ignored,
}

/// A surface in its place.
#[derive(Debug, Clone, Copy)]
pub struct PlacedSurface<'a> {
    /// The surface.
    pub surface: &'a VertexSurface,
    /// Place and turn in the world.
    pub pose: Pose,
    /// Centre of mass of the body it belongs to, in m.
    pub centre_of_body: Vector,
}

/// The vertices of one body that lie inside the other, in the body's own frame.
#[derive(Debug, Clone, PartialEq)]
struct Seen {
    inside: Indices,
    sum: Vector,
    normals: Vector,
}

impl Seen {
    fn mean(&self, sum: &Vector) -> Vector {
        sum / self.inside.count.max(1) as f64
    }
}

/// Numbers of vertices, the first of them without an allocation.
#[derive(Debug, Clone, PartialEq)]
struct Indices {
    count: usize,
    first: [u32; WITHOUT_ALLOCATION],
    rest: Vec<u32>,
}

const WITHOUT_ALLOCATION: usize = 32;

impl Indices {
    fn new() -> Indices {
        Indices { count: 0, first: [0; WITHOUT_ALLOCATION], rest: Vec::new() }
    }

    #[inline]
    fn push(&mut self, index: usize) {
        match self.first.get_mut(self.count) {
            Some(place) => *place = index as u32,
            None => self.rest.push(index as u32),
        }
        self.count += 1;
    }

    #[inline]
    fn iter(&self) -> impl Iterator<Item = usize> {
        self.first.iter().take(self.count).chain(&self.rest).map(|index| *index as usize)
    }
}

/// What one body must look for: only its vertices that reach so far in a direction can lie inside the other.
#[derive(Clone, Copy)]
struct Beyond {
    /// In the body's own frame.
    direction: Vector,
    /// How far its outline reaches.
    of_outline: f64,
    least: f64,
}

/// Where both bodies reach past each other along a direction.
struct Cap {
    of_first: Beyond,
    of_second: Beyond,
    /// How far they do, in m.
    thickness: f64,
}

/// A cap thicker than this part of the bodies is not thin.
const THIN: f64 = 0.05;
/// Rounding of the thickness of a cap, over the size of the bodies.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

impl Cap {
    fn new(shapes: [&Superellipsoid; 2], relative: &Relative, direction: Vector) -> Cap {
        let facing_back = -relative.rotation.tr_mul(&direction);
        let between = relative.position.dot(&direction);
        let (own, other) = (shapes[0].reach(&direction), shapes[1].reach(&facing_back));
        Cap {
            of_first: Beyond { direction, of_outline: own.of_outline, least: between - other.of_all },
            of_second: Beyond { direction: facing_back, of_outline: other.of_outline, least: between - own.of_all },
            thickness: own.of_all + other.of_all - between,
        }
    }

    /// The cap along a guess of the normal, or that along the line of centres if there is no guess or it is a bad one.
    fn of(shapes: [&Superellipsoid; 2], relative: &Relative, guess: Option<Vector>) -> Cap {
        let size = shapes[0].bounding_radius() + shapes[1].bounding_radius();
        let guessed = guess.map(|guess| Cap::new(shapes, relative, guess));
        match guessed {
            Some(cap) if cap.thickness <= THIN * size => cap,
            _ => {
                let towards = Cap::new(shapes, relative, towards(relative));
                guessed.filter(|guessed| guessed.thickness < towards.thickness).unwrap_or(towards)
            }
        }
    }
}

/// From the centre of the first body to that of the second.
fn towards(relative: &Relative) -> Vector {
    relative.position.try_normalize(0.0).unwrap_or_else(Vector::x)
}

/// Looks which vertices lie inside the other surface, among those that reach so far.
#[inline]
fn seen_vertices(own: &VertexSurface, other: &Superellipsoid, other_from_own: &Relative, beyond: &Beyond) -> Seen {
    let mut seen = Seen { inside: Indices::new(), sum: Vector::zeros(), normals: Vector::zeros() };
    own.vertices.beyond(&beyond.direction, beyond.of_outline, beyond.least, |index| {
        let vertex = own.vertices.at(index);
        let inside = other_from_own.rotation.tr_mul(&(vertex - other_from_own.position));
        if other.contains(&inside) {
            seen.inside.push(index);
            seen.sum += vertex;
            seen.normals += own.vertices.normal_at(index);
        }
    });
    seen
}

/// Largest depth of vertices under the other surface to first order, in m.
fn depth(seen: &Seen, own: &VertexSurface, other: &Superellipsoid, other_from_own: &Relative) -> f64 {
    let of_vertex = |index: usize| {
        let inside = other_from_own.rotation.tr_mul(&(own.vertices.at(index) - other_from_own.position));
        (1.0 - other.gauge(&inside)) / other.gradient_of_gauge(&inside).norm()
    };
    seen.inside.iter().map(of_vertex).fold(0.0, f64::max)
}

/// Adds the contact of two surfaces to a list, if their vertices see one. A guess of the normal in the world frame, of unit length, spares looking at most of
/// them.
pub fn vertex_pair(
    first: &PlacedSurface<'_>,
    second: &PlacedSurface<'_>,
    guess: Option<Vector>,
    one_sided: OneSided,
    touches: &mut Vec<Touch>,
) -> Look {
    let relative = Relative::new(&first.pose, &second.pose);
    let (surface, others) = (first.surface, second.surface);
    let looked_up = (surface.vertices.len() + others.vertices.len()) as u32;
    let look = |normal: Vector| Look { guess: normal.into(), corners: looked_up, is_deep: false, gap: 0.0 };
    let nothing = || look(first.pose.rotation * towards(&relative));
    let cap = Cap::of([&surface.shape, &others.shape], &relative, guess.map(|guess| first.pose.rotation.tr_mul(&guess)));
    if cap.thickness < -ROUNDING * (surface.shape.bounding_radius() + others.shape.bounding_radius()) {
        return nothing();
    }
    let back = relative.inverse();
    let own = seen_vertices(surface, &others.shape, &relative, &cap.of_first);
    let other = seen_vertices(others, &surface.shape, &back, &cap.of_second);
    let is_seen = [&own, &other].map(|seen| seen.inside.count > 0);
    if is_seen == [false; 2] || (one_sided == OneSided::Ignored && is_seen != [true; 2]) {
        return nothing();
    }
    let normals = own.mean(&own.normals) - relative.rotation * other.mean(&other.normals);
    let normal = normals.try_normalize(0.0).unwrap_or_else(|| towards(&relative));
    let in_first = |vertex: Vector| relative.position + relative.rotation * vertex;
    let (place, overlap) = match is_seen {
        [true, true] => {
            let foremost = own.inside.iter().map(|index| surface.vertices.at(index).dot(&normal)).fold(f64::NEG_INFINITY, f64::max);
            let hindmost = other.inside.iter().map(|index| in_first(others.vertices.at(index)).dot(&normal)).fold(f64::INFINITY, f64::min);
            (0.5 * (own.mean(&own.sum) + in_first(other.mean(&other.sum))), foremost - hindmost)
        }
        [true, false] => (own.mean(&own.sum), depth(&own, surface, &others.shape, &relative)),
        _ => (in_first(other.mean(&other.sum)), depth(&other, others, &surface.shape, &back)),
    };
    let normal = first.pose.rotation * normal;
    if overlap > 0.0 {
        let arm_of_first = first.pose.position - first.centre_of_body + first.pose.rotation * place;
        let arm_of_second = arm_of_first - (second.centre_of_body - first.centre_of_body);
        touches.push(Touch { overlap, normal, arm_of_first, arm_of_second, is_deep: false });
    }
    look(normal)
}

/// Adds the contact of a surface and a flat wall to a list: the mean of all vertices behind the wall, by the depth of the deepest (S eq. 2.36-2.40).
pub fn vertex_plane(surface: &PlacedSurface<'_>, plane: &Plane, touches: &mut Vec<Touch>) {
    let height_of_centre = plane.height(&surface.pose.position);
    let upwards = surface.pose.rotation.tr_mul(&plane.normal);
    let (mut sum, mut count, mut overlap) = (Vector::zeros(), 0, 0.0_f64);
    let of_outline = surface.surface.shape.reach(&-upwards).of_outline;
    surface.surface.vertices.beyond(&-upwards, of_outline, height_of_centre, |index| {
        let vertex = surface.surface.vertices.at(index);
        let height = height_of_centre + vertex.dot(&upwards);
        if height < 0.0 {
            (sum, count, overlap) = (sum + vertex, count + 1, overlap.max(-height));
        }
    });
    if count > 0 {
        let arm_of_first = surface.pose.position - surface.centre_of_body + surface.pose.rotation * (sum / f64::from(count));
        touches.push(Touch { overlap, normal: -plane.normal, arm_of_first, arm_of_second: Vector::zeros(), is_deep: false });
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;

    use super::*;
    use crate::Orientation;
    use crate::shape::superellipsoid::vertices::Spacing;

    fn surface(semi_axes: [f64; 3], exponents: [f64; 2], in_each_angle: usize) -> VertexSurface {
        let shape = Arc::new(Superellipsoid::new(semi_axes.into(), exponents).unwrap());
        VertexSurface { vertices: shape.vertices(in_each_angle, Spacing::Linear), shape }
    }

    fn placed(surface: &VertexSurface, position: Vector, rotation: Matrix3<f64>) -> PlacedSurface<'_> {
        PlacedSurface { surface, pose: Pose { position, rotation }, centre_of_body: position }
    }

    fn turned(axis: Vector, angle: f64) -> Matrix3<f64> {
        *Orientation::from_axis_angle(&nalgebra::Unit::new_normalize(axis), angle).to_rotation_matrix().matrix()
    }

    /// Exact: two unit balls that overlap by a tenth, at a place of the equator or aside of it. Largest error of place, normal and overlap.
    fn error_of_balls(in_each_angle: usize, direction: Vector) -> f64 {
        let (centre, ball) = (direction.normalize() * 1.9, surface([1.0; 3], [1.0, 1.0], in_each_angle));
        let mut touches = Vec::new();
        let (first, second) = (placed(&ball, Vector::zeros(), Matrix3::identity()), placed(&ball, centre, Matrix3::identity()));
        vertex_pair(&first, &second, None, OneSided::Ignored, &mut touches);
        let touch = touches.first().expect("the overlap is many times the distance of vertices");
        let of_place = (touch.arm_of_first - 0.5 * centre).norm();
        (touch.normal - direction.normalize()).norm().max((touch.overlap - 0.1).abs()).max(of_place)
    }

    /// Where vertices lie evenly about a contact, more of them come closer to it. Elsewhere they lie denser towards the poles, and their mean leans there
    /// however many there are: by some parts in a hundred here. S does not say so.
    #[test]
    fn vertices_come_closer_where_they_lie_evenly_and_only_there() {
        let on_equator = [20, 40, 80].map(|in_each_angle| error_of_balls(in_each_angle, Vector::new(1.0, 0.02, 0.01)));
        assert!(on_equator[0] < 0.1 && on_equator[2] < 0.5 * on_equator[0], "{on_equator:?}");
        let aside = [40, 160].map(|in_each_angle| error_of_balls(in_each_angle, Vector::new(0.5, 0.3, 0.8)));
        assert!(aside[1] > 0.02 && aside[0] < 0.15, "{aside:?}");
    }

    /// Slow twin: all vertices, and normals by their formula.
    fn all_vertices(own: &VertexSurface, other: &Superellipsoid, relative: &Relative) -> Seen {
        let mut seen = Seen { inside: Indices::new(), sum: Vector::zeros(), normals: Vector::zeros() };
        let is_inside = |index: &usize| other.gauge(&relative.rotation.tr_mul(&(own.vertices.at(*index) - relative.position))) <= 1.0;
        for index in (0..own.vertices.len()).filter(is_inside) {
            seen.inside.push(index);
            seen.sum += own.vertices.at(index);
            seen.normals += own.shape.gradient_of_gauge(&own.vertices.at(index)).normalize();
        }
        seen
    }

    /// Only the cap of vertices that can lie inside is looked at: nothing is lost by it, to the bit, whatever the guess.
    #[test]
    fn no_vertex_inside_is_passed_over() {
        let (one, other) = (surface([1.0, 0.5, 0.3], [0.5, 1.3], 30), surface([0.6, 0.6, 1.2], [1.6, 0.3], 27));
        let mut most = 0;
        for index in 0..200 {
            let turn = turned(Vector::new(0.3, 0.1 * f64::from(index % 17), -0.7), 0.31 * f64::from(index));
            let place = Vector::new(0.9, 0.1 * f64::from(index % 7), -0.05 * f64::from(index % 11));
            let relative = Relative { rotation: turn, position: place };
            let guess = Vector::new(1.0, 0.2, 0.1 * f64::from(index % 5)).normalize();
            for guess in [None, Some(guess), Some(-guess)] {
                let cap = Cap::of([&one.shape, &other.shape], &relative, guess);
                let found = [
                    seen_vertices(&one, &other.shape, &relative, &cap.of_first),
                    seen_vertices(&other, &one.shape, &relative.inverse(), &cap.of_second),
                ];
                let expected = [all_vertices(&one, &other.shape, &relative), all_vertices(&other, &one.shape, &relative.inverse())];
                most = most.max(expected[0].inside.count);
                assert_eq!(found, expected);
            }
        }
        assert!(most > WITHOUT_ALLOCATION, "no list is long: {most}");
    }

    /// Where the bodies are certainly apart no vertex is looked at; at the very touch they are.
    #[test]
    fn the_first_vertex_inside_is_seen() {
        let ball = surface([1.0; 3], [1.0, 1.0], 5);
        let pole = ball.vertices.at(12).norm();
        for (gap, is_seen) in [(1e-3, false), (1e-14, false), (-1e-14, true), (-1e-3, true)] {
            let second = placed(&ball, ball.vertices.at(12) / pole * (pole + 1.0 + gap), Matrix3::identity());
            let mut touches = Vec::new();
            let guess = Some(ball.vertices.at(12) / pole);
            vertex_pair(&placed(&ball, Vector::zeros(), Matrix3::identity()), &second, guess, OneSided::Resolved, &mut touches);
            assert_eq!(!touches.is_empty(), is_seen, "{gap}: {touches:?}");
        }
    }

    #[test]
    fn a_contact_that_one_side_sees_is_resolved_or_left_out() {
        // The pole of a slender body between the vertices of a coarse ball.
        let (ball, rod) = (surface([1.0; 3], [1.0, 1.0], 6), surface([0.05, 0.05, 1.0], [1.0, 1.0], 40));
        let (first, second) =
            (placed(&ball, Vector::zeros(), Matrix3::identity()), placed(&rod, Vector::new(0.0, 0.0, 1.98), Matrix3::identity()));
        let mut touches = Vec::new();
        vertex_pair(&first, &second, None, OneSided::Ignored, &mut touches);
        assert!(touches.is_empty());
        vertex_pair(&first, &second, None, OneSided::Resolved, &mut touches);
        let touch = touches[0];
        assert!((touch.overlap - 0.02).abs() < 0.003 && (touch.normal - Vector::z()).norm() < 1e-12, "{touch:?}");
    }

    #[test]
    fn a_wall_is_touched_by_the_vertices_behind_it() {
        let cylinder = surface([1.0, 1.0, 0.5], [0.1, 1.0], 40);
        let plane = Plane { point: Vector::zeros(), normal: Vector::z() };
        let mut touches = Vec::new();
        vertex_plane(&placed(&cylinder, Vector::new(3.0, 0.0, 0.49), Matrix3::identity()), &plane, &mut touches);
        let touch = touches[0];
        assert!((touch.overlap - 0.01).abs() < 1e-4 && touch.arm_of_first.xy().norm() < 1e-12 && touch.normal == -Vector::z(), "{touch:?}");
    }
}
