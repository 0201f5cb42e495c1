//! Small pieces of text that several sections need.

use maud::{Markup, html};

use crate::number;
use crate::row::{Expectation, ReferenceKind, Row, Verdict};
use crate::summary::Standing;

/// A link from a number to the row it comes from.
pub(crate) fn row_link(line: usize, content: &Markup) -> Markup {
    html! { a.row href=(format!("#row-{line}")) title=(format!("row {line}: show its JSON and command")) { (content) } }
}

/// A case's standing as a coloured word; the sign says it without colour.
pub(crate) fn standing(standing: Standing) -> Markup {
    html! {
        @match standing {
            Standing::Met => span.pill.good { "✓ met" },
            Standing::NotMet => span.pill.bad { "✕ not met" },
            Standing::NoResult => span.pill.idle { "– no result" },
        }
    }
}

/// A row's verdict as a coloured word.
pub(crate) fn verdict(row: &Row) -> Markup {
    html! {
        @match (row.verdict(), row.expectation) {
            (Verdict::Met, Expectation::Holds) => span.pill.good { "✓ met" },
            (Verdict::Met, Expectation::KnownLimit) => span.pill.idle { "✓ known limit" },
            (Verdict::Met, Expectation::SourceError) => span.pill.idle { "✓ fails as it must" },
            (Verdict::UnexpectedPass, _) => span.pill.warn { "! unexpected pass" },
            (Verdict::NotMet, Expectation::SourceError) => span.pill.bad { "✕ passes but must fail" },
            (Verdict::NotMet, _) => span.pill.bad { "✕ not met" },
            (Verdict::NoClaim, _) => span.pill.idle { "no claim" },
        }
    }
}

/// The kind of reference as a badge.
pub(crate) fn reference_badge(kind: ReferenceKind) -> Markup {
    let strong = matches!(kind, ReferenceKind::Exact | ReferenceKind::Computed);
    html! { span.badge.strong[strong] title="what the result is compared with" { (kind.words()) } }
}

/// `steps_per_contact = 50`, or nothing.
pub(crate) fn knob(row: &Row) -> Option<String> {
    row.knob.as_ref().map(|knob| format!("{} = {}", knob.name.replace('_', " "), number::knob(knob.value)))
}

/// A unit, unless the number has none.
pub(crate) fn unit(row: &Row) -> Markup {
    html! { @if row.unit != "1" { " " (row.unit) } }
}

/// Text in which web addresses are links.
pub(crate) fn linked(text: &str) -> Markup {
    html! {
        @for (index, word) in text.split(' ').enumerate() {
            @if index > 0 { " " }
            @if word.starts_with("https://") {
                @let address = word.trim_end_matches(['.', ',', ';', ')']);
                a href=(address) { (address.trim_start_matches("https://")) } (word[address.len()..])
            } @else { (word) }
        }
    }
}

/// A quantity's name as words.
pub(crate) fn words(name: &str) -> String {
    name.replace('_', " ")
}
