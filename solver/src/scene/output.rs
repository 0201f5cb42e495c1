//! What of a scene is observed and written.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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
    /// Number of bodies that are there.
    Bodies,
    /// Number of bodies that have left.
    BodiesLeft,
    /// Mass that has left in kg.
    MassLeft,
    /// Root mean square speed of all bodies in m/s, as `scene.settled` means it.
    RootMeanSquareSpeed,
    /// Force of the fluid on a body in N, without the hydrostatic one; that of the last step of the fluid.
    FluidForce,
    /// Torque of the fluid on a body about its centre in N m, without the rate of change of the angular momentum of the fluid that fills it.
    FluidTorque,
    /// Mean velocity in m/s over the whole box of the fluid, bodies included.
    MeanFlow,
    /// Mean pressure gradient of the fluid in Pa/m, without the hydrostatic one.
    MeanPressureGradient,
}

impl Measure {
    /// Whether it is observed body by body.
    pub fn is_of_one_body(self) -> bool {
        matches!(self, Measure::Position | Measure::Velocity | Measure::Orientation | Measure::AngularVelocity)
            || self.is_of_fluid_on_body()
    }

    fn is_of_fluid_on_body(self) -> bool {
        matches!(self, Measure::FluidForce | Measure::FluidTorque)
    }

    /// Whether there must be a fluid.
    pub fn needs_fluid(self) -> bool {
        self.is_of_fluid_on_body() || matches!(self, Measure::MeanFlow | Measure::MeanPressureGradient)
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
