//! Touchstone's results and the pages made from them; knows no physics.
//!
//! Reading order: [`row`] (one measured number), [`card`] (what a case says about itself), [`Results`] (both together),
//! [`render`] (a pure function from results to the files of a static site).
//!
//! A page makes no number: it quotes rows, and each quoted number links to its row and to the command that remakes it.

mod bar_file;
pub mod card;
mod curve_file;
mod equation;
mod number;
mod page;
mod picture;
mod plot;
mod release_change;
mod results;
mod ro_crate;
pub mod row;
mod row_lines;
mod series;
mod site;
mod summary;
mod words;
mod work_precision;

pub use card::Card;
pub use results::{CaseResults, DataFile, KeyDoc, KeyTable, Results, SiteFile, SiteMeta};
pub use row::Row;
pub use row_lines::{ReadError, read_rows, row_line, write_rows};
pub use site::{RenderError, render};
pub use summary::verdict_line;
