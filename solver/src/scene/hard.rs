//! Keys of hard contacts: impulses instead of forces.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use crate::contact::impulse::FrictionClamp;

/// Impulse along the normal of two hard bodies (S eq. 3.14, 3.24).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImpulseRestitution {
    /// Coefficient of restitution: normal velocity of the contact points after over before the collision, reversed. In [0, 1].
    pub restitution: f64,
}

/// Impulse of friction of two hard bodies (S eq. 3.29-3.33, errata).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CoulombImpulse {
    /// Coulomb coefficient while the contact points slip, zero or above.
    pub dynamic_friction: f64,
    /// Coulomb coefficient up to which the slip ends, not below the dynamic one. Absent: the same.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub static_friction: Option<f64>,
    /// How friction is limited.
    #[serde(default)]
    pub clamp: FrictionClamp,
}

/// How collisions of hard bodies are found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum HardContact {
    /// Each at its own time, to rounding. For hundreds of bodies without lasting contacts; the reference. Steps only say how often one may look.
    EventDriven(EventDrivenContact),
    /// At the ends of steps, as S does: first order, misses what happens within a step, holds lasting contacts.
    TimeDriven(TimeDrivenContact),
}

impl Default for HardContact {
    fn default() -> Self {
        HardContact::EventDriven(EventDrivenContact::default())
    }
}

/// Collisions at their own times.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct EventDrivenContact {
    /// Gap at which bodies touch, as a part of their size. In [1e-13, 1e-3].
    pub tolerance: f64,
}

impl Default for EventDrivenContact {
    fn default() -> Self {
        EventDrivenContact { tolerance: 1e-12 }
    }
}

/// Collisions at the ends of steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TimeDrivenContact {
    /// Sweeps over the contacts of a step, at most; from 1 to a million.
    pub sweeps: u32,
    /// Approach that is left alone after the first sweep, as a part of the fastest of the step. In [0, 1).
    pub tolerance: f64,
}

impl Default for TimeDrivenContact {
    fn default() -> Self {
        TimeDrivenContact { sweeps: 100, tolerance: 1e-12 }
    }
}
