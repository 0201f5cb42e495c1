//! The pages of the site, through maud. Every function here turns facts into HTML and computes nothing else.

mod bar_table;
pub(crate) mod case;
mod claims;
mod convergence_table;
mod cost_table;
mod figure;
mod head;
pub(crate) mod index;
mod layout;
mod ledger;
mod other_codes;
mod reproduce;
mod row_list;
pub(crate) mod scene_keys;
mod text;
