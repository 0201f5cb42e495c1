//! Distance and normal of two superellipsoids by bisection: slow, independent of the solver, and without a start that could mislead it.
//!
//! For a direction $d$ of any length the supporting planes leave the gap $g(d) = d \cdot r - h_1(d) - h_2(-d)$, a concave function. Of all unit
//! directions the normal has the largest, and that is the distance $\delta$. So $g(d) - \lambda |d|$, which is concave for $\lambda \ge 0$, is at
//! most zero for $\lambda = \delta$; for smaller $\lambda$ its largest value leads to a larger gap, and $\lambda$ follows it (Dinkelbach 1967). Over a plane of
//! directions the largest value is bisected: the slope along the one coordinate changes its sign once, and so does, along the other, the slope at the
//! best of the first. The plane lies about the best of several hundred directions.
//!
//! Sets that overlap are as deep as the least translation that parts them: $g$ is negative in all directions, and its largest value over all unit
//! vectors, of which there may be several local ones, is less the depth. The best of a thousand directions, far enough from each other, are followed
//! uphill without derivatives, the best of their ends from plane to plane; about the highest the same bisection gives the last digits.
//!
//! The support function is written out with plain powers: Barr (1981), by Hölder's inequality.

use nalgebra::{Matrix3, Vector3};

type Vector = Vector3<f64>;

/// A superellipsoid in its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// Semi-axes in m.
    pub semi_axes: Vector,
    /// Exponents towards z and in the plane of x and y, below two.
    pub exponents: [f64; 2],
    /// Centre in m.
    pub position: Vector,
    /// From the own frame to the world.
    pub rotation: Matrix3<f64>,
}

impl Placed {
    /// Farthest point in a direction, from the centre.
    pub fn support(&self, direction: &Vector) -> Vector {
        let scaled = self.rotation.tr_mul(direction).component_mul(&self.semi_axes).normalize();
        let [outer, inner] = self.exponents.map(|exponent| 2.0 / (2.0 - exponent));
        let in_plane = (scaled.x.abs().powf(inner) + scaled.y.abs().powf(inner)).powf(1.0 / inner);
        let whole = (in_plane.powf(outer) + scaled.z.abs().powf(outer)).powf(1.0 / outer);
        let share = |part: f64, of: f64, power: f64| if of > 0.0 { (part.abs() / of).powf(power - 1.0).copysign(part) } else { 0.0 };
        let across = share(in_plane, whole, outer);
        let point = Vector::new(
            share(scaled.x, in_plane, inner) * across,
            share(scaled.y, in_plane, inner) * across,
            share(scaled.z, whole, outer),
        );
        self.rotation * point.component_mul(&self.semi_axes)
    }

    /// How much larger the shape would have to be for a point, from the centre, to lie on its surface.
    pub fn gauge(&self, from_centre: &Vector) -> f64 {
        let point = self.rotation.tr_mul(from_centre).component_div(&self.semi_axes).abs();
        let [outer, inner] = self.exponents.map(|exponent| 2.0 / exponent);
        let in_plane = (point.x.powf(inner) + point.y.powf(inner)).powf(1.0 / inner);
        (in_plane.powf(outer) + point.z.powf(outer)).powf(1.0 / outer)
    }
}

/// Distance in m, negative by the depth, and unit normal from the first to the second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer {
    /// Distance in m.
    pub distance: f64,
    /// Unit vector.
    pub normal: Vector,
}

/// Halvings of an interval: to the last bit and a few more.
const HALVINGS: usize = 58;

struct Planes<'a> {
    first: &'a Placed,
    second: &'a Placed,
    /// Gap over length that is to be surpassed.
    level: f64,
    halvings: usize,
}

impl Planes<'_> {
    /// The gap over the length of the direction.
    fn gap(&self, direction: &Vector) -> f64 {
        let between = self.second.position - self.first.position + self.second.support(&-direction) - self.first.support(direction);
        between.dot(direction) / direction.norm()
    }

    /// Slope along a vector of the gap less `level` times the length of the direction.
    fn slope(&self, direction: &Vector, along: &Vector) -> f64 {
        let between = self.second.position - self.first.position + self.second.support(&-direction) - self.first.support(direction);
        (between - direction * (self.level / direction.norm())).dot(along)
    }

    /// The two directions, on a line along `other`, between which the slope along it changes its sign.
    fn bracket(&self, start: Vector, other: &Vector, window: f64) -> [Vector; 2] {
        let (mut low, mut high) = (-window, window);
        for _ in 0..self.halvings {
            let middle = 0.5 * (low + high);
            let rises = self.slope(&(start + other * middle), other) > 0.0;
            (low, high) = if rises { (middle, high) } else { (low, middle) };
        }
        [start + other * low, start + other * high]
    }

    /// Slope of the best gap on lines along `other`, from line to line along `one`. Where a flat face makes a kink, slopes jump between the two
    /// directions of a bracket: what counts is the mean of both in which the slope along the line vanishes.
    fn slope_of_best(&self, bracket: &[Vector; 2], one: &Vector, other: &Vector) -> f64 {
        let [before, after] = [0, 1].map(|place| [self.slope(&bracket[place], one), self.slope(&bracket[place], other)]);
        let jump = before[1] - after[1];
        let share = if jump > 0.0 { (before[1] / jump).clamp(0.0, 1.0) } else { 0.5 };
        before[0] * (1.0 - share) + after[0] * share
    }

    fn best_in_window(&self, centre: Vector, window: f64) -> Vector {
        let one = centre.cross(&Vector::ith(centre.iamin(), 1.0)).normalize();
        let other = centre.cross(&one);
        let (mut low, mut high) = (-window, window);
        for _ in 0..self.halvings {
            let middle = 0.5 * (low + high);
            let bracket = self.bracket(centre + one * middle, &other, window);
            (low, high) = if self.slope_of_best(&bracket, &one, &other) > 0.0 { (middle, high) } else { (low, middle) };
        }
        let [before, after] = self.bracket(centre + one * (0.5 * (low + high)), &other, window);
        (0.5 * (before + after)).normalize()
    }
}

/// Directions even over the sphere, by the golden angle.
fn spread_directions(count: usize) -> impl Iterator<Item = Vector> {
    (0..count).map(move |index| {
        let (height, angle) = (1.0 - (2.0 * index as f64 + 1.0) / count as f64, 2.399_963_229_728_653 * index as f64);
        let across = (1.0 - height * height).sqrt();
        Vector::new(across * angle.cos(), across * angle.sin(), height)
    })
}

/// Distance and normal of two superellipsoids; of an overlap the least depth over all directions.
pub fn distance(first: &Placed, second: &Placed) -> Answer {
    let mut planes = Planes { first, second, level: 0.0, halvings: COARSE };
    let centre = spread_directions(400).max_by(|one, other| planes.gap(one).total_cmp(&planes.gap(other))).unwrap_or_else(Vector::x);
    let mut widest = planes.best_in_window(centre, WINDOW);
    let size = first.semi_axes.norm() + second.semi_axes.norm();
    if planes.gap(&widest).abs() < ALMOST_TOUCHING * size {
        // A small gap is lost by a rough look.
        planes.halvings = HALVINGS;
        widest = planes.best_in_window(centre, WINDOW);
    }
    if planes.gap(&widest) > 0.0 {
        return planes.refined(widest, centre, WINDOW);
    }
    planes.halvings = COARSE;
    let deepest = planes.best_of_all();
    let mut refined = planes.refined(deepest, deepest, WINDOW_OF_OVERLAP);
    if (refined.normal - deepest).norm() > 0.5 * WINDOW_OF_OVERLAP {
        // A depth that hardly depends on the direction has its best farther away.
        refined = planes.refined(deepest, deepest, WIDE_WINDOW_OF_OVERLAP);
    }
    // Where the window holds no best, the end of the ascent stays. Its direction is good to the root of rounding only.
    let end = Answer { distance: planes.gap(&deepest), normal: deepest };
    if refined.distance >= end.distance - ROUNDING * size { refined } else { end }
}

/// The same, looking about some directions besides: the gap along any direction is one that some plane leaves, so whoever names a direction with a larger
/// gap, or a lesser depth, is right, and one that names another is not believed.
pub fn distance_from(first: &Placed, second: &Placed, seen: &[Vector]) -> Answer {
    let about = |direction: &Vector| {
        let mut planes = Planes { first, second, level: 0.0, halvings: COARSE };
        let given = Answer { distance: planes.gap(direction), normal: *direction };
        let refined = planes.refined(*direction, *direction, WINDOW_OF_OVERLAP);
        if refined.distance >= given.distance { refined } else { given }
    };
    let size = first.semi_axes.norm() + second.semi_axes.norm();
    seen.iter()
        .map(about)
        .fold(distance(first, second), |best, other| if other.distance > best.distance + ROUNDING * size { other } else { best })
}

/// The largest gap, or least depth, within a hundred-thousandth of a direction, of which an overlap may have several. Where there is none so near, a
/// direction at the edge of that.
pub fn distance_near(first: &Placed, second: &Placed, direction: &Vector) -> Answer {
    Planes { first, second, level: 0.0, halvings: COARSE }.refined(*direction, *direction, WINDOW_OF_ONE)
}

impl Planes<'_> {
    /// The level follows the best of a window, first roughly, then to the last bits.
    fn refined(&mut self, mut normal: Vector, centre: Vector, window: f64) -> Answer {
        for halvings in [COARSE, COARSE, COARSE, HALVINGS, HALVINGS] {
            (self.level, self.halvings) = (self.gap(&normal), halvings);
            normal = self.best_in_window(centre, window);
        }
        Answer { distance: self.gap(&normal), normal }
    }

    /// The direction of the largest gap over the whole sphere.
    fn best_of_all(&self) -> Vector {
        let mut all: Vec<(f64, Vector)> = spread_directions(SPREAD).map(|direction| (self.gap(&direction), direction)).collect();
        all.sort_by(|one, other| other.0.total_cmp(&one.0));
        let spacing = 2.0 / (SPREAD as f64).sqrt();
        let mut starts: Vec<Vector> = Vec::new();
        for (_, direction) in all {
            if starts.len() < STARTS && starts.iter().all(|start| (start - direction).norm() > spacing) {
                starts.push(direction);
            }
        }
        let mut ends: Vec<Vector> = starts.iter().map(|start| self.uphill(*start, 0.5 * spacing)).collect();
        ends.sort_by(|one, other| self.gap(other).total_cmp(&self.gap(one)));
        let tops = ends.iter().take(ENDS).map(|end| self.to_the_top(*end));
        tops.max_by(|one, other| self.gap(one).total_cmp(&self.gap(other))).unwrap_or_else(Vector::x)
    }

    /// From plane to plane, each touching the sphere at the best of the last: negative and concave on the plane, the gap of its best only grows on the way
    /// back to the sphere. Ridges, on which an ascent without derivatives creeps, do not matter.
    fn to_the_top(&self, start: Vector) -> Vector {
        let (mut best, mut gap) = (start, self.gap(&start));
        for _ in 0..LARGEST_NUMBER_OF_PLANES {
            let next = self.best_in_window(best, WINDOW_OF_PLANE);
            let gap_of_next = self.gap(&next);
            if gap_of_next <= gap * (1.0 - GAIN) {
                break;
            }
            (best, gap) = (next, gap_of_next);
        }
        best
    }

    /// Follows the gap uphill: six ways round, with steps that grow where one leads up and shrink where none does.
    fn uphill(&self, start: Vector, first_step: f64) -> Vector {
        let (mut best, mut gap, mut step) = (start, self.gap(&start), first_step);
        for round in 0..LARGEST_NUMBER_OF_ROUNDS {
            if step < SMALLEST_STEP {
                break;
            }
            let one = best.cross(&Vector::ith(best.iamin(), 1.0)).normalize();
            let other = best.cross(&one);
            let ways = (0..6).map(|way| f64::from(round) + f64::from(way) * std::f64::consts::FRAC_PI_3);
            let mut around = ways.map(|angle| (best + (one * angle.cos() + other * angle.sin()) * step).normalize());
            match around.find(|direction| self.gap(direction) > gap) {
                Some(better) => (best, gap, step) = (better, self.gap(&better), 1.6 * step),
                None => step *= 0.45,
            }
        }
        best
    }
}

/// Halvings while the level is still found.
const COARSE: usize = 24;
/// Half the width of the plane of directions about the best of those that are spread.
const WINDOW: f64 = 2.0;
/// The same about the end of an ascent.
const WINDOW_OF_OVERLAP: f64 = 1e-3;
/// Holds one of several least depths.
const WINDOW_OF_ONE: f64 = 1e-5;
const WIDE_WINDOW_OF_OVERLAP: f64 = 3e-2;
/// Gap over size below which a rough look does not tell whether sets overlap.
const ALMOST_TOUCHING: f64 = 1e-5;
/// Rounding of a gap over size.
const ROUNDING: f64 = 1e-15;
/// Directions on the sphere, and how many of them are followed.
const SPREAD: usize = 1000;
const STARTS: usize = 8;
/// Angle in radians that ends an ascent.
const SMALLEST_STEP: f64 = 1e-6;
const LARGEST_NUMBER_OF_ROUNDS: u32 = 200;
/// How many of the best ends are followed further, over how many planes of what half width, until the gap grows by less than this part.
const ENDS: usize = 3;
const LARGEST_NUMBER_OF_PLANES: usize = 20;
const WINDOW_OF_PLANE: f64 = 0.2;
const GAIN: f64 = 1e-9;

#[cfg(test)]
mod tests {
    use super::*;

    fn placed(semi_axes: [f64; 3], exponents: [f64; 2], position: Vector) -> Placed {
        Placed { semi_axes: semi_axes.into(), exponents, position, rotation: Matrix3::identity() }
    }

    /// Exact: balls, and ellipsoids turned alike that are balls in scaled space and touch.
    #[test]
    fn balls_and_ellipsoids_turned_alike_are_exact() {
        let way = Vector::new(0.6, -0.3, 0.74).normalize();
        for gap in [0.3, 1e-6, -0.05] {
            let found = distance(&placed([1.0; 3], [1.0; 2], Vector::zeros()), &placed([0.4; 3], [1.0; 2], way * (1.4 + gap)));
            assert!((found.distance - gap).abs() < 1e-14 && (found.normal - way).norm() < 1e-12, "{gap}: {found:?}");
        }
        let axes = [1.0, 0.2, 2.0];
        let found =
            distance(&placed(axes, [1.0; 2], Vector::zeros()), &placed(axes, [1.0; 2], 2.0 * way.component_mul(&Vector::from(axes))));
        let normal = way.component_div(&Vector::from(axes)).normalize();
        assert!(found.distance.abs() < 1e-14 && (found.normal - normal).norm() < 1e-11, "{found:?}");
    }

    /// Exact: a ball inside a flat ellipsoid parts soonest through its flat side, whichever way its centre lies.
    #[test]
    fn of_all_common_normals_the_least_depth_is_taken() {
        for place in [0.05, -0.01] {
            let (flat, ball) = (placed([1.0, 0.2, 2.0], [1.0; 2], Vector::zeros()), placed([0.1; 3], [1.0; 2], Vector::y() * place));
            let (found, depth) = (distance(&flat, &ball), 0.3 - place.abs());
            assert!((found.distance + depth).abs() < 1e-14 && (found.normal.y - place.signum()).abs() < 1e-12, "{found:?}");
        }
    }

    /// A direction that is no better changes nothing; one that leads to a wider gap than was found is taken, whoever names it.
    #[test]
    fn directions_named_from_outside_count_as_far_as_they_are_better() {
        let way = Vector::new(0.6, -0.3, 0.74).normalize();
        let (first, second) = (placed([1.0; 3], [1.0; 2], Vector::zeros()), placed([0.4; 3], [1.0; 2], way * 1.5));
        for seen in [Vector::x(), -way, (way + Vector::x() * 1e-4).normalize()] {
            let found = distance_from(&first, &second, &[seen]);
            assert!((found.distance - 0.1).abs() < 1e-14 && (found.normal - way).norm() < 1e-12, "{found:?}");
        }
    }

    #[test]
    fn the_support_lies_on_the_surface() {
        let shape = placed([1.0, 0.5, 2.0], [0.3, 1.6], Vector::zeros());
        for direction in spread_directions(100) {
            let point = shape.support(&direction).component_div(&shape.semi_axes).abs();
            let [outer, inner] = shape.exponents.map(|exponent| 2.0 / exponent);
            let value = (point.x.powf(inner) + point.y.powf(inner)).powf(outer / inner) + point.z.powf(outer);
            assert!((value - 1.0).abs() < 1e-12, "{value}");
        }
    }
}
