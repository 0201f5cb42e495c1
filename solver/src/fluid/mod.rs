//! Incompressible flow on a staggered grid (R section 7.3).

pub mod grid;
pub mod operators;
pub mod periodic;
pub mod spectrum;
