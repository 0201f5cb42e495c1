//! How to remake the page: command, seeds, commit, machine, files.

use std::collections::BTreeSet;

use maud::{Markup, html};

use super::layout::{command, scrolling};
use crate::{CaseResults, Row, number, ro_crate};

/// The section's content.
pub(crate) fn reproduce(case: &CaseResults, cpu_s: f64) -> Markup {
    let tiers = distinct(case, |row| row.tier.clone());
    html! {
        @if tiers.is_empty() || case.card.command.is_some() { p { (command(&case.card.command())) } }
        @else { @for tier in &tiers { p { (command(&format!("{} --tier {tier}", case.card.command()))) } } }
        dl.facts {
            dt { "CPU time" } dd { (number::seconds(cpu_s)) " for the runs shown, of " (number::seconds(case.card.budget_cpu_s)) " allowed"
                @if cpu_s > case.card.budget_cpu_s { strong.bad { ": over budget" } } }
            (fact("Random seed", &distinct(case, |row| row.random_seed.to_string())))
            (fact("Threads", &distinct(case, |row| row.threads.to_string())))
            (fact("MPI ranks", &distinct(case, |row| row.ranks.to_string())))
            (fact("Version", &distinct(case, |row| row.version.clone())))
            (fact("Commit", &distinct(case, |row| row.commit.clone())))
            (fact("Machine", &distinct(case, |row| row.machine.clone())))
        }
        @if distinct(case, |row| row.commit.clone()).len() > 1 {
            p.missing { "These rows were made by different commits: do not compare them as one state of the code." }
        }
        (files(case))
    }
}

fn fact(name: &str, values: &BTreeSet<String>) -> Markup {
    let values: Vec<&str> = values.iter().map(String::as_str).collect();
    html! { @if !values.is_empty() { dt { (name) } dd { (values.join(", ")) } } }
}

fn distinct(case: &CaseResults, field: impl Fn(&Row) -> String) -> BTreeSet<String> {
    case.own_rows().map(|(_, row)| field(row)).collect()
}

fn files(case: &CaseResults) -> Markup {
    let content = html! {
        table {
            thead { tr { th scope="col" { "File" } th scope="col" { "Size" } th scope="col" { "SHA-256" } } }
            tbody {
                @for file in case.site_files() {
                    tr {
                        th scope="row" { a href=(file.path) { (file.path) } }
                        td { (number::bytes(file.content.len())) }
                        td { code.hash { (ro_crate::sha256(&file.content)) } }
                    }
                }
            }
        }
    };
    scrolling("files", &content)
}
