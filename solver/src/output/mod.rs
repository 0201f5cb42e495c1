//! What is written: probes, bodies, departures, checkpoints, VTK. Everything is text to a writer; files belong to the caller.
//! [`start`]: bodies as tables of another scene.

pub mod bodies;
pub mod checkpoint;
pub mod departures;
mod number;
pub mod probes;
pub mod start;
pub mod vtk;

pub use number::digits17;
