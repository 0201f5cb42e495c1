//! How bodies move under given forces.

pub mod leapfrog;
pub mod rotation;
