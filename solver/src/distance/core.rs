//! Cores: what is left of a convex shape when a crust of even thickness is taken off it.
//!
//! A shape is replaced by its core and a ball that runs over the core's surface. The distance of two shapes is then the distance of
//! their cores less both ball radii, which is negative, and still has a normal, as long as the overlap is less than both together. For balls
//! and spherocylinders this is exact. For shapes with edges it rounds the edges by the crust: a model error that goes to zero with it.

use std::sync::Arc;

use super::polygon::Polygon;
use crate::Vector;
use crate::shape::{Convex, Polyhedron, Superellipsoid};

/// A convex set without rounding, centred at the centre of its shape.
#[derive(Debug, Clone, PartialEq)]
pub enum Core {
    /// The origin: what a ball runs round.
    Point,
    /// A straight line along z.
    Segment {
        /// Half its length in m.
        half_length: f64,
    },
    /// A rectangular box.
    Box {
        /// Half its edges in m.
        half_lengths: Vector,
    },
    /// A cylinder along z.
    Cylinder {
        /// Radius in m.
        radius: f64,
        /// Half its length in m.
        half_length: f64,
    },
    /// A convex polyhedron.
    Polyhedron(Arc<Polyhedron>),
    /// A superellipsoid.
    Superellipsoid(Arc<Superellipsoid>),
    /// A flat polygon: a plate or a triangle of a wall, never a body.
    Polygon(Arc<Polygon>),
}

/// A core and the radius of the ball that runs over it.
#[derive(Debug, Clone, PartialEq)]
pub struct RoundedCore {
    /// The core.
    pub core: Core,
    /// Radius in m of the ball.
    pub radius: f64,
}

impl RoundedCore {
    /// The shape as it is: only what is round by nature is rounded.
    pub fn sharp(convex: &Convex) -> RoundedCore {
        let core = match convex {
            Convex::Sphere(sphere) => return RoundedCore { core: Core::Point, radius: sphere.radius },
            Convex::Spherocylinder(body) => {
                return RoundedCore { core: Core::Segment { half_length: 0.5 * body.length }, radius: body.radius };
            }
            Convex::Cuboid(cuboid) => Core::Box { half_lengths: cuboid.half_lengths() },
            Convex::Cylinder(cylinder) => Core::Cylinder { radius: cylinder.radius, half_length: 0.5 * cylinder.length },
            Convex::Polyhedron(polyhedron) => Core::Polyhedron(polyhedron.clone()),
            Convex::Superellipsoid(shape) => Core::Superellipsoid(shape.clone()),
        };
        RoundedCore { core, radius: 0.0 }
    }

    /// The shape with its edges rounded by a crust of even thickness in m; superellipsoids are smooth and stay as they are. `None` if the shape is not thick enough for it.
    pub fn with_crust(convex: &Convex, crust: f64) -> Option<RoundedCore> {
        let sharp = RoundedCore::sharp(convex);
        if matches!(sharp.core, Core::Point | Core::Segment { .. } | Core::Superellipsoid(_)) {
            return Some(sharp);
        }
        if crust >= convex.inner_radius() {
            return None;
        }
        let core = match sharp.core {
            Core::Box { half_lengths } => Core::Box { half_lengths: half_lengths.add_scalar(-crust) },
            Core::Cylinder { radius, half_length } => Core::Cylinder { radius: radius - crust, half_length: half_length - crust },
            Core::Polyhedron(polyhedron) => Core::Polyhedron(Arc::new(polyhedron.inset(crust)?)),
            round => round,
        };
        Some(RoundedCore { core, radius: crust })
    }

    /// The shape shrunk by a ratio, as R section 2.5 does it: the crust is as thick as given where the shape is thinnest, thicker elsewhere, yet
    /// counted as if it were even. Overlaps of elongated shapes are wrong by the difference. `None` if the shape is not thick enough.
    pub fn shrunk_by_ratio(convex: &Convex, crust: f64) -> Option<RoundedCore> {
        let sharp = RoundedCore::sharp(convex);
        let ratio = 1.0 - crust / convex.inner_radius();
        if ratio <= 0.0 {
            return None;
        }
        let core = match sharp.core {
            Core::Point => return Some(sharp),
            Core::Segment { half_length } => Core::Segment { half_length: half_length * ratio },
            Core::Box { half_lengths } => Core::Box { half_lengths: half_lengths * ratio },
            Core::Cylinder { radius, half_length } => Core::Cylinder { radius: radius * ratio, half_length: half_length * ratio },
            Core::Polyhedron(polyhedron) => Core::Polyhedron(Arc::new(polyhedron.scaled(ratio))),
            Core::Superellipsoid(_) | Core::Polygon(_) => return Some(sharp),
        };
        let radius = if sharp.radius > 0.0 { sharp.radius * ratio + crust } else { crust };
        Some(RoundedCore { core, radius })
    }
}

impl Core {
    /// Distance in m from the centre to the farthest point.
    pub fn reach(&self) -> f64 {
        match self {
            Core::Point => 0.0,
            Core::Segment { half_length } => *half_length,
            Core::Box { half_lengths } => half_lengths.norm(),
            Core::Cylinder { radius, half_length } => (radius * radius + half_length * half_length).sqrt(),
            Core::Polyhedron(polyhedron) => polyhedron.bounding_radius(),
            Core::Superellipsoid(shape) => shape.bounding_radius(),
            Core::Polygon(polygon) => polygon.bounding_radius(),
        }
    }

    /// Half the edges in m of the box about the centre, along the core's own axes, that holds it.
    pub fn half_extents(&self) -> Vector {
        let of_corners = |corners: &[Vector]| corners.iter().fold(Vector::zeros(), |extents, corner| extents.sup(&corner.abs()));
        match self {
            Core::Point => Vector::zeros(),
            Core::Segment { half_length } => Vector::new(0.0, 0.0, *half_length),
            Core::Box { half_lengths } => *half_lengths,
            Core::Cylinder { radius, half_length } => Vector::new(*radius, *radius, *half_length),
            Core::Polyhedron(polyhedron) => of_corners(polyhedron.vertices()),
            Core::Superellipsoid(shape) => *shape.semi_axes(),
            Core::Polygon(polygon) => of_corners(polygon.corners()),
        }
    }

    /// A farthest point in a direction, in the core's own frame. Ties go to the positive side, or to the first corner.
    #[inline]
    pub fn support(&self, direction: &Vector) -> Vector {
        self.farthest(direction).1
    }

    /// The same with the number of the corner; zero for sets without corners.
    #[inline]
    pub fn farthest(&self, direction: &Vector) -> (u32, Vector) {
        match self {
            Core::Point => (0, Vector::zeros()),
            Core::Segment { half_length } => {
                (u32::from(direction.z.is_sign_negative()), Vector::new(0.0, 0.0, half_length.copysign(direction.z)))
            }
            Core::Box { half_lengths } => {
                let is_negative = direction.map(|along| u32::from(along.is_sign_negative()));
                let corner = half_lengths.zip_map(direction, f64::copysign);
                (is_negative.x | is_negative.y << 1 | is_negative.z << 2, corner)
            }
            Core::Cylinder { radius, half_length } => {
                let across = (direction.x * direction.x + direction.y * direction.y).sqrt();
                let scale = if across > 0.0 { radius / across } else { 0.0 };
                (0, Vector::new(direction.x * scale, direction.y * scale, half_length.copysign(direction.z)))
            }
            Core::Polyhedron(polyhedron) => farthest(polyhedron.vertices(), direction),
            Core::Superellipsoid(shape) => (0, shape.support(direction)),
            Core::Polygon(polygon) => farthest(polygon.corners(), direction),
        }
    }

    /// The corner of a number; `None` if there is no such corner.
    #[inline]
    pub fn corner(&self, number: u32) -> Option<Vector> {
        let side = |place: u32| if number >> place & 1 == 1 { -1.0 } else { 1.0 };
        match self {
            Core::Point => (number == 0).then(Vector::zeros),
            Core::Segment { half_length } => (number < 2).then(|| Vector::z() * (half_length * side(0))),
            Core::Box { half_lengths } => (number < 8).then(|| half_lengths.component_mul(&Vector::new(side(0), side(1), side(2)))),
            Core::Cylinder { .. } | Core::Superellipsoid(_) => None,
            Core::Polyhedron(polyhedron) => polyhedron.vertices().get(number as usize).copied(),
            Core::Polygon(polygon) => polygon.corners().get(number as usize).copied(),
        }
    }

    /// Whether it meets other sets in single points only, however they are turned.
    #[inline]
    pub fn is_pointed(&self) -> bool {
        matches!(self, Core::Point | Core::Superellipsoid(_))
    }

    /// Whether the surface is curved, so that a method that walks from corner to corner does not end.
    #[inline]
    pub fn is_curved(&self) -> bool {
        matches!(self, Core::Cylinder { .. } | Core::Superellipsoid(_))
    }
}

#[inline]
fn farthest(vertices: &[Vector], direction: &Vector) -> (u32, Vector) {
    let mut best = (f64::NEG_INFINITY, 0);
    for (index, vertex) in vertices.iter().enumerate() {
        let reach = vertex.dot(direction);
        if reach > best.0 {
            best = (reach, index);
        }
    }
    (best.1 as u32, vertices[best.1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Cuboid, Cylinder, Spherocylinder};

    fn directions() -> impl Iterator<Item = Vector> {
        (0..200).map(|index| {
            let (height, angle) = (-0.995 + 0.01 * f64::from(index), 2.4 * f64::from(index));
            let across = (1.0 - height * height).sqrt();
            Vector::new(across * angle.cos(), across * angle.sin(), height)
        })
    }

    #[test]
    fn no_corner_lies_farther_than_the_support_and_the_support_is_a_corner() {
        for polyhedron in
            [Polyhedron::tetrahedron(1.0).unwrap(), Polyhedron::octahedron(1.0).unwrap(), Polyhedron::icosahedron(1.0).unwrap()]
        {
            let core = Core::Polyhedron(Arc::new(polyhedron.clone()));
            for direction in directions() {
                let reach = core.support(&direction).dot(&direction);
                assert!(polyhedron.vertices().iter().all(|vertex| vertex.dot(&direction) <= reach));
                assert!(polyhedron.vertices().contains(&core.support(&direction)));
            }
        }
    }

    #[test]
    fn supports_of_simple_sets_reach_as_far_as_their_formulas_say() {
        let (half, radius, half_length) = (Vector::new(0.2, 0.3, 0.7), 0.4, 0.9);
        for direction in directions() {
            let reach = |core: &Core| core.support(&direction).dot(&direction);
            assert!((reach(&Core::Box { half_lengths: half }) - half.dot(&direction.abs())).abs() < 1e-15);
            let of_cylinder = radius * direction.x.hypot(direction.y) + half_length * direction.z.abs();
            assert!((reach(&Core::Cylinder { radius, half_length }) - of_cylinder).abs() < 1e-15);
            assert!((reach(&Core::Segment { half_length }) - half_length * direction.z.abs()).abs() < 1e-15);
            assert_eq!(reach(&Core::Point), 0.0);
        }
    }

    #[test]
    fn a_crust_is_even_or_as_thick_as_the_ratio_makes_it() {
        let rod = Convex::Cylinder(Cylinder { radius: 0.1, length: 2.0 });
        let core = |rounded: Option<RoundedCore>| rounded.map(|rounded| (rounded.core, rounded.radius)).unwrap();
        let even = core(RoundedCore::with_crust(&rod, 0.01));
        assert_eq!(even, (Core::Cylinder { radius: 0.1 - 0.01, half_length: 1.0 - 0.01 }, 0.01));
        let (Core::Cylinder { radius, half_length }, 0.01) = core(RoundedCore::shrunk_by_ratio(&rod, 0.01)) else { panic!("a cylinder") };
        assert!((radius - 0.09).abs() < 1e-15 && (half_length - 0.9).abs() < 1e-15);
        let round = Convex::Spherocylinder(Spherocylinder { radius: 0.1, length: 1.0 });
        assert_eq!(core(RoundedCore::with_crust(&round, 0.01)), (Core::Segment { half_length: 0.5 }, 0.1));
        let thin = Convex::Cuboid(Cuboid { lengths: Vector::new(1.0, 1.0, 0.02) });
        assert_eq!((RoundedCore::with_crust(&thin, 0.01), RoundedCore::shrunk_by_ratio(&thin, 0.01)), (None, None));
    }
}
