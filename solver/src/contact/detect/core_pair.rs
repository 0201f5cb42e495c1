//! Two rounded cores: overlap and normal from their distance, contact points from the pieces that face each other.

use super::feature::{Across, common_piece, facing_piece};
use crate::Vector;
use crate::contact::Touch;
use crate::distance::{Guess, Outcome, Pose, Query, Relative, RoundedCore, Separation, separation};

/// A rounded core in its place.
#[derive(Debug, Clone, Copy)]
pub struct PlacedCore<'a> {
    /// The core and its ball.
    pub rounded: &'a RoundedCore,
    /// Place and turn in the world.
    pub pose: Pose,
    /// Centre of mass of the body it belongs to, in m.
    pub centre_of_body: Vector,
}

/// How many points of a contact are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Points {
    /// All corners of the common piece of two faces or edges.
    All,
    /// The deepest only, wherever on a common face it comes to lie.
    Deepest,
}

/// What a look at a pair found besides contact points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// Where the next look should begin.
    pub guess: Guess,
    /// Corners looked up in the search.
    pub corners: u32,
    /// Whether even the cores overlap: the step is too large or the contact too soft.
    pub is_deep: bool,
    /// No more than the gap in m between both surfaces; zero or below if they touch, or if nothing is known of it.
    pub gap: f64,
}

/// The gap between two surfaces is looked for up to this part of the reach of both cores: a larger one is told by a lower bound.
const FAR: f64 = 0.05;

/// Adds the contact points of two rounded cores to a list, from what the last look left, if there was one.
pub fn core_pair(first: &PlacedCore<'_>, second: &PlacedCore<'_>, guess: Option<Guess>, points: Points, touches: &mut Vec<Touch>) -> Look {
    let reach = first.rounded.radius + second.rounded.radius;
    // The distance vanishes where sharp cores touch: a cutoff of zero still lets that through.
    let query = Query { guess, cutoff: reach + FAR * (first.rounded.core.reach() + second.rounded.core.reach()) };
    let found = separation((&first.rounded.core, &first.pose), (&second.rounded.core, &second.pose), &query);
    let is_deep = found.outcome == Outcome::Overlapping;
    let is_beyond = found.outcome == Outcome::BeyondCutoff;
    let lower_bound = if is_beyond { found.distance } else { found.distance - found.gap };
    let look = Look { guess: found.guess(), corners: found.corners, is_deep, gap: lower_bound - reach };
    let overlap = reach - found.distance;
    if is_beyond || overlap <= 0.0 {
        return look;
    }
    let before = touches.len();
    // So deep that no piece of the surface faces the other: one point between both.
    if points == Points::All && !is_deep {
        add_common_piece(first, second, &found, overlap, touches);
    }
    if touches.len() == before {
        let on_surface = found.on_first + found.normal * (first.rounded.radius - 0.5 * overlap);
        touches.push(touch_at(first, second, &found, overlap, on_surface));
    }
    look
}

/// The contact at a point given from the centre of the first core.
fn touch_at(first: &PlacedCore<'_>, second: &PlacedCore<'_>, found: &Separation, overlap: f64, point: Vector) -> Touch {
    let arm_of_first = first.pose.position - first.centre_of_body + point;
    Touch {
        overlap,
        normal: found.normal,
        arm_of_first,
        arm_of_second: arm_of_first - (second.centre_of_body - first.centre_of_body),
        is_deep: found.outcome == Outcome::Overlapping,
    }
}

/// Contact points of two pieces that face each other, if they meet in more than a point.
fn add_common_piece(first: &PlacedCore<'_>, second: &PlacedCore<'_>, found: &Separation, overlap: f64, touches: &mut Vec<Touch>) {
    if first.rounded.core.is_pointed() || second.rounded.core.is_pointed() {
        return;
    }
    let normal = found.normal;
    let across = Across::of(&normal);
    let own = Relative { rotation: first.pose.rotation, position: Vector::zeros() };
    let other = Relative { rotation: second.pose.rotation, position: second.pose.position - first.pose.position };
    let piece_of_first = facing_piece(&first.rounded.core, &own, &normal, 1.0, overlap, &across);
    if piece_of_first.len() < 2 {
        return;
    }
    let piece_of_second = facing_piece(&second.rounded.core, &other, &normal, -1.0, overlap, &across);
    let height = found.on_first.dot(&normal) + first.rounded.radius;
    common_piece(&piece_of_first, &piece_of_second, |place, below_first| {
        let overlap_here = overlap - place.depth;
        if overlap_here > 0.0 {
            let along = height - below_first - 0.5 * overlap_here;
            let point = across.x * place.x + across.y * place.y + normal * along;
            touches.push(touch_at(first, second, found, overlap_here, point));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Orientation;
    use crate::shape::{Convex, Cuboid, Cylinder, Spherocylinder};

    fn look(first: &Convex, second: &Convex, place: Vector, turn: Orientation) -> Vec<Touch> {
        let rounded = [first, second].map(|convex| RoundedCore::with_crust(convex, 0.02).expect("the shapes are thicker than that"));
        let origin = Pose { position: Vector::zeros(), rotation: nalgebra::Matrix3::identity() };
        let pose = Pose { position: place, rotation: *turn.to_rotation_matrix().matrix() };
        let one = PlacedCore { rounded: &rounded[0], pose: origin, centre_of_body: Vector::new(0.1, 0.0, 0.0) };
        let other = PlacedCore { rounded: &rounded[1], pose, centre_of_body: place };
        let mut touches = Vec::new();
        core_pair(&one, &other, None, Points::All, &mut touches);
        touches
    }

    fn cube() -> Convex {
        Convex::Cuboid(Cuboid { lengths: Vector::repeat(1.0) })
    }

    /// The crusts are taken off and put on again: flat faces overlap by exactly what the sharp cubes overlap, at every corner.
    #[test]
    fn faces_overlap_as_sharp_faces_do() {
        let touches = look(&cube(), &cube(), Vector::new(0.3, 0.2, 0.99), Orientation::identity());
        assert_eq!(touches.len(), 4);
        for touch in &touches {
            assert!((touch.overlap - 0.01).abs() < 16.0 * f64::EPSILON, "{}", touch.overlap);
            assert!((touch.normal - Vector::z()).norm() < 1e-14);
            // Halfway between both surfaces, and the same point seen from either body.
            assert!((touch.arm_of_first.z - 0.495).abs() < 1e-14);
            let from_second = touch.arm_of_second + Vector::new(0.3, 0.2, 0.99) - Vector::new(0.1, 0.0, 0.0);
            assert!((touch.arm_of_first - from_second).norm() < 1e-14);
        }
        let middle = touches.iter().map(|touch| touch.arm_of_first).sum::<Vector>() / 4.0;
        assert!((middle - Vector::new(0.15 - 0.1, 0.1, 0.495)).norm() < 1e-12, "{middle}");
    }

    #[test]
    fn turned_faces_meet_in_an_octagon_and_crossed_edges_in_a_point() {
        let eighth = Orientation::from_scaled_axis(Vector::z() * std::f64::consts::FRAC_PI_4);
        assert_eq!(look(&cube(), &cube(), Vector::z() * 0.99, eighth).len(), 8);
        let rod = Convex::Spherocylinder(Spherocylinder { radius: 0.1, length: 1.0 });
        let crossed = Orientation::from_scaled_axis(Vector::x() * std::f64::consts::FRAC_PI_2);
        let touches = look(&rod, &rod, Vector::x() * 0.19, crossed);
        assert!(touches.len() == 1 && (touches[0].overlap - 0.01).abs() < 16.0 * f64::EPSILON);
        assert_eq!(look(&rod, &rod, Vector::new(0.19, 0.0, 0.4), Orientation::identity()).len(), 2);
        let cylinder = Convex::Cylinder(Cylinder { radius: 0.1, length: 1.0 });
        assert_eq!(look(&cylinder, &cylinder, Vector::new(0.19, 0.0, 0.3), Orientation::identity()).len(), 2);
    }

    /// A face tilted by more than its overlap reaches lets go of its far corners; none of them jumps.
    #[test]
    fn a_tilting_face_lets_go_of_its_corners_where_their_overlap_is_zero() {
        let mut last = f64::NAN;
        for tilt in [0.0, 0.004, 0.008, 0.012, 0.03] {
            let turn = Orientation::from_scaled_axis(Vector::y() * tilt);
            let touches = look(&cube(), &cube(), Vector::z() * 0.99, turn);
            let total: f64 = touches.iter().map(|touch| touch.overlap).sum();
            assert!(touches.len() == if tilt < 0.02 { 4 } else { 2 }, "{tilt}: {}", touches.len());
            assert!(last.is_nan() || (total - last).abs() < 0.05, "{tilt}: {last} -> {total}");
            last = total;
        }
    }

    /// Rims over edges, whose nearest points lie on the outlines of both pieces: rounding must not make two contact points of one.
    #[test]
    fn no_two_contact_points_lie_at_the_same_place() {
        let (disc, mut points) = (Convex::Cylinder(Cylinder { radius: 0.5, length: 1.0 }), 0);
        for index in 0..4000_u32 {
            let part = |stride: f64| (f64::from(index) * stride).fract() - 0.5;
            let turn = Orientation::from_euler_angles(0.04 * part(0.618_034), 0.04 * part(0.754_878), 7.0 * part(0.569_841));
            let touches = look(&cube(), &disc, Vector::new(0.9 + 0.1 * part(0.324_718), 0.3 * part(0.220_744), 0.985), turn);
            points += touches.len();
            for (place, touch) in touches.iter().enumerate() {
                let is_apart = |other: &Touch| (other.arm_of_first - touch.arm_of_first).norm() > 1e-9;
                assert!(touches[..place].iter().all(is_apart), "{index}: {touches:?}");
            }
        }
        assert!(points > 4000, "{points}");
    }

    /// However deep, the answer is finite and counted.
    #[test]
    fn coincident_bodies_are_pushed_apart_along_some_direction() {
        let touches = look(&cube(), &cube(), Vector::zeros(), Orientation::identity());
        assert!(!touches.is_empty() && touches.iter().all(|touch| touch.is_deep && touch.overlap > 0.5 && touch.overlap < 1.01));
    }
}
