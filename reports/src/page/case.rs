//! The page of a case: its first screen, then sections in a fixed order, each only if the case has it.

use maud::{Markup, html};

use super::figure::figure;
use super::head::head;
use super::layout::{captioned, document};
use super::{bar_table, claims, convergence_table, cost_table, ledger, other_codes, reproduce, row_list, text};
use crate::card::{Card, Plot};
use crate::plot::DrawError;
use crate::plot::bars::Bars;
use crate::plot::convergence::Convergence;
use crate::plot::cost::ErrorAgainstCost;
use crate::plot::curves::Curves;
use crate::plot::slices;
use crate::row::Reference;
use crate::summary::Summary;
use crate::{CaseResults, SiteMeta, equation};

/// A section: anchor, title, content.
struct Section {
    anchor: &'static str,
    title: &'static str,
    content: Markup,
}

/// The whole page.
pub(crate) fn page(case: &CaseResults, meta: &SiteMeta) -> Result<String, DrawError> {
    let summary = Summary::new(case);
    let sections = sections(case, &summary)?;
    let content = html! {
        (head(case, &summary, meta)?)
        nav.contents aria-label="on this page" {
            @for section in &sections { a href=(format!("#{}", section.anchor)) { (section.title) } " " }
        }
        @for section in &sections {
            section id=(section.anchor) { h2 { (section.title) } (section.content) }
        }
    };
    Ok(document(&case.card.title, &case.card.question, false, meta, &content))
}

fn sections(case: &CaseResults, summary: &Summary) -> Result<Vec<Section>, DrawError> {
    let card = &case.card;
    let section = |anchor, title, content| Section { anchor, title, content };
    let mut all =
        vec![section("model", "Question and model", model(card)), section("reference", "Reference and its uncertainty", reference(case))];
    let plots = |wanted: fn(&Plot) -> bool| card.plots.iter().filter(move |plot| wanted(plot)).collect::<Vec<_>>();
    for (anchor, title, plots) in [
        ("result", "Result", plots(|plot| matches!(plot, Plot::Curves { .. } | Plot::Bars { .. } | Plot::Slices { .. }))),
        ("convergence", "Convergence", plots(|plot| matches!(plot, Plot::Convergence { .. }))),
        ("error-against-run-time", "Error against run time", plots(|plot| matches!(plot, Plot::ErrorAgainstCost { .. }))),
    ] {
        if !plots.is_empty() {
            let drawn = plots.into_iter().map(|plot| plot_block(case, plot)).collect::<Result<Vec<_>, _>>()?;
            all.push(section(anchor, title, html! { @for plot in drawn { (plot) } }));
        }
    }
    if case.foreign_rows().next().is_some() {
        all.push(section("other-codes", "Other codes", other_codes::other_codes(case)));
    }
    if !card.mutants.is_empty() {
        all.push(section("mutants", "What would fail this test", ledger::mutants(&card.mutants)));
    }
    if !card.ledger.is_empty() {
        all.push(section("ledger", "Left out and why", ledger::ledger(&card.ledger)));
    }
    if !card.remarks.is_empty() {
        all.push(section("remarks", "Remarks", list(&card.remarks)));
    }
    all.push(section("claims", "Claims", claims_section(case, summary)));
    all.push(section("reproduce", "Reproduce", reproduce::reproduce(case, summary.cpu_s)));
    if !card.answers.is_empty() {
        all.push(section("answers", "Requirements and threads it answers", list(&card.answers)));
    }
    all.push(section("rows", "Every row", row_list::row_list(case)));
    Ok(all)
}

fn list(lines: &[String]) -> Markup {
    html! { ul { @for line in lines { li { (text::linked(line)) } } } }
}

fn model(card: &Card) -> Markup {
    html! {
        p { (card.question) }
        @for paragraph in &card.model { p { (text::linked(paragraph)) } }
        @for equation in &card.equations {
            figure.equation { (equation::display(&equation.latex)) figcaption { (equation.meaning) } }
        }
        @if !card.parameters.is_empty() {
            (captioned("parameters", &html! { "Fixed parameters." }, &html! {
                table.cards {
                    thead { tr { th scope="col" { "Parameter" } th scope="col" { "Value" } th scope="col" { "Remark" } } }
                    tbody { @for parameter in &card.parameters {
                        tr { th scope="row" { (parameter.name) } td data-label="Value" { (parameter.value) }
                            td.why data-label="Remark" { (parameter.remark) } }
                    } }
                }
            }))
        }
    }
}

/// A source that rows name, the least and the largest uncertainty that they give it, and how many they are.
struct Named<'a> {
    reference: &'a Reference,
    uncertainty: [f64; 2],
    rows: usize,
}

fn named(case: &CaseResults) -> Vec<Named<'_>> {
    let mut named: Vec<Named<'_>> = Vec::new();
    for reference in case.own_rows().filter_map(|(_, row)| row.reference.as_ref()) {
        let is_it = |other: &Named<'_>| (other.reference.kind, &other.reference.source) == (reference.kind, &reference.source);
        let uncertainty = reference.uncertainty;
        match named.iter_mut().find(|other| is_it(other)) {
            Some(known) => {
                known.uncertainty = [known.uncertainty[0].min(uncertainty), known.uncertainty[1].max(uncertainty)];
                known.rows += 1;
            }
            None => named.push(Named { reference, uncertainty: [uncertainty; 2], rows: 1 }),
        }
    }
    named
}

/// The reference in words, every reference the rows name, and the sources.
fn reference(case: &CaseResults) -> Markup {
    let named = named(case);
    let short = crate::number::short;
    html! {
        p { (text::linked(&case.card.reference)) }
        @if !named.is_empty() {
            (captioned("references", &html! { "What the rows are held against." }, &html! {
                table.cards {
                    thead { tr { th scope="col" { "Kind" } th scope="col" { "Source" } th scope="col" { "Uncertainty" }
                        th scope="col" { "Rows" } } }
                    tbody { @for Named { reference, uncertainty: [least, largest], rows } in &named {
                        tr {
                            th scope="row" { (text::reference_badge(reference.kind)) }
                            td.why data-label="Source" { (text::linked(&reference.source)) }
                            td data-label="Uncertainty" {
                                (short(*least)) @if largest > least { " to " (short(*largest)) }
                            }
                            td data-label="Rows" { (rows) }
                        }
                    } }
                }
            }))
        }
        @if !case.card.sources.is_empty() { h3 { "Sources" } (list(&case.card.sources)) }
    }
}

fn plot_block(case: &CaseResults, plot: &Plot) -> Result<Markup, DrawError> {
    let rows_file = format!("data/{}.jsonl", case.card.case);
    let command = case.card.command();
    Ok(match plot {
        Plot::Convergence { title, quantity, setups, statistics, orders, knob_is_resolution, knob_label } => {
            let plot = Convergence { title, quantity, setups, statistics, orders, knob_is_resolution: *knob_is_resolution, knob_label };
            html! {
                (figure(title, &plot.draw(case)?, &rows_file, &command))
                (convergence_table::tables(case, quantity, setups, statistics, *knob_is_resolution))
            }
        }
        Plot::ErrorAgainstCost { title, quantity, setups, statistic, targets } => {
            let plot = ErrorAgainstCost { title, quantity, setups, statistic };
            html! {
                (figure(title, &plot.draw(case)?, &rows_file, &command))
                (cost_table::table(case, quantity, setups, statistic, targets))
            }
        }
        Plot::Curves { title, file, x_label, y_label, columns, log_x, log_y, caption } => {
            let plot = Curves { title, file, labels: [x_label, y_label], columns, logarithmic: [*log_x, *log_y], caption };
            figure(title, &plot.draw(case)?, &format!("data/{file}"), &command)
        }
        Plot::Bars { title, file, x_label, caption } => {
            let plot = Bars { title, file, x_label, caption };
            html! {
                (figure(title, &plot.draw(case)?, &format!("data/{file}"), &command))
                (bar_table::table(case, file))
            }
        }
        Plot::Slices { title, file, radius, caption } => slices::figure(case, [title, file, caption], *radius, &command),
    })
}

fn claims_section(case: &CaseResults, summary: &Summary) -> Markup {
    html! {
        p {
            (summary.met) " of " (summary.claims) " expectations are met. A claim holds if its error is not larger than what "
            "is allowed; the floor is the smallest error that could mean anything."
            @if summary.known_limits > 0 {
                " " (summary.known_limits) " of them " @if summary.known_limits == 1 { "is a known limit" } @else { "are known limits" }
                ", written down and expected not to hold."
            }
            @if summary.source_errors > 0 {
                " " (summary.source_errors) " " @if summary.source_errors == 1 { "tries a formula" } @else { "try formulas" }
                " as a source misprints " @if summary.source_errors == 1 { "it" } @else { "them" } ": that must fail."
            }
        }
        (claims::table(case.own_rows()))
    }
}
