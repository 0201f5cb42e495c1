//! Touchstone's performance measurements. [`pairs`] is the instrument for pieces of our own work, [`peers`] that for other codes; the benches use them.

pub mod pairs;
pub mod peers;
