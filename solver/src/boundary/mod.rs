//! Walls. One file per kind.

mod plane;

pub use plane::Plane;
