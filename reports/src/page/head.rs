//! The first screen of a case's page: what it asks, whether it holds, and by how much.

use maud::{Markup, html};

use super::layout::command;
use super::text::{self, row_link};
use crate::card::Plot;
use crate::plot::DrawError;
use crate::plot::cost::ErrorAgainstCost;
use crate::release_change::{Direction, change_of, count_changes};
use crate::row::{ErrorKind, Row};
use crate::summary::{Standing, Summary};
use crate::work_precision::CostToTarget;
use crate::{CaseResults, SiteMeta, number, picture, words};

/// The whole first screen.
pub(crate) fn head(case: &CaseResults, summary: &Summary, meta: &SiteMeta) -> Result<Markup, DrawError> {
    let thumbnail = thumbnail(case)?;
    Ok(html! {
        header.case {
            p.badges {
                (text::standing(summary.standing))
                @if let Some(kind) = summary.reference_kind() { (text::reference_badge(kind)) }
                code { (case.card.case) }
            }
            h1 { (case.card.title) }
            p.question { (case.card.question) }
            p.verdict { (sentence(summary)) }
            (tiles(case, summary))
            div.pictures {
                figure {
                    (picture::draw(&case.card.picture))
                    figcaption { (case.card.picture.caption) }
                }
                @if let Some([drawing, legend]) = thumbnail {
                    figure.thumbnail {
                        a href="#error-against-run-time" { (drawing) }
                        (legend)
                        figcaption { "Error against run time: lower left is better." }
                    }
                }
            }
            p.origin {
                (command(&case.card.command()))
                span { "commit " code { (meta.commit) } } span { (meta.date) } span { (meta.machine) }
            }
        }
    })
}

fn thumbnail(case: &CaseResults) -> Result<Option<[Markup; 2]>, DrawError> {
    let first = case.card.plots.iter().find_map(|plot| match plot {
        Plot::ErrorAgainstCost { title, quantity, setups, statistic, .. } => Some(ErrorAgainstCost { title, quantity, setups, statistic }),
        _ => None,
    });
    first.map_or(Ok(None), |plot| plot.thumbnail(case))
}

/// The verdict in words.
fn sentence(summary: &Summary) -> Markup {
    let (claims, met) = (summary.claims, summary.met);
    html! {
        strong {
            @match summary.standing {
                Standing::NoResult => "There is no result yet: no row makes a claim.",
                Standing::Met => { @if claims == 1 { "The one claim is met." } @else { "All " (claims) " claims are met." } },
                Standing::NotMet => { (claims - met) " of " (claims) " claims " (if claims - met == 1 { "is" } else { "are" }) " not met." },
            }
        }
        @if let Some((_, row)) = summary.headline { " " (headline_sentence(row)) }
        @else if summary.claims > 0 { " The row its headline asks for is missing." }
        @if summary.unexpected_passes > 0 { " " (summary.unexpected_passes) " known limit passed unexpectedly." }
        @if summary.failed_runs > 0 {
            " " (summary.failed_runs) @if summary.failed_runs == 1 { " run" } @else { " runs" } " failed."
        }
    }
}

fn headline_sentence(row: &Row) -> Markup {
    let error_of_quantity = words::error_of(&row.quantity);
    html! {
        @match (row.error, row.bound, &row.failed) {
            (_, _, Some(reason)) => { "The headline run failed: " (reason) "." },
            (Some(error), Some(bound), None) if error > 0.0 && error <= bound => {
                "The " (error_of_quantity) " is " (number::ratio(bound / error)) " times smaller than allowed."
            },
            (Some(error), Some(bound), None) if error > bound => {
                "The " (error_of_quantity) " is " (number::ratio(error / bound)) " times larger than allowed."
            },
            (Some(_), _, None) => {},
            (None, _, None) => { "The " (error_of_quantity) " is missing from its row." },
        }
    }
}

fn tiles(case: &CaseResults, summary: &Summary) -> Markup {
    html! {
        dl.tiles {
            @if let Some((line, row)) = summary.headline { (error_tile(line, row)) (tolerance_tile(line, row)) }
            @if let Some((line, row)) = summary.order { (order_tile(line, row)) }
            @if let Some((setup, cost)) = summary.cost_to_one_percent {
                @if cost != CostToTarget::Unknown { (cost_tile(setup, cost, summary)) }
            }
            @if let Some((_, row)) = summary.headline { (change_tile(case, row)) }
        }
    }
}

fn tile(label: &Markup, number: &Markup, remark: &Markup) -> Markup {
    html! { div { dt { (label) } dd { span.big { (number) } span.remark { (remark) } } } }
}

fn error_tile(line: usize, row: &Row) -> Markup {
    let number = html! {
        @match row.error {
            Some(error) => {
                (row_link(line, &number::short(error)))
                @if row.error_kind == ErrorKind::Absolute { (text::unit(row)) }
            },
            None => "missing",
        }
    };
    let remark = html! {
        @if let Some([low, high]) = row.ci95 { "95 % interval " (number::short(low)) " to " (number::short(high)) "; " }
        (row.statistic) @if let Some(knob) = text::knob(row) { ", " (knob) }
    };
    let of = words::error_of(&row.quantity);
    let label = if row.error_kind == ErrorKind::Relative { format!("Relative {of}") } else { of.replacen('e', "E", 1) };
    tile(&html! { (label) }, &number, &remark)
}

fn tolerance_tile(line: usize, row: &Row) -> Markup {
    let number = html! {
        @match row.bound { Some(bound) => (row_link(line, &number::short(bound))), None => "none" }
    };
    let remark = html! { @if let Some(reason) = &row.bound_reason { "= " (text::reason(reason)) } };
    tile(&html! { "Tolerance" }, &number, &remark)
}

fn order_tile(line: usize, row: &Row) -> Markup {
    let number = html! { @if let Some(order) = row.value { (row_link(line, &html! { (number::order(order)) })) } };
    let remark = html! {
        @if let Some(design) = row.expected { "by design " (number::knob(design)) } @else { "no design order stated" }
    };
    tile(&html! { "Observed order" }, &number, &remark)
}

fn cost_tile(setup: &str, cost: CostToTarget, summary: &Summary) -> Markup {
    let number = html! {
        @match cost {
            CostToTarget::Reached { cost, .. } => (number::seconds(cost)),
            CostToTarget::AtMost { cost } => { "≤ " (number::seconds(cost)) },
            CostToTarget::NotReached => "not reached",
            CostToTarget::Unknown => "unknown",
        }
    };
    let headline_is_other = summary.headline.is_some_and(|(_, row)| row.setup != setup);
    let remark = html! {
        "CPU time of one run"
        @if headline_is_other { ", " (setup) }
        @if let Some(seconds) = summary.headline.and_then(|(_, row)| row.cpu_s_per_run()) {
            "; the headline run took " (number::seconds(seconds))
        }
    };
    tile(&html! { "Cost to 1 %" }, &number, &remark)
}

fn change_tile(case: &CaseResults, row: &Row) -> Markup {
    let (number, remark) = match change_of(case, row) {
        Some(change) => {
            let (rows, better, worse) = count_changes(case);
            let class = match change.direction {
                Direction::Better => "better",
                Direction::Unchanged => "same",
                Direction::Worse => "worse",
            };
            let number = html! { span class=(class) {
                span aria-hidden="true" { (change.arrow()) } " "
                @if change.direction == Direction::Unchanged { "same" } @else { (number::short(change.now)) }
            } };
            let remark = html! {
                "error was " (number::short(change.before)) "; of " (rows) " rows " (better) " better, " (worse) " worse"
            };
            (number, remark)
        }
        None => (html! { span.same { "–" } }, html! { "no earlier row to compare with" }),
    };
    tile(&html! { "Since last release" }, &number, &remark)
}
