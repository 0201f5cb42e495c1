//! What is written: probes, bodies, departures, checkpoints, VTK of bodies ([`vtk`]) and of flows ([`flow_vtk`]). Everything is text to a writer; files belong to the caller.
//! [`start`]: bodies as tables of another scene.

pub mod bodies;
pub mod checkpoint;
pub mod departures;
pub mod flow_vtk;
mod number;
pub mod probes;
pub mod start;
pub mod vtk;

pub use number::digits17;
