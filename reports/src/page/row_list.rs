//! Every row of the case with its JSON and the command that remakes it; the target of every number's link.

use std::collections::BTreeSet;

use maud::{Markup, PreEscaped, html};

use super::text;
use crate::row::{Row, Verdict};
use crate::{Card, CaseResults, row_line, words};

/// Characters of JSON a page may hold; a case with more rows shows the rest in its result file only.
const MOST_JSON: usize = 400_000;

/// The list; claims come first when there is not room for all.
pub(crate) fn row_list(case: &CaseResults) -> Markup {
    if case.rows.is_empty() {
        return html! { p.missing { "There are no rows." } };
    }
    let shown = lines_with_room(case);
    let file = format!("data/{}.jsonl", case.card.case);
    html! {
        p { "Each number on this page is one of these lines of " a href=(file) { (file) } "." }
        @if shown.len() < case.rows.len() {
            p { "To keep the page small, " (case.rows.len() - shown.len()) " rows without a claim are in that file only." }
        }
        details.rows {
            summary { "Show all " (case.rows.len()) " rows" }
            @for (line, row) in case.numbered_rows().filter(|(line, _)| shown.contains(line)) {
                details id=(format!("row-{line}")) {
                    summary { (line) ". " (summary_words(row)) }
                    p { "Remake: " code { (remake(&case.card, row)) } }
                    (files(case, row))
                    pre { (PreEscaped(escaped(&row_line(row)))) }
                }
            }
            @if shown.len() < case.rows.len() {
                p {
                    "Lines in " a href=(file) { (file) } " only:"
                    @for (line, _) in case.numbered_rows().filter(|(line, _)| !shown.contains(line)) {
                        " " span id=(format!("row-{line}")) { (line) }
                    }
                }
            }
        }
    }
}

/// The files behind a row; one that is not there is named all the same.
fn files(case: &CaseResults, row: &Row) -> Markup {
    html! {
        @if !row.data.is_empty() {
            p {
                "Data:"
                @for path in &row.data {
                    " "
                    @if case.file(path).is_some() { a href=(format!("data/{path}")) { (path) } }
                    @else { (path) " (missing)" }
                }
            }
        }
    }
}

fn lines_with_room(case: &CaseResults) -> BTreeSet<usize> {
    let mut rows: Vec<(usize, &Row)> = case.numbered_rows().collect();
    rows.sort_by_key(|(line, row)| (row.verdict() == Verdict::NoClaim, *line));
    let mut room = MOST_JSON;
    rows.into_iter()
        .take_while(|(_, row)| {
            let length = row_line(row).len();
            let fits = length <= room;
            room = room.saturating_sub(length);
            fits
        })
        .map(|(line, _)| line)
        .collect()
}

fn summary_words(row: &Row) -> String {
    let mut parts = vec![words::words(&row.quantity), row.setup.clone()];
    parts.extend(text::knob(row));
    parts.push(row.statistic.clone());
    if !row.is_own() {
        parts.push(row.code.clone());
    }
    parts.join("; ")
}

/// The command that makes the row again.
fn remake(card: &Card, row: &Row) -> String {
    if !row.is_own() {
        return format!("touchstone compare {} FILE.csv", row.case);
    }
    if card.command.is_some() {
        return card.command();
    }
    let threads = if row.threads > 1 { format!(" --threads {}", row.threads) } else { String::new() };
    format!("{} --tier {}{threads}", card.command(), row.tier)
}

/// Escapes what text inside an element needs. Quotation marks stay, or JSON would double in size.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
