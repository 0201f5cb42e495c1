//! The wall of a cylinder: a vessel round bodies, a tube, or a rod among them.

use nalgebra::Matrix3;

use super::{PlacedPiece, SphereTouch};
use crate::Vector;
use crate::distance::{Core, Pose, RoundedCore};

/// On which side of a cylinder bodies are.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// Bodies are inside: a vessel; of finite length an open tube, which bodies outside touch too.
    #[default]
    Inside,
    /// Bodies are outside: a rod; of finite length with flat ends.
    Outside,
}

/// A cylindrical wall.
#[derive(Debug, Clone, PartialEq)]
pub struct Cylinder {
    /// Middle of the axis, in m; any point of it if the cylinder is infinite.
    pub centre: Vector,
    /// Unit vector along the axis.
    pub axis: Vector,
    /// Radius in m.
    pub radius: f64,
    /// Half the length in m; infinite for a cylinder without ends.
    pub half_length: f64,
    /// Where bodies are.
    pub side: Side,
}

/// A point as a cylinder sees it.
struct Place {
    /// Along the axis from the middle, in m.
    along: f64,
    /// From the axis, in m.
    across: f64,
    /// Unit vector away from the axis; a choice on the axis.
    outwards: Vector,
    is_on_axis: bool,
}

/// Distance from a wall, and the unit vector towards it.
struct Nearest {
    distance: f64,
    direction: Vector,
    is_a_choice: bool,
}

impl Cylinder {
    /// Distance in m of a point from the wall; negative inside a solid one.
    pub fn distance(&self, point: &Vector) -> f64 {
        self.nearest(point).distance
    }

    /// Contact of a ball; `None` if they do not overlap. The nearest point is the only one unless the ball is larger than the vessel.
    #[inline]
    pub fn touch_sphere(&self, position: &Vector, radius: f64) -> Option<SphereTouch> {
        let found = self.nearest(position);
        let touch = SphereTouch::at(found.distance, found.direction, radius)?;
        Some(SphereTouch { is_deep: found.is_a_choice, ..touch })
    }

    /// A rod as a convex set, for bodies of any shape; of an infinite one the piece within reach of a point, in m. `None` for a vessel, which is not convex.
    pub fn as_core_near(&self, point: &Vector, reach: f64) -> Option<PlacedPiece> {
        if self.side == Side::Inside {
            return None;
        }
        let is_finite = self.half_length.is_finite();
        let half_length = if is_finite { self.half_length } else { reach };
        let along = if is_finite { 0.0 } else { (point - self.centre).dot(&self.axis) };
        let across = any_across(&self.axis);
        let rotation = Matrix3::from_columns(&[across, self.axis.cross(&across), self.axis]);
        let rounded = RoundedCore { core: Core::Cylinder { radius: self.radius, half_length }, radius: 0.0 };
        Some(PlacedPiece { rounded, pose: Pose { position: self.centre + self.axis * along, rotation }, number: 0 })
    }

    /// From the axis to a point, in m, and its length.
    #[inline]
    pub fn radial(&self, point: &Vector) -> (Vector, f64) {
        let place = self.place(point);
        (place.outwards * place.across, place.across)
    }

    #[inline]
    fn place(&self, point: &Vector) -> Place {
        let from_centre = point - self.centre;
        let along = from_centre.dot(&self.axis);
        let radial = from_centre - self.axis * along;
        // Once more, so that what rounding has left along a long axis is gone.
        let radial = radial - self.axis * radial.dot(&self.axis);
        let across = radial.norm();
        let is_on_axis = across == 0.0;
        let outwards = if is_on_axis { any_across(&self.axis) } else { radial / across };
        Place { along, across, outwards, is_on_axis }
    }

    #[inline]
    fn nearest(&self, point: &Vector) -> Nearest {
        let place = self.place(point);
        match self.side {
            Side::Inside if self.half_length == f64::INFINITY => {
                Nearest { distance: self.radius - place.across, direction: place.outwards, is_a_choice: place.is_on_axis }
            }
            Side::Inside => self.nearest_on_tube(&place),
            Side::Outside => self.nearest_on_rod(&place),
        }
    }

    /// Of an open tube without thickness: its side, or the rims beyond its ends.
    fn nearest_on_tube(&self, place: &Place) -> Nearest {
        let beyond = place.along - place.along.clamp(-self.half_length, self.half_length);
        let outwards = self.radius - place.across;
        if beyond == 0.0 {
            let direction = if outwards >= 0.0 { place.outwards } else { -place.outwards };
            return Nearest { distance: outwards.abs(), direction, is_a_choice: place.is_on_axis || outwards == 0.0 };
        }
        let distance = outwards.hypot(beyond);
        Nearest { distance, direction: (place.outwards * outwards - self.axis * beyond) / distance, is_a_choice: place.is_on_axis }
    }

    /// Of a solid rod with flat ends.
    fn nearest_on_rod(&self, place: &Place) -> Nearest {
        let above_side = place.across - self.radius;
        let above_end = place.along.abs() - self.half_length;
        let towards_end = self.axis * -1.0_f64.copysign(place.along);
        if above_end <= 0.0 {
            // Inside or beside: the nearer surface.
            if above_side >= above_end {
                return Nearest { distance: above_side, direction: -place.outwards, is_a_choice: place.is_on_axis };
            }
            return Nearest { distance: above_end, direction: towards_end, is_a_choice: false };
        }
        if above_side <= 0.0 {
            return Nearest { distance: above_end, direction: towards_end, is_a_choice: false };
        }
        let distance = above_side.hypot(above_end);
        let direction = (towards_end * above_end - place.outwards * above_side) / distance;
        Nearest { distance, direction, is_a_choice: false }
    }
}

/// A unit vector at right angles to an axis.
fn any_across(axis: &Vector) -> Vector {
    axis.cross(&Vector::ith(axis.iamin(), 1.0)).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cylinder(side: Side, half_length: f64) -> Cylinder {
        Cylinder { centre: Vector::new(1.0, 2.0, 3.0), axis: Vector::new(0.6, 0.0, 0.8), radius: 2.0, half_length, side }
    }

    /// A point by its coordinates along the axis and across it.
    fn at(cylinder: &Cylinder, along: f64, across: [f64; 2]) -> Vector {
        cylinder.centre + cylinder.axis * along + Vector::new(0.8, 0.0, -0.6) * across[0] + Vector::y() * across[1]
    }

    const ROUNDING: f64 = 16.0 * f64::EPSILON;

    #[test]
    fn a_ball_in_a_vessel_touches_it_at_its_side() {
        let vessel = cylinder(Side::Inside, f64::INFINITY);
        // 3-4-5: 1.5 m off the axis.
        let ball = at(&vessel, 7.0, [0.9, 1.2]);
        let outwards = Vector::new(0.8, 0.0, -0.6) * 0.6 + Vector::y() * 0.8;
        let touch = vessel.touch_sphere(&ball, 0.75).unwrap();
        assert!((touch.overlap - 0.25).abs() < ROUNDING && (touch.normal - outwards).norm() < ROUNDING && !touch.is_deep);
        assert!((touch.arm - outwards * 0.625).norm() < ROUNDING);
        assert_eq!(vessel.touch_sphere(&ball, 0.5 - ROUNDING), None);
        // However far through the wall, it is pushed back inside.
        let out = vessel.touch_sphere(&at(&vessel, 0.0, [0.0, 5.0]), 1.0).unwrap();
        assert!((out.overlap - 4.0).abs() < ROUNDING && (out.normal - Vector::y()).norm() < ROUNDING);
    }

    /// On the axis every direction across it is as good: the overlap is that of the radii, the normal some unit vector across.
    #[test]
    fn on_the_axis_the_overlap_is_the_difference_of_the_radii() {
        let vessel = cylinder(Side::Inside, f64::INFINITY);
        assert_eq!(vessel.touch_sphere(&vessel.centre, 2.0), None);
        let touch = vessel.touch_sphere(&vessel.centre, 2.5).unwrap();
        assert!(touch.is_deep && touch.overlap == 0.5 && touch.normal.dot(&vessel.axis).abs() < ROUNDING);
        assert!((touch.normal.norm() - 1.0).abs() < ROUNDING);
        // A hair off the axis the normal is the direction of the hair.
        let touch = vessel.touch_sphere(&(vessel.centre + Vector::y() * 1e-9), 2.5).unwrap();
        assert!(!touch.is_deep && (touch.normal - Vector::y()).norm() < 1e-6 && (touch.overlap - 0.5 - 1e-9).abs() < ROUNDING);
    }

    #[test]
    fn rods_have_sides_ends_and_rims() {
        let rod = cylinder(Side::Outside, 3.0);
        let touch = |along: f64, across: [f64; 2]| rod.touch_sphere(&at(&rod, along, across), 1.0).unwrap();
        let (x, y) = (Vector::new(0.8, 0.0, -0.6), Vector::y());
        for (found, overlap, normal) in [
            (touch(1.0, [0.0, 2.5]), 0.5, -y),
            (touch(-3.25, [1.0, 0.0]), 0.75, rod.axis),
            // Beyond the end by 0.3 m and the side by 0.4 m.
            (touch(3.3, [2.4, 0.0]), 0.5, -rod.axis * 0.6 - x * 0.8),
            // Inside: out by the nearer surface.
            (touch(2.75, [0.5, 0.0]), 1.25, -rod.axis),
            (touch(0.0, [0.0, 1.75]), 1.25, -y),
        ] {
            assert!((found.overlap - overlap).abs() < ROUNDING && (found.normal - normal).norm() < 4.0 * ROUNDING, "{found:?} {overlap}");
        }
        assert_eq!(cylinder(Side::Outside, f64::INFINITY).touch_sphere(&at(&rod, 50.0, [0.0, 3.5]), 1.0), None);
    }

    #[test]
    fn a_tube_is_touched_from_both_sides_and_at_its_rims() {
        let tube = cylinder(Side::Inside, 3.0);
        let touch = |along: f64, across: [f64; 2]| tube.touch_sphere(&at(&tube, along, across), 1.0);
        let (x, y) = (Vector::new(0.8, 0.0, -0.6), Vector::y());
        let inside = touch(2.0, [0.0, 1.5]).unwrap();
        assert!((inside.overlap - 0.5).abs() < ROUNDING && (inside.normal - y).norm() < ROUNDING);
        let outside = touch(2.0, [0.0, 2.5]).unwrap();
        assert!((outside.overlap - 0.5).abs() < ROUNDING && (outside.normal + y).norm() < ROUNDING);
        // Beyond the end by 0.3 m, within the side by 0.4 m.
        let rim = touch(-3.3, [1.6, 0.0]).unwrap();
        assert!((rim.overlap - 0.5).abs() < ROUNDING && (rim.normal - tube.axis * 0.6 - x * 0.8).norm() < 4.0 * ROUNDING, "{rim:?}");
        assert_eq!((touch(0.0, [0.0, 0.5]), touch(4.5, [0.0, 2.0])), (None, None));
    }

    /// The wall as a net of points: none is nearer than the answer, and the nearest is no farther from it than the net is wide.
    #[test]
    fn no_point_of_the_wall_is_nearer() {
        for (side, caps) in [(Side::Inside, false), (Side::Outside, true)] {
            let wall = cylinder(side, 1.0);
            for sample in 0..200 {
                let part = |stride: f64| (f64::from(sample) * stride).fract();
                let point = at(&wall, 4.0 * part(0.618_034) - 2.0, [6.0 * part(0.754_878) - 3.0, 6.0 * part(0.569_841) - 3.0]);
                let mut least = f64::INFINITY;
                for step in 0..2000 {
                    let (sine, cosine) = (std::f64::consts::TAU * f64::from(step) / 2000.0).sin_cos();
                    for height in 0..=40 {
                        let (along, shrink) = (f64::from(height) / 20.0 - 1.0, f64::from(height) / 40.0);
                        least = least.min((at(&wall, along, [2.0 * cosine, 2.0 * sine]) - point).norm());
                        for end in if caps { vec![-1.0, 1.0] } else { vec![] } {
                            least = least.min((at(&wall, end, [2.0 * cosine * shrink, 2.0 * sine * shrink]) - point).norm());
                        }
                    }
                }
                let found = wall.distance(&point).abs();
                // Half the diagonal of a mesh of 0.05 m by 0.0063 m.
                assert!(found <= least + 1e-12 && found >= least - 0.0253, "{sample}: {found} {least}");
            }
        }
    }
}
