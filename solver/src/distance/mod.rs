//! Distance of two convex sets: how far, along which direction, between which points (R section 2.5).
//!
//! # Reading order
//!
//! [`mod@core`] (what is left of a shape without its crust) -> [`boxes`] round it, a first bound -> closed forms where there are any -> [`gjk`] for everything else -> [`polish`] where a surface is curved
//! -> [`overlap`] when even the cores overlap -> `least_depth` where smooth sets overlap. Everything happens in the frame of the first set, so that neither the place of a pair
//! in the world nor the unit of length matters.

pub mod boxes;
mod closed_forms;
mod common_normal;
pub mod core;
mod ellipsoids;
pub mod gjk;
mod least_depth;
pub mod order;
pub mod overlap;
pub mod polish;
pub mod polygon;
mod simplex;

use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};

pub use self::core::{Core, RoundedCore};
use crate::Vector;
use common_normal::Start;
pub(crate) use common_normal::basis;
use gjk::{Goal, KnownCorners, Search, State};
pub use polygon::{Polygon, PolygonError};

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
        self.farthest(second, direction).1
    }

    /// The same with the number of the corner.
    #[inline]
    pub fn farthest(&self, second: &Core, direction: &Vector) -> (u32, Vector) {
        let (number, corner) = second.farthest(&self.rotation.tr_mul(direction));
        (number, self.position + self.rotation * corner)
    }

    /// The first set as seen from the second.
    pub fn inverse(&self) -> Relative {
        Relative { rotation: self.rotation.transpose(), position: -self.rotation.tr_mul(&self.position) }
    }
}

/// What is known of two sets. Vectors are in the world frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Separation {
    /// Distance in m; negative by the depth if the sets overlap; a lower bound if it is beyond the cutoff. The depth of superellipsoids, cold or
    /// warm, is the length of the least translation that parts them; of other sets, whose crusts should not be used up, a local minimum of that.
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
    /// Where on both surfaces the nearest points lie.
    pub known: Known,
    /// Corners looked up in the search: its cost.
    pub corners: u32,
}

impl Separation {
    /// Seen from another frame.
    #[inline]
    fn turned(self, rotation: &Matrix3<f64>) -> Separation {
        Separation { normal: rotation * self.normal, on_first: rotation * self.on_first, on_second: rotation * self.on_second, ..self }
    }

    /// Seen from the other set.
    fn swapped(self) -> Separation {
        let Separation { normal, on_first, on_second, known, .. } = self;
        Separation { normal: -normal, on_first: on_second, on_second: on_first, known: known.swapped(), ..self }
    }

    /// The guess for the next look at the same sets.
    #[inline]
    pub fn guess(&self) -> Guess {
        Guess { direction: self.normal, known: self.known }
    }
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

/// Where a search begins.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Guess {
    /// Direction from first to second in the world frame; any length but zero.
    pub direction: Vector,
    /// Where on both surfaces the nearest points were.
    pub known: Known,
}

/// Where on two surfaces the nearest points lie, in a form that moves with the sets.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Known {
    /// Not said.
    #[default]
    Nothing,
    /// Corners of both sets.
    Corners(KnownCorners),
    /// Parameters of two smooth surfaces.
    Parameters([Vector; 2]),
}

impl Known {
    /// Seen from the other set.
    fn swapped(self) -> Known {
        match self {
            Known::Nothing => Known::Nothing,
            Known::Corners(corners) => Known::Corners(corners.swapped()),
            Known::Parameters([first, second]) => Known::Parameters([second, first]),
        }
    }
}

impl Guess {
    /// Seen from the other set.
    pub fn swapped(self) -> Guess {
        Guess { direction: -self.direction, known: self.known.swapped() }
    }
}

impl From<Vector> for Guess {
    fn from(direction: Vector) -> Guess {
        Guess { direction, known: Known::Nothing }
    }
}

/// What is asked.
#[derive(Debug, Clone, Copy)]
pub struct Query {
    /// Where to begin, such as the [guess](Separation::guess) of the last answer.
    pub guess: Option<Guess>,
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
pub const CERTIFIED_GAP: f64 = 1e-12;
/// Gap, relative to size, above which a search on curved sets has lost its way.
const LOST_GAP: f64 = 1e-11;
/// Rounding errors in a difference of points, relative to size and distance of the sets.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Distance, direction and nearest points of two sets.
///
/// The sets are looked at in an order of their own ([`order`]), so that swapping them changes no bit of the answer.
pub fn separation(first: (&Core, &Pose), second: (&Core, &Pose), query: &Query) -> Separation {
    if order::is_after(first, second) {
        return in_order(second, first, &Query { guess: query.guess.map(Guess::swapped), ..*query }).swapped();
    }
    in_order(first, second, query)
}

#[inline]
fn in_order(first: (&Core, &Pose), second: (&Core, &Pose), query: &Query) -> Separation {
    let relative = Relative::new(first.1, second.1);
    let guess = query.guess.map(|guess| Guess { direction: first.1.rotation.tr_mul(&guess.direction), ..guess });
    let found = apart(first.0, second.0, &relative, guess, query.cutoff);
    let found = found.unwrap_or_else(|| overlap::separation(first.0, second.0, &relative, guess.map(|guess| guess.direction)));
    let is_doubtful = found.distance < 0.0 && least_depth::is_doubtful(first.0, second.0, &relative, &found);
    let found = if is_doubtful { least_depth::least(first.0, second.0, &relative, found) } else { found };
    found.turned(&first.1.rotation)
}

/// The same with everything in the frame of the first set; `None` if the sets touch or overlap, or if the search has lost its way.
#[inline]
fn apart(first: &Core, second: &Core, relative: &Relative, guess: Option<Guess>, cutoff: f64) -> Option<Separation> {
    match closed_forms::nearest(first, second, relative) {
        Some(nearest) => answer_of_closed_form(&nearest, first, second, relative),
        None => searched(first, second, relative, guess, cutoff),
    }
}

/// `None` if the sets touch or overlap.
fn answer_of_closed_form(nearest: &closed_forms::Nearest, first: &Core, second: &Core, relative: &Relative) -> Option<Separation> {
    let distance = nearest.vector.norm();
    (distance > ROUNDING * (first.reach() + second.reach())).then(|| Separation {
        distance,
        normal: nearest.normal.unwrap_or(nearest.vector / distance),
        on_first: nearest.on_first,
        on_second: nearest.on_first + nearest.vector - relative.position,
        gap: 0.0,
        outcome: Outcome::ClosedForm,
        known: Known::Nothing,
        corners: 0,
    })
}

/// By search, and polish where a surface is curved. `None` if the sets touch or overlap, or if
/// the search has lost its way.
#[inline]
fn searched(first: &Core, second: &Core, relative: &Relative, guess: Option<Guess>, cutoff: f64) -> Option<Separation> {
    let size = first.reach() + second.reach();
    let rounding = ROUNDING * (size + relative.position.norm());
    let certified = CERTIFIED_GAP * size;
    let is_curved = first.is_curved() || second.is_curved();
    if is_curved
        && let Some(guess) = &guess
        && let Some(found) = warm(first, second, relative, guess, certified)
    {
        return Some(found);
    }
    let known = match &guess {
        Some(Guess { known: Known::Corners(corners), .. }) => Some(corners),
        _ => None,
    };
    let direction = || {
        let direction = guess.map(|guess| guess.direction).or_else(|| relative.position.try_normalize(0.0));
        direction.unwrap_or_else(Vector::x)
    };
    let mut search = Search::resume(known, direction, first, second, relative);
    let gaps = if is_curved { &GAPS_BEFORE_POLISHING[..] } else { &[] };
    for gap in gaps.iter().map(|gap| gap * size).chain([rounding]) {
        search.go_on(first, second, relative, &Goal { gap, cutoff, rounding });
        match search.state {
            State::Overlapping => return None,
            State::BeyondCutoff => break,
            State::Converged => {}
        }
        if is_curved && let Some(found) = polished(first, second, relative, &search, certified) {
            return Some(found);
        }
    }
    let answer = search.answer(first, second, relative);
    // Corners on a curved surface can end in slivers, far from the answer.
    let is_lost = is_curved && answer.outcome == Outcome::Searched && answer.gap > LOST_GAP * size;
    (!is_lost).then_some(answer)
}

/// Newton's method straight from a guess, where that is enough to know both surfaces by.
#[inline(never)]
fn warm(first: &Core, second: &Core, relative: &Relative, guess: &Guess, certified: f64) -> Option<Separation> {
    match (first, second) {
        (Core::Cylinder { .. }, Core::Cylinder { .. }) => {
            Some(polish::polish(first, second, relative, &guess.direction, None, certified)?.answer(relative, 0))
        }
        (Core::Superellipsoid(_) | Core::Point, Core::Superellipsoid(_) | Core::Point) => {
            ellipsoids::separation(first, second, relative, &guess.direction, certified)
                .or_else(|| common_normal::separation(first, second, relative, &Start::Guess(*guess), certified))
        }
        _ => None,
    }
}

/// Newton's method from where a search stands.
#[inline(never)]
fn polished(first: &Core, second: &Core, relative: &Relative, search: &Search, certified: f64) -> Option<Separation> {
    let is_smooth = |core: &Core| matches!(core, Core::Superellipsoid(_));
    let found = if !is_smooth(first) && !is_smooth(second) {
        polish::polish(first, second, relative, &search.vector, Some(&search.simplex), certified)?.answer(relative, 0)
    } else if let Some(found) = ellipsoids::separation(first, second, relative, &search.vector, certified) {
        found
    } else {
        let simplex::Foot { difference, on_first } = search.simplex.nearest();
        let points = [on_first, on_first + difference - relative.position];
        let from = polish::smooth::Found { direction: search.vector, points, simplex: &search.simplex, moved: Vector::zeros() };
        common_normal::separation(first, second, relative, &Start::Points(search.vector, points), certified)
            .or_else(|| polish::smooth::separation(first, second, relative, &from, certified))?
    };
    Some(Separation { corners: search.corners, ..found })
}

/// The search alone, down to rounding error and without polish: what the polish is measured against. In the world frame; `None` if the sets
/// touch or overlap.
pub fn search_alone(first: (&Core, &Pose), second: (&Core, &Pose)) -> Option<Separation> {
    let relative = Relative::new(first.1, second.1);
    let rounding = ROUNDING * (first.0.reach() + second.0.reach() + relative.position.norm());
    let start = relative.position.try_normalize(0.0).unwrap_or_else(Vector::x);
    let mut search = Search::start(&start, first.0, second.0, &relative);
    search.go_on(first.0, second.0, &relative, &Goal { gap: rounding, cutoff: f64::INFINITY, rounding });
    (search.state == State::Converged).then(|| search.answer(first.0, second.0, &relative).turned(&first.1.rotation))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Orientation;

    const CUBE: Core = Core::Box { half_lengths: Vector::new(0.5, 0.5, 0.5) };

    /// A pose of a sequence that fills places and turns evenly enough.
    fn pose(index: u32, distance: f64) -> Pose {
        let part = |stride: f64| (f64::from(index) * stride).fract() - 0.5;
        let direction = Vector::new(part(0.618_034), part(0.754_878), part(0.569_841)).normalize();
        let turn = Orientation::from_euler_angles(7.0 * part(0.324_718), 7.0 * part(0.220_744), 7.0 * part(0.856_675));
        Pose { position: direction * distance, rotation: *turn.to_rotation_matrix().matrix() }
    }

    /// The second of a pair put a gap apart along the direction between both.
    fn apart(first: (&Core, &Pose), second: (&Core, Pose), gap: f64) -> Pose {
        let far = separation(first, (second.0, &second.1), &Query::cold());
        Pose { position: second.1.position - far.normal * (far.distance - gap), ..second.1 }
    }

    #[test]
    fn bounds_of_boxes_meet_at_any_gap() {
        let first = pose(0, 1.0);
        for index in 1..3000 {
            for gap in [1e-6, 1e-2] {
                let second = apart((&CUBE, &first), (&CUBE, pose(index, 5.0)), gap);
                let found = separation((&CUBE, &first), (&CUBE, &second), &Query::cold());
                assert!((found.distance - gap).abs() < 1e-14 && found.gap < 1e-14, "{index}: {found:?}");
            }
        }
    }

    #[test]
    fn known_corners_shorten_the_search_and_swapping_changes_no_bit() {
        let cylinder = Core::Cylinder { radius: 0.5, half_length: 0.5 };
        let tetrahedron = Core::Polyhedron(std::sync::Arc::new(crate::shape::Polyhedron::tetrahedron(1.0).unwrap()));
        let (mut cold_corners, mut warm_corners) = (0, 0);
        for index in 1..2000 {
            for (one, other) in [(&CUBE, &CUBE), (&CUBE, &tetrahedron), (&tetrahedron, &cylinder), (&cylinder, &cylinder)] {
                let (first, second) = (pose(7 * index, 1.0), pose(index, 5.0));
                let second = Pose { position: first.position + second.position * 0.35, ..second };
                let before = Pose { position: second.position + Vector::new(1e-3, 1e-3, -1e-3), ..second };
                let guess = Some(separation((one, &first), (other, &before), &Query::cold()).guess());
                let cold = separation((one, &first), (other, &second), &Query::cold());
                let warm = separation((one, &first), (other, &second), &Query { guess, cutoff: f64::INFINITY });
                let agree = 1e-11 * (1.0 + cold.distance.abs());
                assert!((cold.distance - warm.distance).abs() < agree || cold.distance < 0.0, "{index}: {cold:?} {warm:?}");
                let swapped = Query { guess: guess.map(Guess::swapped), cutoff: f64::INFINITY };
                assert_eq!(separation((other, &second), (one, &first), &swapped), warm.swapped());
                if !one.is_curved() && !other.is_curved() && cold.distance > 0.0 {
                    (cold_corners, warm_corners) = (cold_corners + cold.corners, warm_corners + warm.corners);
                }
            }
        }
        assert!(f64::from(warm_corners) < 0.8 * f64::from(cold_corners), "{warm_corners} of {cold_corners}");
    }

    /// As a checkpoint changed by hand could hold them.
    #[test]
    fn corners_that_do_not_exist_are_not_used() {
        let (first, second) = (pose(0, 1.0), pose(1, 5.0));
        let corners = serde_json::from_str(r#"{"numbers": [[0, 9], [0, 0], [0, 0]], "count": 200}"#).unwrap();
        let guess = Some(Guess { direction: Vector::z(), known: Known::Corners(corners) });
        let found = separation((&CUBE, &first), (&CUBE, &second), &Query { guess, cutoff: f64::INFINITY });
        let cold = separation((&CUBE, &first), (&CUBE, &second), &Query::cold());
        assert!((found.distance - cold.distance).abs() < 1e-14, "{found:?} {cold:?}");
    }

    #[test]
    fn cylinders_are_certified_however_little_they_are_tilted_and_almost_all_by_the_polish() {
        let mut searched = 0;
        let cores = [(0.5, 0.5), (0.1, 1.0), (1.0, 0.1)].map(|(radius, half_length)| Core::Cylinder { radius, half_length });
        let first = pose(0, 1.0);
        for index in 1..2000 {
            let free = pose(index, 5.0);
            let tilt = 10.0_f64.powi(-((index % 16) as i32) - 1);
            let tilted = Orientation::from_axis_angle(&nalgebra::Unit::new_normalize(free.position), tilt).to_rotation_matrix();
            let almost_parallel = Pose { rotation: tilted.matrix() * first.rotation, ..free };
            let (one, other) = (&cores[(index % 3) as usize], &cores[(index / 3 % 3) as usize]);
            for second in [free, almost_parallel] {
                let second = apart((one, &first), (other, second), 0.02);
                let found = separation((one, &first), (other, &second), &Query::cold());
                searched += u32::from(found.outcome != Outcome::Polished);
                assert!(found.gap < 2e-11 && (found.distance - 0.02).abs() < 1e-10, "{index}: {found:?}");
            }
        }
        assert!(searched <= 4, "{searched} of 4000 were left to the search");
    }

    #[test]
    fn crossed_cylinders_that_overlap_aside_of_their_centres_have_the_depth_of_their_sides() {
        let core = Core::Cylinder { radius: 0.5, half_length: 1.0 };
        let turn = Orientation::from_axis_angle(&Vector::x_axis(), 1.0);
        let first = Pose { position: Vector::zeros(), rotation: Matrix3::identity() };
        for depth in [1e-6, 1e-3, 1e-2] {
            let second = Pose { position: Vector::new(1.0 - depth, 0.1, 0.2), rotation: *turn.to_rotation_matrix().matrix() };
            let found = separation((&core, &first), (&core, &second), &Query::cold());
            assert!((found.distance + depth).abs() < 1e-12 && (found.normal - Vector::x()).norm() < 1e-9, "{depth}: {found:?}");
        }
    }

    #[test]
    fn crossed_edges_that_overlap_aside_of_their_centres_have_the_depth_of_the_edges() {
        let normal = Vector::new(1.0, 0.0, 1.0).normalize();
        let turn = Orientation::from_axis_angle(&nalgebra::Unit::new_normalize(normal), std::f64::consts::FRAC_PI_2);
        let first = Pose { position: Vector::zeros(), rotation: Matrix3::identity() };
        for depth in [1e-6, 1e-3, 1e-2] {
            let position = normal * (2.0_f64.sqrt() - depth) + Vector::y() * 0.3;
            let second = Pose { position, rotation: *turn.to_rotation_matrix().matrix() };
            let found = separation((&CUBE, &first), (&CUBE, &second), &Query::cold());
            assert!((found.distance + depth).abs() < 1e-13 && (found.normal - normal).norm() < 1e-10, "{depth}: {found:?}");
            assert_eq!(found.outcome, Outcome::Overlapping);
        }
    }
}
