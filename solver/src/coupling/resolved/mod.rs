//! Flow resolved around every body: a rigid motion is imposed on the fluid that fills the bodies, by forces that only act there (R chapter 7, DLM/FD).
//!
//! Reading order: [`surface`] (where bodies end) -> [`immersed`] (which values of the grid lie in which body) -> [`constraint`] (what is asked of the velocity, and
//! where forces may act) with [`ghosts`] (sharp, the default) and [`points`] (as R) -> [`steady`] (creeping flow past fixed bodies, solved at once) and [`marching`] (the same as R states it, step by step). Flow of any
//! Reynolds number with bodies that are held, moved or free: [`matter`] (what they are made of) -> [`walls`] (flat ones, beside bodies) -> [`balance`] (one step, for flow and bodies together) -> [`unsteady`] (step by step), with [`fringe`] where a stream is made uniform (coupled to contacts by `scheme::resolved`); to a steady state without time: [`inertial`]. What is read off either: [`measures`].

pub mod balance;
pub mod constraint;
pub mod fringe;
pub mod ghosts;
pub mod immersed;
pub mod inertial;
pub mod interpolation;
pub mod krylov;
pub mod marching;
pub mod matter;
pub mod measures;
pub mod pockets;
pub mod points;
pub mod steady;
pub mod surface;
pub mod unsteady;
pub mod walls;
