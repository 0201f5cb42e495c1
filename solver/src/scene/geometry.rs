//! Shapes as a scene gives them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{identity, is_identity};

/// A shape with a name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NamedShape {
    /// Name that bodies refer to.
    pub name: String,
    /// The geometry.
    pub geometry: Geometry,
}

/// The geometry of a shape.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Geometry {
    /// A ball.
    Sphere(SphereGeometry),
    /// A rectangular box.
    Cuboid(CuboidGeometry),
    /// A cylinder; its axis is z.
    Cylinder(RodGeometry),
    /// A cylinder with half a ball on either end; its axis is z.
    Spherocylinder(RodGeometry),
    /// A regular tetrahedron.
    Tetrahedron(RegularGeometry),
    /// A regular octahedron.
    Octahedron(RegularGeometry),
    /// A regular icosahedron.
    Icosahedron(RegularGeometry),
    /// A convex polyhedron by its corners and faces.
    Polyhedron(PolyhedronGeometry),
    /// The convex hull of points.
    Hull(HullGeometry),
    /// A superellipsoid (S eq. 2.1).
    Superellipsoid(SuperellipsoidGeometry),
    /// Several shapes glued together, which may overlap (R section 2.2).
    Composite(CompositeGeometry),
    /// Three touching cylinders along z and the prism between their axes (R figure 7.3).
    Trilobe(LobeGeometry),
    /// Four touching cylinders along z and the box between their axes (R figure 7.3).
    Quadralobe(LobeGeometry),
    /// Two equal cylinders that cross in the middle at right angles, along x and y (R figure 3.12).
    CrossInPlane(RodGeometry),
    /// Three equal cylinders that cross in the middle at right angles (R figure 3.12).
    CrossInSpace(RodGeometry),
}

impl Geometry {
    /// The word a scene file uses for it.
    pub fn name(&self) -> &'static str {
        match self {
            Geometry::Sphere(_) => "sphere",
            Geometry::Cuboid(_) => "cuboid",
            Geometry::Cylinder(_) => "cylinder",
            Geometry::Spherocylinder(_) => "spherocylinder",
            Geometry::Tetrahedron(_) => "tetrahedron",
            Geometry::Octahedron(_) => "octahedron",
            Geometry::Icosahedron(_) => "icosahedron",
            Geometry::Polyhedron(_) => "polyhedron",
            Geometry::Hull(_) => "hull",
            Geometry::Superellipsoid(_) => "superellipsoid",
            Geometry::Composite(_) => "composite",
            Geometry::Trilobe(_) => "trilobe",
            Geometry::Quadralobe(_) => "quadralobe",
            Geometry::CrossInPlane(_) => "cross_in_plane",
            Geometry::CrossInSpace(_) => "cross_in_space",
        }
    }

    /// Whether it can be a part of a composite.
    pub fn is_convex(&self) -> bool {
        !matches!(
            self,
            Geometry::Composite(_) | Geometry::Trilobe(_) | Geometry::Quadralobe(_) | Geometry::CrossInPlane(_) | Geometry::CrossInSpace(_)
        )
    }
}

/// A ball.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SphereGeometry {
    /// Radius in m, above zero.
    pub radius: f64,
}

/// A rectangular box.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CuboidGeometry {
    /// Full edge lengths in m, each above zero.
    pub lengths: [f64; 3],
}

/// A straight rod, or several equal ones.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RodGeometry {
    /// Radius in m, above zero.
    pub radius: f64,
    /// Length in m, above zero: of a spherocylinder the straight part, of a cross each rod, at least its diameter.
    pub length: f64,
}

/// A superellipsoid: the surface $(|x/a_1|^{2/e_2} + |y/a_2|^{2/e_2})^{e_2/e_1} + |z/a_3|^{2/e_1} = 1$.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SuperellipsoidGeometry {
    /// Semi-axes in m, each above zero.
    pub semi_axes: [f64; 3],
    /// Exponents towards z and in the plane of x and y, each above 0 and at most 2: 1 is round, towards 0 square, 2 pointed.
    pub exponents: [f64; 2],
}

/// A regular polyhedron.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RegularGeometry {
    /// Length of an edge in m, above zero.
    pub edge: f64,
}

/// A convex polyhedron.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PolyhedronGeometry {
    /// Corners in m. The shape is moved so that its centre of mass is its origin.
    pub vertices: Vec<[f64; 3]>,
    /// Corners of each face by number, from 0, counterclockwise seen from outside.
    pub faces: Vec<Vec<usize>>,
}

/// The convex hull of points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HullGeometry {
    /// Points in m; those inside the hull do not count. The shape is moved so that its centre of mass is its origin.
    pub points: Vec<[f64; 3]>,
}

/// Several shapes glued together.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CompositeGeometry {
    /// The parts, in any order. The shape is moved so that its centre of mass is its origin, unless mass properties are given.
    pub parts: Vec<PartGeometry>,
    /// Mass properties, if they are known. Absent: those of the union of the parts, exact where there is a way, else by counting cells (R section 2.3).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass_properties: Option<GivenMassProperties>,
}

/// Known mass properties of a composite whose parts are given about its centre of mass, along its principal axes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GivenMassProperties {
    /// Volume in m^3, above zero.
    pub volume: f64,
    /// Mean squares of the coordinates over the volume in m^2, each above zero: half the sum of two principal moments less the third, per mass.
    pub mean_squares: [f64; 3],
}

/// A part of a composite.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PartGeometry {
    /// Name of another shape of the scene, convex.
    pub shape: String,
    /// Its centre in the frame of the composite, in m.
    #[serde(default)]
    pub position: [f64; 3],
    /// Quaternion [w, x, y, z] from the part to the composite, of any length but zero.
    #[serde(default = "identity", skip_serializing_if = "is_identity")]
    pub orientation: [f64; 4],
}

/// A prism with lobes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LobeGeometry {
    /// Diameter in m of the circle round all lobes, above zero.
    pub diameter: f64,
    /// Length in m along z, above zero.
    pub length: f64,
}
