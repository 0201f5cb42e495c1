//! The scene: the world as plain data, from a Rust literal or a TOML file.
//!
//! An absent table is absent physics. The doc comments of the fields below are the reference page of scene keys: [`keys`] reads
//! them from the schema, so the page cannot differ from the code. [`Scene::build`](crate::build) resolves a scene into a
//! [`Simulation`](crate::Simulation).

mod boundary;
mod contact_laws;
mod domain;
mod error;
mod flow;
mod geometry;
mod hard;
mod hard_checks;
mod insertion;
pub mod keys;
mod load;
mod numerics;
mod outlet;
mod output;
mod shaped_contact;
mod validate;
mod validate_laws;

pub use boundary::{
    Boundary, BoundaryGeometry, BoundaryMotion, BoxGeometry, CylinderWallGeometry, HopperGeometry, MeshGeometry, OscillationMotion,
    PlaneGeometry, PlateGeometry, RotationMotion, Side, TranslationMotion,
};
pub use contact_laws::{
    ConstantTorque, Elasticity, EndOfContact, Hertz, LinearHistory, LinearSpringDashpot, Mindlin, NormalLaw, RollingLaw, SpringTorque,
    TangentialLaw, ViscousCoulomb, ViscousSpring,
};
pub use domain::{Domain, NeighbourSearch, SearchMethod};
pub use error::{SceneError, SceneErrorKind};
pub use flow::{Coupling, Direction, Fluid, ImmersedMotion, MovingSides, ResolvedCoupling};
pub use geometry::{
    CompositeGeometry, CuboidGeometry, Geometry, GivenMassProperties, HullGeometry, LobeGeometry, NamedShape, PartGeometry,
    PolyhedronGeometry, RegularGeometry, RodGeometry, SphereGeometry, SuperellipsoidGeometry,
};
pub use hard::{CoulombImpulse, EventDrivenContact, FrictionClamp, HardContact, ImpulseRestitution, TimeDrivenContact};
pub use insertion::{
    BoxRegion, DuringRun, InsertedOrientation, InsertedShape, Insertion, InsertionRegion, LatticeRegion, PointRegion, RandomOrientation,
    RectangleRegion,
};
pub use numerics::{ContactEdges, DampingTime, InitialOverlap, Numerics, Rotation, Step, StepChoice, StepsPerContact};
pub use outlet::{Outlet, OutletRegion};
pub use output::{Measure, Output, Probe};
pub use shaped_contact::{ContactPoints, CrustForm, DampedMass, ShapedContact, Sharing, SuperellipsoidContact, VertexSpacing};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A particle scene. SI units, angles in radians; unknown keys are refused.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Name, gravity, end time and seed.
    pub scene: General,
    /// The box that bodies live in, if it repeats.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub domain: Option<Domain>,
    /// Materials that bodies and boundaries are made of.
    #[serde(default, rename = "material")]
    pub materials: Vec<Material>,
    /// What happens when two materials touch. Materials without a pair pass through each other.
    #[serde(default, rename = "pair")]
    pub pairs: Vec<Pair>,
    /// Shapes that bodies refer to by name.
    #[serde(default, rename = "shape")]
    pub shapes: Vec<NamedShape>,
    /// Everything that moves.
    #[serde(default, rename = "body")]
    pub bodies: Vec<Body>,
    /// Bodies that come in numbers, before the start or during the run.
    #[serde(default, rename = "insertion", skip_serializing_if = "Vec::is_empty")]
    pub insertions: Vec<Insertion>,
    /// Where bodies leave the run.
    #[serde(default, rename = "outlet", skip_serializing_if = "Vec::is_empty")]
    pub outlets: Vec<Outlet>,
    /// Walls.
    #[serde(default, rename = "boundary")]
    pub boundaries: Vec<Boundary>,
    /// What flows between bodies.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fluid: Option<Fluid>,
    /// How bodies meet the fluid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coupling: Option<Coupling>,
    /// Time step and numerical methods.
    #[serde(default)]
    pub numerics: Numerics,
    /// What is observed over time.
    #[serde(default, rename = "probe")]
    pub probes: Vec<Probe>,
    /// What is written, and how often.
    #[serde(default)]
    pub output: Output,
}

/// Name, gravity, end time and seed of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct General {
    /// Name of the scene; it heads outputs.
    pub name: String,
    /// Acceleration of gravity in m/s^2. Absent: no gravity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity: Option<[f64; 3]>,
    /// End of the simulated time in s; the run ends with the first step that reaches it.
    pub end_time: f64,
    /// Seed of every random choice.
    #[serde(default)]
    pub random_seed: u64,
    /// The run ends before `end_time` once all bodies are in and at rest. Absent: it does not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub settled: Option<Settled>,
}

/// When bodies count as being at rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Settled {
    /// Root mean square speed in m/s, above zero, that all bodies together must stay below: the root of twice their kinetic energy, of turning too, over their
    /// mass.
    pub speed: f64,
    /// For how long in s, above zero: longer than bodies take to fall or turn round.
    pub hold: f64,
}

/// A material.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Name that bodies, boundaries and pairs refer to.
    pub name: String,
    /// Density in kg/m^3. Needed unless every body of the material gives its own mass.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub density: Option<f64>,
}

/// What happens when two materials touch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pair {
    /// The two materials, in any order; the same name twice for like on like.
    pub materials: [String; 2],
    /// Force along the contact normal.
    pub normal: NormalLaw,
    /// Force in the contact plane. Absent: frictionless.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangential: Option<TangentialLaw>,
    /// Torque against rolling, between spheres or a sphere and a wall. Absent: they roll freely.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rolling: Option<RollingLaw>,
}

/// A body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Name of its shape.
    pub shape: String,
    /// Name of its material.
    pub material: String,
    /// Stable number of the body, unique. Absent: its position in the file, from 0. Results do not depend on the order of
    /// bodies in the file once ids are given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub id: Option<u32>,
    /// Mass in kg, above zero. Absent: density times volume.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass: Option<f64>,
    /// Principal moments of inertia about the body axes in kg m^2, each above zero and none above the sum of the other two. Absent:
    /// those of the shape with its mass.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub principal_inertia: Option<[f64; 3]>,
    /// Centre of mass in m.
    pub position: [f64; 3],
    /// Velocity of the centre of mass in m/s.
    #[serde(default)]
    pub velocity: [f64; 3],
    /// Quaternion [w, x, y, z] from body to world, of any length but zero. Not for spheres that need no orientation.
    #[serde(default = "identity", skip_serializing_if = "is_identity")]
    pub orientation: [f64; 4],
    /// Angular velocity in the world frame, in rad/s.
    #[serde(default)]
    pub angular_velocity: [f64; 3],
}

pub(crate) fn identity() -> [f64; 4] {
    [1.0, 0.0, 0.0, 0.0]
}

pub(crate) fn is_identity(orientation: &[f64; 4]) -> bool {
    *orientation == identity()
}

impl Body {
    /// A body at rest at the origin: the start of a Rust literal.
    pub fn new(shape: &str, material: &str) -> Body {
        Body {
            shape: shape.to_string(),
            material: material.to_string(),
            id: None,
            mass: None,
            principal_inertia: None,
            position: [0.0; 3],
            velocity: [0.0; 3],
            orientation: identity(),
            angular_velocity: [0.0; 3],
        }
    }
}

impl Scene {
    /// A scene with nothing in it but a name and an end time: the start of a Rust literal.
    pub fn empty(name: &str, end_time: f64) -> Scene {
        Scene {
            scene: General { name: name.to_string(), gravity: None, end_time, random_seed: 0, settled: None },
            domain: None,
            materials: Vec::new(),
            pairs: Vec::new(),
            shapes: Vec::new(),
            bodies: Vec::new(),
            insertions: Vec::new(),
            outlets: Vec::new(),
            boundaries: Vec::new(),
            fluid: None,
            coupling: None,
            numerics: Numerics::default(),
            probes: Vec::new(),
            output: Output::default(),
        }
    }
}
