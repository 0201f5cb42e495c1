//! The table under bars: every column of their file.

use maud::{Markup, html};

use super::layout::captioned;
use crate::CaseResults;
use crate::bar_file::{BarFile, read_bars};

/// Names, ratios with their intervals, and words; nothing if the file cannot be read, which the plot says.
pub(crate) fn table(case: &CaseResults, file: &str) -> Markup {
    let Some(Ok(BarFile { headers, bars })) = case.file(file).map(read_bars) else { return html! {} };
    captioned(
        "table of the bars",
        &html! { "The numbers behind the bars." },
        &html! {
            table.cards {
                thead { tr { th scope="col" { "What" } th scope="col" { "Ratio [95 %]" } @for header in &headers { th scope="col" { (header) } } } }
                tbody { @for bar in &bars {
                    tr {
                        th scope="row" { (bar.name) }
                        td data-label="Ratio [95 %]" { (format!("{:.3}", bar.ratio)) span.remark { (format!(" [{:.3}, {:.3}]", bar.interval[0], bar.interval[1])) } }
                        @for (header, words) in headers.iter().zip(&bar.words) { td data-label=(header) { (words) } }
                    }
                } }
            }
        },
    )
}
