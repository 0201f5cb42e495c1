//! Which pairs may touch. One file per algorithm.

mod all_pairs;

pub use all_pairs::{LARGEST_NUMBER_OF_BODIES, all_pairs};
