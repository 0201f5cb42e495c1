//! What the scene uses and what it leaves out, and which deliberate bugs the case catches.

use maud::{Markup, html};

use super::layout::scrolling;
use crate::card::{LedgerLine, Mutant};
use crate::number;

/// The ledger; a stage that is left out but worked is called out.
pub(crate) fn ledger(lines: &[LedgerLine]) -> Markup {
    let content = html! {
        table {
            thead { tr { th scope="col" { "Stage" } th scope="col" { "Used" } th scope="col" { "Which, or why not" }
                th scope="col" { "Work counted" } } }
            tbody { @for line in lines { (ledger_line(line)) } }
        }
    };
    let left_out = lines.iter().filter(|line| !line.used).count();
    html! {
        p { (left_out) " of " (lines.len()) " stages are left out because this scene does not need them. "
            "A stage that is left out does no work: its counters are zero." }
        (scrolling("stages used and left out", &content))
    }
}

fn ledger_line(line: &LedgerLine) -> Markup {
    let work: Vec<(&String, &u64)> = line.work.iter().filter(|(_, count)| **count > 0).collect();
    html! {
        tr.red[!line.used && !work.is_empty()] {
            th scope="row" { (line.stage) }
            td { @if line.used { "✓ used" } @else { "– left out" } }
            td.why { (line.reason) }
            td {
                @if work.is_empty() { "0" }
                @for (index, (name, count)) in work.iter().enumerate() {
                    @if index > 0 { ", " } (number::grouped(**count)) " " (name.replace('_', " "))
                }
                @if !line.used && !work.is_empty() { span.remark.bad { "left out, yet it worked" } }
            }
        }
    }
}

/// The deliberate bugs.
pub(crate) fn mutants(mutants: &[Mutant]) -> Markup {
    let content = html! {
        table {
            thead { tr { th scope="col" { "Deliberate bug" } th scope="col" { "What turned red" } } }
            tbody { @for mutant in mutants { tr { th scope="row" { (mutant.name) } td.why { (mutant.caught_by) } } } }
        }
    };
    html! {
        p { "Each bug was put into the solver on purpose; a test that cannot fail proves nothing." }
        (scrolling("deliberate bugs", &content))
    }
}
