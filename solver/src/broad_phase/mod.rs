//! Which pairs may touch. One file per algorithm.

mod all_pairs;
pub mod cells;
pub mod morton;
pub mod neighbour_list;

pub use all_pairs::all_pairs;
pub use cells::NearPair;
pub use neighbour_list::NeighbourList;
