//! The impact of a rigid cylinder on a plane wall without friction, in closed form, and how long the formula stands.
//!
//! The lowest point of the lower rim, at the horizontal offset $x = R\cos\theta - \frac{L}{2}\sin\theta$ from the centre of mass, leaves
//! the wall with $e$ times the velocity of its approach. With $1/m = 1/M + x^2/I$ the impulse is $J = (1 + e) m V$, the velocity $J/M - V$
//! and the angular velocity $J x/I$: R eq. 3.37-3.38, which hold once the restitution is that of the contact point ($-v_c^+/v_c^-$;
//! printed: the inverse, of the centre of mass). Contrary to R section 3.2 they give spin at 0 and 90 degrees, where the contact is no
//! longer of one point, and their result stands only if no other point of the rims comes down afterwards.

use std::f64::consts::PI;

/// A cylinder that comes down on a wall without spin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CylinderImpact {
    /// Radius in m.
    pub radius: f64,
    /// Length in m.
    pub length: f64,
    /// Mass in kg.
    pub mass: f64,
    /// Moment of inertia about an axis across the cylinder, in kg m^2.
    pub inertia: f64,
    /// Velocity towards the wall in m/s, positive.
    pub approach: f64,
    /// Restitution at the contact point.
    pub restitution: f64,
}

/// What the impact leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// Of the centre of mass in m/s, positive away from the wall.
    pub velocity: f64,
    /// In rad/s, positive when it lowers the tilt: the negative of the tilt's rate.
    pub angular_velocity: f64,
    /// Of the wall, in N s.
    pub impulse: f64,
}

/// Within this time after the impact other contacts are sought, in s.
pub const WATCHED_TIME: f64 = 0.05;

impl CylinderImpact {
    /// Horizontal offset from the centre of mass to the contact point, for a tilt in radians: 0 stands on its face, $\pi/2$ lies on its
    /// side.
    pub fn arm(&self, tilt: f64) -> f64 {
        self.radius * tilt.cos() - 0.5 * self.length * tilt.sin()
    }

    /// Impact of one point of the lower rim at a tilt from 0 to $\pi/2$; at both ends this is the limit, not what the face or the line
    /// does.
    pub fn after_impact(&self, tilt: f64) -> Impact {
        self.impact_at(self.arm(tilt))
    }

    /// Impact of the whole face at no tilt, or of the whole side line at $\pi/2$: symmetric, without spin.
    pub fn after_flat_impact(&self) -> Impact {
        self.impact_at(0.0)
    }

    fn impact_at(&self, arm: f64) -> Impact {
        let effective_mass = 1.0 / (1.0 / self.mass + arm * arm / self.inertia);
        let impulse = (1.0 + self.restitution) * effective_mass * self.approach;
        Impact { velocity: impulse / self.mass - self.approach, angular_velocity: impulse * arm / self.inertia, impulse }
    }

    /// When another point of the rims touches the wall in the free motion after the impact of one point, if within [`WATCHED_TIME`]. The
    /// formula of one impact gives the final state only without such a contact.
    ///
    /// The lowest point of a tilted rim lies in the plane of the motion: three points have to be watched.
    pub fn next_rim_contact(&self, tilt: f64) -> Option<f64> {
        let Impact { velocity, angular_velocity, .. } = self.after_impact(tilt);
        let (axial, radial) = (0.5 * self.length, self.radius);
        let height = axial * tilt.cos() + radial * tilt.sin();
        [(axial, radial), (axial, -radial), (-axial, -radial)]
            .into_iter()
            .filter_map(|(axial, radial)| {
                FlyingPoint::new(axial, radial, [height, velocity], [tilt, -angular_velocity]).first_touch(WATCHED_TIME)
            })
            .min_by(f64::total_cmp)
    }
}

/// A point of a body in free planar flight above a wall: its height is $h + v t + a \cos(\phi + \omega t)$.
#[derive(Debug, Clone, Copy)]
pub(super) struct FlyingPoint {
    height: f64,
    velocity: f64,
    arm: f64,
    phase: f64,
    rate: f64,
}

impl FlyingPoint {
    /// The point at body coordinates along the axis and along the radius; heights and tilts each with their rates.
    pub(super) fn new(axial: f64, radial: f64, [height, velocity]: [f64; 2], [tilt, rate]: [f64; 2]) -> FlyingPoint {
        FlyingPoint { height, velocity, arm: axial.hypot(radial), phase: tilt + radial.atan2(axial), rate }
    }

    fn height_at(&self, time: f64) -> f64 {
        self.height + self.velocity * time + self.arm * (self.phase + self.rate * time).cos()
    }

    /// When the point first comes down to the wall, within a time; a point that stands on the wall and rises does not touch it.
    pub(super) fn first_touch(&self, within: f64) -> Option<f64> {
        let mut ends = self.turning_times(within);
        ends.push(within);
        let mut start = 0.0;
        for end in ends {
            // Monotone in between.
            let falls = self.height_at(end) < self.height_at(start);
            if falls && self.height_at(end) < 0.0 {
                return Some(self.crossing(start, end));
            }
            start = end;
        }
        None
    }

    /// Times at which the height turns, increasing: $\sin(\phi + \omega t) = v/(a \omega)$.
    fn turning_times(&self, within: f64) -> Vec<f64> {
        let sine = self.velocity / (self.arm * self.rate);
        if sine.is_nan() || sine.abs() >= 1.0 {
            return Vec::new();
        }
        let period = 2.0 * PI / self.rate.abs();
        let turns = (within / period).ceil() as usize;
        let mut times: Vec<f64> = [sine.asin(), PI - sine.asin()]
            .into_iter()
            .map(|angle| ((angle - self.phase) / self.rate).rem_euclid(period))
            .flat_map(|first| (0..=turns).map(move |turn| first + turn as f64 * period))
            .filter(|time| *time < within)
            .collect();
        times.sort_by(f64::total_cmp);
        times
    }

    /// Time within a fall at which the height is zero, to the last bit.
    fn crossing(&self, mut low: f64, mut high: f64) -> f64 {
        if self.height_at(low) <= 0.0 {
            return low;
        }
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return high;
            }
            if self.height_at(middle) > 0.0 { low = middle } else { high = middle }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = include_str!("../../../reference-data/cylinder_wall_impact/data.csv");

    const CYLINDER: CylinderImpact =
        CylinderImpact { radius: 4e-3, length: 5.3e-3, mass: 3.1e-4, inertia: 1.966e-9, approach: 1.0, restitution: 0.85 };

    /// Half a unit of the last of eight digits of a number that starts with one, twice for the rounding on both sides.
    const PRINTED: f64 = 2.0 * 5e-8;

    /// The table samples its times: they are late by up to this step, besides five printed digits.
    const SAMPLING_STEP: f64 = 2.5e-7;

    /// Independent: the reference data, computed elsewhere to the digits it prints.
    #[test]
    fn every_row_of_the_reference_table_is_met() {
        let mut rows = 0;
        for line in TABLE.lines().skip(1) {
            let fields: Vec<&str> = line.split(',').collect();
            let number = |column: usize| fields[column].parse::<f64>().expect("a number");
            let flat = fields[0].ends_with("_sym");
            let tilt = if flat { f64::NAN } else { number(0).to_radians() };
            let impact = if flat { CYLINDER.after_flat_impact() } else { CYLINDER.after_impact(tilt) };
            let arm = if flat { 0.0 } else { CYLINDER.arm(tilt) };
            let energy = |velocity: f64, spin: f64| CYLINDER.mass * velocity * velocity + CYLINDER.inertia * spin * spin;
            let kept = energy(impact.velocity, impact.angular_velocity) / energy(CYLINDER.approach, 0.0);
            let results = [arm, impact.angular_velocity, impact.velocity, impact.impulse, kept];
            for (column, value) in results.into_iter().enumerate() {
                let reference = number(column + 1);
                assert!((value - reference).abs() <= PRINTED * reference.abs(), "{line}: {value}");
            }
            if !flat && number(0) > 0.0 && number(0) < 90.0 {
                let expected = fields[6].parse::<f64>().ok();
                let found = CYLINDER.next_rim_contact(tilt);
                assert_eq!(expected.is_some(), found.is_some(), "{line}: {found:?}");
                let sampled = |(printed, time): (f64, f64)| {
                    let digits = 5e-5 * printed;
                    printed - time >= -digits && printed - time <= SAMPLING_STEP + digits
                };
                assert!(expected.zip(found).is_none_or(sampled), "{line}: {found:?}");
            }
            rows += 1;
        }
        assert_eq!(rows, 22);
    }

    /// Exact: at 0 and 90 degrees another point touches in the same instant.
    #[test]
    fn the_limits_of_one_point_have_a_second_contact_at_once() {
        for tilt in [0.0, 0.5 * PI] {
            let time = CYLINDER.next_rim_contact(tilt).expect("a contact");
            assert!(time * CYLINDER.approach < f64::EPSILON * CYLINDER.length, "{time}");
        }
    }

    /// Independent: roots of the height in arithmetic of 30 digits.
    #[test]
    fn second_contacts_are_found_to_ten_digits() {
        for (degrees, time) in [(5.0_f64, 3.866302848e-4), (30.0, 3.25044991e-3), (80.0, 1.432687515e-3)] {
            let found = CYLINDER.next_rim_contact(degrees.to_radians()).expect("a contact");
            assert!((found / time - 1.0).abs() < 5e-10, "{found}");
        }
    }

    /// Independent: the range in which one impact is the whole story, by sampling the motion every 0.5 us.
    #[test]
    fn one_impact_suffices_between_31_and_80_degrees() {
        let again = |degrees: f64| CYLINDER.next_rim_contact(degrees.to_radians()).is_some();
        assert!(again(31.131) && !again(31.132) && !again(79.510) && again(79.511));
    }
}
