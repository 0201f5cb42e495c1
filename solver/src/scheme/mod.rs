//! Time stepping schemes. Each file is one step, in the order of the paper.

pub mod granular;
pub mod hard;
pub(crate) mod resolved;
