//! Resistance to rolling: a torque between two spheres against their relative spin. One file per law.
//!
//! Sources name the coefficient $k_{ms}$ (R, tables 5.1 and 5.4, values $10^{-5}$ and 0) without a formula; it is read here as the coefficient of
//! [`ConstantTorque`], the only law with a single dimensionless number. Spin about the normal is not resisted.

mod constant_torque;
mod spring_torque;

use serde::Serialize;
use serde::de::DeserializeOwned;

pub use constant_torque::ConstantTorque;
pub use spring_torque::SpringTorque;

use super::{StepKind, TimeScales};
use crate::Vector;

/// The rolling side of a contact during one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingContact {
    /// Unit normal from the first partner to the second.
    pub normal: Vector,
    /// Angular velocity of the first less the second in the contact plane, mean over the last step, in rad/s.
    pub spin: Vector,
    /// Its rate at the last step, in rad/s^2.
    pub spin_rate: Vector,
    /// Mean normal force over the step in N.
    pub normal_force: f64,
    /// Radius in m of the sphere that would roll on a flat wall as the partners roll on each other.
    pub rolling_radius: f64,
    /// Reduced moment of inertia of the partners, in kg m^2.
    pub inertia: f64,
    /// Length of the part of the last step, in steps, in which the bodies touched.
    pub touched_before: f64,
    /// Angle in rad by which the partners have turned together about the normal since the last step.
    pub twist: f64,
}

/// A torque in the contact plane.
pub trait RollingLaw: Clone + Send + Sync + 'static {
    /// What a contact remembers from step to step.
    type History: Clone + Default + Send + Sync + Serialize + DeserializeOwned;
    /// Whether there is a torque at all.
    const NEEDS_ROTATION: bool;
    /// Name for the ledger; empty without a torque.
    const NAME: &'static str;

    /// Mean torque on the first partner over the step, in N m.
    fn mean_torque(&self, contact: &RollingContact, kind: &StepKind, history: &mut Self::History) -> Vector;

    /// Energy stored in J.
    fn stored_energy(&self, history: &Self::History) -> f64;

    /// Time scales for a reduced moment of inertia in kg m^2.
    fn time_scales(&self, inertia: f64, lagged_damping: bool) -> TimeScales;
}

/// No resistance to rolling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoRolling;

impl RollingLaw for NoRolling {
    type History = ();
    const NEEDS_ROTATION: bool = false;
    const NAME: &'static str = "";

    fn mean_torque(&self, _contact: &RollingContact, _kind: &StepKind, _history: &mut ()) -> Vector {
        Vector::zeros()
    }

    fn stored_energy(&self, _history: &()) -> f64 {
        0.0
    }

    fn time_scales(&self, _inertia: f64, _lagged_damping: bool) -> TimeScales {
        TimeScales::NONE
    }
}
