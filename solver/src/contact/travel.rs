//! How far bodies have moved, so that a pair that is certainly apart need not be looked at before it may touch.
//!
//! From one look to the next a point of a body moves by at most $|\Delta x| + 2 R\,|\Delta q|$, with the radius $R$ of the ball round the body and the
//! difference $\Delta q$ of its unit quaternions: a turn by $\theta$ moves it by $2 R \sin(\theta/2)$, and $|\Delta q| = 2 \sin(\theta/4)$. Two bodies that
//! were apart by a gap cannot touch before both sums together have grown by as much.

use serde::{Deserialize, Serialize};

use crate::relocation::Relocation;
use crate::{Bodies, Orientation, Vector};

/// The sums of all bodies, by storage index.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Travel {
    bodies: Vec<Traveller>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Traveller {
    /// Where the body was last seen, in m.
    position: Vector,
    orientation: Orientation,
    /// No point of it has moved further since the start, in m.
    length: f64,
}

impl Traveller {
    fn at_start(bodies: &Bodies, index: usize) -> Traveller {
        Traveller { position: bodies.position(index), orientation: bodies.orientation(index), length: 0.0 }
    }
}

impl Travel {
    /// Takes note of where some bodies are now.
    pub(super) fn note(&mut self, bodies: &Bodies, members: &[u32]) {
        self.bodies.extend((self.bodies.len()..bodies.len()).map(|index| Traveller::at_start(bodies, index)));
        for &index in members {
            let index = index as usize;
            let (position, orientation) = (bodies.position(index), bodies.orientation(index));
            let body = &mut self.bodies[index];
            let turned = (orientation.coords - body.orientation.coords).norm();
            body.length += (position - body.position).norm() + 2.0 * bodies.state.motion[index].radius * turned;
            (body.position, body.orientation) = (position, orientation);
        }
    }

    /// How far two bodies have moved together, in m. Only its growth has a meaning.
    #[inline]
    pub(super) fn of_both(&self, first: usize, second: usize) -> f64 {
        self.bodies[first].length + self.bodies[second].length
    }

    /// Follows bodies to where they are stored now, after some may have gone and others come.
    pub(super) fn follow(&mut self, bodies: &Bodies, moved: &Relocation) {
        if self.bodies.is_empty() {
            return;
        }
        let old = std::mem::take(&mut self.bodies);
        self.bodies.extend((0..bodies.len()).map(|index| Traveller::at_start(bodies, index)));
        for (place, body) in old.into_iter().enumerate() {
            if let Some(place) = moved.place(place) {
                self.bodies[place as usize] = body;
            }
        }
    }

    /// Whether it can belong to so many bodies.
    pub(super) fn is_of(&self, bodies: usize) -> bool {
        self.bodies.is_empty() || self.bodies.len() == bodies
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Convex, Cuboid};
    use crate::test_bodies;

    /// Corners of a box that is moved and turned, by much and by little, one way and back.
    #[test]
    fn no_point_moves_further_than_its_body_travels() {
        let lengths = Vector::new(0.4, 0.6, 2.0);
        let corners: Vec<Vector> = (0..8)
            .map(|bits| lengths.map_with_location(|axis, _, length| if bits >> axis & 1 == 0 { -0.5 * length } else { 0.5 * length }))
            .collect();
        let mut bodies = Bodies::new(vec![test_bodies::at_rest(Convex::Cuboid(Cuboid { lengths }), 1.0)]);
        let mut travel = Travel::default();
        travel.note(&bodies, &[0]);
        assert_eq!(travel.of_both(0, 0), 0.0);
        let places = |bodies: &Bodies| corners.iter().map(|corner| bodies.position(0) + bodies.orientation(0) * corner).collect::<Vec<_>>();
        let mut longest_ratio = 0.0_f64;
        for step in 1..400_u32 {
            let before = places(&bodies);
            let part = |stride: f64| (f64::from(step) * stride).fract() - 0.5;
            let size = 10.0_f64.powi(-((step % 7) as i32));
            let turn = Orientation::from_scaled_axis(Vector::new(part(0.618_034), part(0.754_878), part(0.569_841)) * (6.0 * size));
            bodies.state.motion[0].position += Vector::new(part(0.324_718), part(0.220_744), 0.0) * (size * f64::from(step % 3));
            bodies.state.orientation[0] = turn * bodies.state.orientation[0];
            let travelled = travel.of_both(0, 0);
            travel.note(&bodies, &[0]);
            let grown = 0.5 * (travel.of_both(0, 0) - travelled);
            for (from, to) in before.iter().zip(places(&bodies)) {
                let moved = (to - from).norm();
                assert!(moved <= grown * (1.0 + 1e-12) + 1e-14, "{step}: {moved} {grown}");
                longest_ratio = longest_ratio.max(moved / grown);
            }
        }
        // A bound, and not a loose one.
        assert!(longest_ratio > 0.9, "{longest_ratio}");
    }

    #[test]
    fn sums_follow_their_bodies() {
        let body = |id: u32| crate::bodies::BodySpecification {
            id,
            ..test_bodies::at_rest(Convex::Cuboid(Cuboid { lengths: Vector::repeat(1.0) }), 1.0)
        };
        let mut bodies = Bodies::new(vec![body(0), body(1), body(2)]);
        let mut travel = Travel::default();
        travel.note(&bodies, &[0, 1, 2]);
        bodies.state.motion[1].position.x += 0.5;
        travel.note(&bodies, &[1]);
        travel.follow(&bodies, &Relocation::of_order(&[1, 2, 0], 3));
        assert_eq!([travel.of_both(0, 1), travel.of_both(1, 2)], [0.5, 0.0]);
        assert!(travel.is_of(3) && !travel.is_of(2));
        // The last one goes, and another comes in its place.
        travel.follow(&bodies, &Relocation::of_order(&[1, 0], 3));
        assert_eq!([travel.of_both(0, 2), travel.of_both(1, 2)], [0.0, 0.5]);
    }
}
