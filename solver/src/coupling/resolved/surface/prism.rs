//! Prisms: an outline drawn along z.

use super::outline::{INSET, Outline, PlaneFoot, triangular_lattice};
use super::{Foot, Surface};
use crate::Vector;
use crate::coupling::resolved::surface::outline::intervals;

/// How a prism ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// Flat, at right angles to its axis.
    Closed,
    /// In its own images: a body without ends in a box that is as long as itself.
    Joined,
}

/// An outline drawn along z, its middle at the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prism<Across> {
    /// Outline across the axis.
    pub outline: Across,
    /// In m.
    pub length: f64,
    /// How it ends.
    pub ends: Ends,
}

impl<Across: Outline> Prism<Across> {
    /// A prism with flat ends.
    pub fn closed(outline: Across, length: f64) -> Prism<Across> {
        Prism { outline, length, ends: Ends::Closed }
    }

    /// A prism that goes on for ever in a box of that length.
    pub fn joined(outline: Across, length: f64) -> Prism<Across> {
        Prism { outline, length, ends: Ends::Joined }
    }

    /// In m^3, of one box if it has no ends.
    pub fn volume(&self) -> f64 {
        self.outline.area() * self.length
    }
}

impl<Across: Outline> Surface for Prism<Across> {
    fn foot(&self, point: &Vector) -> Foot {
        let PlaneFoot { distance: across, normal } = self.outline.foot(&point.xy());
        let normal = Vector::new(normal.x, normal.y, 0.0);
        let end = Vector::z() * point.z.signum();
        let beyond = if self.ends == Ends::Closed { point.z.abs() - 0.5 * self.length } else { f64::NEG_INFINITY };
        if across > 0.0 && beyond > 0.0 {
            let distance = across.hypot(beyond);
            return Foot { distance, normal: (normal * across + end * beyond) / distance };
        }
        if across >= beyond { Foot { distance: across, normal } } else { Foot { distance: beyond, normal: end } }
    }

    fn bounding_radius(&self) -> f64 {
        self.outline.bounding_radius().hypot(0.5 * self.length)
    }

    fn joined_length(&self) -> Option<f64> {
        (self.ends == Ends::Joined).then_some(self.length)
    }

    /// The outline in slices, and on flat ends a lattice of triangles within it. R lays rings on the ends of cylinders and lattices on those of the
    /// polyhedra between lobes; one lattice inside the whole outline is as even and needs no merging.
    fn points(&self, spacing: f64) -> Vec<Vector> {
        let slices = intervals(self.length, spacing);
        let height = |slice: usize| self.length * (slice as f64 / slices as f64 - 0.5);
        let is_closed = self.ends == Ends::Closed;
        let around = self.outline.points(spacing);
        let slice = |slice: usize| around.iter().map(move |point| Vector::new(point.x, point.y, height(slice)));
        let mut points: Vec<Vector> = (0..slices + usize::from(is_closed)).flat_map(slice).collect();
        if is_closed {
            let is_within = |point: &super::outline::PlanePoint| self.outline.foot(point).distance <= -INSET * spacing;
            for point in triangular_lattice(spacing, self.outline.bounding_radius()).filter(is_within) {
                points.extend([0, slices].map(|slice| Vector::new(point.x, point.y, height(slice))));
            }
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::coupling::resolved::surface::checks::{assert_feet_are_nearest, assert_points_are_spread, assert_volume_inside};
    use crate::coupling::resolved::surface::outline::Circle;

    fn cylinder() -> Prism<Circle> {
        Prism::closed(Circle { radius: 0.4 }, 1.1)
    }

    #[test]
    fn feet_on_a_cylinder_are_nearest() {
        assert_feet_are_nearest(&cylinder(), 0.01);
        assert_volume_inside(&cylinder(), PI * 0.16 * 1.1);
        // Beyond the rim.
        let foot = cylinder().foot(&Vector::new(0.7, 0.0, -0.95));
        assert!((foot.distance - 0.5).abs() < 1e-15 && (foot.normal - Vector::new(0.6, 0.0, -0.8)).norm() < 1e-15);
    }

    #[test]
    fn points_of_a_cylinder_are_evenly_spread() {
        for spacing in [0.12, 0.07, 0.04] {
            assert_points_are_spread(&cylinder(), spacing);
        }
    }

    #[test]
    fn a_joined_prism_has_no_ends() {
        let joined = Prism::joined(Circle { radius: 0.4 }, 1.1);
        let foot = joined.foot(&Vector::new(0.1, 0.0, 5.0));
        assert!((foot.distance + 0.3).abs() < 1e-15 && foot.normal == Vector::x());
        assert_eq!((joined.joined_length(), cylinder().joined_length()), (Some(1.1), None));
        // Eleven slices at tenths: the last of them is as far from the next image as from the one before.
        let heights: Vec<f64> = joined.points(0.1).iter().map(|point| point.z).collect();
        let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        assert!((highest - 0.45).abs() < 1e-12, "{highest}");
    }
}
