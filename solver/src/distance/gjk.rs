//! The algorithm of Gilbert, Johnson and Keerthi (1988) for the distance of two convex sets (R section 2.5).
//!
//! Coded form: the point `v` of the difference of both sets that is nearest to the origin is approached by points of a growing and shrinking simplex.
//! Every step adds the corner that is farthest against `v`, which also gives a lower bound of the distance; upper less lower bound is the gap
//! that is returned with the result. All tolerances are relative to the size of the sets: nothing depends on the unit of length.

use serde::{Deserialize, Serialize};

use super::closed_forms::across;
use super::core::Core;
use super::simplex::{Corner, Foot, Simplex};
use super::{Known, Outcome, Relative, Separation};
use crate::Vector;

/// Where the search stands.
#[derive(Debug, Clone, Copy)]
pub struct Search {
    /// From the point on the first set to the point on the second.
    pub vector: Vector,
    /// The simplex that holds it.
    pub simplex: Simplex,
    /// Best lower bound of the distance so far, in m.
    pub lower_bound: f64,
    /// Direction that gave it, of any length.
    pub direction: Vector,
    /// Corners looked up so far.
    pub corners: u32,
    /// Why the search stands still.
    pub state: State,
}

/// How a search has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    /// The gap is below the tolerance, or rounding allows no more.
    Converged,
    /// The sets overlap.
    Overlapping,
    /// The distance is certainly above the cutoff.
    BeyondCutoff,
}

/// What ends a search.
#[derive(Debug, Clone, Copy)]
pub struct Goal {
    /// Gap between upper and lower bound that is small enough, in m.
    pub gap: f64,
    /// Distance above which the exact value is of no interest, in m.
    pub cutoff: f64,
    /// Length in m that rounding cannot resolve.
    pub rounding: f64,
}

/// A search does not take more corners than this: polytopes end much earlier, curved sets are polished before.
const LARGEST_NUMBER_OF_CORNERS: u32 = 200;

/// A squared length that grows by less than this, relatively, has not grown.
const STALL: f64 = 16.0 * f64::EPSILON;
const LARGEST_NUMBER_OF_STALLS: u32 = 8;

#[inline]
fn corner_against(vector: &Vector, first: &Core, second: &Core, relative: &Relative) -> Corner {
    let (of_first, on_first) = first.farthest(vector);
    let (of_second, on_second) = relative.farthest(second, &-vector);
    Corner { difference: on_second - on_first, on_first, numbers: [of_first, of_second] }
}

/// Corners of both sets that held the nearest points at the last look, by their numbers: where sets have moved little, they still do.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct KnownCorners {
    numbers: [[u32; 2]; 3],
    count: u8,
}

impl KnownCorners {
    #[inline]
    fn of(simplex: &Simplex) -> KnownCorners {
        let mut known = KnownCorners::default();
        for (numbers, corner) in known.numbers.iter_mut().zip(simplex.corners()) {
            *numbers = corner.numbers;
            known.count += 1;
        }
        known
    }

    /// Seen from the other set.
    pub(super) fn swapped(self) -> KnownCorners {
        KnownCorners { numbers: self.numbers.map(|[first, second]| [second, first]), ..self }
    }
}

impl Search {
    /// From corners known from the last look, or else from a direction.
    #[inline(always)]
    pub fn resume(
        known: Option<&KnownCorners>,
        direction: impl FnOnce() -> Vector,
        first: &Core,
        second: &Core,
        relative: &Relative,
    ) -> Search {
        let nothing = Vector::zeros();
        let mut search = Search {
            vector: nothing,
            simplex: Simplex::default(),
            lower_bound: f64::NEG_INFINITY,
            direction: nothing,
            corners: 0,
            state: State::Converged,
        };
        if known.and_then(|known| search.put_up(known, first, second, relative)).is_none() {
            search = Search::start(&direction(), first, second, relative);
        }
        search
    }

    /// Puts known corners together; `None` if there are none.
    #[inline(always)]
    fn put_up(&mut self, known: &KnownCorners, first: &Core, second: &Core, relative: &Relative) -> Option<()> {
        let (last, others) = known.numbers[..usize::from(known.count.min(3))].split_last()?;
        let corner = |numbers: [u32; 2]| {
            let on_first = first.corner(numbers[0])?;
            let on_second = relative.position + relative.rotation * second.corner(numbers[1])?;
            Some(Corner { difference: on_second - on_first, on_first, numbers })
        };
        for numbers in others {
            self.simplex.push(corner(*numbers)?);
        }
        self.vector = self.simplex.add(corner(*last)?);
        self.direction = self.vector;
        self.corners = u32::from(known.count);
        Some(())
    }

    /// A start from a guess of the direction from the first set to the second.
    #[inline]
    pub fn start(guess: &Vector, first: &Core, second: &Core, relative: &Relative) -> Search {
        let corner = corner_against(guess, first, second, relative);
        let lower_bound = corner.difference.dot(guess) / guess.norm();
        let mut simplex = Simplex::default();
        Search { vector: simplex.add(corner), simplex, lower_bound, direction: *guess, corners: 1, state: State::Converged }
    }

    /// Goes on until the goal is reached.
    #[inline]
    pub fn go_on(&mut self, first: &Core, second: &Core, relative: &Relative, goal: &Goal) {
        let mut squared = self.vector.norm_squared();
        let mut stalls = 0;
        while self.corners < LARGEST_NUMBER_OF_CORNERS {
            let length = squared.sqrt();
            if length <= goal.rounding {
                self.state = State::Overlapping;
                return;
            }
            let corner = corner_against(&self.vector, first, second, relative);
            self.corners += 1;
            let lower_bound = corner.difference.dot(&self.vector) / length;
            if lower_bound > self.lower_bound {
                (self.lower_bound, self.direction) = (lower_bound, self.vector);
            }
            if self.lower_bound > goal.cutoff {
                self.state = State::BeyondCutoff;
                return;
            }
            self.state = State::Converged;
            let is_known = self.simplex.corners().iter().any(|known| known.difference == corner.difference);
            if is_known || length - self.lower_bound <= goal.gap {
                return;
            }
            let nearest = self.simplex.with(corner);
            let next = nearest.point.norm_squared();
            if next >= squared {
                // Where faces are almost parallel, the direction still gets better when the length does not.
                stalls += 1;
                if next > squared * (1.0 + STALL) || stalls > LARGEST_NUMBER_OF_STALLS {
                    return;
                }
            }
            self.simplex.keep(&nearest);
            (self.vector, squared) = (nearest.point, next);
        }
    }

    /// What the search has found, in the frame of the first set; of a search that has not found an overlap.
    #[inline]
    pub(super) fn answer(&self, first: &Core, second: &Core, relative: &Relative) -> Separation {
        let Foot { difference, on_first } = self.simplex.nearest();
        let length = difference.norm();
        let mut normal = self.direction.normalize();
        let mut lower_bound = self.lower_bound;
        if let [from, to] = self.simplex.corners()
            && let Some(across) = across(&self.vector, &(to.difference - from.difference).normalize())
        {
            // Across an edge, without the rounding along the edge that grows as the gap gets small.
            let bound = corner_against(&across, first, second, relative).difference.dot(&across);
            if bound >= lower_bound {
                (lower_bound, normal) = (bound, across);
            }
        }
        let is_beyond = self.state == State::BeyondCutoff;
        Separation {
            distance: if is_beyond { lower_bound } else { length },
            normal,
            on_first,
            on_second: on_first + difference - relative.position,
            gap: (length - lower_bound).max(0.0),
            outcome: if is_beyond { Outcome::BeyondCutoff } else { Outcome::Searched },
            known: Known::Corners(KnownCorners::of(&self.simplex)),
            corners: self.corners,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Outcome, Pose, Query, search_alone, separation};
    use super::*;
    use crate::Orientation;

    const CUBE: Core = Core::Box { half_lengths: Vector::new(0.5, 0.5, 0.5) };

    fn pose(position: Vector, axis: Vector, angle: f64) -> Pose {
        let turn = Orientation::from_axis_angle(&nalgebra::Unit::new_normalize(axis), angle);
        Pose { position, rotation: *turn.to_rotation_matrix().matrix() }
    }

    #[test]
    fn cubes_are_as_far_as_their_faces_edges_and_corners() {
        let diagonal = Vector::new(1.0, 1.0, 1.0);
        let edges = Vector::new(1.0, 0.0, 1.0);
        let cases = [
            (Vector::z(), Vector::z(), 0.4, 1.0),
            (edges, edges, std::f64::consts::FRAC_PI_2, 2.0_f64.sqrt()),
            (diagonal, diagonal, 1.0, 3.0_f64.sqrt()),
            // A corner over a face: half a cube and half a diagonal.
            (Vector::z(), Vector::new(1.0, -1.0, 0.0), (1.0 / 3.0_f64.sqrt()).acos(), 0.5 + 0.75_f64.sqrt()),
        ];
        for (direction, axis, angle, touching) in cases {
            for gap in [1e-9, 1e-3, 0.3, 10.0] {
                let first = pose(Vector::new(3.0, 2.0, 1.0), Vector::z(), 0.0);
                let second = pose(first.position + direction.normalize() * (touching + gap), axis, angle);
                let found = separation((&CUBE, &first), (&CUBE, &second), &Query::cold());
                assert!((found.distance - gap).abs() < 1e-14 * (1.0 + gap), "{direction} {gap}: {found:?}");
                assert!(found.gap < 1e-13 * (1.0 + gap), "{direction} {gap}: {found:?}");
            }
        }
    }

    #[test]
    fn a_distance_beyond_the_cutoff_is_a_lower_bound() {
        let (first, second) = (pose(Vector::zeros(), Vector::z(), 0.0), pose(Vector::new(3.0, 1.0, 0.2), Vector::y(), 0.7));
        let exact = separation((&CUBE, &first), (&CUBE, &second), &Query::cold()).distance;
        let found = separation((&CUBE, &first), (&CUBE, &second), &Query { guess: None, cutoff: 0.1 });
        assert_eq!(found.outcome, Outcome::BeyondCutoff);
        assert!(found.distance > 0.1 && found.distance <= exact, "{found:?} {exact}");
        // Just below the cutoff the exact value is of interest.
        let found = separation((&CUBE, &first), (&CUBE, &second), &Query { guess: None, cutoff: exact * (1.0 + 1e-9) });
        assert!((found.distance - exact).abs() < 1e-14, "{found:?} {exact}");
    }

    #[test]
    fn the_search_alone_agrees_with_the_polish_and_sees_overlap() {
        let core = Core::Cylinder { radius: 0.5, half_length: 0.5 };
        let first = pose(Vector::zeros(), Vector::z(), 0.0);
        let apart = pose(Vector::new(1.1, 0.4, 0.9), Vector::x(), 0.6);
        let polished = separation((&core, &first), (&core, &apart), &Query::cold());
        let searched = search_alone((&core, &first), (&core, &apart)).unwrap();
        assert_eq!((polished.outcome, searched.outcome), (Outcome::Polished, Outcome::Searched));
        assert!((polished.distance - searched.distance).abs() < 1e-6);
        assert_eq!(search_alone((&core, &first), (&core, &pose(Vector::new(0.3, 0.0, 0.0), Vector::x(), 0.6))), None);
    }
}
