//! Contact laws of a scene: along the normal, in the contact plane, against rolling.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{CoulombImpulse, ImpulseRestitution};
pub use crate::contact::law::EndOfContact;
pub use crate::contact::law::hertz::Elasticity;

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

/// Hertz's spring between spheres, or a sphere and a wall, and Tsuji's dashpot; contacts end at zero overlap.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hertz {
    /// Elastic constants of the first of the two `materials`.
    pub first: Elasticity,
    /// Elastic constants of the second. Absent: the second material is rigid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub second: Option<Elasticity>,
    /// Coefficient of restitution of an isolated head-on contact at any speed, in [0, 1].
    pub restitution: f64,
    /// Impact speed in m/s for which the time step is chosen and checked; faster impacts are shorter. Absent: twice the largest speed of a body at the
    /// start; needed if there is gravity or nothing moves at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference_speed: Option<f64>,
}

/// Mindlin's tangential spring without slip inside the contact area, capped by Coulomb's law. Only with `hertz`, whose elastic constants it takes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mindlin {
    /// Coulomb coefficient, zero or above; the cap uses the total normal force.
    pub friction: f64,
    /// Damping of the tangential oscillation as a fraction of critical, zero or above.
    #[serde(default)]
    pub damping_ratio: f64,
}

/// Tangential spring whose stretch is guessed as velocity times the duration of a contact (S eq. 3.43-3.47). Only with `linear_spring_dashpot`, whose
/// stiffness and damping it takes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ViscousSpring {
    /// Coulomb coefficient, zero or above; the cap uses the total normal force.
    pub friction: f64,
    /// Tangential stiffness in N/m, above zero.
    pub stiffness: f64,
}

/// Resistance of spheres to rolling.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum RollingLaw {
    /// A torque of constant size against the direction of rolling (Ai et al. 2011, type A; R's k_ms is read as its coefficient).
    ConstantTorque(ConstantTorque),
    /// A spring and dashpot against rolling, with a largest torque (Ai et al. 2011, type C).
    SpringTorque(SpringTorque),
}

/// A torque of constant size against the direction of rolling.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConstantTorque {
    /// Coefficient of rolling friction, zero or above: torque over normal force and rolling radius (that of the sphere at a wall, r1 r2/(r1 + r2) of two).
    pub friction: f64,
}

/// A spring and dashpot against rolling, with a largest torque.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpringTorque {
    /// Coefficient of rolling friction, zero or above: largest torque over normal force and rolling radius.
    pub friction: f64,
    /// Stiffness in N m a radian, above zero.
    pub stiffness: f64,
    /// Damping as a fraction of critical, zero or above; critical refers to the moment of inertia of a sphere about its centre.
    #[serde(default)]
    pub damping_ratio: f64,
}
