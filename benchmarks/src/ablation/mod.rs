//! What a scene does not need, forced on: [`crystal`] is the scene, [`list`] what is forced, [`answer`] whether it changes anything, [`results`] what is
//! told of it.

pub mod answer;
pub mod crystal;
pub mod list;
pub mod results;
