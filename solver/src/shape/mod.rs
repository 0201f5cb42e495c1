//! Shapes and their mass properties. One file per shape.

mod cuboid;
mod sphere;

pub use cuboid::Cuboid;
pub use sphere::Sphere;

use crate::Vector;

/// A rigid shape, in its own frame: origin at the centre of mass, axes along the principal axes of inertia.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A ball.
    Sphere(Sphere),
    /// A rectangular box.
    Cuboid(Cuboid),
}

impl Shape {
    /// Volume in m^3.
    pub fn volume(&self) -> f64 {
        match self {
            Shape::Sphere(sphere) => sphere.volume(),
            Shape::Cuboid(cuboid) => cuboid.volume(),
        }
    }

    /// Principal moments of inertia per unit mass, in m^2.
    pub fn specific_inertia(&self) -> Vector {
        match self {
            Shape::Sphere(sphere) => sphere.specific_inertia(),
            Shape::Cuboid(cuboid) => cuboid.specific_inertia(),
        }
    }

    /// Radius in m of the smallest ball about the centre of mass that holds the shape.
    pub fn bounding_radius(&self) -> f64 {
        match self {
            Shape::Sphere(sphere) => sphere.radius,
            Shape::Cuboid(cuboid) => cuboid.half_lengths().norm(),
        }
    }

    /// The word a scene file uses for it.
    pub fn name(&self) -> &'static str {
        match self {
            Shape::Sphere(_) => "sphere",
            Shape::Cuboid(_) => "cuboid",
        }
    }
}
