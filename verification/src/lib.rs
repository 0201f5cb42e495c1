//! Touchstone's cases, claims and studies.
//!
//! # Reading order
//!
//! [`case`] (one canonical problem: question, scene, measurement, claims) -> [`study`] (refinement, statistics, timing: measurements become
//! rows) -> [`claim`] (what must hold, and the bound's floor) -> [`variant`] (the setups of a case as values) -> [`cases`] (the list; one file each), which start from a [`packing`] where bodies must be at rest. [`exact`] holds the closed forms that cases are
//! held against, independent of the solver. The command line lives in [`cli`] behind the feature of the same name; everything else is
//! free of files and clocks.

#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

pub mod case;
pub mod cases;
pub mod claim;
#[cfg(feature = "cli")]
pub mod cli;
pub mod exact;
pub mod export;
pub mod mutants;
pub mod packing;
pub mod reference_kernel;
pub mod statistics;
pub mod study;
pub mod variant;

pub use case::{Case, Tier};
pub use cases::CASES;
