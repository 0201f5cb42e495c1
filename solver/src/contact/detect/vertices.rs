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
use crate::shape::superellipsoid::vertices::{LANES, Vertices};

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

/// What the vertices of one body that lie inside the other tell, in the body's own frame.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Seen {
    count: usize,
    sum: Vector,
    normals: Vector,
    /// Largest depth under the other surface to first order, in m.
    depth: f64,
}

/// A direction and how far along it the other surface reaches back towards this one: only vertices beyond can lie inside it.
#[derive(Clone, Copy)]
struct Cap {
    direction: Vector,
    nearest: f64,
    thickness: f64,
}

impl Cap {
    fn new(own: &VertexSurface, other: &VertexSurface, other_from_own: &Relative, direction: Vector) -> Cap {
        let facing_back = -other_from_own.rotation.tr_mul(&direction);
        let nearest = other_from_own.position.dot(&direction) - other.shape.support(&facing_back).dot(&facing_back);
        Cap { direction, nearest, thickness: own.shape.support(&direction).dot(&direction) - nearest }
    }
}

/// Looks which vertices lie inside the other surface: those of the thinner of the caps along the line of centres and along a guess of the normal.
fn seen_vertices(
    own: &VertexSurface,
    other: &VertexSurface,
    other_from_own: &Relative,
    guess: Option<Vector>,
    mut flag: impl FnMut(usize),
) -> Seen {
    let mut seen = Seen { count: 0, sum: Vector::zeros(), normals: Vector::zeros(), depth: 0.0 };
    let centre = other_from_own.position;
    let towards = Cap::new(own, other, other_from_own, centre.try_normalize(0.0).unwrap_or_else(Vector::x));
    let guessed = guess.map_or(towards, |guess| Cap::new(own, other, other_from_own, guess));
    let Cap { direction, nearest, .. } = if guessed.thickness < towards.thickness { guessed } else { towards };
    for start in (0..own.vertices.len()).step_by(LANES) {
        let mut beyond = own.vertices.beyond(start, &direction, nearest);
        while beyond != 0 {
            let index = start + beyond.trailing_zeros() as usize;
            beyond &= beyond - 1;
            let vertex = own.vertices.at(index);
            let inside = other_from_own.rotation.tr_mul(&(vertex - centre));
            if !other.shape.contains(&inside) {
                continue;
            }
            flag(index);
            seen.count += 1;
            seen.sum += vertex;
            seen.normals += own.shape.gradient_of_gauge(&vertex).normalize();
            seen.depth = seen.depth.max((1.0 - other.shape.gauge(&inside)) / other.shape.gradient_of_gauge(&inside).norm());
        }
    }
    seen
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
    let back = relative.inverse();
    let (mut of_first, mut of_second) = (Vec::new(), Vec::new());
    let of_guess = |turn: &nalgebra::Matrix3<f64>, sign: f64| guess.map(|guess| turn.tr_mul(&guess) * sign);
    let own = seen_vertices(first.surface, second.surface, &relative, of_guess(&first.pose.rotation, 1.0), |index| of_first.push(index));
    let other = seen_vertices(second.surface, first.surface, &back, of_guess(&second.pose.rotation, -1.0), |index| of_second.push(index));
    let looked_up = (first.surface.vertices.len() + second.surface.vertices.len()) as u32;
    let look = |normal: Vector| Look { guess: normal.into(), corners: looked_up, is_deep: false };
    let towards = relative.position.try_normalize(0.0).unwrap_or_else(Vector::x);
    let is_ignored = one_sided == OneSided::Ignored && (own.count == 0 || other.count == 0);
    if own.count + other.count == 0 || is_ignored {
        return look(first.pose.rotation * towards);
    }
    let mean = |sum: Vector, count: usize| sum / count.max(1) as f64;
    let normals = mean(own.normals, own.count) - relative.rotation * mean(other.normals, other.count);
    let normal = normals.try_normalize(0.0).unwrap_or(towards);
    let in_first = |index: &usize| relative.position + relative.rotation * second.surface.vertices.at(*index);
    let (place, overlap) = if own.count > 0 && other.count > 0 {
        let foremost = of_first.iter().map(|index| first.surface.vertices.at(*index).dot(&normal)).fold(f64::NEG_INFINITY, f64::max);
        let hindmost = of_second.iter().map(|index| in_first(index).dot(&normal)).fold(f64::INFINITY, f64::min);
        let mean_of_second = relative.position + relative.rotation * mean(other.sum, other.count);
        (0.5 * (mean(own.sum, own.count) + mean_of_second), foremost - hindmost)
    } else if own.count > 0 {
        (mean(own.sum, own.count), own.depth)
    } else {
        (relative.position + relative.rotation * mean(other.sum, other.count), other.depth)
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
    for index in 0..surface.surface.vertices.len() {
        let vertex = surface.surface.vertices.at(index);
        let height = height_of_centre + vertex.dot(&upwards);
        if height < 0.0 {
            (sum, count, overlap) = (sum + vertex, count + 1, overlap.max(-height));
        }
    }
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

    /// Only the cap of vertices that can lie inside is looked at: nothing is lost by it.
    #[test]
    fn no_vertex_inside_is_passed_over() {
        let (one, other) = (surface([1.0, 0.5, 0.3], [0.5, 1.3], 30), surface([0.6, 0.6, 1.2], [1.6, 0.3], 30));
        for index in 0..200 {
            let turn = turned(Vector::new(0.3, 0.1 * f64::from(index % 17), -0.7), 0.31 * f64::from(index));
            let place = Vector::new(0.9, 0.1 * f64::from(index % 7), -0.05 * f64::from(index % 11));
            let relative = Relative { rotation: turn, position: place };
            let guess = Vector::new(1.0, 0.2, 0.1 * f64::from(index % 5)).normalize();
            let seen = [None, Some(guess)].map(|guess| seen_vertices(&one, &other, &relative, guess, |_| {}).count);
            let inside = |vertex: Vector| other.shape.gauge(&turn.tr_mul(&(vertex - place))) <= 1.0;
            assert_eq!(seen, [(0..one.vertices.len()).filter(|index| inside(one.vertices.at(*index))).count(); 2]);
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
