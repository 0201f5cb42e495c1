//! Touchstone's reference solver for particle-laden flow: the models, and nothing else.
//!
//! # Reading order
//!
//! [`scene`] (the world as plain data) -> [`build`] (resolves every option once) ->
//! [`simulation`] (the stages that exist) -> [`scheme::granular`] (one step, in the order of the paper) ->
//! [`broad_phase`] (who is near) -> [`contact`] (who touches, with what force), on [`distance`] (how far apart) and [`shape`] (what bodies are) -> [`motion`] (how bodies move) -> [`measure`] (what is observed).
//! With a fluid: [`fluid`] (grid and inverses) -> [`coupling::resolved`] (bodies in the flow) -> `scheme::resolved` (both and contacts in one step).
//!
//! # Conventions, stated once
//!
//! - SI units everywhere; angles in radians.
//! - Quaternions `[w, x, y, z]` rotate body coordinates to world coordinates.
//! - Angular velocity, angular momentum, force and torque are in the world frame.
//! - A contact has a *first* and a *second* partner: the first is the body with the lower id; a boundary is always second.
//! - The contact normal points from the first partner to the second; `overlap` is positive in contact.
//! - The *approach rate* is the rate of change of the overlap: positive while the partners move together.
//! - A normal force is positive when it pushes the partners apart: the first feels `-normal_force * normal`.
//! - Relative velocity at a contact is that of the first partner's material point minus the second's.
//!
//! # Time levels
//!
//! Leapfrog (R eq. 3.13): positions live at `t`, velocities at `t - step/2`. A force at `t` that depends on velocity needs the
//! velocity at `t`: it is predicted from the last acceleration, and a contact's own share in it is solved implicitly
//! (see [`contact::law::linear_spring_dashpot`]).
//!
//! Hard bodies know no forces; their velocities live at the time of the positions (see [`scheme::hard`]).

#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

pub mod bodies;
pub mod boundary;
pub mod broad_phase;
pub mod build;
pub mod contact;
pub mod coupling;
pub mod distance;
pub mod domain;
pub mod fluid;
pub mod insertion;
pub mod ledger;
pub mod measure;
pub mod motion;
pub mod openings;
pub mod output;
mod parallel;
pub mod relocation;
pub mod scene;
pub mod scheme;
pub mod shape;
pub mod simulation;
#[cfg(test)]
mod test_bodies;

/// A fingerprint of the source of this crate: results that are kept belong to it.
pub const FINGERPRINT: &str = env!("SOLVER_FINGERPRINT");

/// A vector in three dimensions, double precision.
pub type Vector = nalgebra::Vector3<f64>;
/// A rotation from body to world.
pub type Orientation = nalgebra::UnitQuaternion<f64>;

pub use bodies::Bodies;
pub use ledger::Ledger;
pub use scene::{Scene, SceneError};
pub use simulation::Simulation;
