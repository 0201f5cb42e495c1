//! Fluid and bodies together.

pub mod resolved;
