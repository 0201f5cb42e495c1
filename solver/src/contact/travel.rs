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
    last_seen: Vec<Place>,
    /// No point of a body has moved further since the start, in m. By itself, because it is looked up for every pair.
    length: Vec<f64>,
}

/// Where a body was.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Place {
    /// In m.
    position: Vector,
    orientation: Orientation,
}

impl Place {
    fn of(bodies: &Bodies, index: usize) -> Place {
        Place { position: bodies.position(index), orientation: bodies.orientation(index) }
    }
}

impl Travel {
    /// Takes note of where some bodies are now.
    pub(super) fn note(&mut self, bodies: &Bodies, members: &[u32]) {
        self.last_seen.extend((self.last_seen.len()..bodies.len()).map(|index| Place::of(bodies, index)));
        self.length.resize(bodies.len(), 0.0);
        for &index in members {
            let index = index as usize;
            let (now, before) = (Place::of(bodies, index), &mut self.last_seen[index]);
            let turned = (now.orientation.coords - before.orientation.coords).norm();
            self.length[index] += (now.position - before.position).norm() + 2.0 * bodies.state.motion[index].radius * turned;
            *before = now;
        }
    }

    /// How far two bodies have moved together, in m. Only its growth has a meaning.
    #[inline]
    pub(super) fn of_both(&self, first: usize, second: usize) -> f64 {
        self.length[first] + self.length[second]
    }

    /// Follows bodies to where they are stored now, after some may have gone and others come.
    pub(super) fn follow(&mut self, bodies: &Bodies, moved: &Relocation) {
        if self.length.is_empty() {
            return;
        }
        let old = std::mem::take(self);
        self.last_seen.extend((0..bodies.len()).map(|index| Place::of(bodies, index)));
        self.length.resize(bodies.len(), 0.0);
        for (index, body) in old.last_seen.into_iter().zip(old.length).enumerate() {
            if let Some(index) = moved.place(index) {
                (self.last_seen[index as usize], self.length[index as usize]) = body;
            }
        }
    }

    /// Whether it can belong to so many bodies.
    pub(super) fn is_of(&self, bodies: usize) -> bool {
        self.last_seen.len() == self.length.len() && (self.length.is_empty() || self.length.len() == bodies)
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
