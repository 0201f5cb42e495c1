//! What other codes found: their errors beside ours, claim by claim.

use maud::{Markup, html};

use super::layout::captioned;
use super::text;
use crate::row::Row;
use crate::{CaseResults, number};

/// The section's content.
pub(crate) fn other_codes(case: &CaseResults) -> Markup {
    let mut codes: Vec<(&str, &str)> = case.foreign_rows().map(|(_, row)| (row.code.as_str(), row.version.as_str())).collect();
    codes.sort_unstable();
    codes.dedup();
    let claims = claims(case);
    html! {
        p { "Results of other codes for the same setups, from the tables that this checkout keeps or that " code { "touchstone compare" }
            " brought in. They stand in the plots as stars, and do not decide whether this case is met." }
        ul { @for (code, version) in &codes {
            li { (code) " " (version) ", " (case.foreign_rows().filter(|(_, row)| row.code == *code && row.version == *version).count()) " rows" }
        } }
        @if !claims.is_empty() {
            (captioned("errors of other codes", &html! { "Errors beside what the claims of this case allow. ✓: within it; ×: above it, which is no fault of a code that "
                "has another scheme or model by design." }, &table(case, &codes, &claims)))
        }
    }
}

/// The first foreign row about each claim.
fn claims(case: &CaseResults) -> Vec<&Row> {
    let mut claims: Vec<&Row> = Vec::new();
    for (_, row) in case.foreign_rows().filter(|(_, row)| row.bound.is_some()) {
        if !claims.iter().any(|known| is_about_the_same(known, row)) {
            claims.push(row);
        }
    }
    claims
}

fn is_about_the_same(one: &Row, other: &Row) -> bool {
    one.setup == other.setup && one.quantity == other.quantity && one.knob == other.knob
}

fn table(case: &CaseResults, codes: &[(&str, &str)], claims: &[&Row]) -> Markup {
    let own = |claim: &Row| {
        let rows = || case.own_rows().filter(|(_, row)| is_about_the_same(claim, row) && row.bound.is_some());
        rows().find(|(_, row)| !row.statistic.starts_with("worst"))
    };
    let foreign = |claim: &Row, code: (&str, &str)| {
        case.foreign_rows().find(|(_, row)| is_about_the_same(claim, row) && row.code == code.0 && row.version == code.1)
    };
    html! {
        table.cards {
            thead { tr {
                th scope="col" { "Error of" } th scope="col" { "Allowed" } th scope="col" { "Touchstone" }
                @for (code, _) in codes { th scope="col" { (code) } }
            } }
            tbody { @for claim in claims {
                tr {
                    th scope="row" { (claim.quantity) br; span.remark { (claim.setup) @if let Some(knob) = text::knob(claim) { "; " (knob) } } }
                    td data-label="Allowed" { @if let Some(bound) = claim.bound { (number::short(bound)) (text::unit(claim)) } }
                    td data-label="Touchstone" { (cell(own(claim))) }
                    @for code in codes { td data-label=(code.0) { (cell(foreign(claim, *code))) } }
                }
            } }
        }
    }
}

fn cell(row: Option<(usize, &Row)>) -> Markup {
    html! {
        @match row {
            Some((line, row)) => {
                @match row.error {
                    Some(error) => (text::row_link(line, &number::short(error))),
                    None => "failed",
                }
                @match row.holds() { Some(true) => " ✓", Some(false) => " ×", None => "" }
            },
            None => "–",
        }
    }
}
