//! The claims table: every row with a bound, red first.

use maud::{Markup, html};

use super::layout::scrolling;
use super::text::{self, row_link};
use crate::row::{Expectation, Row, Verdict};
use crate::{number, words};

/// The table of the claims among `rows`, or a statement that there are none.
pub(crate) fn table<'a>(rows: impl Iterator<Item = (usize, &'a Row)>) -> Markup {
    let mut claims: Vec<(usize, &Row)> = rows.filter(|(_, row)| row.verdict() != Verdict::NoClaim).collect();
    if claims.is_empty() {
        return html! { p.missing { "No row makes a claim." } };
    }
    claims.sort_by_key(|(line, row)| (rank(row), *line));
    let content = html! {
        table.claims.cards {
            thead { tr {
                th scope="col" { "Verdict" } th scope="col" { "What was measured" } th scope="col" { "Value" }
                th scope="col" { "Expected" } th scope="col" { "Error" } th scope="col" { "Floor" }
                th scope="col" { "Allowed, and why" } th scope="col" { "Expectation" }
            } }
            tbody { @for (line, row) in claims { (claim(line, row)) } }
        }
    };
    scrolling("claims", &content)
}

/// Red first, then what passed unexpectedly, then what is expected to fail, then the rest.
fn rank(row: &Row) -> u8 {
    match (row.verdict(), row.expectation) {
        (Verdict::NotMet, _) => 0,
        (Verdict::UnexpectedPass, _) => 1,
        (_, Expectation::KnownLimit | Expectation::SourceError) => 2,
        _ => 3,
    }
}

fn claim(line: usize, row: &Row) -> Markup {
    html! {
        tr.red[row.verdict() == Verdict::NotMet] {
            td data-label="Verdict" { (text::verdict(row)) span.remark { (row_link(line, &html! { "row " (line) })) } }
            td.what data-label="Measured" {
                strong { (words::words(&row.quantity)) }
                span.remark { (row.setup) "; " @if let Some(knob) = text::knob(row) { (knob) "; " } (row.statistic) }
                @if let Some(reason) = &row.failed { span.remark.bad { "Run failed: " (reason) } }
            }
            td data-label="Value" { (optional(row.value)) @if row.value.is_some() { (text::unit(row)) } }
            td data-label="Expected" {
                (optional(row.expected))
                @if let Some(reference) = &row.reference { span.remark { (reference.kind.words()) } }
            }
            td data-label="Error" { @match row.error { Some(error) => (number::short(error)), None => "–" } }
            td data-label="Floor" { @match row.floor { Some(floor) => (number::short(floor)), None => "–" } }
            td.why data-label="Allowed" {
                @match row.bound { Some(bound) => (number::short(bound)), None => "–" }
                @if let Some(reason) = &row.bound_reason { span.remark { (text::reason(reason)) } }
            }
            td.why data-label="Expectation" { (expectation(row)) }
        }
    }
}

fn optional(number: Option<f64>) -> Markup {
    html! { @match number { Some(number) => (number::value(number)), None => "–" } }
}

/// What is expected of the claim, in words a stranger understands.
fn expectation(row: &Row) -> Markup {
    let reason = row.expectation_reason.as_deref().unwrap_or("no reason is given");
    html! {
        @match (row.expectation, row.verdict()) {
            (Expectation::Holds, _) => "must hold",
            (Expectation::KnownLimit, Verdict::UnexpectedPass) => {
                "Known limit, but it holds now: look again." span.remark { (reason) }
            },
            (Expectation::KnownLimit, _) => { "Known limit: not expected to hold." span.remark { (reason) } },
            (Expectation::SourceError, Verdict::NotMet) => {
                "The source's printed form must fail and did not: the test lost its power." span.remark { (reason) }
            },
            (Expectation::SourceError, _) => { "The source's printed form, which must fail." span.remark { (reason) } },
        }
    }
}
