//! Small pieces of text that several sections need.

use maud::{Markup, html};

use crate::number;
use crate::row::{Expectation, ReferenceKind, Row, Verdict};
use crate::summary::Standing;
use crate::words::with_powers;

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
    html! { @if row.unit != "1" { " " (with_powers(&row.unit)) } }
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

/// Why a bound is what it is: `10 x 5.0e-2, rounding` with its numbers set like all others.
pub(crate) fn reason(reason: &str) -> Markup {
    let parts = reason.split_once(" x ").and_then(|(factor, rest)| {
        let (floor, words) = rest.split_once(", ")?;
        Some((factor.parse::<f64>().ok()?, floor.parse::<f64>().ok()?, words))
    });
    html! {
        @match parts {
            Some((factor, floor, words)) => { (number::knob(factor)) " × " (number::short(floor)) ", " (with_powers(words)) },
            None => (with_powers(reason)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::reason;

    #[test]
    fn a_reason_is_set_with_its_numbers() {
        assert_eq!(
            reason("10 x 5.0e-5, (pi / steps)^2 / 24").into_string(),
            "10 × <span class=\"number\">5.0\u{2009}×\u{2009}10<sup>−5</sup></span>, (pi / steps)² / 24"
        );
        assert_eq!(reason("1 x the budget").into_string(), "1 x the budget");
    }
}
