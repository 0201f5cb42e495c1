//! Rigorous bounds of the distance of two convex bodies from an answer to be judged: two points and a direction.
//!
//! The lower bound is the gap between the supporting planes across the given direction, $-h_A(n) - h_B(-n)$, which no distance is below. The upper
//! bound is the distance of the given points, plus by how much each lies outside of its body. Both hold whatever the answer was, so that half
//! their difference bounds its error without any second solver. For two polyhedra the exact distance is found by trying all pairs of
//! faces, besides.
//!
//! Source of the bounds: weak duality of the minimum-norm problem (von Neumann; Boyd and Vandenberghe, Convex Optimization, section 8.1.3).

use nalgebra::{Matrix3, Vector3};

use super::superellipsoid_twin;

/// A point or direction.
pub type Vector = Vector3<f64>;

/// A convex body round which a ball runs, in its own frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// What the ball runs round.
    pub core: Solid,
    /// Radius of the ball in m.
    pub rounding: f64,
}

/// A convex set centred at its origin.
#[derive(Debug, Clone, PartialEq)]
pub enum Solid {
    /// The origin.
    Point,
    /// A straight line along z of half this length in m.
    Line(f64),
    /// A box of these half edges in m.
    Box(Vector),
    /// A cylinder along z: radius and half length in m.
    Cylinder(f64, f64),
    /// The hull of corners.
    Hull(Hull),
    /// A superellipsoid of these semi-axes in m and exponents towards z and in the plane of x and y.
    Superellipsoid(Vector, [f64; 2]),
}

/// The convex hull of a few points that surround the origin.
#[derive(Debug, Clone, PartialEq)]
pub struct Hull {
    corners: Vec<Vector>,
    /// Triples of corners with all others on one side.
    triangles: Vec<[usize; 3]>,
    /// Outward normal of each, and its distance from the origin in m.
    planes: Vec<(Vector, f64)>,
}

/// Height over a plane, relative to the largest corner, that is rounding.
const ON_PLANE: f64 = 1e-12;

impl Hull {
    /// From its corners, by trying all triples.
    pub fn new(corners: Vec<Vector>) -> Hull {
        let reach = corners.iter().map(|corner| corner.norm()).fold(0.0, f64::max);
        let (mut triangles, mut planes) = (Vec::new(), Vec::new());
        let count = corners.len();
        for (a, b, c) in (0..count).flat_map(|a| (a + 1..count).flat_map(move |b| (b + 1..count).map(move |c| (a, b, c)))) {
            let Some(normal) = (corners[b] - corners[a]).cross(&(corners[c] - corners[a])).try_normalize(ON_PLANE * reach * reach) else {
                continue;
            };
            let normal = if normal.dot(&corners[a]) < 0.0 { -normal } else { normal };
            let height = normal.dot(&corners[a]);
            if corners.iter().all(|corner| corner.dot(&normal) <= height + ON_PLANE * reach) {
                triangles.push([a, b, c]);
                planes.push((normal, corners.iter().map(|corner| corner.dot(&normal)).fold(height, f64::max)));
            }
        }
        Hull { corners, triangles, planes }
    }

    /// An upper bound of the distance from a point to the hull: drawn towards the origin, the point comes inside by then.
    fn excess(&self, point: &Vector) -> f64 {
        let outside = self.planes.iter().map(|(normal, height)| normal.dot(point) - height).fold(0.0, f64::max);
        let inner_radius = self.planes.iter().map(|(_, height)| *height).fold(f64::INFINITY, f64::min);
        outside / (inner_radius + outside) * point.norm()
    }
}

impl Solid {
    /// Largest product with a direction.
    fn support(&self, direction: &Vector) -> f64 {
        match self {
            Solid::Point => 0.0,
            Solid::Line(half_length) => half_length * direction.z.abs(),
            Solid::Box(half) => half.x * direction.x.abs() + half.y * direction.y.abs() + half.z * direction.z.abs(),
            Solid::Cylinder(radius, half_length) => radius * direction.xy().norm() + half_length * direction.z.abs(),
            Solid::Hull(hull) => hull.corners.iter().map(|corner| corner.dot(direction)).fold(f64::NEG_INFINITY, f64::max),
            Solid::Superellipsoid(semi_axes, exponents) => superellipsoid(semi_axes, *exponents).support(direction).dot(direction),
        }
    }

    /// Distance of a point from the set, or for hulls and superellipsoids an upper bound of it; zero inside.
    fn excess(&self, point: &Vector) -> f64 {
        let beyond = |half_length: f64| (point.z.abs() - half_length).max(0.0);
        match self {
            Solid::Point => point.norm(),
            Solid::Line(half_length) => point.xy().norm().hypot(beyond(*half_length)),
            Solid::Box(half) => (point.abs() - half).map(|excess| excess.max(0.0)).norm(),
            Solid::Cylinder(radius, half_length) => (point.xy().norm() - radius).max(0.0).hypot(beyond(*half_length)),
            Solid::Hull(hull) => hull.excess(point),
            // Drawn towards the origin by as much as the gauge is above one, the point comes to the surface.
            Solid::Superellipsoid(semi_axes, exponents) => {
                let gauge = superellipsoid(semi_axes, *exponents).gauge(point);
                (1.0 - 1.0 / gauge.max(1.0)) * point.norm()
            }
        }
    }

    /// Distance of the farthest point from the origin in m.
    pub fn reach(&self) -> f64 {
        match self {
            Solid::Point => 0.0,
            Solid::Line(half_length) => *half_length,
            Solid::Box(half) => half.norm(),
            Solid::Cylinder(radius, half_length) => radius.hypot(*half_length),
            Solid::Hull(hull) => hull.corners.iter().map(|corner| corner.norm()).fold(0.0, f64::max),
            Solid::Superellipsoid(semi_axes, _) => semi_axes.norm(),
        }
    }
}

/// About the origin.
fn superellipsoid(semi_axes: &Vector, exponents: [f64; 2]) -> superellipsoid_twin::Placed {
    superellipsoid_twin::Placed { semi_axes: *semi_axes, exponents, position: Vector::zeros(), rotation: Matrix3::identity() }
}

/// A body in its place.
#[derive(Debug, Clone, Copy)]
pub struct Placed<'a> {
    /// The body.
    pub body: &'a Body,
    /// Its centre in m.
    pub position: Vector,
    /// From its own frame to the world.
    pub rotation: Matrix3<f64>,
}

/// An answer: points from the centre of each *core*, in the world frame, and a direction from first to second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer {
    /// Distance in m.
    pub distance: f64,
    /// Direction from the first to the second; of any length but zero.
    pub normal: Vector,
    /// Point of the core of the first.
    pub on_first: Vector,
    /// Point of the core of the second.
    pub on_second: Vector,
}

/// What is certain of a distance, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// It is not less than this; negative for an overlap by no more than this depth along the direction.
    pub lower: f64,
    /// It is not more than this.
    pub upper: f64,
}

impl Bounds {
    /// Bounds of the distance of two bodies from an answer for them.
    pub fn of(first: &Placed<'_>, second: &Placed<'_>, answer: &Answer) -> Bounds {
        let between = second.position - first.position;
        let roundings = first.body.rounding + second.body.rounding;
        let length = answer.normal.norm();
        let highest = first.body.core.support(&first.rotation.tr_mul(&answer.normal));
        let lowest = between.dot(&answer.normal) - second.body.core.support(&second.rotation.tr_mul(&-answer.normal));
        let excess = |placed: &Placed<'_>, point: &Vector| placed.body.core.excess(&placed.rotation.tr_mul(point));
        let across = (between + answer.on_second - answer.on_first).norm();
        let outside = excess(first, &answer.on_first) + excess(second, &answer.on_second);
        Bounds { lower: (lowest - highest) / length - roundings, upper: across + outside - roundings }
    }

    /// Largest possible error of a distance in m; NaN if anything in the answer was.
    pub fn error_of(&self, distance: f64) -> f64 {
        let (below, above) = (distance - self.lower, self.upper - distance);
        if below.is_nan() || above.is_nan() { f64::NAN } else { below.abs().max(above.abs()) }
    }
}

/// Exact distance of two polyhedra that do not overlap: the least over all pairs of triangles of their faces, in m.
pub fn distance_of_hulls(first: (&Hull, &Vector, &Matrix3<f64>), second: (&Hull, &Vector, &Matrix3<f64>)) -> f64 {
    let triangles = |(hull, position, rotation): (&Hull, &Vector, &Matrix3<f64>)| -> Vec<[Vector; 3]> {
        hull.triangles.iter().map(|triangle| triangle.map(|corner| position + rotation * hull.corners[corner])).collect()
    };
    let others = triangles(second);
    let of_pair = |one: &[Vector; 3]| others.iter().map(|other| distance_of_triangles(one, other)).fold(f64::INFINITY, f64::min);
    triangles(first).iter().map(of_pair).fold(f64::INFINITY, f64::min)
}

/// Corners over triangles, and edges against edges.
fn distance_of_triangles(one: &[Vector; 3], other: &[Vector; 3]) -> f64 {
    let over = |corners: &[Vector; 3], triangle: &[Vector; 3]| {
        corners.iter().map(|corner| height_over_triangle(corner, triangle)).fold(f64::INFINITY, f64::min)
    };
    let edges = |triangle: &[Vector; 3]| [0, 1, 2].map(|corner| [triangle[corner], triangle[(corner + 1) % 3]]);
    let mut least = over(one, other).min(over(other, one));
    for edge in edges(one) {
        for against in edges(other) {
            least = least.min(distance_of_edges(&edge, &against));
        }
    }
    least
}

/// Height over a triangle; infinite beside it.
fn height_over_triangle(point: &Vector, [a, b, c]: &[Vector; 3]) -> f64 {
    let normal = (b - a).cross(&(c - a)).normalize();
    let is_inside = [[a, b], [b, c], [c, a]].iter().all(|[from, to]| (*to - *from).cross(&(point - *from)).dot(&normal) >= 0.0);
    if is_inside { (point - a).dot(&normal).abs() } else { f64::INFINITY }
}

/// Inside both edges along their common perpendicular, else from an end of one to the other.
fn distance_of_edges([a, b]: &[Vector; 2], [c, d]: &[Vector; 2]) -> f64 {
    let ends = [(a, [c, d]), (b, [c, d]), (c, [a, b]), (d, [a, b])];
    let least = ends.map(|(point, edge)| distance_to_edge(point, edge)).into_iter().fold(f64::INFINITY, f64::min);
    let (one, other) = (b - a, d - c);
    let common = one.cross(&other);
    let squared = common.norm_squared();
    if squared == 0.0 {
        return least;
    }
    let on_one = (c - a).cross(&other).dot(&common) / squared;
    let on_other = (c - a).cross(&one).dot(&common) / squared;
    let cross = (0.0..=1.0).contains(&on_one) && (0.0..=1.0).contains(&on_other);
    if cross { least.min((c - a).dot(&common).abs() / squared.sqrt()) } else { least }
}

fn distance_to_edge(point: &Vector, [from, to]: [&Vector; 2]) -> f64 {
    let edge = to - from;
    let along = ((point - from).dot(&edge) / edge.norm_squared()).clamp(0.0, 1.0);
    (from + edge * along - point).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube() -> Body {
        Body { core: Solid::Box(Vector::repeat(0.5)), rounding: 0.0 }
    }

    fn bounds_of(answer: &Answer) -> Bounds {
        let body = cube();
        let placed = |position| Placed { body: &body, position, rotation: Matrix3::identity() };
        Bounds::of(&placed(Vector::zeros()), &placed(Vector::new(0.2, 0.1, 1.5)), answer)
    }

    const RIGHT: Answer = Answer {
        distance: 0.5,
        normal: Vector::new(0.0, 0.0, 1.0),
        on_first: Vector::new(0.1, 0.1, 0.5),
        on_second: Vector::new(-0.1, 0.0, -0.5),
    };

    #[test]
    fn a_right_answer_is_certified_and_each_wrong_part_is_seen() {
        assert!(bounds_of(&RIGHT).error_of(0.5) < 1e-15);
        assert!((bounds_of(&RIGHT).error_of(0.5 + 1e-9) - 1e-9).abs() < 1e-15);
        let turned = Answer { normal: Vector::new(1e-6, 0.0, 1.0), ..RIGHT };
        assert!(bounds_of(&turned).error_of(0.5) > 5e-7);
        let outside = Answer { on_first: Vector::new(0.1, 0.1, 0.5 + 1e-9), on_second: Vector::new(-0.1, 0.0, -0.5), ..RIGHT };
        assert!(bounds_of(&outside).upper >= 0.5 - 1e-15, "points outside cannot make the upper bound too small");
        let other_corner = Answer { on_second: Vector::new(-0.1, 0.0, 0.5), ..RIGHT };
        assert!(bounds_of(&other_corner).error_of(0.5) > 0.9);
        assert!(bounds_of(&Answer { normal: Vector::repeat(f64::NAN), ..RIGHT }).error_of(0.5).is_nan());
    }

    #[test]
    fn a_hull_knows_its_planes_and_never_underrates_how_far_a_point_is_outside() {
        let corners = (0..8).map(|index| Vector::new((index & 1) as f64, ((index >> 1) & 1) as f64, (index >> 2) as f64).add_scalar(-0.5));
        let hull = Hull::new(corners.collect());
        assert_eq!(hull.triangles.len(), 24, "four triangles on each face");
        for point in [Vector::new(0.6, 0.0, 0.0), Vector::new(0.6, 0.7, -0.8), Vector::new(0.5 + 1e-9, 0.1, 0.2), Vector::zeros()] {
            let exact = Solid::Box(Vector::repeat(0.5)).excess(&point);
            let bound = hull.excess(&point);
            assert!(bound >= exact - 1e-15 && bound <= 4.0 * exact + 1e-15, "{point} {bound} {exact}");
        }
    }

    /// Points made of angles (Barr 1981) lie on the surface, and none of them reaches beyond the support.
    #[test]
    fn a_superellipsoid_reaches_as_far_as_its_points() {
        let solid = Solid::Superellipsoid(Vector::new(0.5, 0.35, 0.25), [0.6, 1.3]);
        let power = |base: f64, exponent: f64| base.abs().powf(exponent).copysign(base);
        let points = (0..400).map(|index| {
            let (upwards, about) = (std::f64::consts::PI * (f64::from(index % 20) / 19.0 - 0.5), 2.399_963 * f64::from(index));
            let across = power(upwards.cos(), 0.6);
            let [x, y] = [power(about.cos(), 1.3), power(about.sin(), 1.3)];
            Vector::new(0.5 * across * x, 0.35 * across * y, 0.25 * power(upwards.sin(), 0.6))
        });
        let points: Vec<Vector> = points.collect();
        for (index, point) in points.iter().enumerate() {
            assert!(solid.excess(point) < 4.0 * f64::EPSILON && solid.excess(&(point * (1.0 + 1e-9))) > 1e-10, "{point}");
            let direction = points[(index + 137) % 400].normalize();
            let reach = points.iter().map(|point| point.dot(&direction)).fold(0.0, f64::max);
            let support = solid.support(&direction);
            assert!(reach <= support * (1.0 + 4.0 * f64::EPSILON) && reach > 0.9 * support, "{direction}: {reach} {support}");
        }
    }

    #[test]
    fn hulls_are_as_far_as_their_faces_edges_and_corners() {
        let corners = (0..8).map(|index| Vector::new((index & 1) as f64, ((index >> 1) & 1) as f64, (index >> 2) as f64).add_scalar(-0.5));
        let hull = Hull::new(corners.collect());
        let distance = |position: Vector, axis: Vector, angle: f64| {
            let turn = nalgebra::Rotation3::from_axis_angle(&nalgebra::Unit::new_normalize(axis), angle);
            distance_of_hulls((&hull, &Vector::zeros(), &Matrix3::identity()), (&hull, &position, turn.matrix()))
        };
        let edges = Vector::new(1.0, 0.0, 1.0);
        assert!((distance(Vector::new(0.2, 0.1, 1.5), Vector::z(), 0.3) - 0.5).abs() < 1e-15);
        assert!((distance(edges * 1.25, edges, std::f64::consts::FRAC_PI_2) - 0.25 * 2.0_f64.sqrt()).abs() < 1e-15);
        assert!((distance(Vector::repeat(1.5), Vector::repeat(1.0), 1.0) - 0.75_f64.sqrt()).abs() < 1e-15);
    }
}
