//! Contact laws. One file per law.
//!
//! A law sees one contact during one step and answers with the *mean force over the part of that step in which the bodies touch*.
//! What it must remember between steps is its associated type, so that a law without memory stores nothing.

pub mod frictionless;
pub mod linear_history;
pub mod linear_spring_dashpot;
pub mod viscous_coulomb;

use serde::Serialize;
use serde::de::DeserializeOwned;

pub use frictionless::Frictionless;
pub use linear_history::LinearHistory;
pub use linear_spring_dashpot::{EndOfContact, LinearSpringDashpot};
pub use viscous_coulomb::ViscousCoulomb;

use crate::Vector;

/// How the step is being taken, the same for every contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepKind {
    /// Step in s.
    pub step: f64,
    /// True while velocities still live at the time of the positions: before the first kick of a run. Predictions are then exact
    /// and no step came before, so neither the implicit share nor the contact edges apply.
    pub synchronous: bool,
    /// Take damping velocities half a step early, as most codes do.
    pub lagged_damping: bool,
    /// Weight the first and the last step of a contact by the part in which the bodies touch.
    pub resolved_edges: bool,
}

/// The tangential side of a contact during one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TangentialContact {
    /// Unit normal from the first partner to the second.
    pub normal: Vector,
    /// Relative velocity in the contact plane, mean over the last step, in m/s.
    pub velocity: Vector,
    /// Relative acceleration in the contact plane predicted for the time of the force, in m/s^2.
    pub acceleration: Vector,
    /// Mean normal force over the step in N.
    pub normal_force: f64,
    /// Elastic part of the normal force in N.
    pub elastic_force: f64,
    /// Effective mass of the contact point along the contact plane, in kg.
    pub effective_mass: f64,
    /// Reduced mass of the partners, in kg.
    pub reduced_mass: f64,
    /// The part of the law's spring and dashpot that this contact point carries.
    pub share: f64,
    /// Length of the part of the last step, in steps, in which the bodies touched: 1 inside a contact, less at its start.
    pub touched_before: f64,
    /// Length of the part of the time covered by the force, in steps, in which the bodies touch: 1 inside a contact.
    pub touched: f64,
}

/// A force in the contact plane.
pub trait TangentialLaw: Clone + Send + Sync + 'static {
    /// What a contact remembers from step to step.
    type History: Clone + Default + Send + Sync + Serialize + DeserializeOwned;
    /// Whether the force can turn bodies. If no law of a scene needs rotation, rotation is left out.
    const NEEDS_ROTATION: bool;
    /// Name for the ledger.
    const NAME: &'static str;

    /// Mean force on the first partner over the step, in N.
    fn mean_force(&self, contact: &TangentialContact, kind: &StepKind, history: &mut Self::History) -> Vector;

    /// Energy stored in the tangential spring of a point that carries a share of the law, in J.
    fn stored_energy(&self, history: &Self::History, share: f64) -> f64;

    /// Half period in s of a contact point on the tangential spring; infinite without a spring.
    fn half_period(&self, effective_mass: f64) -> f64;

    /// Time in s in which the dashpot alone would stop a contact point, halved; infinite without a dashpot.
    fn damping_time(&self, effective_mass: f64, reduced_mass: f64) -> f64;

    /// Largest stable step in s for a contact point of given effective and reduced mass.
    fn largest_step(&self, effective_mass: f64, reduced_mass: f64, lagged_damping: bool) -> f64;
}

/// Largest stable leapfrog step in s of a damped oscillator: $2/\omega$ if its damping is centred, however strong, and
/// $2(\sqrt{1 + \zeta^2} - \zeta)/\omega$ if it is lagged.
pub fn largest_step_of_oscillator(angular_frequency: f64, damping_ratio: f64, lagged_damping: bool) -> f64 {
    let reduction = if lagged_damping { 1.0_f64.hypot(damping_ratio) - damping_ratio } else { 1.0 };
    2.0 * reduction / angular_frequency
}
