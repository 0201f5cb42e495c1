//! Closed curves in the plane across a prism.

use std::f64::consts::TAU;

/// A point or a direction in the plane across a prism, in m.
pub type PlanePoint = nalgebra::Vector2<f64>;

/// The nearest point of an outline, seen from a point of its plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneFoot {
    /// Distance to the outline in m, negative inside.
    pub distance: f64,
    /// Outward unit normal at the nearest point; from the point to it where that is a corner.
    pub normal: PlanePoint,
}

/// A closed curve about the origin.
pub trait Outline: Send + Sync {
    /// The nearest point of the outline.
    fn foot(&self, point: &PlanePoint) -> PlaneFoot;

    /// Radius in m of a disc about the origin that holds it.
    fn bounding_radius(&self) -> f64;

    /// What it encloses, in m^2.
    fn area(&self) -> f64;

    /// Points along it about so many m from their nearest neighbours, its corners among them.
    fn points(&self, spacing: f64) -> Vec<PlanePoint>;
}

/// A circle about the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle {
    /// In m.
    pub radius: f64,
}

impl Outline for Circle {
    fn foot(&self, point: &PlanePoint) -> PlaneFoot {
        let distance = point.norm();
        // The centre is as far from all of the circle.
        let normal = if distance > 0.0 { point / distance } else { PlanePoint::x() };
        PlaneFoot { distance: distance - self.radius, normal }
    }

    fn bounding_radius(&self) -> f64 {
        self.radius
    }

    fn area(&self) -> f64 {
        0.5 * TAU * self.radius * self.radius
    }

    fn points(&self, spacing: f64) -> Vec<PlanePoint> {
        let count = intervals(TAU * self.radius, spacing).max(3);
        let at = |number: usize| {
            let (sine, cosine) = (TAU * number as f64 / count as f64).sin_cos();
            PlanePoint::new(cosine, sine) * self.radius
        };
        (0..count).map(at).collect()
    }
}

/// Equal parts of a length, each as near to a spacing as that allows; at least one.
pub(super) fn intervals(length: f64, spacing: f64) -> usize {
    (length / spacing).round().max(1.0) as usize
}

/// The corners of triangles of an edge length that tile a disc about the origin.
pub(super) fn triangular_lattice(spacing: f64, radius: f64) -> impl Iterator<Item = PlanePoint> {
    let height = 0.75_f64.sqrt() * spacing;
    let (rows, columns) = ((radius / height).ceil() as isize, (radius / spacing).ceil() as isize + 1);
    let row = move |row: isize| {
        let shift = 0.5 * row.rem_euclid(2) as f64;
        (-columns..=columns).map(move |column| PlanePoint::new((column as f64 + shift) * spacing, row as f64 * height))
    };
    (-rows..=rows).flat_map(row).filter(move |point| point.norm() <= radius)
}

/// Points inside an outline keep that share of a spacing from those on it.
pub(super) const INSET: f64 = 0.85;
