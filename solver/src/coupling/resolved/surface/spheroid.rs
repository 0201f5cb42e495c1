//! The surface of a spheroid: an ellipse turned about its z axis.
//!
//! The nearest point $x$ of an ellipse to $p$ lies along the normal there: $p_i = x_i (1 + t / a_i^2)$ with one $t$ for both directions, negative inside. It is the
//! largest root of $\sum_i (a_i p_i / (t + a_i^2))^2 = 1$. Counted from the pole of that sum, $s = t + \min a_i^2$, nothing cancels; and of one over the root of
//! the sum, which is almost straight, Newton's method finds it from the left without ever passing it.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::outline::intervals;
use super::{Foot, Surface};
use crate::Vector;

/// A spheroid about the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spheroid {
    /// Semi-axis across z in m.
    pub equatorial: f64,
    /// Semi-axis along z in m.
    pub polar: f64,
}

/// Steps of Newton's method, of which six to eight are enough.
const MOST_STEPS: usize = 60;

/// Parts of a quarter of the ellipse of which its length is summed.
const PARTS: usize = 1000;

impl Spheroid {
    /// In m^3.
    pub fn volume(&self) -> f64 {
        2.0 / 3.0 * TAU * self.equatorial * self.equatorial * self.polar
    }

    /// The ellipse's point nearest to one of the first quarter of its plane, and $t$.
    fn nearest(&self, point: [f64; 2]) -> ([f64; 2], f64) {
        let axes = [self.equatorial, self.polar];
        let squares = axes.map(|axis| axis * axis);
        let pole = squares[0].min(squares[1]);
        let beyond = squares.map(|square| square - pole);
        let terms = [0, 1].map(|direction| axes[direction] * point[direction]);
        // Not below any single term's own root, where the sum is at least one.
        let mut distance = (terms[0] - beyond[0]).max(terms[1] - beyond[1]).max(0.0);
        let is_short = [0, 1].map(|direction| beyond[direction] == 0.0);
        let is_on_axis = [0, 1].into_iter().all(|direction| !is_short[direction] || terms[direction] == 0.0);
        let along = |direction: usize, distance: f64| {
            if terms[direction] == 0.0 { 0.0 } else { terms[direction] / (distance + beyond[direction]) }
        };
        let size = |distance: f64| along(0, distance).hypot(along(1, distance));
        if is_on_axis && size(0.0) < 1.0 {
            // Between the centres of curvature: two points are as near, or all of an equator. One of them is as good as the other.
            let shares = [0, 1].map(|direction| along(direction, 0.0));
            let left = (1.0 - shares[0] * shares[0] - shares[1] * shares[1]).sqrt();
            let short = usize::from(!is_short[0]);
            let nearest = [0, 1].map(|direction| axes[direction] * if direction == short { left } else { shares[direction] });
            return (nearest, -pole);
        }
        for _ in 0..MOST_STEPS {
            let now = size(distance);
            let slope: f64 = [0, 1]
                .map(
                    |direction| {
                        if terms[direction] == 0.0 { 0.0 } else { along(direction, distance).powi(2) / (distance + beyond[direction]) }
                    },
                )
                .iter()
                .sum();
            let step = now * now * (now - 1.0) / slope;
            distance += step;
            if step.is_nan() || step <= f64::EPSILON * distance {
                break;
            }
        }
        ([0, 1].map(|direction| axes[direction] * along(direction, distance)), distance - pole)
    }

    /// The ellipse's point at an angle of its parameter from the equator.
    fn at(&self, angle: f64) -> [f64; 2] {
        [self.equatorial * angle.cos(), self.polar * angle.sin()]
    }
}

impl Surface for Spheroid {
    fn foot(&self, point: &Vector) -> Foot {
        let across = point.x.hypot(point.y);
        let ([radius, height], t) = self.nearest([across, point.z.abs()]);
        // On the axis all ways across are alike.
        let outwards = if across > 0.0 { [point.x / across, point.y / across] } else { [1.0, 0.0] };
        let slope = radius / (self.equatorial * self.equatorial);
        let gradient = Vector::new(slope * outwards[0], slope * outwards[1], (height / (self.polar * self.polar)).copysign(point.z));
        let length = gradient.norm();
        Foot { distance: t * length, normal: gradient / length }
    }

    fn bounding_radius(&self) -> f64 {
        self.equatorial.max(self.polar)
    }

    /// Rings at even distances along the ellipse, and even points on each.
    fn points(&self, spacing: f64) -> Vec<Vector> {
        let ends: Vec<[f64; 2]> = (0..=PARTS).map(|part| self.at(FRAC_PI_2 * part as f64 / PARTS as f64)).collect();
        let mut lengths = vec![0.0];
        for pair in ends.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]));
        }
        let quarter = lengths[PARTS];
        let rings = intervals(2.0 * quarter, spacing);
        let mut points = Vec::new();
        for ring in 0..=rings {
            // From pole to pole; lengths are counted from the equator.
            let along = quarter - 2.0 * quarter * ring as f64 / rings as f64;
            let after = lengths.partition_point(|length| *length < along.abs()).clamp(1, PARTS);
            let share = (along.abs() - lengths[after - 1]) / (lengths[after] - lengths[after - 1]);
            let [radius, height] = self.at(FRAC_PI_2 * ((after - 1) as f64 + share) / PARTS as f64);
            let count = if ring == 0 || ring == rings { 1 } else { intervals(TAU * radius, spacing) };
            points.extend((0..count).map(|number| {
                let (sine, cosine) = (TAU * number as f64 / count as f64).sin_cos();
                Vector::new(radius * cosine, radius * sine, height.copysign(along))
            }));
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coupling::resolved::surface::Ball;
    use crate::coupling::resolved::surface::checks::{assert_feet_are_nearest, assert_points_are_spread, assert_volume_inside};

    const SHAPES: [Spheroid; 4] = [
        Spheroid { equatorial: 0.3, polar: 0.6 },
        Spheroid { equatorial: 0.6, polar: 0.3 },
        Spheroid { equatorial: 0.5, polar: 0.5 },
        Spheroid { equatorial: 0.1, polar: 0.5 },
    ];

    #[test]
    fn feet_on_a_spheroid_are_nearest() {
        for shape in SHAPES {
            assert_feet_are_nearest(&shape, 0.01);
            assert_volume_inside(&shape, shape.volume());
        }
    }

    #[test]
    fn points_of_a_spheroid_are_evenly_spread() {
        for (shape, spacing) in SHAPES.into_iter().zip([0.06, 0.06, 0.09, 0.04]) {
            assert_points_are_spread(&shape, spacing);
        }
    }

    /// Points off the surface along its normal have their feet where they come from, up to the nearest centre of curvature.
    #[test]
    fn feet_are_found_again_along_normals_and_where_points_are_nowhere_special() {
        for shape in SHAPES {
            let (short, long) = (shape.equatorial.min(shape.polar), shape.equatorial.max(shape.polar));
            for number in 0..200 {
                let angle = 0.031 * f64::from(number) - 3.0;
                let [radius, height] = shape.at(angle);
                let on = Vector::new(0.6 * radius, 0.8 * radius, height);
                let squares = Vector::new(shape.equatorial, shape.equatorial, shape.polar).map(|axis| axis * axis);
                let normal = on.component_div(&squares).normalize();
                for off in [-0.9 * short * short / long, -1e-3, -1e-9, 0.0, 1e-12, 0.3, 20.0] {
                    let foot = shape.foot(&(on + normal * off));
                    assert!((foot.distance - off).abs() < 1e-14 * (1.0 + off.abs()), "{shape:?} {angle} {off} {foot:?}");
                    assert!((foot.normal - normal).norm() < 1e-11, "{shape:?} {angle} {off} {foot:?}");
                }
            }
        }
    }

    #[test]
    fn points_as_near_to_two_places_have_a_foot() {
        let [long, flat, round, _] = SHAPES;
        assert_eq!(long.foot(&Vector::zeros()).distance, -0.3);
        assert_eq!(flat.foot(&Vector::zeros()), Foot { distance: -0.3, normal: Vector::z() });
        assert_eq!(round.foot(&Vector::zeros()).distance, -0.5);
        // On the axis between the centres of curvature: nearest are places on a ring, whose normals lead back to the point.
        for height in [1e-300, 1e-9, 0.2, 0.44] {
            let foot = long.foot(&Vector::new(0.0, 0.0, height));
            let on = Vector::new(0.0, 0.0, height) - foot.normal * foot.distance;
            assert!(((on.x / 0.3).powi(2) + (on.z / 0.6).powi(2) - 1.0).abs() < 1e-14 && on.y == 0.0, "{on}");
            // An almost central point has the foot of the centre.
            let beside = long.foot(&Vector::new(1e-280, 0.0, height));
            assert!((beside.distance - foot.distance).abs() < 1e-14 && (beside.normal - foot.normal).norm() < 1e-7, "{beside:?} {foot:?}");
        }
        let foot = long.foot(&Vector::new(0.0, 0.0, -0.5));
        assert!((foot.distance + 0.1).abs() < 1e-15 && foot.normal == -Vector::z());
        let ball = Ball { radius: 0.5 };
        let point = Vector::new(0.1, -0.7, 0.3);
        assert!((ball.foot(&point).distance - round.foot(&point).distance).abs() < 1e-15);
    }
}
