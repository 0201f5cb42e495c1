//! Incompressible flow on a staggered grid (R section 7.3).
//!
//! Reading order: [`grid`] (where values live) -> [`periodic`] (boxes that repeat: pressure and creeping flow at once) on [`spectrum`] and [`operators`], and planes within them on which the flow is held ([`sheet`]). Boxes with walls, inlets
//! and outlets: [`sides`] (what bounds the fluid) -> [`border`] (values beyond the sides) -> [`stencils`] (differences) -> [`helmholtz`] (their exact inverses) ->
//! [`navier_stokes`] (one time step) with [`projection`] (how velocity and pressure are found together).

pub mod advection;
pub mod border;
pub mod grid;
pub mod helmholtz;
pub mod navier_stokes;
pub mod operators;
pub mod periodic;
pub mod projection;
pub mod sheet;
pub mod sides;
pub mod spectrum;
pub mod stencils;
mod trigonometric;
