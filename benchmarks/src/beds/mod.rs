//! Settled beds of every kind of shape, all bodies with the volume of the same ball: [`kinds`] are the bodies and their scenes, [`states`] where they lie, [`settle`]
//! how they came there, [`results`] what their steps cost.

pub mod kinds;
pub mod results;
pub mod settle;
pub mod states;
