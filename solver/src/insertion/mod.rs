//! Where bodies come from that a scene does not list one by one: plain data and pure functions, which know nothing of scenes and stages.
//!
//! # Reading order
//!
//! [`draws`] (random numbers that depend on seed and place in the sequence alone) -> [`population`] (which shapes, how many of each, how large) ->
//! [`lattice`] (rows and layers, before the start) and [`window`] (random places; R section 4.2.2) -> [`inflow`] (a window during the run).
//!
//! Room is judged by balls about the centres that hold the bodies: exact for spheres, on the safe side for all others.

pub mod draws;
pub mod inflow;
pub mod lattice;
pub mod occupancy;
pub mod population;
pub mod window;

pub use draws::Draws;
pub use inflow::{Inflow, InflowState, Schedule};
pub use lattice::Lattice;
pub use occupancy::Occupancy;
pub use population::{Kind, Population};
pub use window::{Turned, Window};

use crate::{Orientation, Vector};

/// A body that has found room.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NewBody {
    /// Number of its kind in the population.
    pub kind: usize,
    /// Size, as a multiple of the shape of its kind.
    pub scale: f64,
    /// Radius in m of a ball about the centre that holds it.
    pub radius: f64,
    /// Centre in m.
    pub position: Vector,
    /// Body to world.
    pub orientation: Orientation,
}

/// Bodies that found no room.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum NoRoom {
    /// A lattice is full.
    #[error("there is room for {placed} bodies, {wanted} are wanted")]
    Sites {
        /// How many fit.
        placed: usize,
        /// How many are wanted.
        wanted: usize,
    },
    /// A window is full, or so nearly that chance does not find the gaps.
    #[error("no room for the last {left} of {wanted} bodies: {attempts} attempts to place the next one have failed")]
    Attempts {
        /// How many are left.
        left: usize,
        /// How many are wanted.
        wanted: usize,
        /// How often the next one was tried.
        attempts: u64,
    },
    /// During a run nothing has made room.
    #[error("no room for the last {left} of {wanted} bodies after {waited} s of waiting")]
    Time {
        /// How many are left.
        left: usize,
        /// How many are wanted.
        wanted: usize,
        /// For how long the next one has waited, in s.
        waited: f64,
    },
}
