//! The table under an error-against-run-time plot: what each accuracy costs.

use maud::{Markup, html};

use super::layout::captioned;
use crate::series::{distinguish, own_series};
use crate::work_precision::{CostToTarget, series_cost_to_target};
use crate::{CaseResults, number};

/// Cost to each target for each setup; the cheapest of a column stands out.
pub(crate) fn table(case: &CaseResults, quantity: &str, setups: &[String], statistic: &str, targets: &[f64]) -> Markup {
    let all = own_series(case, quantity, setups, statistic);
    let (names, _) = distinguish(&all.iter().map(|series| series.setup).collect::<Vec<_>>());
    let costs: Vec<Vec<CostToTarget>> =
        all.iter().map(|series| targets.iter().map(|target| series_cost_to_target(series, *target)).collect()).collect();
    if costs.iter().flatten().all(|cost| *cost == CostToTarget::Unknown) {
        return html! { p.missing { "No run of this quantity has a measured cost and a relative error." } };
    }
    let cheapest: Vec<Option<f64>> =
        (0..targets.len()).map(|column| costs.iter().filter_map(|row| row[column].seconds()).min_by(f64::total_cmp)).collect();
    let content = html! {
        table.numbers {
            thead { tr {
                th scope="col" { "Setup" }
                @for target in targets { th scope="col" { "cost to " (percent(*target)) } }
            } }
            tbody {
                @for (row, name) in costs.iter().zip(&names) {
                    tr {
                        th scope="row" { (name) }
                        @for (cost, best) in row.iter().zip(&cheapest) {
                            td .best[cost.seconds().is_some() && cost.seconds() == *best] { (cell(*cost)) }
                        }
                    }
                }
            }
        }
    };
    let caption = html! {
        "CPU time of one run that reaches a relative error, interpolated between neighbouring runs; nothing is "
        "extrapolated. In brackets the range over the timing rounds. Bold: cheapest."
    };
    captioned("cost to reach an error", &caption, &content)
}

/// A cost in words.
pub(crate) fn cell(cost: CostToTarget) -> Markup {
    html! {
        @match cost {
            CostToTarget::Reached { cost, interval } => {
                (number::seconds(cost))
                @if let Some([low, high]) = interval {
                    span.remark { "[" (number::seconds(low)) ", " (number::seconds(high)) "]" }
                }
            },
            CostToTarget::AtMost { cost } => { "≤ " (number::seconds(cost)) span.remark { "coarsest run" } },
            CostToTarget::NotReached => span.remark { "not reached" },
            CostToTarget::Unknown => span.remark { "not measured" },
        }
    }
}

fn percent(target: f64) -> String {
    // Binary fractions such as 0.001 x 100 would show their last digit.
    format!("{}\u{a0}%", (target * 1e8).round() / 1e6)
}
