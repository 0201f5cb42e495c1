//! Other codes beside ours on the same packing: [`packing`] is the state that all start from, [`codes`] the codes that are installed, [`process`] what
//! a run of one of them costs, [`results`] what is told of it.

pub mod codes;
pub mod packing;
pub mod process;
pub mod results;
