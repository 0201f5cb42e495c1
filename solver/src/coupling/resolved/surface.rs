//! Surfaces of bodies as a flow needs them: signed distance and normal of the nearest point.

use crate::Vector;

/// The nearest point of a surface, seen from a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foot {
    /// Distance to the surface in m, negative inside the body.
    pub distance: f64,
    /// Outward unit normal at the nearest point.
    pub normal: Vector,
}

/// A closed surface in the frame of its body.
pub trait Surface: Send + Sync {
    /// The nearest point of the surface.
    fn foot(&self, point: &Vector) -> Foot;

    /// Radius in m of a ball about the origin that holds the body.
    fn bounding_radius(&self) -> f64;
}

/// A sphere about the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    /// In m.
    pub radius: f64,
}

impl Surface for Ball {
    fn foot(&self, point: &Vector) -> Foot {
        let distance = point.norm();
        // The centre is as far from all of the surface.
        let normal = if distance > 0.0 { point / distance } else { Vector::z() };
        Foot { distance: distance - self.radius, normal }
    }

    fn bounding_radius(&self) -> f64 {
        self.radius
    }
}
