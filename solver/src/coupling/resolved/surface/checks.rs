//! What tests ask of any surface.

use super::Surface;
use crate::Vector;

/// Places about a surface, in and out of it, none of them special.
fn places(surface: &dyn Surface, count: usize) -> impl Iterator<Item = Vector> {
    let reach = 1.3 * surface.bounding_radius();
    // Multiples of the roots of a cubic equation fill a cube evenly.
    (1..=count).map(move |number| {
        let along = |step: f64| reach * (2.0 * (step * number as f64).fract() - 1.0);
        Vector::new(along(0.819_172_513), along(0.671_043_607), along(0.549_700_478))
    })
}

/// Holds feet against the nearest of points sampled so densely on the surface, which come from formulas of their own.
pub(in crate::coupling::resolved) fn assert_feet_are_nearest(surface: &dyn Surface, sampling: f64) {
    let samples = surface.points(sampling);
    let nearest = |point: &Vector| samples.iter().map(|sample| (sample - point).norm()).fold(f64::INFINITY, f64::min);
    for point in places(surface, 400) {
        let foot = surface.foot(&point);
        assert!((foot.normal.norm() - 1.0).abs() < 1e-12);
        let sampled = nearest(&point);
        assert!(foot.distance.abs() < sampled + 1e-9 && sampled < foot.distance.abs() + 0.9 * sampling, "{point} {foot:?} {sampled}");
        let touched = point - foot.normal * foot.distance;
        assert!(nearest(&touched) < 0.9 * sampling, "{point} {foot:?}");
    }
    for sample in &samples {
        assert!(surface.foot(sample).distance.abs() < 1e-12, "{sample}");
        assert!(sample.norm() < surface.bounding_radius() + 1e-12);
    }
}

/// Holds the volume where the distance is negative, summed over a fine grid, against the exact one.
pub(in crate::coupling::resolved) fn assert_volume_inside(surface: &dyn Surface, exact: f64) {
    let (cells, edge) = (120, 2.02 * surface.bounding_radius());
    let spacing = edge / f64::from(cells);
    let place = |number: i32| (f64::from(number) + 0.5) * spacing - 0.5 * edge;
    // Cells that the surface cuts count by the distance of their middle: all of the square of the spacing that is left is curvature.
    let mut sum = 0.0;
    for k in 0..cells {
        for j in 0..cells {
            for i in 0..cells {
                let distance = surface.foot(&Vector::new(place(i), place(j), place(k))).distance;
                sum += (0.5 - distance / spacing).clamp(0.0, 1.0);
            }
        }
    }
    let counted = sum * spacing.powi(3);
    assert!((counted / exact - 1.0).abs() < 2e-3, "{counted} {exact}");
}

/// No point has its nearest neighbour nearer than 0.8 or farther than 1.3 spacings, and no place of the surface is farther than that from a point.
pub(in crate::coupling::resolved) fn assert_points_are_spread(surface: &dyn Surface, spacing: f64) {
    let points = surface.points(spacing);
    for (number, point) in points.iter().enumerate() {
        let others = points.iter().enumerate().filter(|(other, _)| *other != number);
        let nearest = others.map(|(_, other)| (other - point).norm()).fold(f64::INFINITY, f64::min) / spacing;
        assert!((0.8..1.3).contains(&nearest), "{point} {nearest}");
    }
    for sample in surface.points(0.37 * spacing) {
        let nearest = points.iter().map(|point| (point - sample).norm()).fold(f64::INFINITY, f64::min) / spacing;
        assert!(nearest < 1.3, "{sample} {nearest}");
    }
}
