//! What is written: probes, bodies, checkpoints, VTK. Everything is text to a writer; files belong to the caller.

pub mod bodies;
pub mod checkpoint;
mod number;
pub mod probes;
pub mod vtk;

pub use number::digits17;
