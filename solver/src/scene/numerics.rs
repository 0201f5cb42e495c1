//! Time step and numerical methods of a scene.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{HardContact, NeighbourSearch, ShapedContact};

/// Time step and numerical methods.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Numerics {
    /// Time step in s, or "advise": the shortest contact duration over `steps_per_contact`. With a `[fluid]` it is made shorter until it divides the step of that.
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
    /// How it is found out which bodies may touch.
    #[serde(default)]
    pub neighbours: NeighbourSearch,
    /// How collisions of hard bodies are found. Only with pairs that have impulses; absent: event-driven.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hard_contact: Option<HardContact>,
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
