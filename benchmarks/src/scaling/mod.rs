//! How cost grows with the number of spheres and falls with that of threads: [`bed`] is what is stepped, [`triad`] how fast this machine moves memory,
//! [`results`] what is told of it.

pub mod bed;
pub mod results;
pub mod triad;
