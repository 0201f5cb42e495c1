//! Nearest points that need no search: a point and a simple set, two straight lines.

use super::Relative;
use super::core::Core;
use crate::Vector;

/// Nearest points of two sets, in the frame of the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// Point of the first set.
    pub on_first: Vector,
    /// From there to the point of the second.
    pub vector: Vector,
    /// Unit vector along it where one is known better than the difference of two points.
    pub normal: Option<Vector>,
}

/// Nearest points of a pair that has a closed form.
pub fn nearest(first: &Core, second: &Core, relative: &Relative) -> Option<Nearest> {
    match (first, second) {
        (_, Core::Point) => {
            let on_first = nearest_to_point(first, &relative.position)?;
            Some(Nearest { on_first, vector: relative.position - on_first, normal: None })
        }
        (Core::Point, _) => {
            // In the frame of the second, where a difference along an axis that is zero is so exactly.
            let point = relative.inverse().position;
            let vector = relative.rotation * (nearest_to_point(second, &point)? - point);
            Some(Nearest { on_first: Vector::zeros(), vector, normal: None })
        }
        (Core::Segment { half_length: half_of_one }, Core::Segment { half_length: half_of_other }) => {
            let (one, other) = ((Vector::z(), *half_of_one), (relative.rotation.column(2).into_owned(), *half_of_other));
            let places = nearest_on_lines(&relative.position, one, other);
            let on_first = one.0 * places[0];
            let normal = direction_between_lines(&relative.position, one, other, places);
            Some(Nearest { on_first, vector: relative.position + other.0 * places[1] - on_first, normal })
        }
        _ => None,
    }
}

fn nearest_to_point(core: &Core, point: &Vector) -> Option<Vector> {
    match core {
        Core::Point => Some(Vector::zeros()),
        Core::Segment { half_length } => Some(nearest_on_segment(*half_length, point)),
        Core::Box { half_lengths } => Some(nearest_on_box(half_lengths, point)),
        Core::Cylinder { radius, half_length } => Some(nearest_on_cylinder(*radius, *half_length, point)),
        Core::Polygon(polygon) => {
            let found = polygon.nearest(point);
            Some(point + found.direction * found.distance)
        }
        Core::Polyhedron(_) | Core::Superellipsoid(_) => None,
    }
}

/// Point of a box, given by half its edges, nearest to a point.
#[inline]
pub fn nearest_on_box(half_lengths: &Vector, point: &Vector) -> Vector {
    point.sup(&-half_lengths).inf(half_lengths)
}

/// Point of a cylinder along z nearest to a point.
#[inline]
pub fn nearest_on_cylinder(radius: f64, half_length: f64, point: &Vector) -> Vector {
    let across = point.x.hypot(point.y);
    let scale = if across > radius { radius / across } else { 1.0 };
    Vector::new(point.x * scale, point.y * scale, point.z.clamp(-half_length, half_length))
}

/// Point of a line along z nearest to a point.
#[inline]
pub fn nearest_on_segment(half_length: f64, point: &Vector) -> Vector {
    Vector::new(0.0, 0.0, point.z.clamp(-half_length, half_length))
}

/// A straight line by its unit vector and half its length in m.
pub type Line = (Vector, f64);

/// Squared sine between two lines below which they count as parallel: their crossing is lost to rounding.
const PARALLEL: f64 = f64::EPSILON;

/// Places along two lines of their nearest points, from their middles. `between` leads from the one middle to the other.
///
/// Source: Ericson, Real-Time Collision Detection (2005), section 5.1.9. Lines that are parallel to rounding: at the nearer end of their common
/// stretch, or in its middle if there is none.
#[inline]
pub fn nearest_on_lines(between: &Vector, (one, half_of_one): Line, (other, half_of_other): Line) -> [f64; 2] {
    let cosine = one.dot(&other);
    let determinant = one.cross(&other).norm_squared();
    let (along_one, along_other) = (between.dot(&one), between.dot(&other));
    let is_parallel = determinant < PARALLEL;
    if is_parallel {
        let low = (-half_of_one).max(along_one - half_of_other);
        let high = half_of_one.min(along_one + half_of_other);
        if low <= high {
            // Half the change of the squared distance along the stretch, against the rounding of that distance.
            let slope = (cosine.signum() * other - one).dot(between) * (high - low);
            let rounding = 4.0 * f64::EPSILON * (between.norm() + half_of_one + half_of_other);
            let is_even = slope.abs() <= rounding * (between - one * along_one).norm();
            let place = if is_even {
                0.5 * (low + high)
            } else if slope > 0.0 {
                low
            } else {
                high
            };
            return [place, (cosine.signum() * (place - along_one)).clamp(-half_of_other, half_of_other)];
        }
    }
    let free = if is_parallel { 0.0 } else { (along_one - cosine * along_other) / determinant };
    let on_one = free.clamp(-half_of_one, half_of_one);
    let on_other = (cosine * on_one - along_other).clamp(-half_of_other, half_of_other);
    // Where the other line ends first, the one is looked at again.
    [(along_one + cosine * on_other).clamp(-half_of_one, half_of_one), on_other]
}

/// Unit vector between the nearest points of two lines: at right angles to each that is not left at an end. Where lines are near, the difference of
/// two points has lost its direction to rounding, but their cross product has not.
pub fn direction_between_lines(
    between: &Vector,
    (one, half_of_one): Line,
    (other, half_of_other): Line,
    places: [f64; 2],
) -> Option<Vector> {
    let vector = between + other * places[1] - one * places[0];
    let crossed = one.cross(&other);
    let across = match (places[0].abs() < half_of_one, places[1].abs() < half_of_other) {
        (true, true) if crossed.norm_squared() > 1e4 * PARALLEL => crossed * crossed.dot(&vector),
        (true, _) => return across(&vector, &one),
        (false, true) => return across(&vector, &other),
        (false, false) => vector,
    };
    across.try_normalize(0.0)
}

/// Unit vector of the part across a line. Twice, so that no rounding is left along the line where little is left across it.
pub fn across(vector: &Vector, line: &Vector) -> Option<Vector> {
    let unit = (vector - line * vector.dot(line)).try_normalize(0.0)?;
    (unit - line * unit.dot(line)).try_normalize(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_beside_beyond_and_inside_simple_sets() {
        let point = Vector::new(3.0, 4.0, 2.0);
        assert!(((point - nearest_on_cylinder(1.0, 1.0, &point)).norm() - 17.0_f64.sqrt()).abs() < 1e-15);
        assert!(((point - nearest_on_box(&Vector::new(1.0, 2.0, 3.0), &point)).norm() - 8.0_f64.sqrt()).abs() < 1e-15);
        assert!(((point - nearest_on_segment(2.5, &point)).norm() - 5.0).abs() < 1e-15);
        let inside = Vector::new(0.1, 0.2, 0.3);
        assert_eq!((nearest_on_cylinder(1.0, 1.0, &inside), nearest_on_box(&Vector::repeat(1.0), &inside)), (inside, inside));
    }

    #[test]
    fn lines_meet_inside_at_one_end_and_at_both() {
        let (z, x) = ((Vector::z(), 1.0), (Vector::x(), 1.0));
        assert_eq!(nearest_on_lines(&Vector::new(0.5, 2.0, 0.25), z, x), [0.25, -0.5]);
        assert_eq!(nearest_on_lines(&Vector::new(3.0, 2.0, 0.25), z, x), [0.25, -1.0]);
        assert_eq!(nearest_on_lines(&Vector::new(3.0, 2.0, 5.0), z, x), [1.0, -1.0]);
    }

    #[test]
    fn almost_parallel_lines_are_nearest_at_the_end_to_which_they_lean() {
        let straight = (Vector::z(), 1.0);
        for tilt in [1e-3, 1e-6, 1e-9, 1e-12] {
            for lean in [tilt, -tilt] {
                let leaning = (Vector::new(lean, 0.0, 1.0).normalize(), 1.0);
                // The second leans away from the first towards positive places if it leans towards positive x.
                let places = nearest_on_lines(&Vector::new(0.5, 0.0, 0.4), straight, leaning);
                let expected = if lean > 0.0 { -0.6 } else { 1.0 };
                assert!((places[0] - expected).abs() < 2e-3, "{lean}: {places:?}");
            }
        }
        let even = nearest_on_lines(&Vector::new(0.5, 0.0, 0.4), straight, straight);
        assert!((even[0] - 0.2).abs() < 1e-15 && (even[1] + 0.2).abs() < 1e-15);
    }

    #[test]
    fn the_direction_between_crossed_lines_outlives_their_gap() {
        let (one, other) = ((Vector::z(), 1.0), (Vector::new(0.6, 0.8, 0.0), 1.0));
        let expected = Vector::new(-0.8, 0.6, 0.0);
        for gap in [1e-3, 1e-9, 1e-15] {
            let between = expected * gap + other.0 * 0.3 + one.0 * 0.2;
            let places = nearest_on_lines(&between, one, other);
            let normal = direction_between_lines(&between, one, other, places).unwrap();
            assert!((normal - expected).norm() < 4.0 * f64::EPSILON, "{gap}: {normal}");
        }
    }
}
