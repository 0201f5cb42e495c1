//! Area and moments of a union of discs and convex polygons in the plane, exact.

pub use super::area_moments::Point;
use super::area_moments::{AreaMoments, circular_sector, triangle};
use super::outline_crossings::{Curve, crossings};

/// A convex member of a union.
#[derive(Debug, Clone, PartialEq)]
pub enum Member {
    /// A disc.
    Disc {
        /// Centre in m.
        centre: Point,
        /// Radius in m.
        radius: f64,
    },
    /// A convex polygon by its corners in m, counterclockwise.
    Polygon(Vec<Point>),
}

/// Lengths that are rounding, relative to the extent of the outline.
const ROUNDING: f64 = 1e-13;

/// Area and moments of the union of members, about the origin.
///
/// By Green's theorem the moments of a region are sums over its boundary: here each piece of boundary contributes the moments of the
/// sector that it spans with the origin. The boundary of the union consists of those pieces of the members' boundaries, cut wherever two of
/// them cross, that lie inside no other member. Pieces that two members share bound the union once if the members lie on the same side, and
/// not at all if they lie on either side. Members that touch within rounding do not cross.
pub fn union_moments(members: &[Member]) -> AreaMoments {
    let tolerance = ROUNDING * extent(members);
    let curves: Vec<Vec<Curve>> = members.iter().map(Member::curves).collect();
    let cuts = crossings(&curves, tolerance);
    let mut moments = AreaMoments::nothing();
    for (index, (curves, cuts)) in curves.iter().zip(cuts).enumerate() {
        for (curve, mut cuts) in curves.iter().zip(cuts) {
            cuts.sort_by(f64::total_cmp);
            for pair in cuts.windows(2) {
                let piece = Piece { curve, from: pair[0], to: pair[1] };
                if piece.bounds_union(index, members, tolerance) {
                    moments.add(&piece.sector());
                }
            }
        }
    }
    moments
}

/// Half the size of the box about the origin that holds all members, in m.
fn extent(members: &[Member]) -> f64 {
    let reach = |member: &Member| match member {
        Member::Disc { centre, radius } => centre.norm() + radius,
        Member::Polygon(corners) => corners.iter().map(|corner| corner.norm()).fold(0.0, f64::max),
    };
    members.iter().map(reach).fold(0.0, f64::max)
}

impl Member {
    /// Its boundary, counterclockwise.
    fn curves(&self) -> Vec<Curve> {
        match self {
            Member::Disc { centre, radius } => vec![Curve::Circle { centre: *centre, radius: *radius }],
            Member::Polygon(corners) => {
                let next = corners.iter().cycle().skip(1);
                corners.iter().zip(next).map(|(from, to)| Curve::Segment { from: *from, to: *to }).collect()
            }
        }
    }

    /// Distance in m of a point from the boundary, negative inside; a lower bound of it outside of a polygon.
    fn distance(&self, point: &Point) -> f64 {
        match self {
            Member::Disc { centre, radius } => (point - centre).norm() - radius,
            Member::Polygon(corners) => {
                let next = corners.iter().cycle().skip(1);
                let beyond = |(from, to): (&Point, &Point)| (point - from).perp(&(to - from)) / (to - from).norm();
                corners.iter().zip(next).map(beyond).fold(f64::NEG_INFINITY, f64::max)
            }
        }
    }
}

/// A part of a curve, between two of its parameters.
struct Piece<'a> {
    curve: &'a Curve,
    from: f64,
    to: f64,
}

/// How a piece of the boundary of one member lies with respect to another member.
#[derive(PartialEq)]
enum Lie {
    Inside,
    Outside,
    /// On its boundary, with the insides of both on the same side.
    Along,
    /// On its boundary, with the insides on either side.
    Against,
}

impl Piece<'_> {
    /// Whether this piece of the boundary of the member `index` is part of the boundary of the union.
    fn bounds_union(&self, index: usize, members: &[Member], tolerance: f64) -> bool {
        let others = members.iter().enumerate().filter(|(other, _)| *other != index);
        others.into_iter().all(|(other, member)| match self.lie(member, tolerance) {
            Lie::Outside => true,
            Lie::Along => index < other,
            Lie::Inside | Lie::Against => false,
        })
    }

    /// The piece crosses no boundary: where it is farthest from it, its side is known best.
    fn lie(&self, member: &Member, tolerance: f64) -> Lie {
        if let Some(along) = self.shares_boundary(member, tolerance) {
            return if along { Lie::Along } else { Lie::Against };
        }
        let at = |share: f64| member.distance(&self.curve.at(self.from + share * (self.to - self.from)));
        let farthest = [0.5, 0.25, 0.75, 0.1, 0.9].map(at).into_iter().max_by(|left, right| left.abs().total_cmp(&right.abs()));
        if farthest.is_some_and(|distance| distance < 0.0) { Lie::Inside } else { Lie::Outside }
    }

    /// Whether the piece is part of the boundary of a member, and if so, whether in the same direction.
    fn shares_boundary(&self, member: &Member, tolerance: f64) -> Option<bool> {
        match (self.curve, member) {
            (Curve::Circle { centre, radius }, Member::Disc { centre: other_centre, radius: other_radius }) => {
                ((centre - other_centre).norm() <= tolerance && (radius - other_radius).abs() <= tolerance).then_some(true)
            }
            (Curve::Segment { from, to }, Member::Polygon(_)) => {
                let ends = [self.curve.at(self.from), self.curve.at(self.to)];
                let holds = |edge: &Curve| ends.iter().all(|end| edge.distance(end) <= tolerance);
                let edge = member.curves().into_iter().find(holds)?;
                Some((edge.at(1.0) - edge.at(0.0)).dot(&(to - from)) > 0.0)
            }
            _ => None,
        }
    }

    /// Moments of the region between the origin and the piece.
    fn sector(&self) -> AreaMoments {
        let ends = [self.curve.at(self.from), self.curve.at(self.to)];
        match self.curve {
            Curve::Segment { .. } => triangle(ends[0], ends[1]),
            Curve::Circle { centre, radius } => {
                let mut sector = circular_sector(*radius, self.from, self.to).moved(centre);
                sector.add(&triangle(ends[0], *centre));
                sector.add(&triangle(*centre, ends[1]));
                sector
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use nalgebra::Matrix2;
    use proptest::prelude::*;

    use super::*;

    fn disc(x: f64, y: f64, radius: f64) -> Member {
        Member::Disc { centre: Point::new(x, y), radius }
    }

    fn square(lower: f64, upper: f64) -> Member {
        let corners = [(lower, lower), (upper, lower), (upper, upper), (lower, upper)];
        Member::Polygon(corners.map(|(x, y)| Point::new(x, y)).to_vec())
    }

    fn turned(member: &Member, angle: f64, by: Point) -> Member {
        let turn = nalgebra::Rotation2::new(angle);
        match member {
            Member::Disc { centre, radius } => Member::Disc { centre: turn * centre + by, radius: *radius },
            Member::Polygon(corners) => Member::Polygon(corners.iter().map(|corner| turn * corner + by).collect()),
        }
    }

    /// Closed form of the lens of two discs of radius 1 at the distance 2 cos(t): area 2 t - sin(2 t).
    #[test]
    fn two_discs_overlap_in_a_lens() {
        for angle in [1.5, 1.0, 0.5, 1e-2, 1e-4, 1e-6, 0.0] {
            let distance = 2.0 * f64::cos(angle);
            let moments = union_moments(&[disc(0.0, 0.0, 1.0), disc(distance, 0.0, 1.0)]);
            let expected = 2.0 * PI - (2.0 * angle - (2.0 * angle).sin());
            assert!((moments.area - expected).abs() < 16.0 * f64::EPSILON, "{angle}");
            assert!((moments.first - Point::new(0.5 * distance * expected, 0.0)).norm() < 64.0 * f64::EPSILON, "{angle}");
        }
    }

    /// A disc of radius 1 about a corner of a square of side 2: three quarters of the disc stand out.
    #[test]
    fn a_disc_and_a_square() {
        let moments = union_moments(&[disc(0.0, 0.0, 1.0), square(0.0, 2.0)]);
        assert!((moments.area - (4.0 + 0.75 * PI)).abs() < 16.0 * f64::EPSILON);
        // The quarter in the square has its centre at 4 / (3 pi), so that the rest has -1/3 as its first moment.
        assert!((moments.first - Point::repeat(4.0 - 1.0 / 3.0)).norm() < 16.0 * f64::EPSILON);
        // Second moments: 16/3 and 4 of the square; 3/4 of pi/4 and, by the symmetry of the missing quarter, -1/8 of the rest.
        let expected = Matrix2::new(16.0 / 3.0 + 3.0 * PI / 16.0, 3.875, 3.875, 16.0 / 3.0 + 3.0 * PI / 16.0);
        assert!((moments.second - expected).norm() < 32.0 * f64::EPSILON, "{}", moments.second - expected);
    }

    /// Members of a trilobe, or of any ring of touching lobes around a polygon.
    fn lobes(count: usize) -> Vec<Member> {
        let circumradius = 1.0 / (PI / count as f64).sin();
        let place = |index: usize| {
            let angle = TAU * index as f64 / count as f64;
            Point::new(angle.cos(), angle.sin()) * circumradius
        };
        let discs = (0..count).map(|index| Member::Disc { centre: place(index), radius: 1.0 });
        discs.chain([Member::Polygon((0..count).map(place).collect())]).collect()
    }

    /// Three lobes of radius 1 around a triangle of edge 2. Closed form by sectors of 300 degrees: area 5/2 pi + sqrt 3, polar second moment
    /// 5 / sqrt 3 + 55/12 pi. Four around a square of edge 2, by sectors of 270 degrees: area 3 pi + 4, polar moment 4 (3 pi/8 + sqrt 2
    /// (2 sqrt 2 / 3) + 2 (3 pi/4)) + 8/3 = 15/2 pi + 8.
    #[test]
    fn touching_lobes_around_a_triangle_and_a_square_wherever_they_lie() {
        for (count, area, polar) in
            [(3, 2.5 * PI + 3.0_f64.sqrt(), 5.0 / 3.0_f64.sqrt() + 55.0 / 12.0 * PI), (4, 3.0 * PI + 4.0, 7.5 * PI + 8.0)]
        {
            for angle in [0.0, 0.1, 1.0, 2.0, 3.0, 4.0] {
                let by = Point::new(0.3, -0.2) * angle;
                let members: Vec<Member> = lobes(count).iter().map(|member| turned(member, angle, by)).collect();
                let moments = union_moments(&members).moved(&-by);
                assert!((moments.area - area).abs() < 64.0 * f64::EPSILON, "{count} {angle} {}", moments.area - area);
                assert!(moments.first.norm() < 256.0 * f64::EPSILON);
                let round = Matrix2::identity() * (0.5 * polar);
                assert!((moments.second - round).norm() < 512.0 * f64::EPSILON, "{count} {angle} {}", moments.second - round);
            }
        }
    }

    #[test]
    fn members_that_repeat_touch_or_lie_inside_add_nothing_twice() {
        let whole = union_moments(&[square(0.0, 2.0)]);
        let halves = [0.0, 1.0].map(|x| {
            let corners = [(x, 0.0), (x + 1.0, 0.0), (x + 1.0, 2.0), (x, 2.0)];
            Member::Polygon(corners.map(|(x, y)| Point::new(x, y)).to_vec())
        });
        let same = |members: &[Member]| (union_moments(members).second - whole.second).norm() < 32.0 * f64::EPSILON;
        assert!(same(&halves));
        assert!(same(&[square(0.0, 2.0), square(0.0, 2.0), square(0.0, 2.0)]));
        assert!(same(&[square(0.0, 1.0), square(0.0, 2.0), disc(1.0, 1.0, 1.0)]));
        let twice = union_moments(&[disc(0.1, 0.2, 1.0), disc(0.1, 0.2, 1.0), disc(0.6, 0.2, 0.5)]);
        assert!((twice.area - PI).abs() < 8.0 * f64::EPSILON);
    }

    /// Length of the union of the intervals in which a vertical line cuts the members, and the integral of y over them.
    fn strip(members: &[Member], x: f64) -> [f64; 2] {
        let cut = |member: &Member| match member {
            Member::Disc { centre, radius } => {
                let half = (radius * radius - (x - centre.x).powi(2)).max(0.0).sqrt();
                (half > 0.0).then_some((centre.y - half, centre.y + half))
            }
            Member::Polygon(corners) => {
                let edges = corners.iter().zip(corners.iter().cycle().skip(1));
                let crossed = edges.filter(|(from, to)| (from.x < x) != (to.x < x));
                let heights: Vec<f64> = crossed.map(|(from, to)| from.y + (to.y - from.y) * (x - from.x) / (to.x - from.x)).collect();
                (heights.len() == 2).then(|| (heights[0].min(heights[1]), heights[0].max(heights[1])))
            }
        };
        let mut intervals: Vec<(f64, f64)> = members.iter().filter_map(cut).collect();
        intervals.sort_by(|left, right| left.0.total_cmp(&right.0));
        let (mut sums, mut reached) = ([0.0; 2], f64::NEG_INFINITY);
        for (lower, upper) in intervals {
            let lower = lower.max(reached);
            if upper > lower {
                sums[0] += upper - lower;
                sums[1] += 0.5 * (upper * upper - lower * lower);
                reached = upper;
            }
        }
        sums
    }

    /// Adaptive Simpson integration: halves intervals until both halves agree with the whole.
    fn integrate(function: &dyn Fn(f64) -> f64, lower: f64, upper: f64, allowed: f64) -> f64 {
        let simpson = |from: f64, to: f64| (to - from) / 6.0 * (function(from) + 4.0 * function(0.5 * (from + to)) + function(to));
        let middle = 0.5 * (lower + upper);
        let halves = simpson(lower, middle) + simpson(middle, upper);
        if (halves - simpson(lower, upper)).abs() <= allowed || upper - lower < 1e-12 {
            return halves;
        }
        integrate(function, lower, middle, 0.7 * allowed) + integrate(function, middle, upper, 0.7 * allowed)
    }

    /// Sum over strips of a function of their place and content, from -3.1 to 3.9.
    fn over_strips(members: &[Member], weight: &dyn Fn(f64, [f64; 2]) -> f64, allowed: f64) -> f64 {
        let ends = |index: i32| -3.1 + 7.0 * f64::from(index) / 37.0;
        (0..37).map(|index| integrate(&|x| weight(x, strip(members, x)), ends(index), ends(index + 1), allowed)).sum()
    }

    /// Independent: strips, each cut exactly, added up by adaptive quadrature.
    #[test]
    fn a_crowd_of_members_agrees_with_its_strips() {
        let triangle = Member::Polygon([(-1.3, -0.4), (0.2, -1.7), (1.1, 0.9)].map(|(x, y)| Point::new(x, y)).to_vec());
        let members = [
            disc(0.3, 0.4, 0.8),
            disc(-0.5, 0.1, 0.7),
            triangle,
            turned(&square(0.0, 1.1), 0.4, Point::new(0.2, -0.5)),
            disc(2.5, 0.0, 0.5),
        ];
        let moments = union_moments(&members);
        let sum = |weight: &dyn Fn(f64, [f64; 2]) -> f64| over_strips(&members, weight, 1e-13);
        assert!((moments.area - sum(&|_, strip| strip[0])).abs() < 1e-11);
        assert!((moments.first.y - sum(&|_, strip| strip[1])).abs() < 1e-11);
        assert!((moments.second[(0, 0)] - sum(&|x, strip| x * x * strip[0])).abs() < 1e-11);
        assert!((moments.second[(0, 1)] - sum(&|x, strip| x * strip[1])).abs() < 1e-11);
    }

    fn any_member() -> impl Strategy<Value = Member> {
        // Few different places and sizes, so that members often touch, repeat or share edges.
        let grid = || (-3..4_i32).prop_map(|step| 0.5 * f64::from(step));
        let disc = (grid(), grid(), 1..4_i32).prop_map(|(x, y, size)| disc(x, y, 0.5 * f64::from(size)));
        let square = (grid(), grid(), 1..4_i32).prop_map(|(x, y, size)| turned(&square(0.0, 0.5 * f64::from(size)), 0.0, Point::new(x, y)));
        prop_oneof![disc, square]
    }

    proptest! {
        /// Neither the order of members nor turning them, which rounds all coincidences away, changes the union; and it is that of the strips.
        #[test]
        fn unions_of_touching_members_depend_neither_on_order_nor_on_rounding(
            members in prop::collection::vec(any_member(), 2..6),
            angle in 0.0..6.0_f64,
        ) {
            let straight = union_moments(&members);
            let area = over_strips(&members, &|_, strip| strip[0], 1e-8);
            // Adaptive quadrature may take a corner between its first points for a straight line: a coarse check that nothing is left out.
            prop_assert!((straight.area - area).abs() < 1e-3, "{} {}", straight.area, area);
            let reversed: Vec<Member> = members.iter().rev().cloned().collect();
            prop_assert!((union_moments(&reversed).second - straight.second).norm() < 1e-11);
            let turned: Vec<Member> = members.iter().map(|member| turned(member, angle, Point::new(0.1, 0.2))).collect();
            prop_assert!((union_moments(&turned).area - straight.area).abs() < 1e-11);
        }
    }
}
