//! Contact laws. One file per law.
//!
//! A law sees one contact during one step and answers with the *mean force over the part of that step in which the bodies touch*.
//! What it must remember between steps is its associated type, so that a law without memory stores nothing.

mod carried;
pub mod frictionless;
pub mod hertz;
pub mod linear_history;
pub mod linear_spring_dashpot;
pub mod mindlin;
pub mod normal;
pub mod rolling;
mod sliding;
pub mod viscous_coulomb;
pub mod viscous_spring;

use serde::Serialize;
use serde::de::DeserializeOwned;

pub use frictionless::Frictionless;
pub use hertz::Hertz;
pub use linear_history::LinearHistory;
pub use linear_spring_dashpot::{EndOfContact, LinearSpringDashpot};
pub use mindlin::Mindlin;
pub use normal::NormalLaw;
pub use rolling::{NoRolling, RollingLaw};
pub use viscous_coulomb::ViscousCoulomb;
pub use viscous_spring::ViscousSpring;

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

impl StepKind {
    /// How long ago, in s, the velocities of bodies were those that they are said to be.
    pub fn age_of_velocities(&self) -> f64 {
        if self.synchronous { 0.0 } else { 0.5 * self.step }
    }
}

/// The tangential side of a contact during one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TangentialContact {
    /// Unit normal from the first partner to the second.
    pub normal: Vector,
    /// Relative velocity in the contact plane in m/s: of half a step ago, at the lever arms of now.
    pub velocity: Vector,
    /// Relative displacement in the contact plane over a whole last step, in m: that of the arms and the plane in its middle.
    pub displacement: Vector,
    /// Relative acceleration in the contact plane predicted for the time of the force, in m/s^2.
    pub acceleration: Vector,
    /// Angle in rad by which the partners have turned together about the normal over the last step, as far as they touched in it.
    pub twist: f64,
    /// Mean normal force over the step in N.
    pub normal_force: f64,
    /// Elastic part of the normal force in N.
    pub elastic_force: f64,
    /// Overlap in m, above zero.
    pub overlap: f64,
    /// Radius in m of the sphere that would meet a flat wall as the partners meet each other; not a number where they have none.
    pub curvature_radius: f64,
    /// One over the effective mass of the contact point along the contact plane, in 1/kg.
    pub inverse_effective_mass: f64,
    /// Reduced mass of the partners, in kg.
    pub reduced_mass: f64,
    /// The part of the law's spring and dashpot that this contact point carries.
    pub share: f64,
    /// Length of the part of the last step, in steps, in which the bodies touched: 1 inside a contact, less at its start.
    pub touched_before: f64,
    /// Length of the part of the time covered by the force, in steps, in which the bodies touch: 1 inside a contact.
    pub touched: f64,
    /// By how much the mean stretch of a spring along the contact plane, over the time covered by the force, exceeds the one of now, in displacements of a step:
    /// not zero at the start of a contact.
    pub stretch_ahead: f64,
}

#[cfg(test)]
impl TangentialContact {
    /// A contact of unit masses on a floor, pressed by 100 N, for the tests of the laws.
    fn at_velocity(velocity: Vector) -> TangentialContact {
        TangentialContact {
            normal: Vector::z(),
            velocity,
            displacement: Vector::zeros(),
            acceleration: Vector::zeros(),
            twist: 0.0,
            normal_force: 100.0,
            elastic_force: 100.0,
            overlap: 0.01,
            curvature_radius: f64::NAN,
            inverse_effective_mass: 1.0,
            reduced_mass: 1.0,
            share: 1.0,
            touched_before: 1.0,
            touched: 1.0,
            stretch_ahead: 0.0,
        }
    }
}

/// A force in the contact plane.
pub trait TangentialLaw: Clone + Send + Sync + 'static {
    /// What a contact remembers from step to step.
    type History: Copy + Default + Send + Sync + Serialize + DeserializeOwned;
    /// Whether the force can turn bodies. If no law of a scene needs rotation, rotation is left out.
    const NEEDS_ROTATION: bool;
    /// Name for the ledger.
    const NAME: &'static str;

    /// Mean force on the first partner over the step, in N.
    fn mean_force(&self, contact: &TangentialContact, kind: &StepKind, history: &mut Self::History) -> Vector;

    /// The same without branches, so that several contacts can be evaluated at once, and whether it holds: if it does not, this is not the force.
    #[inline(always)]
    fn force_inside(&self, contact: &TangentialContact, kind: &StepKind, history: &mut Self::History) -> (Vector, bool) {
        (self.mean_force(contact, kind, history), true)
    }

    /// Energy stored in the tangential spring of a point that carries a share of the law, in J.
    fn stored_energy(&self, history: &Self::History, share: f64) -> f64;

    /// Time scales of an isolated contact on the tangential spring and dashpot.
    fn time_scales(&self, contact: &ContactScale) -> TimeScales;
}

/// An isolated contact, as far as its time scales depend on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactScale {
    /// Effective mass in kg in the direction of the law.
    pub effective_mass: f64,
    /// Reduced mass of the partners, in kg.
    pub reduced_mass: f64,
    /// Radius in m of the sphere that would meet a flat wall as the partners do; not a number where they have none.
    pub curvature_radius: f64,
    /// The largest overlap in m to expect, for laws that stiffen with it; not a number where it is not known.
    pub overlap: f64,
    /// Whether damping velocities are taken half a step early.
    pub lagged_damping: bool,
}

/// Time scales of an isolated contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeScales {
    /// Duration of a head-on contact in s (S eq. 3.51).
    pub contact_duration: f64,
    /// Half period in s of the stiffest spring, undamped.
    pub half_period: f64,
    /// Time in s in which the strongest dashpot alone would stop the partners, halved: the step must resolve it where a body has several contacts.
    pub damping_time: f64,
    /// Largest stable step in s of an isolated contact.
    pub largest_step: f64,
    /// Time in s that a Rayleigh wave takes over the surface of the smaller partner: infinite for laws without elastic constants.
    pub wave_time: f64,
}

impl TimeScales {
    /// Of something that has no time scale.
    pub const NONE: TimeScales = TimeScales {
        contact_duration: f64::INFINITY,
        half_period: f64::INFINITY,
        damping_time: f64::INFINITY,
        largest_step: f64::INFINITY,
        wave_time: f64::INFINITY,
    };

    /// Of a damped oscillator, given its undamped angular frequency in rad/s and its damping as a fraction of critical.
    pub fn of_oscillator(angular_frequency: f64, damping_ratio: f64, lagged_damping: bool) -> TimeScales {
        TimeScales {
            half_period: std::f64::consts::PI / angular_frequency,
            damping_time: 1.0 / (damping_ratio * angular_frequency),
            largest_step: largest_step_of_oscillator(angular_frequency, damping_ratio, lagged_damping),
            ..TimeScales::NONE
        }
    }

    /// Of a dashpot in N s/m on a mass in kg: a step that it must not overshoot if its velocity is lagged.
    pub fn of_dashpot(dashpot: f64, mass: f64, lagged_damping: bool) -> TimeScales {
        let damping_time = 2.0 * mass / dashpot;
        TimeScales { damping_time, largest_step: if lagged_damping { damping_time } else { f64::INFINITY }, ..TimeScales::NONE }
    }

    /// The shortest of each.
    pub fn shortest(self, other: TimeScales) -> TimeScales {
        TimeScales {
            contact_duration: self.contact_duration.min(other.contact_duration),
            half_period: self.half_period.min(other.half_period),
            damping_time: self.damping_time.min(other.damping_time),
            largest_step: self.largest_step.min(other.largest_step),
            wave_time: self.wave_time.min(other.wave_time),
        }
    }
}

/// Largest stable leapfrog step in s of a damped oscillator: $2/\omega$ if its damping is centred, however strong, and
/// $2(\sqrt{1 + \zeta^2} - \zeta)/\omega$ if it is lagged.
pub fn largest_step_of_oscillator(angular_frequency: f64, damping_ratio: f64, lagged_damping: bool) -> f64 {
    let reduction = if lagged_damping { 1.0_f64.hypot(damping_ratio) - damping_ratio } else { 1.0 };
    2.0 * reduction / angular_frequency
}
