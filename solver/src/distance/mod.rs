//! Distance of two convex sets: how far, along which direction, between which points (R section 2.5).
//!
//! # Reading order
//!
//! [`core`](self::core) (what is left of a shape without its crust) -> closed forms where there are any -> [`gjk`] for everything else -> [`polish`] where a surface is curved
//! -> [`overlap`] when even the cores overlap. Everything happens in the frame of the first set, so that neither the place of a pair
//! in the world nor the unit of length matters.

mod closed_forms;
pub mod core;
pub mod gjk;
pub mod overlap;
pub mod polish;
mod simplex;

use nalgebra::Matrix3;

pub use self::core::{Core, RoundedCore};
use crate::Vector;
use gjk::{Goal, Search, State};
use simplex::Corner;

/// Place and turn of a set in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Centre in m.
    pub position: Vector,
    /// From the set's own frame to the world.
    pub rotation: Matrix3<f64>,
}

/// The second set as seen from the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relative {
    /// From the frame of the second to the frame of the first.
    pub rotation: Matrix3<f64>,
    /// Centre of the second in the frame of the first, in m.
    pub position: Vector,
}

impl Relative {
    /// The second pose seen from the first.
    #[inline]
    pub fn new(first: &Pose, second: &Pose) -> Relative {
        Relative { rotation: first.rotation.tr_mul(&second.rotation), position: first.rotation.tr_mul(&(second.position - first.position)) }
    }

    /// Farthest point of the second set in a direction, both in the frame of the first.
    #[inline]
    pub fn support(&self, second: &Core, direction: &Vector) -> Vector {
        self.position + self.rotation * second.support(&self.rotation.tr_mul(direction))
    }

    fn inverse(&self) -> Relative {
        Relative { rotation: self.rotation.transpose(), position: -self.rotation.tr_mul(&self.position) }
    }
}

/// What is known of two sets. Vectors are in the world frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Separation {
    /// Distance in m; negative by the depth if the sets overlap; a lower bound if it is beyond the cutoff.
    pub distance: f64,
    /// Unit vector from the first set to the second.
    pub normal: Vector,
    /// Nearest point of the first set, from its centre, in m.
    pub on_first: Vector,
    /// Nearest point of the second set, from its centre, in m.
    pub on_second: Vector,
    /// Upper less lower bound of the distance, in m.
    pub gap: f64,
    /// How it was found.
    pub outcome: Outcome,
    /// Corners looked up in the search: its cost.
    pub corners: u32,
}

/// How a distance was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// By a closed form.
    ClosedForm,
    /// By the search alone.
    Searched,
    /// By Newton's method, certified.
    Polished,
    /// The sets are certainly farther apart than the cutoff.
    BeyondCutoff,
    /// The sets overlap: the depth along the normal is exact, the normal the best of those tried.
    Overlapping,
}

/// What is asked.
#[derive(Debug, Clone, Copy)]
pub struct Query {
    /// A guess of the direction from first to second in the world frame, such as the last answer; any length but zero.
    pub guess: Option<Vector>,
    /// Distance in m above which the exact value is of no interest.
    pub cutoff: f64,
}

impl Query {
    /// Everything, from no guess.
    pub fn cold() -> Query {
        Query { guess: None, cutoff: f64::INFINITY }
    }
}

/// Gap between the bounds of the distance, relative to the size of the sets, at which a search on curved sets turns to Newton's method.
const GAPS_BEFORE_POLISHING: [f64; 4] = [3e-2, 1e-3, 1e-5, 1e-7];
/// Gap, relative to size, that certifies a polished distance.
const CERTIFIED_GAP: f64 = 1e-12;
/// Rounding errors in a difference of points, relative to size and distance of the sets.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Distance, direction and nearest points of two sets.
pub fn separation(first: (&Core, &Pose), second: (&Core, &Pose), query: &Query) -> Separation {
    let relative = Relative::new(first.1, second.1);
    let guess = query.guess.map(|guess| first.1.rotation.tr_mul(&guess));
    let found = separation_in_frame(first.0, second.0, &relative, guess, query.cutoff);
    let to_world = |vector: Vector| first.1.rotation * vector;
    Separation { normal: to_world(found.normal), on_first: to_world(found.on_first), on_second: to_world(found.on_second), ..found }
}

/// The same with everything in the frame of the first set.
fn separation_in_frame(first: &Core, second: &Core, relative: &Relative, guess: Option<Vector>, cutoff: f64) -> Separation {
    if let Some((on_first, on_second)) = closed_form(first, second, relative) {
        let vector = on_second - on_first;
        let distance = vector.norm();
        if distance > ROUNDING * (first.reach() + second.reach()) {
            let normal = vector / distance;
            let on_second = on_second - relative.position;
            return Separation { distance, normal, on_first, on_second, gap: 0.0, outcome: Outcome::ClosedForm, corners: 0 };
        }
        return overlap::separation(first, second, relative, guess);
    }
    searched(first, second, relative, guess, cutoff)
}

/// Nearest points of pairs with a closed form, in the frame of the first.
fn closed_form(first: &Core, second: &Core, relative: &Relative) -> Option<(Vector, Vector)> {
    let nearest_to_point = |core: &Core, point: &Vector| match core {
        Core::Point => Some(Vector::zeros()),
        Core::Segment { half_length } => Some(closed_forms::nearest_on_segment(*half_length, point)),
        Core::Box { half_lengths } => Some(closed_forms::nearest_on_box(half_lengths, point)),
        Core::Cylinder { radius, half_length } => Some(closed_forms::nearest_on_cylinder(*radius, *half_length, point)),
        Core::Polyhedron(_) => None,
    };
    match (first, second) {
        (_, Core::Point) => Some((nearest_to_point(first, &relative.position)?, relative.position)),
        (Core::Point, _) => {
            let nearest = nearest_to_point(second, &relative.inverse().position)?;
            Some((Vector::zeros(), relative.position + relative.rotation * nearest))
        }
        (Core::Segment { half_length: one }, Core::Segment { half_length: other }) => {
            let direction = relative.rotation.column(2).into_owned();
            Some(closed_forms::nearest_on_segments(*one, &relative.position, &direction, *other))
        }
        _ => None,
    }
}

fn searched(first: &Core, second: &Core, relative: &Relative, guess: Option<Vector>, cutoff: f64) -> Separation {
    let size = first.reach() + second.reach();
    let rounding = ROUNDING * (size + relative.position.norm());
    let certified = CERTIFIED_GAP * size;
    let answer = |polished: polish::Polished, corners| Separation {
        distance: polished.distance,
        normal: polished.normal,
        on_first: polished.on_first,
        on_second: polished.on_first + polished.normal * polished.distance - relative.position,
        gap: polished.gap,
        outcome: Outcome::Polished,
        corners,
    };
    let is_curved = first.is_curved() || second.is_curved();
    if let (Core::Cylinder { .. }, Core::Cylinder { .. }, Some(guess)) = (first, second, &guess)
        && let Some(polished) = polish::polish(first, second, relative, guess, None, certified)
    {
        return answer(polished, 0);
    }
    let start = guess.or_else(|| relative.position.try_normalize(0.0)).unwrap_or_else(Vector::x);
    let mut search = Search::start(&start, first, second, relative);
    let gaps = if is_curved { &GAPS_BEFORE_POLISHING[..] } else { &[] };
    for gap in gaps.iter().map(|gap| gap * size).chain([rounding]) {
        search.go_on(first, second, relative, &Goal { gap, cutoff, rounding });
        match search.state {
            State::Overlapping => return overlap::separation(first, second, relative, guess),
            State::BeyondCutoff => break,
            State::Converged => {}
        }
        if is_curved
            && search.lower_bound > 0.0
            && let Some(polished) = polish::polish(first, second, relative, &search.vector, Some(&search.simplex), certified)
        {
            return answer(polished, search.corners);
        }
    }
    let normal = search.vector.normalize();
    let Corner { difference, on_first } = search.simplex.nearest();
    let length = difference.norm();
    let is_beyond = search.state == State::BeyondCutoff;
    Separation {
        distance: if is_beyond { search.lower_bound } else { length },
        normal,
        on_first,
        on_second: on_first + difference - relative.position,
        gap: (length - search.lower_bound).max(0.0),
        outcome: if is_beyond { Outcome::BeyondCutoff } else { Outcome::Searched },
        corners: search.corners,
    }
}
