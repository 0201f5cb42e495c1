//! Outlines of lobed prisms: equal discs in a ring and the polygon of their centres, which fills the gap between them (R section 7.3.4, figure 7.3).

use std::f64::consts::PI;

use super::outline::{INSET, Outline, PlaneFoot, PlanePoint, intervals};

/// A ring of lobes that touch or overlap their neighbours; the first lies on the x axis.
///
/// R tells neither the radius of its lobes nor their overlap. Its bodies of equal volume and length (table 7.1) fill 71.1 % (trilobe) and 74.3 %
/// (quadralobe) of their circumscribed cylinders, and its text tells 69 % and 74 % (section 4.2.4); lobes that just touch fill 65.7 % and 73.3 %.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lobes {
    count: usize,
    radius: f64,
    /// Of the lobes' centres from the axis, in m.
    distance: f64,
    /// Where a lobe meets the next one, in m from the axis.
    groove: f64,
    /// Half the angle between neighbours.
    half_angle: f64,
}

/// Why lobes make no outline.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum LobesError {
    /// No ring.
    #[error("a ring needs at least 3 lobes, not {0}")]
    TooFew(usize),
    /// Not a length.
    #[error("a length of {0} m; lobes need a positive radius and distance")]
    Length(f64),
    /// The polygon of centres would show between them.
    #[error("lobes of radius {radius} m whose neighbours are {apart} m apart do not touch; the radius must be at least half of that")]
    Apart {
        /// Of a lobe, in m.
        radius: f64,
        /// Of the centres of neighbours, in m.
        apart: f64,
    },
    /// One disc holds all.
    #[error("lobes of radius {radius} m at {distance} m from the axis hold each other's centres: the outline has no lobes")]
    Merged {
        /// Of a lobe, in m.
        radius: f64,
        /// Of its centre from the axis, in m.
        distance: f64,
    },
}

impl Lobes {
    /// Lobes of a radius whose centres lie at a distance from the axis, in m.
    ///
    /// # Errors
    ///
    /// [`LobesError`] if they do not touch their neighbours, or hide them.
    pub fn new(count: usize, radius: f64, distance: f64) -> Result<Lobes, LobesError> {
        if count < 3 {
            return Err(LobesError::TooFew(count));
        }
        if let Some(length) = [radius, distance].into_iter().find(|length| !(length.is_finite() && *length > 0.0)) {
            return Err(LobesError::Length(length));
        }
        let half_angle = PI / count as f64;
        let half_apart = distance * half_angle.sin();
        // Lobes that touch do so to rounding.
        let over = if radius >= half_apart { radius * radius - half_apart * half_apart } else { 0.0 };
        if radius < half_apart * (1.0 - 1e-12) {
            return Err(LobesError::Apart { radius, apart: 2.0 * half_apart });
        }
        if radius >= 2.0 * half_apart {
            return Err(LobesError::Merged { radius, distance });
        }
        Ok(Lobes { count, radius, distance, groove: distance * half_angle.cos() + over.sqrt(), half_angle })
    }

    /// Lobes that just touch, within a circumscribed circle of a diameter in m.
    ///
    /// # Errors
    ///
    /// [`LobesError`] for fewer than three of them or a diameter that is no length.
    pub fn touching(count: usize, diameter: f64) -> Result<Lobes, LobesError> {
        let sine = (PI / count.max(1) as f64).sin();
        let radius = 0.5 * diameter / (1.0 + 1.0 / sine);
        Lobes::new(count, radius, radius / sine)
    }

    /// Diameter in m of the circle around all lobes.
    pub fn diameter(&self) -> f64 {
        2.0 * (self.distance + self.radius)
    }

    /// Length in m of the outline.
    pub fn perimeter(&self) -> f64 {
        2.0 * self.count as f64 * self.half_arc() * self.radius
    }

    /// The groove beside the first lobe, at positive y.
    fn corner(&self) -> PlanePoint {
        PlanePoint::new(self.half_angle.cos(), self.half_angle.sin()) * self.groove
    }

    /// Half the angle of a lobe's arc, seen from its centre.
    fn half_arc(&self) -> f64 {
        let corner = self.corner();
        corner.y.atan2(corner.x - self.distance)
    }

    /// The nearest point of the part of the first lobe's arc at positive y, from a point of that sector.
    fn foot_in_sector(&self, point: &PlanePoint) -> PlaneFoot {
        let from_centre = PlanePoint::new(point.x - self.distance, point.y);
        let apart = from_centre.norm();
        let in_core = point.x * self.half_angle.cos() + point.y * self.half_angle.sin() < self.distance * self.half_angle.cos();
        let is_inside = apart < self.radius || in_core;
        // From outside the arc is seen from everywhere, from inside only from within its own angle.
        if !is_inside || from_centre.y.atan2(from_centre.x) <= self.half_arc() {
            let normal = if apart > 0.0 { from_centre / apart } else { PlanePoint::x() };
            return PlaneFoot { distance: apart - self.radius, normal };
        }
        let to_corner = self.corner() - point;
        let distance = to_corner.norm();
        let normal = if distance > 0.0 { to_corner / distance } else { self.corner() / self.groove };
        PlaneFoot { distance: -distance, normal }
    }
}

impl Outline for Lobes {
    /// The outline repeats with each lobe and is the same on its both sides, so the nearest point lies in the half sector of the point itself.
    fn foot(&self, point: &PlanePoint) -> PlaneFoot {
        let sector = (point.y.atan2(point.x) / (2.0 * self.half_angle)).round();
        let turn = nalgebra::Rotation2::new(2.0 * self.half_angle * sector);
        let mut turned = turn.inverse() * point;
        let side = if turned.y < 0.0 { -1.0 } else { 1.0 };
        turned.y *= side;
        let mut foot = self.foot_in_sector(&turned);
        foot.normal.y *= side;
        PlaneFoot { normal: turn * foot.normal, ..foot }
    }

    fn bounding_radius(&self) -> f64 {
        self.distance + self.radius
    }

    /// In each half sector: the triangle of the axis, a centre and the middle between neighbours, the one from there to the groove, and the arc's sector.
    fn area(&self) -> f64 {
        let (sine, cosine) = self.half_angle.sin_cos();
        let (half_apart, height) = (self.distance * sine, self.distance * cosine);
        let half_sector = 0.5 * half_apart * (height + (self.groove - height)) + 0.5 * self.radius * self.radius * self.half_arc();
        2.0 * self.count as f64 * half_sector
    }

    /// Even parts of each arc, from groove to groove. In a groove the two arcs come near each other; there one of two points does for both.
    fn points(&self, spacing: f64) -> Vec<PlanePoint> {
        let parts = intervals(2.0 * self.half_arc() * self.radius, spacing).max(3);
        let angle = |part: usize| self.half_arc() * (2.0 * part as f64 / parts as f64 - 1.0);
        let on_arc =
            |part: usize| PlanePoint::new(self.distance, 0.0) + PlanePoint::new(angle(part).cos(), angle(part).sin()) * self.radius;
        // Distance from the mirror image in the plane of the groove that the arc ends in.
        let from_image = |point: &PlanePoint| 2.0 * (point.x * self.half_angle.sin() - point.y * self.half_angle.cos()).abs();
        let is_kept = |part: &usize| 2 * part <= parts || from_image(&on_arc(*part)) >= INSET * spacing;
        let arc: Vec<PlanePoint> = (0..parts).filter(is_kept).map(on_arc).collect();
        let turned = |lobe: usize| nalgebra::Rotation2::new(2.0 * self.half_angle * lobe as f64);
        (0..self.count).flat_map(|lobe| arc.iter().map(move |point| turned(lobe) * point)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coupling::resolved::surface::Surface;
    use crate::coupling::resolved::surface::checks::{assert_feet_are_nearest, assert_points_are_spread, assert_volume_inside};
    use crate::coupling::resolved::surface::prism::Prism;

    fn outlines() -> [Lobes; 4] {
        let of = |lobes: Result<Lobes, LobesError>| lobes.expect("lobes that touch");
        [of(Lobes::touching(3, 1.0)), of(Lobes::touching(4, 1.1)), of(Lobes::new(3, 0.26, 0.27)), of(Lobes::new(5, 0.3, 0.4))]
    }

    #[test]
    fn feet_are_the_nearest_points_of_the_union() {
        for outline in outlines() {
            assert_feet_are_nearest(&Prism::closed(outline, 0.9), 0.01);
        }
    }

    /// The polygon through points of the outline is shorter by the square of their spacing over the radius.
    #[test]
    fn the_perimeter_is_that_of_the_polygon_through_its_points() {
        for outline in outlines() {
            let points = outline.points(0.003);
            let sides = (0..points.len()).map(|place| (points[(place + 1) % points.len()] - points[place]).norm());
            assert!((sides.sum::<f64>() / outline.perimeter() - 1.0).abs() < 2e-3, "{outline:?}");
        }
        let touching = Lobes::touching(3, 2.0).expect("lobes");
        assert!((touching.perimeter() / (5.0 * PI * touching.radius) - 1.0).abs() < 1e-14);
    }

    /// The union counted from discs and polygon, which the distance knows nothing of.
    #[test]
    fn inside_is_the_union_of_discs_and_polygon() {
        for lobes in outlines() {
            let centre = |lobe: usize| {
                let (sine, cosine) = (2.0 * lobes.half_angle * lobe as f64).sin_cos();
                PlanePoint::new(cosine, sine) * lobes.distance
            };
            let is_in_union = |point: &PlanePoint| {
                (0..lobes.count).any(|lobe| (point - centre(lobe)).norm() < lobes.radius)
                    || (0..lobes.count).all(|lobe| (centre(lobe + 1) - centre(lobe)).perp(&(point - centre(lobe))) > 0.0)
            };
            let (cells, edge) = (400, lobes.diameter());
            let place = |number: usize| ((number as f64 + 0.5) / cells as f64 - 0.5) * edge;
            let points = (0..cells).flat_map(|row| (0..cells).map(move |column| (row, column)));
            let mut count = 0;
            for (row, column) in points {
                let point = PlanePoint::new(place(row), place(column));
                let distance = lobes.foot(&point).distance;
                assert!(is_in_union(&point) == (distance < 0.0) || distance.abs() < 1e-12, "{point}");
                count += usize::from(distance < 0.0);
            }
            let counted = count as f64 * (edge / cells as f64).powi(2);
            assert!((counted / lobes.area() - 1.0).abs() < 2e-3, "{counted} {}", lobes.area());
        }
    }

    /// By sectors of discs: (5/2 pi + sqrt 3) r^2 and (3 pi + 4) r^2.
    #[test]
    fn touching_lobes_have_the_area_of_their_sectors() {
        let [three, four] = [3, 4].map(|count| Lobes::touching(count, 1.0).expect("lobes that touch"));
        assert!((three.area() - (2.5 * PI + 3.0_f64.sqrt()) * three.radius.powi(2)).abs() < 1e-15);
        assert!((four.area() - (3.0 * PI + 4.0) * four.radius.powi(2)).abs() < 1e-15);
        assert!((three.diameter() - 1.0).abs() < 1e-15);
        let share = |lobes: &Lobes| lobes.area() / (PI / 4.0);
        assert!((share(&three) - 0.657).abs() < 1e-3 && (share(&four) - 0.733).abs() < 1e-3);
        assert_volume_inside(&Prism::closed(three, 0.7), 0.7 * three.area());
    }

    #[test]
    fn points_are_spread_evenly_with_the_grooves_among_them() {
        for outline in outlines() {
            let prism = Prism::closed(outline, 1.1);
            for spacing in [0.1, 0.047] {
                assert_points_are_spread(&prism, spacing);
                let corner = prism.outline.corner();
                assert!(prism.points(spacing).iter().any(|point| (point.xy() - corner).norm() < 1e-12));
            }
        }
    }

    #[test]
    fn rings_without_an_outline_are_refused() {
        assert_eq!(Lobes::touching(2, 1.0), Err(LobesError::TooFew(2)));
        assert!(matches!(Lobes::touching(3, f64::NAN), Err(LobesError::Length(_))));
        assert!(matches!(Lobes::touching(3, -1.0), Err(LobesError::Length(_))));
        assert!(matches!(Lobes::new(3, 0.1, 0.2), Err(LobesError::Apart { .. })));
        assert!(matches!(Lobes::new(4, 0.3, 0.2), Err(LobesError::Merged { .. })));
    }
}
