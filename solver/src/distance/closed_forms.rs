//! Nearest points that need no search: a point and a simple set, two straight lines.

use crate::Vector;

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
pub fn nearest_on_segments(half_of_first: f64, centre: &Vector, direction: &Vector, half_of_second: f64) -> (Vector, Vector) {
    let at = |on_first: f64, on_second: f64| (Vector::new(0.0, 0.0, on_first), centre + direction * on_second);
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
