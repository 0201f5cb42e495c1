//! The shapes of the case, each once for the solver and once, from its own numbers, for the certificate.

use nalgebra::Vector3;
use solver::shape::{Convex, Cuboid, Cylinder, Polyhedron, Sphere, Spherocylinder, Superellipsoid};

use crate::exact::distance_certificate::{Body, Hull, Solid};

/// A shape whose largest dimension is about its size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Sphere,
    Cube,
    Cylinder,
    /// A cylinder ten times as long as wide.
    Rod,
    /// A cylinder ten times as wide as long.
    Coin,
    Spherocylinder,
    Tetrahedron,
    Icosahedron,
    Ellipsoid,
    /// A superellipsoid that is blunt towards its poles and has ridges on its sides.
    Pebble,
}

impl Kind {
    pub const ALL: [Kind; 10] = [
        Kind::Sphere,
        Kind::Cube,
        Kind::Cylinder,
        Kind::Rod,
        Kind::Coin,
        Kind::Spherocylinder,
        Kind::Tetrahedron,
        Kind::Icosahedron,
        Kind::Ellipsoid,
        Kind::Pebble,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Kind::Sphere => "sphere",
            Kind::Cube => "cube",
            Kind::Cylinder => "cylinder",
            Kind::Rod => "rod 10:1",
            Kind::Coin => "coin 1:10",
            Kind::Spherocylinder => "spherocylinder",
            Kind::Tetrahedron => "tetrahedron",
            Kind::Icosahedron => "icosahedron",
            Kind::Ellipsoid => "ellipsoid",
            Kind::Pebble => "pebble",
        }
    }

    /// Whether Newton's method has the last word on its distances, which ends at a certified gap instead of rounding.
    pub fn is_curved(self) -> bool {
        matches!(self, Kind::Cylinder | Kind::Rod | Kind::Coin) || self.is_superellipsoid()
    }

    /// Whether it has no edges.
    pub fn is_superellipsoid(self) -> bool {
        matches!(self, Kind::Ellipsoid | Kind::Pebble)
    }

    /// Semi-axes over the size, and exponents, of a superellipsoid.
    fn semi_axes_and_exponents(self) -> (Vector3<f64>, [f64; 2]) {
        (Vector3::new(0.5, 0.35, 0.25), if self == Kind::Pebble { [0.6, 1.3] } else { [1.0, 1.0] })
    }

    /// Radius and length over the size.
    fn proportions(self) -> (f64, f64) {
        match self {
            Kind::Rod => (0.05, 1.0),
            Kind::Coin => (0.5, 0.1),
            Kind::Spherocylinder => (0.25, 0.5),
            _ => (0.5, 1.0),
        }
    }

    /// The shape as the solver has it, of a size in m. `None` cannot happen for positive sizes.
    pub fn convex(self, size: f64) -> Option<Convex> {
        let (radius, length) = (self.proportions().0 * size, self.proportions().1 * size);
        Some(match self {
            Kind::Sphere => Convex::Sphere(Sphere { radius }),
            Kind::Cube => Convex::Cuboid(Cuboid { lengths: Vector3::repeat(size) }),
            Kind::Cylinder | Kind::Rod | Kind::Coin => Convex::Cylinder(Cylinder { radius, length }),
            Kind::Spherocylinder => Convex::Spherocylinder(Spherocylinder { radius, length }),
            Kind::Tetrahedron => Convex::Polyhedron(Polyhedron::tetrahedron(size).ok()?.into()),
            Kind::Icosahedron => Convex::Polyhedron(Polyhedron::icosahedron(0.5 * size).ok()?.into()),
            Kind::Ellipsoid | Kind::Pebble => {
                let (semi_axes, exponents) = self.semi_axes_and_exponents();
                Convex::Superellipsoid(Superellipsoid::new(semi_axes * size, exponents).ok()?.into())
            }
        })
    }

    /// The same body for the certificate, from the numbers above and nothing of the solver.
    pub fn body(self, size: f64) -> Body {
        let (radius, length) = (self.proportions().0 * size, self.proportions().1 * size);
        let sharp = |core| Body { core, rounding: 0.0 };
        match self {
            Kind::Sphere => Body { core: Solid::Point, rounding: radius },
            Kind::Cube => sharp(Solid::Box(Vector3::repeat(0.5 * size))),
            Kind::Cylinder | Kind::Rod | Kind::Coin => sharp(Solid::Cylinder(radius, 0.5 * length)),
            Kind::Spherocylinder => Body { core: Solid::Line(0.5 * length), rounding: radius },
            Kind::Tetrahedron => sharp(Solid::Hull(Hull::new(tetrahedron(size)))),
            Kind::Icosahedron => sharp(Solid::Hull(Hull::new(icosahedron(0.5 * size)))),
            Kind::Ellipsoid | Kind::Pebble => {
                let (semi_axes, exponents) = self.semi_axes_and_exponents();
                sharp(Solid::Superellipsoid(semi_axes * size, exponents))
            }
        }
    }
}

/// Every other corner of a cube.
fn tetrahedron(edge: f64) -> Vec<Vector3<f64>> {
    let scale = edge / 8.0_f64.sqrt();
    [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(|corner| Vector3::from(corner) * scale).to_vec()
}

/// Corners of three golden rectangles.
fn icosahedron(edge: f64) -> Vec<Vector3<f64>> {
    let (short, long) = (0.5 * edge, 0.25 * edge * (1.0 + 5.0_f64.sqrt()));
    let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let corners = |(one, other): (f64, f64)| {
        let (a, b) = (one * short, other * long);
        [Vector3::new(0.0, a, b), Vector3::new(a, b, 0.0), Vector3::new(b, 0.0, a)]
    };
    signs.into_iter().flat_map(corners).collect()
}
