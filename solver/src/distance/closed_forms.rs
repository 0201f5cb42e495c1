//! Nearest points that need no search: a point and a simple set, two straight lines.

use super::core::Core;
use super::Relative;
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
        (Core::Segment { half_length: one }, Core::Segment { half_length: other }) => {
            let direction = relative.rotation.column(2).into_owned();
            Some(nearest_on_segments(*one, &relative.position, &direction, *other))
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
        Core::Polyhedron(_) => None,
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

/// Nearest points of a line along z through the origin and of another line, both given by half their length.
///
/// Source: Ericson, Real-Time Collision Detection (2005), section 5.1.9. Parallel lines: in the middle of their common stretch.
pub fn nearest_on_segments(half_of_first: f64, centre: &Vector, direction: &Vector, half_of_second: f64) -> Nearest {
    let at = |on_first: f64, on_second: f64| {
        let on_first_line = Vector::new(0.0, 0.0, on_first);
        let vector = centre + direction * on_second - on_first_line;
        let lines = [on_first.abs() < half_of_first, on_second.abs() < half_of_second];
        Nearest { on_first: on_first_line, vector, normal: across_lines(&vector, direction, lines) }
    };
    let cosine = direction.z;
    let determinant = direction.x * direction.x + direction.y * direction.y;
    let (along_first, along_second) = (centre.z, centre.dot(direction));
    if determinant < f64::EPSILON {
        let low = (-half_of_first).max(along_first - half_of_second);
        let high = half_of_first.min(along_first + half_of_second);
        if low <= high {
            let middle = 0.5 * (low + high);
            return at(middle, (cosine.signum() * (middle - along_first)).clamp(-half_of_second, half_of_second));
        }
    }
    let free = if determinant < f64::EPSILON { 0.0 } else { (along_first - cosine * along_second) / determinant };
    let on_first = free.clamp(-half_of_first, half_of_first);
    let on_second = (cosine * on_first - along_second).clamp(-half_of_second, half_of_second);
    // Where the second line ends first, the first is looked at again.
    let on_first = (along_first + cosine * on_second).clamp(-half_of_first, half_of_first);
    at(on_first, on_second)
}

/// Unit vector along a vector, at right angles to the z axis, to another line, to both or to neither: where lines are near, the difference of two
/// points has lost its direction to rounding.
fn across_lines(vector: &Vector, direction: &Vector, lines: [bool; 2]) -> Option<Vector> {
    let crossed = Vector::new(direction.y, -direction.x, 0.0);
    let across = match lines {
        [false, false] => return None,
        [true, true] if crossed.norm_squared() > f64::EPSILON => crossed * crossed.dot(vector),
        [true, _] => Vector::new(vector.x, vector.y, 0.0),
        [false, true] => {
            let unit = vector.try_normalize(0.0)?;
            unit - direction * unit.dot(direction)
        }
    };
    across.try_normalize(0.0)
}
