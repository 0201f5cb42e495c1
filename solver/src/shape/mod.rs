//! Shapes and their mass properties. One file per shape.
//!
//! A body's [`Shape`] is one convex part or several glued together (R section 2.2: glued convex; glued spheres are the same thing).

pub mod composites;
mod convex;
mod cuboid;
mod cylinder;
pub mod mass;
mod parry;
mod polyhedron;
mod sphere;
mod spherocylinder;
pub mod superellipsoid;

pub use convex::Convex;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use mass::MassProperties;
pub use mass::union::{MassMethod, mass_of_union};
pub use parry::ParryPair;
pub use polyhedron::{Polyhedron, PolyhedronError};
pub use sphere::Sphere;
pub use spherocylinder::Spherocylinder;
pub use superellipsoid::{Superellipsoid, SuperellipsoidError};

use crate::{Orientation, Vector};

/// A convex part in its place within a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// The shape of the part.
    pub convex: Convex,
    /// Its centre in the frame of the body, in m.
    pub position: Vector,
    /// From the frame of the part to the frame of the body.
    pub orientation: Orientation,
}

/// A rigid shape in its own frame: origin at the centre of mass, axes along the principal axes of inertia.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    name: &'static str,
    parts: Vec<Part>,
    volume: f64,
    specific_inertia: Vector,
    axes: Orientation,
    bounding_radius: f64,
}

impl Shape {
    /// A body of one convex part, which is centred at its centre of mass.
    pub fn of_one(convex: Convex) -> Shape {
        let name = convex.name();
        let part = Part { convex, position: Vector::zeros(), orientation: Orientation::identity() };
        Shape::glued(name, vec![part], |parts| parts[0].convex.mass_properties())
    }

    /// A body of several parts in the frame of whoever gives them; `mass_of` finds the mass properties of their union in the same frame. Parts are
    /// first put into an order of their own, so that nothing depends on the order in which they are given, not even by rounding.
    pub fn glued(name: &'static str, mut parts: Vec<Part>, mass_of: impl FnOnce(&[Part]) -> MassProperties) -> Shape {
        parts.sort_by(|left, right| key(left).partial_cmp(&key(right)).unwrap_or(std::cmp::Ordering::Equal));
        let properties = mass_of(&parts);
        let (specific_inertia, axes) = properties.principal();
        let to_body = axes.inverse();
        let placed = |part: Part| Part {
            position: to_body * (part.position - properties.centre),
            orientation: to_body * part.orientation,
            convex: part.convex,
        };
        let parts: Vec<Part> = parts.into_iter().map(placed).collect();
        let bounding_radius = parts.iter().map(|part| part.position.norm() + part.convex.bounding_radius()).fold(0.0, f64::max);
        Shape { name, parts, volume: properties.volume, specific_inertia, axes, bounding_radius }
    }

    /// The parts, in the frame of the body.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Volume in m^3.
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// Principal moments of inertia per unit mass, in m^2.
    pub fn specific_inertia(&self) -> Vector {
        self.specific_inertia
    }

    /// From the principal axes to the axes in which the shape was given.
    pub fn axes(&self) -> &Orientation {
        &self.axes
    }

    /// Radius in m of a ball about the centre of mass that holds the shape.
    pub fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }

    /// The ball that the shape is, if it is one.
    pub fn as_sphere(&self) -> Option<&Sphere> {
        match self.parts.as_slice() {
            [Part { convex: Convex::Sphere(sphere), position, .. }] if *position == Vector::zeros() => Some(sphere),
            _ => None,
        }
    }

    /// The word a scene file uses for it.
    pub fn name(&self) -> &'static str {
        self.name
    }
}

/// What parts are ordered by.
fn key(part: &Part) -> [f64; 8] {
    let (position, turn) = (part.position, part.orientation.coords);
    [position.x, position.y, position.z, turn.w, turn.x, turn.y, turn.z, part.convex.bounding_radius()]
}
