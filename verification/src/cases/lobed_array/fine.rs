//! Friction factors on grids finer than those of a tier, extrapolated: there is no closed form for these bodies.
//!
//! Means of the default constraint at one place of the body on each of four to eight grids. The uncertainty is their scatter, by which the places of edges
//! between values outweigh the trend.

use super::flows::{Course, Family, Shape};

/// Friction factor and its uncertainty at 21.6 % solid, if it was found.
pub fn friction(shape: Shape, family: Family, course: Course) -> Option<[f64; 2]> {
    Some(match (family, course, shape) {
        (Family::Short, Course::Along, Shape::Cylinder) => [6.840, 0.03],
        (Family::Short, Course::Along, Shape::Trilobe) => [6.519, 0.04],
        _ => return None,
    })
}
