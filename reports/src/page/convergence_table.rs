//! The table under a convergence plot: errors by knob, the order between neighbours, and how far phases spread.

use maud::{Markup, html};

use super::layout::captioned;
use super::text::row_link;
use crate::series::{Point, Series, distinguish, own_series};
use crate::summary::same_knob;
use crate::{CaseResults, number};

/// One table for each statistic: the first with observed orders, the others with their ratio to the first.
pub(crate) fn tables(case: &CaseResults, quantity: &str, setups: &[String], statistics: &[String], knob_is_resolution: bool) -> Markup {
    let Some(first) = statistics.first() else { return html! {} };
    let base = own_series(case, quantity, setups, first);
    html! {
        (table(&base, first, "and the order between neighbouring columns", |series, index| {
            order(series, index, knob_is_resolution).map(|order| format!("order {}", number::order(order)))
        }))
        @for statistic in &statistics[1..] {
            @let others = own_series(case, quantity, setups, statistic);
            (table(&others, statistic, &format!("and how many times the {first} it is"), |series, index| {
                ratio(series, index, &base).map(|ratio| format!("{}×", number::ratio(ratio)))
            }))
        }
    }
}

fn table(all: &[Series], statistic: &str, second: &str, remark: impl Fn(&Series, usize) -> Option<String>) -> Markup {
    let knobs = knob_values(all);
    let name = all.iter().flat_map(|series| &series.points).find_map(|point| point.row.knob.as_ref());
    let knob_name = name.map_or("knob".to_string(), |knob| knob.name.replace('_', " "));
    let (names, shared) = distinguish(&all.iter().map(|series| series.setup).collect::<Vec<_>>());
    if knobs.is_empty() {
        return html! { p.missing { "There are no rows of the statistic \"" (statistic) "\"." } };
    }
    let title = format!("{statistic} error at each {knob_name}");
    let content = html! {
        table.numbers {
            thead { tr { th scope="col" { "Setup" } @for knob in &knobs { th scope="col" { (number::knob(*knob)) } } } }
            tbody {
                @for (series, name) in all.iter().zip(&names) {
                    tr {
                        th scope="row" { (name) }
                        @for knob in &knobs { (cell(series, *knob, &remark)) }
                    }
                }
            }
        }
    };
    let caption = html! {
        "Error (" (statistic) ") by " (knob_name) ", " (second) "."
        @if !shared.is_empty() { " The same in all: " (shared) "." }
    };
    captioned(&title, &caption, &content)
}

fn cell(series: &Series, knob: f64, remark: &impl Fn(&Series, usize) -> Option<String>) -> Markup {
    let failed = series.failed.iter().find(|(_, row)| row.knob.as_ref().is_some_and(|k| same_knob(k.value, knob)));
    html! {
        td {
            @if let Some(index) = series.points.iter().position(|point| same_knob(point.knob, knob)) {
                @let point = series.points[index];
                (row_link(point.line, &number::short(point.error)))
                @if let Some(remark) = remark(series, index) { span.remark { (remark) } }
            } @else if let Some((line, _)) = failed {
                (row_link(*line, &html! { span.bad { "✕ failed" } }))
            } @else { "–" }
        }
    }
}

/// All knob values with a row, rising.
fn knob_values(all: &[Series]) -> Vec<f64> {
    let failed = all.iter().flat_map(|series| &series.failed).filter_map(|(_, row)| row.knob.as_ref().map(|k| k.value));
    let measured = all.iter().flat_map(|series| &series.points).map(|point| point.knob);
    let mut knobs: Vec<f64> = measured.chain(failed).filter(|knob| knob.is_finite()).collect();
    knobs.sort_by(f64::total_cmp);
    knobs.dedup_by(|a, b| same_knob(*a, *b));
    knobs
}

/// Observed order between a point and the one before it; below the floor there is none.
fn order(series: &Series, index: usize, knob_is_resolution: bool) -> Option<f64> {
    let (before, here) = (series.points[index.checked_sub(1)?], series.points[index]);
    let above_floor = |point: &Point| point.error > point.row.floor.unwrap_or(0.0);
    if !above_floor(&before) || !above_floor(&here) || before.knob <= 0.0 || same_knob(before.knob, here.knob) {
        return None;
    }
    let slope = (here.error / before.error).ln() / (here.knob / before.knob).ln();
    Some(if knob_is_resolution { -slope } else { slope })
}

fn ratio(series: &Series, index: usize, base: &[Series]) -> Option<f64> {
    let here = series.points[index];
    let base = base.iter().find(|other| other.setup == series.setup)?;
    let same = base.points.iter().find(|point| same_knob(point.knob, here.knob))?;
    (same.error > 0.0).then(|| here.error / same.error)
}
