//! The scene: the world as plain data, from a Rust literal or a TOML file.
//!
//! An absent table is absent physics. The doc comments of the fields below are the reference page of scene keys: [`keys`] reads
//! them from the schema, so the page cannot differ from the code. [`Scene::build`](crate::build) resolves a scene into a
//! [`Simulation`](crate::Simulation).

mod boundary;
mod contact_laws;
mod error;
mod geometry;
mod hard;
mod hard_checks;
mod insertion;
pub mod keys;
mod load;
mod validate;
mod validate_laws;

pub use boundary::{
    Boundary, BoundaryGeometry, BoundaryMotion, BoxGeometry, CylinderWallGeometry, HopperGeometry, MeshGeometry, OscillationMotion,
    PlaneGeometry, PlateGeometry, RotationMotion, Side, TranslationMotion,
};
pub use contact_laws::{ConstantTorque, Elasticity, Hertz, Mindlin, RollingLaw, SpringTorque, ViscousSpring};
pub use error::{SceneError, SceneErrorKind};
pub use geometry::{
    CompositeGeometry, CuboidGeometry, Geometry, GivenMassProperties, HullGeometry, LobeGeometry, NamedShape, PartGeometry,
    PolyhedronGeometry, RegularGeometry, RodGeometry, SphereGeometry, SuperellipsoidGeometry,
};
pub use hard::{CoulombImpulse, EventDrivenContact, FrictionClamp, HardContact, ImpulseRestitution, TimeDrivenContact};
pub use insertion::{
    BoxRegion, DuringRun, InsertedOrientation, InsertedShape, Insertion, InsertionRegion, LatticeRegion, PointRegion, RandomOrientation,
    RectangleRegion,
};

pub use crate::contact::law::EndOfContact;
pub use crate::contact::sharing::{DampedMass, Sharing};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A particle scene. SI units, angles in radians; unknown keys are refused.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Name, gravity, end time and seed.
    pub scene: General,
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
    /// Walls.
    #[serde(default, rename = "boundary")]
    pub boundaries: Vec<Boundary>,
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

/// A normal contact law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum NormalLaw {
    /// Linear spring and dashpot in parallel.
    LinearSpringDashpot(LinearSpringDashpot),
    /// Impulses of hard bodies: no overlap, no duration. Hard and soft pairs do not go together in one scene.
    Impulse(ImpulseRestitution),
    /// Hertz's spring between spheres, or a sphere and a wall, and Tsuji's dashpot.
    Hertz(Hertz),
}

/// Linear spring and dashpot in parallel (R eq. 3.18-3.19, S eq. 3.35).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LinearSpringDashpot {
    /// Spring stiffness in N/m, above zero.
    pub stiffness: f64,
    /// Coefficient of restitution: rebound over impact velocity of an isolated head-on contact. In [0, 1]; the dashpot is
    /// calibrated for the chosen end of contact, and `no_attraction` needs it above zero.
    pub restitution: f64,
    /// When a contact ends.
    #[serde(default)]
    pub end_of_contact: EndOfContact,
}

/// A tangential contact law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum TangentialLaw {
    /// Viscous friction capped by Coulomb's law: no memory and no static friction (R eq. 3.20-3.21).
    ViscousCoulomb(ViscousCoulomb),
    /// Tangential spring with memory, capped by Coulomb's law (S eq. 3.41-3.42, 3.47).
    LinearHistory(LinearHistory),
    /// Impulse of friction; goes with a normal impulse only.
    CoulombImpulse(CoulombImpulse),
    /// Tangential spring whose stretch is guessed from the velocity, capped by Coulomb's law (S eq. 3.43-3.47): no memory.
    ViscousSpring(ViscousSpring),
    /// Mindlin's tangential spring with memory for elastic spheres, capped by Coulomb's law.
    Mindlin(Mindlin),
}

/// Viscous friction capped by Coulomb's law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ViscousCoulomb {
    /// Coulomb coefficient, zero or above. The cap uses the elastic part of the normal force, as R eq. 3.20 does.
    pub friction: f64,
    /// Dissipation rate gamma_t in 1/s, zero or above: the force is `2 gamma_t m_reduced v_t` below the cap.
    pub damping_rate: f64,
}

/// Tangential spring with memory, capped by Coulomb's law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LinearHistory {
    /// Coulomb coefficient, zero or above; the cap uses the total normal force.
    pub friction: f64,
    /// Tangential spring stiffness in N/m, above zero.
    pub stiffness: f64,
    /// Damping of the tangential oscillation as a fraction of critical, zero or above; critical refers to the tangential effective mass
    /// (2/7 of the reduced mass for spheres).
    #[serde(default)]
    pub damping_ratio: f64,
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

/// Time step and numerical methods.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Numerics {
    /// Time step in s, or "advise": the shortest contact duration over `steps_per_contact`.
    #[serde(default)]
    pub step: Step,
    /// Steps in the shortest contact, used by "advise".
    #[serde(default)]
    pub steps_per_contact: StepsPerContact,
    /// At which time the velocity in a damping force is taken.
    #[serde(default)]
    pub damping: DampingTime,
    /// How the first and the last step of a contact are weighted.
    #[serde(default)]
    pub contact_edges: ContactEdges,
    /// How orientations are advanced. Spheres need none of it.
    #[serde(default)]
    pub rotation: Rotation,
    /// Whether bodies may overlap at the start.
    #[serde(default)]
    pub initial_overlap: InitialOverlap,
    /// How bodies touch that are not spheres.
    #[serde(default)]
    pub shaped_contact: ShapedContact,
    /// How collisions of hard bodies are found. Only with pairs that have impulses; absent: event-driven.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hard_contact: Option<HardContact>,
}

/// How bodies touch that are not spheres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ShapedContact {
    /// How several contact points between the same two bodies share the contact law.
    pub sharing: Sharing,
    /// Which mass the normal dashpot is calibrated for.
    pub damped_mass: DampedMass,
    /// How many points of a flat or straight contact are looked at.
    pub points: ContactPoints,
    /// Thickness of the crust by which edges are rounded, as a part of the radius of the largest ball about the centre that fits into the part. In
    /// (0, 1). Contacts deeper than both crusts together lose their exact normal.
    pub crust: f64,
    /// How a shape is shrunk to the core inside its crust.
    pub crust_form: CrustForm,
    /// Whether edges are rounded against walls too. Absent: walls meet the sharp shape.
    pub crust_at_walls: bool,
    /// How superellipsoids touch each other and walls.
    pub superellipsoids: SuperellipsoidContact,
    /// Vertices of a superellipsoid in each angle, where contacts are found by them, from 4 to 1000; a surface has the square of it.
    pub vertices: u32,
    /// How the vertices' angle towards z is spaced.
    pub vertex_spacing: VertexSpacing,
}

impl Default for ShapedContact {
    fn default() -> Self {
        ShapedContact {
            sharing: Sharing::default(),
            damped_mass: DampedMass::default(),
            points: ContactPoints::default(),
            crust: 0.02,
            crust_form: CrustForm::default(),
            crust_at_walls: false,
            superellipsoids: SuperellipsoidContact::default(),
            vertices: 20,
            vertex_spacing: VertexSpacing::default(),
        }
    }
}

/// How superellipsoids touch each other and walls.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SuperellipsoidContact {
    /// At the common normal of the smooth surfaces.
    #[default]
    Continuous,
    /// By the vertices of each that lie inside the other (S section 2.4); a contact that one side alone sees counts.
    Vertices,
    /// As S: a contact that one side alone sees is left out.
    VerticesOfBothSides,
}

/// How the angle towards z is spaced (S figure 2-3).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum VertexSpacing {
    /// In equal steps.
    #[default]
    Linear,
    /// In equal ratios, so that a straight side has vertices too.
    Exponential,
}

/// How many points of a flat or straight contact are looked at.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ContactPoints {
    /// All corners of the common piece of two faces or edges.
    #[default]
    All,
    /// The deepest only, as R does: on a face or a line it may lie anywhere.
    Deepest,
}

/// How a shape is shrunk to the core inside its crust.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CrustForm {
    /// By the same thickness everywhere: overlaps are exact.
    #[default]
    Even,
    /// By a ratio, as R does, with the crust counted as if it were even: overlaps of elongated shapes are wrong.
    ByRatio,
}

/// A time step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "a time step in seconds, or \"advise\"")]
pub enum Step {
    /// In s.
    Seconds(f64),
    /// Chosen by the solver.
    Chosen(StepChoice),
}

/// How the solver chooses a time step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StepChoice {
    /// The shortest contact duration over `steps_per_contact`.
    Advise,
}

impl Default for Step {
    fn default() -> Self {
        Step::Chosen(StepChoice::Advise)
    }
}

/// Steps in the shortest contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct StepsPerContact(pub f64);

impl Default for StepsPerContact {
    fn default() -> Self {
        StepsPerContact(50.0)
    }
}

/// At which time the velocity in a damping force is taken.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DampingTime {
    /// At the time of the force: predicted, with the contact's own share implicit. Second order.
    #[default]
    Centred,
    /// Half a step earlier, as most codes do. First order.
    Lagged,
}

/// How the first and the last step of a contact are weighted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ContactEdges {
    /// By the part of the step in which the bodies touch. Second order for every start phase.
    #[default]
    Resolved,
    /// As a whole step or not at all, as most codes do. First order with damping.
    Sampled,
}

/// How orientations are advanced.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Rotation {
    /// Symplectic splitting into rotations about the body axes in the order 1-2-3-2-1: second order, angular momentum exact, no
    /// energy drift. Axisymmetric bodies turn exactly, by precession and spin.
    #[default]
    Splitting,
    /// The splitting for every body, without the exact shortcut for axisymmetric ones.
    SplittingWithoutShortcut,
    /// Three splittings in a row with Suzuki-Yoshida weights: fourth order, angular momentum exact.
    SplittingFourthOrder,
    /// Classical Runge-Kutta of fourth order on quaternion and momentum: a reference, not symplectic.
    RungeKuttaFourthOrder,
    /// Angular velocity by explicit Euler, then one exact turn (S eq. 2.8-2.15) with the gyroscopic term that S eq. 3.49 lacks. First order.
    ExplicitEuler,
    /// The same without the gyroscopic term, as S eq. 3.49 prints it: wrong for anything but spheres.
    ExplicitEulerAsPrinted,
}

/// Whether bodies may overlap at the start.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum InitialOverlap {
    /// An overlap is an error that names the pair.
    #[default]
    Refuse,
    /// The run starts with loaded springs.
    Allow,
}

/// Something observed over time; a column group of probes.csv.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Probe {
    /// What is observed.
    pub measure: Measure,
    /// Id of the body, for the measures of one body. Absent: every body in turn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<u32>,
}

/// What a probe observes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Centre of mass of a body in m.
    Position,
    /// Velocity of a body in m/s.
    Velocity,
    /// Orientation quaternion of a body.
    Orientation,
    /// Angular velocity of a body in rad/s, world frame.
    AngularVelocity,
    /// Kinetic energy of all bodies, translation and rotation, in J.
    KineticEnergy,
    /// Energy of all bodies in the gravity field, zero at the origin, in J.
    GravitationalEnergy,
    /// Energy stored in contact springs in J.
    ElasticEnergy,
    /// Sum of the three energies in J.
    TotalEnergy,
    /// Linear momentum of all bodies in kg m/s.
    Momentum,
    /// Angular momentum of all bodies about the origin in kg m^2/s.
    AngularMomentum,
    /// Number of touching contacts.
    Contacts,
    /// Largest overlap of any contact in m.
    LargestOverlap,
}

impl Measure {
    /// Whether it is observed body by body.
    pub fn is_of_one_body(self) -> bool {
        matches!(self, Measure::Position | Measure::Velocity | Measure::Orientation | Measure::AngularVelocity)
    }
}

/// What is written, and how often.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// Time between rows of probes.csv in s. Absent: one row each step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub probe_interval: Option<f64>,
    /// Time between VTK snapshots in s. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vtk_interval: Option<f64>,
    /// Time between checkpoints in s. Absent: none but the one at the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub checkpoint_interval: Option<f64>,
    /// Advance the orientation of spheres too, for pictures; nothing else needs it.
    #[serde(default)]
    pub sphere_orientation: bool,
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
            scene: General { name: name.to_string(), gravity: None, end_time, random_seed: 0 },
            materials: Vec::new(),
            pairs: Vec::new(),
            shapes: Vec::new(),
            bodies: Vec::new(),
            insertions: Vec::new(),
            boundaries: Vec::new(),
            numerics: Numerics::default(),
            probes: Vec::new(),
            output: Output::default(),
        }
    }
}
