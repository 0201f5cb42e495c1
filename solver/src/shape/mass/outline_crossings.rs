//! Where the boundaries of the members of an outline cross.

use std::f64::consts::TAU;

use super::area_moments::Point;

/// A part of the boundary of a member, counterclockwise about it.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Curve {
    /// A circle; its parameter is the angle from the x axis, from 0 to a full turn.
    Circle { centre: Point, radius: f64 },
    /// A straight piece; its parameter runs from 0 to 1.
    Segment { from: Point, to: Point },
}

impl Curve {
    /// The point at a parameter.
    pub(super) fn at(&self, parameter: f64) -> Point {
        match self {
            Curve::Circle { centre, radius } => centre + Point::new(parameter.cos(), parameter.sin()) * *radius,
            Curve::Segment { from, to } => from + (to - from) * parameter,
        }
    }

    /// Distance of a point from the curve, in m.
    pub(super) fn distance(&self, point: &Point) -> f64 {
        match self {
            Curve::Circle { centre, radius } => ((point - centre).norm() - radius).abs(),
            Curve::Segment { from, to } => {
                let along = (to - from).dot(&(point - from)) / (to - from).norm_squared();
                (self.at(along.clamp(0.0, 1.0)) - point).norm()
            }
        }
    }

    /// First and last parameter.
    fn ends(&self) -> [f64; 2] {
        match self {
            Curve::Circle { .. } => [0.0, TAU],
            Curve::Segment { .. } => [0.0, 1.0],
        }
    }

    /// The parameter of a point on the curve; `None` if it lies beyond an end by more than a tolerance.
    fn parameter(&self, point: &Point, tolerance: f64) -> Option<f64> {
        match self {
            Curve::Circle { centre, .. } => Some((point.y - centre.y).atan2(point.x - centre.x).rem_euclid(TAU)),
            Curve::Segment { from, to } => {
                let length = (to - from).norm();
                let along = (to - from).dot(&(point - from)) / length;
                (-tolerance..=length + tolerance).contains(&along).then(|| (along / length).clamp(0.0, 1.0))
            }
        }
    }
}

/// For each curve of each member, its ends and the parameters at which curves of other members cross it, unsorted. Curves that touch within a
/// tolerance do not cross; segments on a common line are cut at each other's ends. Each crossing is found once and cuts both curves, so that
/// no rounding can cut only one of them.
pub(super) fn crossings(curves: &[Vec<Curve>], tolerance: f64) -> Vec<Vec<Vec<f64>>> {
    let ends = |curves: &Vec<Curve>| curves.iter().map(|curve| curve.ends().to_vec()).collect();
    let mut cuts: Vec<Vec<Vec<f64>>> = curves.iter().map(ends).collect();
    for second in 0..curves.len() {
        for first in 0..second {
            for (i, one) in curves[first].iter().enumerate() {
                for (j, other) in curves[second].iter().enumerate() {
                    for point in common_points(one, other, tolerance) {
                        if let (Some(on_one), Some(on_other)) = (one.parameter(&point, tolerance), other.parameter(&point, tolerance)) {
                            cuts[first][i].push(on_one);
                            cuts[second][j].push(on_other);
                        }
                    }
                }
            }
        }
    }
    cuts
}

/// Points at which two curves, continued beyond their ends, cross.
fn common_points(one: &Curve, other: &Curve, tolerance: f64) -> Vec<Point> {
    match (one, other) {
        (Curve::Circle { centre, radius }, Curve::Circle { centre: other_centre, radius: other_radius }) => {
            circles(*centre, *radius, *other_centre, *other_radius, tolerance)
        }
        (Curve::Circle { centre, radius }, Curve::Segment { from, to })
        | (Curve::Segment { from, to }, Curve::Circle { centre, radius }) => circle_and_line(*centre, *radius, *from, *to, tolerance),
        (Curve::Segment { from, to }, Curve::Segment { from: other_from, to: other_to }) => {
            lines([*from, *to], [*other_from, *other_to], tolerance)
        }
    }
}

fn circles(centre: Point, radius: f64, other: Point, other_radius: f64, tolerance: f64) -> Vec<Point> {
    let distance = (other - centre).norm();
    let (farthest, nearest) = (radius + other_radius, (radius - other_radius).abs());
    if distance >= farthest - tolerance || distance <= nearest + tolerance {
        return Vec::new();
    }
    let along = (other - centre) / distance;
    let foot = 0.5 * (distance + (radius - other_radius) * farthest / distance);
    let half_chord = ((radius - foot) * (radius + foot)).max(0.0).sqrt();
    let across = Point::new(-along.y, along.x) * half_chord;
    vec![centre + along * foot + across, centre + along * foot - across]
}

fn circle_and_line(centre: Point, radius: f64, from: Point, to: Point, tolerance: f64) -> Vec<Point> {
    let along = (to - from).normalize();
    let height = along.perp(&(centre - from)).abs();
    if height >= radius - tolerance {
        return Vec::new();
    }
    let foot = from + along * along.dot(&(centre - from));
    let half_chord = along * ((radius - height) * (radius + height)).sqrt();
    vec![foot - half_chord, foot + half_chord]
}

fn lines(one: [Point; 2], other: [Point; 2], tolerance: f64) -> Vec<Point> {
    let [long, short] = if (one[1] - one[0]).norm() >= (other[1] - other[0]).norm() { [one, other] } else { [other, one] };
    let along = (long[1] - long[0]).normalize();
    let heights = short.map(|point| along.perp(&(point - long[0])));
    if heights.iter().all(|height| height.abs() <= tolerance) {
        return [one, other].concat();
    }
    let rise = heights[1] - heights[0];
    // Lines so nearly parallel that they cross beyond all ends have no crossing that matters.
    if rise.abs() <= tolerance { Vec::new() } else { vec![short[0] - (short[1] - short[0]) * (heights[0] / rise)] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circles_and_lines_cross_where_they_must() {
        let unit = Curve::Circle { centre: Point::zeros(), radius: 1.0 };
        let other = Curve::Circle { centre: Point::new(1.0, 0.0), radius: 1.0 };
        let line = Curve::Segment { from: Point::new(-2.0, 0.6), to: Point::new(0.0, 0.6) };
        let slope = Curve::Segment { from: Point::new(-2.0, -0.4), to: Point::new(0.0, 1.6) };
        let points = common_points(&unit, &other, 1e-13);
        assert!(points.iter().all(|point| (point.x - 0.5).abs() < 1e-15 && (point.y.abs() - 0.75_f64.sqrt()).abs() < 1e-15));
        assert!((common_points(&unit, &line, 1e-13)[0] - Point::new(-0.8, 0.6)).norm() < 1e-15);
        assert!((common_points(&slope, &line, 1e-13)[0] - Point::new(-1.0, 0.6)).norm() < 1e-15);
        // One of the two crossings lies beyond the end of the segment.
        let cuts = crossings(&[vec![unit], vec![line]], 1e-13);
        assert_eq!((cuts[0][0].len(), cuts[1][0].len()), (3, 3));
        assert!((cuts[1][0][2] - 0.6).abs() < 1e-15);
    }

    #[test]
    fn touching_curves_do_not_cross() {
        let circle = |x: f64, radius: f64| Curve::Circle { centre: Point::new(x, 0.0), radius };
        for rounding in [-1e-15, 0.0, 1e-15] {
            assert!(common_points(&circle(0.0, 1.0), &circle(2.0 + rounding, 1.0), 1e-13).is_empty());
            assert!(common_points(&circle(0.0, 1.0), &circle(0.5 + rounding, 0.5), 1e-13).is_empty());
            assert!(common_points(&circle(0.0, 1.0), &circle(rounding, 1.0), 1e-13).is_empty());
            let tangent = Curve::Segment { from: Point::new(-1.0, 1.0 + rounding), to: Point::new(1.0, 1.0) };
            assert!(common_points(&circle(0.0, 1.0), &tangent, 1e-13).is_empty());
        }
        assert_eq!(common_points(&circle(0.0, 1.0), &circle(2.0 - 1e-12, 1.0), 1e-13).len(), 2);
    }

    #[test]
    fn segments_on_one_line_are_cut_at_each_others_ends() {
        let segment = |from: f64, to: f64| Curve::Segment { from: Point::new(from, 2.0), to: Point::new(to, 2.0) };
        let cuts = crossings(&[vec![segment(0.0, 4.0)], vec![segment(3.0, 1.0)]], 1e-13);
        assert!(cuts[0][0].contains(&0.25) && cuts[0][0].contains(&0.75));
        assert!(cuts[1][0].iter().all(|cut| *cut == 0.0 || *cut == 1.0));
    }
}
