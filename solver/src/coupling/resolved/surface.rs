//! Surfaces of bodies as a flow needs them: signed distance and normal of the nearest point.

#[cfg(test)]
mod checks;
mod cuboid;
pub mod lobes;
pub mod outline;
mod polyhedron;
pub mod prism;
pub mod spheroid;

use std::f64::consts::PI;
use std::sync::Arc;

use crate::{Orientation, Vector};

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

    /// Length in m along its own z axis after which it goes on as its image in a box of that length; `None` for a body with ends.
    fn joined_length(&self) -> Option<f64> {
        None
    }

    /// Points spread over the surface about so many m from their nearest neighbours (R section 7.3.4).
    fn points(&self, spacing: f64) -> Vec<Vector>;
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

    /// A spiral of golden angles, as many as triangles of that edge would have corners.
    fn points(&self, spacing: f64) -> Vec<Vector> {
        let count = (4.0 * PI * self.radius.powi(2) / (0.75_f64.sqrt() * spacing * spacing)).round().max(4.0);
        let golden = PI * (3.0 - 5.0_f64.sqrt());
        let point = |number: usize| {
            let height = 1.0 - (2 * number + 1) as f64 / count;
            let (sine, cosine) = (golden * number as f64).sin_cos();
            let across = (1.0 - height * height).sqrt();
            Vector::new(across * cosine, across * sine, height) * self.radius
        };
        (0..count as usize).map(point).collect()
    }
}

/// A surface in other axes of its body.
pub struct Turned {
    /// In its own axes.
    pub surface: Arc<dyn Surface>,
    /// From its own axes to those of the body.
    pub orientation: Orientation,
}

impl Surface for Turned {
    fn foot(&self, point: &Vector) -> Foot {
        let foot = self.surface.foot(&(self.orientation.inverse() * point));
        Foot { normal: self.orientation * foot.normal, ..foot }
    }

    fn bounding_radius(&self) -> f64 {
        self.surface.bounding_radius()
    }

    fn points(&self, spacing: f64) -> Vec<Vector> {
        self.surface.points(spacing).into_iter().map(|point| self.orientation * point).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_a_sphere_are_evenly_spread() {
        let ball = Ball { radius: 1.5 };
        let spacing = 0.2;
        let points = ball.points(spacing);
        let nearest = |point: &Vector| {
            let others = points.iter().filter(|other| *other != point);
            others.map(|other| (other - point).norm()).fold(f64::INFINITY, f64::min)
        };
        for point in &points {
            assert!((point.norm() - 1.5).abs() < 1e-14);
            assert!((0.8..1.1).contains(&(nearest(point) / spacing)), "{}", nearest(point) / spacing);
        }
    }
}
