//! Touchstone's performance measurements; the benches use them. [`pairs`] is the instrument for pieces of our own work, [`peers`] that for other codes,
//! [`beds`], [`flow`], [`scaling`] and [`ablation`] hold what the benches of these names run, [`page`] makes pages of all of them.

pub mod ablation;
pub mod beds;
pub mod flow;
pub mod page;
pub mod pairs;
pub mod peers;
pub mod scaling;
