//! An order of two placed sets that does not depend on which of them is called the first.
//!
//! A search begins somewhere and rounds on its way. Begun in an order of the sets' own, it goes the same way whichever of both is named first, and the
//! two answers mirror each other to the bit.

use std::cmp::Ordering;

use super::Pose;
use super::core::Core;

/// Whether the first of two sets comes after the second: by kind, place, turn and, last, size. Sets that agree in all of it are equal.
#[inline]
pub fn is_after(first: (&Core, &Pose), second: (&Core, &Pose)) -> bool {
    let (one, other) = ((kind(first.0), first.1.position.x), (kind(second.0), second.1.position.x));
    if one == other { is_after_by_all(first, second) } else { one > other }
}

#[cold]
fn is_after_by_all(first: (&Core, &Pose), second: (&Core, &Pose)) -> bool {
    let by_place = compare(first.1.position.iter(), second.1.position.iter());
    let by_turn = || compare(first.1.rotation.iter(), second.1.rotation.iter());
    by_place.then_with(by_turn).then_with(|| by_size(first.0, second.0)) == Ordering::Greater
}

fn kind(core: &Core) -> u8 {
    match core {
        Core::Point => 0,
        Core::Segment { .. } => 1,
        Core::Box { .. } => 2,
        Core::Cylinder { .. } => 3,
        Core::Polyhedron(_) => 4,
        Core::Superellipsoid(_) => 5,
        Core::Polygon(_) => 6,
    }
}

fn compare<'a>(first: impl Iterator<Item = &'a f64>, second: impl Iterator<Item = &'a f64>) -> Ordering {
    first.zip(second).map(|(one, other)| one.total_cmp(other)).find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
}

fn by_size(first: &Core, second: &Core) -> Ordering {
    match (first, second) {
        (Core::Box { half_lengths: one }, Core::Box { half_lengths: other }) => compare(one.iter(), other.iter()),
        (Core::Cylinder { radius: one, .. }, Core::Cylinder { radius: other, .. }) if one != other => one.total_cmp(other),
        (Core::Polyhedron(one), Core::Polyhedron(other)) => compare(one.vertices().iter().flatten(), other.vertices().iter().flatten()),
        (Core::Polygon(one), Core::Polygon(other)) => compare(one.corners().iter().flatten(), other.corners().iter().flatten()),
        (Core::Superellipsoid(one), Core::Superellipsoid(other)) => {
            compare(one.semi_axes().iter().chain(&one.exponents()), other.semi_axes().iter().chain(&other.exponents()))
        }
        _ => first.reach().total_cmp(&second.reach()),
    }
}
