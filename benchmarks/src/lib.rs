//! Touchstone's performance measurements. [`pairs`] is the instrument; the benches use it.

pub mod pairs;
