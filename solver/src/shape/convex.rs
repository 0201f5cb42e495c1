//! A convex shape, whatever its kind: the parts that bodies are glued from.

use std::sync::Arc;

use super::mass::MassProperties;
use super::{Cuboid, Cylinder, Polyhedron, Sphere, Spherocylinder, Superellipsoid};
use crate::Vector;

/// A convex shape, centred at its centre of mass.
#[derive(Debug, Clone, PartialEq)]
pub enum Convex {
    /// A ball.
    Sphere(Sphere),
    /// A rectangular box.
    Cuboid(Cuboid),
    /// A cylinder.
    Cylinder(Cylinder),
    /// A cylinder with round ends.
    Spherocylinder(Spherocylinder),
    /// A convex polyhedron.
    Polyhedron(Arc<Polyhedron>),
    /// A superellipsoid.
    Superellipsoid(Arc<Superellipsoid>),
}

impl Convex {
    /// Volume, centre and second moments.
    pub fn mass_properties(&self) -> MassProperties {
        match self {
            Convex::Sphere(sphere) => MassProperties::centred(sphere.volume(), sphere.mean_squares()),
            Convex::Cuboid(cuboid) => MassProperties::centred(cuboid.volume(), cuboid.mean_squares()),
            Convex::Cylinder(cylinder) => MassProperties::centred(cylinder.volume(), cylinder.mean_squares()),
            Convex::Spherocylinder(body) => MassProperties::centred(body.volume(), body.mean_squares()),
            Convex::Polyhedron(polyhedron) => *polyhedron.mass_properties(),
            Convex::Superellipsoid(shape) => MassProperties::centred(shape.volume(), shape.mean_squares()),
        }
    }

    /// Radius in m of the smallest ball about the centre that holds the shape.
    pub fn bounding_radius(&self) -> f64 {
        match self {
            Convex::Sphere(sphere) => sphere.radius,
            Convex::Cuboid(cuboid) => cuboid.half_lengths().norm(),
            Convex::Cylinder(cylinder) => cylinder.radius.hypot(0.5 * cylinder.length),
            Convex::Spherocylinder(body) => body.radius + 0.5 * body.length,
            Convex::Polyhedron(polyhedron) => polyhedron.bounding_radius(),
            Convex::Superellipsoid(shape) => shape.bounding_radius(),
        }
    }

    /// Radius in m of a ball about the centre that fits into the shape.
    pub fn inner_radius(&self) -> f64 {
        match self {
            Convex::Sphere(sphere) => sphere.radius,
            Convex::Cuboid(cuboid) => cuboid.half_lengths().min(),
            Convex::Cylinder(cylinder) => cylinder.radius.min(0.5 * cylinder.length),
            Convex::Spherocylinder(body) => body.radius,
            Convex::Polyhedron(polyhedron) => polyhedron.inner_radius(),
            Convex::Superellipsoid(shape) => shape.inner_radius(),
        }
    }

    /// Half the extent in m along the shape's own axes, measured from its centre: the smallest box about the centre that holds it.
    pub fn half_extent(&self) -> Vector {
        match self {
            Convex::Sphere(sphere) => Vector::repeat(sphere.radius),
            Convex::Cuboid(cuboid) => cuboid.half_lengths(),
            Convex::Cylinder(cylinder) => Vector::new(cylinder.radius, cylinder.radius, 0.5 * cylinder.length),
            Convex::Spherocylinder(body) => Vector::new(body.radius, body.radius, body.radius + 0.5 * body.length),
            Convex::Polyhedron(polyhedron) => {
                polyhedron.vertices().iter().fold(Vector::zeros(), |extent, vertex| extent.sup(&vertex.abs()))
            }
            Convex::Superellipsoid(shape) => *shape.semi_axes(),
        }
    }

    /// Whether a point, in the shape's own frame, lies inside or on the surface.
    #[inline]
    pub fn contains(&self, point: &Vector) -> bool {
        match self {
            Convex::Sphere(sphere) => point.norm_squared() <= sphere.radius * sphere.radius,
            Convex::Cuboid(cuboid) => point.abs() <= cuboid.half_lengths(),
            Convex::Cylinder(cylinder) => {
                point.z.abs() <= 0.5 * cylinder.length && point.x * point.x + point.y * point.y <= cylinder.radius * cylinder.radius
            }
            Convex::Spherocylinder(body) => {
                let beyond = (point.z.abs() - 0.5 * body.length).max(0.0);
                point.x * point.x + point.y * point.y + beyond * beyond <= body.radius * body.radius
            }
            Convex::Polyhedron(polyhedron) => polyhedron.contains(point),
            Convex::Superellipsoid(shape) => shape.contains(point),
        }
    }

    /// The word a scene file uses for it.
    pub fn name(&self) -> &'static str {
        match self {
            Convex::Sphere(_) => "sphere",
            Convex::Cuboid(_) => "cuboid",
            Convex::Cylinder(_) => "cylinder",
            Convex::Spherocylinder(_) => "spherocylinder",
            Convex::Polyhedron(_) => "polyhedron",
            Convex::Superellipsoid(_) => "superellipsoid",
        }
    }
}
