//! The index: one matrix of all cases, red first.

use maud::{Markup, html};

use super::cost_table;
use super::layout::{command, document, scrolling};
use super::text;
use crate::summary::{Standing, Summary};
use crate::{CaseResults, Results, SiteMeta, number};

/// The whole page.
pub(crate) fn page(results: &Results, meta: &SiteMeta) -> String {
    let mut cases: Vec<(&CaseResults, Summary)> = results.cases.iter().map(|case| (case, Summary::new(case))).collect();
    cases.sort_by_key(|(_, summary)| summary.standing);
    let content = html! {
        header.site {
            h1 { "Does the code get particle-laden flow right?" }
            p.question { "Touchstone runs each case below and holds every number against a reference of known uncertainty." }
            p.verdict { (sentence(&cases)) }
            dl.tiles {
                (tile("CPU time of all runs", &html! { (number::seconds(cases.iter().map(|(_, s)| s.cpu_s).sum())) }))
                (tile("Date", &html! { (meta.date) }))
                (tile("Commit", &html! { code { (meta.commit) } }))
                (tile("Remake everything", &command("cargo run --release")))
            }
        }
        section id="cases" {
            h2 { "Cases" }
            @if cases.is_empty() { p.missing { "There are no results yet. Run the command above." } }
            @else { (scrolling("all cases", &matrix(&cases))) }
        }
        (how_to_read())
    };
    document("All cases", "Verification and benchmark results for particle-laden flow", true, meta, &content)
}

fn tile(label: &str, content: &Markup) -> Markup {
    html! { div { dt { (label) } dd { span.big { (content) } } } }
}

fn sentence(cases: &[(&CaseResults, Summary)]) -> Markup {
    let count = |standing| cases.iter().filter(|(_, summary)| summary.standing == standing).count();
    let (red, idle) = (count(Standing::NotMet), count(Standing::NoResult));
    let claims: usize = cases.iter().map(|(_, summary)| summary.claims).sum();
    html! {
        strong {
            @match (red, idle) {
                _ if cases.is_empty() => "There are no results yet.",
                (0, 0) => { @if cases.len() == 1 { "The one case meets" } @else { "All " (cases.len()) " cases meet" } " all expectations." },
                (0, _) => { "No case is red." },
                _ => { (red) " of " (cases.len()) " cases " (if red == 1 { "does" } else { "do" }) " not meet all expectations." },
            }
        }
        @if idle > 0 { " " (idle) @if idle == 1 { " case has" } @else { " cases have" } " no result yet." }
        " " (claims) " claims were checked."
    }
}

fn matrix(cases: &[(&CaseResults, Summary)]) -> Markup {
    html! {
        table.matrix.cards data-sortable {
            thead { tr {
                @for title in ["Case", "Verdict", "Compared with", "Error / allowed", "Order", "Cost to 1 %", "Claims met", "Known limits"] {
                    th scope="col" { (title) }
                }
            } }
            tbody { @for (case, summary) in cases { (matrix_row(case, summary)) } }
        }
    }
}

fn matrix_row(case: &CaseResults, summary: &Summary) -> Markup {
    let href = format!("{}.html", case.card.case);
    let margin = summary.margin();
    let cost = summary.cost_to_one_percent.map(|(_, cost)| cost);
    let order = summary.order.and_then(|(_, row)| row.value.map(|order| (order, row.expected)));
    html! {
        tr {
            th scope="row" data-value=(case.card.title) {
                a href=(href) { (case.card.title) } span.remark { (case.card.question) }
            }
            td data-label="Verdict" data-value=(summary.standing as u8) { (text::standing(summary.standing)) }
            td data-label="Compared with" { @match summary.reference_kind() { Some(kind) => (text::reference_badge(kind)), None => "–" } }
            td class=(margin_class(margin)) data-label="Error / allowed" data-value=(margin.unwrap_or(f64::INFINITY)) {
                @match margin { Some(margin) => (number::ratio(margin)), None => "–" }
            }
            td data-label="Order" data-value=(order.map_or(f64::NEG_INFINITY, |(order, _)| order)) {
                @match order {
                    Some((order, design)) => {
                        (number::order(order))
                        @if let Some(design) = design { span.remark { "design " (number::knob(design)) } }
                    },
                    None => "–",
                }
            }
            td data-label="Cost to 1 %" data-value=(cost.and_then(|cost| cost.seconds()).unwrap_or(f64::INFINITY)) {
                @match cost { Some(cost) => (cost_table::cell(cost)), None => "–" }
            }
            td data-label="Claims met" data-value=(summary.claims - summary.met) {
                (summary.met) " / " (summary.claims)
                @if summary.unexpected_passes > 0 { span.remark { (summary.unexpected_passes) " unexpected pass" } }
                @if summary.failed_runs > 0 { span.remark.bad { (summary.failed_runs) " failed run" @if summary.failed_runs > 1 { "s" } } }
            }
            td data-label="Known limits" data-value=(summary.known_limits) { (summary.known_limits) }
        }
    }
}

fn margin_class(margin: Option<f64>) -> &'static str {
    match margin {
        None => "margin",
        Some(margin) if margin > 1.0 => "margin over",
        Some(margin) if margin > 0.5 => "margin near",
        Some(_) => "margin inside",
    }
}

fn how_to_read() -> Markup {
    html! {
        section id="how-to-read" {
            h2 { "How to read this" }
            dl.facts {
                dt { "Verdict" } dd { "Met: everything that was expected of the case happened, known limits included." }
                dt { "Compared with" } dd { "Where the truth comes from. An exact solution weighs more than another code, and that more than a correlation." }
                dt { "Error / allowed" } dd { "Error of the case's headline number over its tolerance. Below 1 holds; the smaller the better." }
                dt { "Order" } dd { "How fast the error falls: order 2 means that halving the step divides the error by four." }
                dt { "Cost to 1 %" } dd { "CPU time of one run that is accurate to one percent, between measured runs; never extrapolated." }
                dt { "Known limits" } dd { "Claims that are known not to hold, each with its reason on the case's page." }
            }
            p { "Each measured number on a case's page leads to the row behind it and the command that remakes it." }
        }
    }
}
