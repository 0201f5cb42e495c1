//! What a law along the contact normal is.

use serde::{Deserialize, Serialize};

use super::{ContactScale, LinearSpringDashpot, StepKind, TimeScales};
use crate::contact::sharing::Share;

/// The normal side of a contact during one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalContact {
    /// Overlap in m, above zero.
    pub overlap: f64,
    /// Whether the bodies did not touch at the last step.
    pub is_new: bool,
    /// Mean approach rate over the last step, in m/s.
    pub approach_rate: f64,
    /// Rate of the approach rate predicted for the time of the force, in m/s^2.
    pub approach_acceleration: f64,
    /// One over the effective mass of the contact point along the normal, in 1/kg.
    pub inverse_effective_mass: f64,
    /// One over the mass that the dashpot is calibrated for, in 1/kg.
    pub inverse_damped_mass: f64,
    /// Radius in m of the sphere that would meet a flat wall as the partners meet each other; not a number where they have none.
    pub curvature_radius: f64,
    /// The part of the law that this contact point carries.
    pub share: Share,
}

/// What the normal law remembers of a contact.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct NormalMemory {
    /// Mean force over the last step, in N.
    pub force: f64,
    /// The end of the contact has been resolved although the surfaces still overlap by a part of a step.
    pub ended: bool,
}

/// The normal force over a step and how much of the time it stands for is spent in contact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct NormalForce {
    /// Mean force in N, positive when it pushes apart.
    pub mean: f64,
    /// Elastic part in N.
    pub elastic: f64,
    /// Part of the last step, in steps, in which the bodies touched.
    pub touched_before: f64,
    /// Part of the time that the kick stands for, in steps, in which the bodies touch.
    pub touched: f64,
}

/// A force along the contact normal.
pub trait NormalLaw: Clone + Send + Sync + 'static {
    /// Name for the ledger.
    const NAME: &'static str;

    /// Mean normal force over the time a kick stands for.
    fn mean_force(&self, contact: &NormalContact, kind: &StepKind, memory: &mut NormalMemory) -> NormalForce;

    /// Whether there is [`NormalLaw::force_inside`].
    const KNOWS_INSIDE: bool = false;

    /// The mean force, given that of the last step, of a contact that is neither new nor has ended; and whether it also lasts beyond the next kick. If it does,
    /// [`NormalLaw::mean_force`] gives the same bits. It does not branch on the contact, so that several are evaluated at once.
    fn force_inside(&self, _contact: &NormalContact, _kind: &StepKind, _last_force: f64) -> (NormalForce, bool) {
        (NormalForce::default(), false)
    }

    /// Energy stored in the spring of a whole contact at an overlap in m, in J.
    fn stored_energy(&self, overlap: f64, curvature_radius: f64) -> f64;

    /// The largest overlap in m to expect of a head-on contact; not a number for laws whose time scales do not depend on it.
    fn expected_overlap(&self, effective_mass: f64, curvature_radius: f64) -> f64;

    /// Time scales of an isolated head-on contact.
    fn time_scales(&self, contact: &ContactScale) -> TimeScales;

    /// Time in s that a Rayleigh wave takes over half the girth of a sphere of given radius in m and density in kg/m^3: infinite without elastic
    /// constants.
    fn wave_time(&self, _radius: f64, _density: f64) -> f64 {
        f64::INFINITY
    }

    /// The law for shapes whose contacts have no radius of curvature, if it is one.
    fn without_curvature(&self) -> Option<LinearSpringDashpot>;
}
