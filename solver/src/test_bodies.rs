//! Bodies for unit tests.

use std::sync::Arc;

use crate::bodies::BodySpecification;
use crate::shape::{Convex, Shape};
use crate::{Orientation, Vector};

/// A body of one convex part and of a mass in kg, at rest at the origin.
pub(crate) fn at_rest(convex: Convex, mass: f64) -> BodySpecification {
    let shape = Arc::new(Shape::of_one(convex));
    BodySpecification {
        id: 0,
        inertia: shape.specific_inertia() * mass,
        shape,
        material: 0,
        mass,
        position: Vector::zeros(),
        velocity: Vector::zeros(),
        orientation: Orientation::identity(),
        angular_velocity: Vector::zeros(),
    }
}
