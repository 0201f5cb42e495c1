//! Results on disk, and the site that is made from them.
//!
//! `<case>.jsonl` holds a case's own rows, `<case>/` its card, its curves and the rows that `touchstone compare` brought in
//! (`compared_<code>.jsonl`) or that come from the tables of other codes in `../other_codes/` (`kept_<code>.jsonl`), `../baseline/<case>.jsonl` the rows of the last release.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use reports::row::Verdict;
use reports::{CaseResults, DataFile, KeyDoc, KeyTable, Results, Row, SiteMeta, read_rows, render, write_rows};

use super::environment::Environment;
use super::files::{names_in, read_text, read_text_if_there, write_whole};
use super::places::Places;
use super::{CommandError, Finish};
use crate::CASES;
use crate::study::Outcome;

/// Writes what a study found: curves and card first, rows last, so that rows never speak of files that are not there.
///
/// # Errors
///
/// If a file cannot be written.
pub fn write_outcome(places: &Places, outcome: &Outcome) -> Result<(), CommandError> {
    write_with_rows(places, outcome, &outcome.rows)?;
    remove_stale_curves(&places.results.join(&outcome.card.case), outcome)
}

/// Writes what a study of some points found; rows and curves of other points stay. That measurements of a whole setup are missing was said of other runs, and
/// goes.
///
/// # Errors
///
/// If a file cannot be written, or rows that are there cannot be read.
pub fn write_part(places: &Places, outcome: &Outcome) -> Result<(), CommandError> {
    let mut rows = read_rows_if_there(&rows_file(places, &outcome.card.case))?.unwrap_or_default();
    let is_of = |new: &Row, old: &Row| new.setup == old.setup && (new.knob == old.knob || (old.knob.is_none() && old.failed.is_some()));
    rows.retain(|old| !outcome.rows.iter().any(|new| is_of(new, old)));
    rows.extend(outcome.rows.iter().cloned());
    write_with_rows(places, outcome, &rows)
}

fn write_with_rows(places: &Places, outcome: &Outcome, rows: &[Row]) -> Result<(), CommandError> {
    let folder = places.results.join(&outcome.card.case);
    for curve in &outcome.curves {
        write_whole(&folder.join(&curve.file), &curve.to_csv())?;
    }
    let card = serde_json::to_string_pretty(&outcome.card).map_err(|error| CommandError::input(error.to_string()))?;
    write_whole(&folder.join("card.json"), &(card + "\n"))?;
    write_whole(&rows_file(places, &outcome.card.case), &write_rows(rows))
}

fn remove_stale_curves(folder: &Path, outcome: &Outcome) -> Result<(), CommandError> {
    let written: BTreeSet<&str> = outcome.curves.iter().map(|curve| curve.file.as_str()).collect();
    for name in names_in(folder)?.iter().filter(|name| name.ends_with(".csv") && !written.contains(name.as_str())) {
        let path = folder.join(name);
        fs::remove_file(&path).map_err(|error| CommandError::file("remove the old curve", &path, &error))?;
    }
    Ok(())
}

/// Writes the rows of another code beside a case's own.
///
/// # Errors
///
/// If the file cannot be written.
pub fn write_compared(places: &Places, case: &str, code_slug: &str, rows: &[Row]) -> Result<(), CommandError> {
    write_whole(&places.results.join(case).join(format!("compared_{code_slug}.jsonl")), &write_rows(rows))
}

/// Writes the rows of another code that come from the table that the checkout keeps.
///
/// # Errors
///
/// If the file cannot be written.
pub fn write_kept(places: &Places, case: &str, code_slug: &str, rows: &[Row]) -> Result<(), CommandError> {
    write_whole(&places.results.join(case).join(format!("kept_{code_slug}.jsonl")), &write_rows(rows))
}

fn rows_file(places: &Places, case: &str) -> std::path::PathBuf {
    places.results.join(format!("{case}.jsonl"))
}

/// What is on disk of a case; `None` if it has not been run.
///
/// # Errors
///
/// If rows or card cannot be read; the message names file and line.
pub fn read_case(places: &Places, case: &str) -> Result<Option<CaseResults>, CommandError> {
    let Some(mut rows) = read_rows_if_there(&rows_file(places, case))? else { return Ok(None) };
    let folder = places.results.join(case);
    let card_file = folder.join("card.json");
    let card_text = read_text_if_there(&card_file)?;
    let Some(card_text) = card_text else {
        let again = format!("`touchstone run {case}` makes it again");
        return Err(CommandError::input(format!("`{}` is missing, although there are rows of the case; {again}", card_file.display())));
    };
    let card = serde_json::from_str(&card_text)
        .map_err(|error| CommandError::input(format!("`{}` is not a card of this version: {error}", card_file.display())))?;
    let mut data = Vec::new();
    let names = names_in(&folder)?;
    // What was brought in takes the place of what is kept.
    let is_outdone = |name: &str| name.strip_prefix("kept_").is_some_and(|code| names.contains(&format!("compared_{code}")));
    for name in &names {
        if (name.starts_with("compared_") || name.starts_with("kept_")) && name.ends_with(".jsonl") {
            if is_outdone(name) {
                continue;
            }
            rows.extend(read_rows_if_there(&folder.join(name))?.unwrap_or_default());
        } else if name.ends_with(".csv") || name == "card.json" {
            data.push(DataFile { path: format!("{case}/{name}"), content: read_text(&folder.join(name))? });
        }
    }
    let baseline = read_rows_if_there(&places.baseline().join(format!("{case}.jsonl")))?.unwrap_or_default();
    Ok(Some(CaseResults { card, rows, baseline, data }))
}

fn read_rows_if_there(path: &Path) -> Result<Option<Vec<Row>>, CommandError> {
    let Some(text) = read_text_if_there(path)? else { return Ok(None) };
    let rows = read_rows(&text);
    rows.map(Some).map_err(|error| CommandError::input(format!("{}:{}: not a result row: {}", path.display(), error.line, error.message)))
}

/// Every case on disk: those of this version in their order, then others by name.
///
/// # Errors
///
/// If a file cannot be read; the message names file and line.
pub fn read_all(places: &Places) -> Result<Vec<CaseResults>, CommandError> {
    let mut identifiers: Vec<String> = CASES.iter().map(|case| case.description().id.to_string()).collect();
    for name in names_in(&places.results)? {
        if let Some(case) = name.strip_suffix(".jsonl").filter(|case| !identifiers.iter().any(|known| known == case)) {
            identifiers.push(case.to_string());
        }
    }
    let read = |case: &String| read_case(places, case).transpose();
    identifiers.iter().filter_map(read).collect()
}

/// Renders the site from what is on disk; returns the cases it shows.
///
/// # Errors
///
/// If results cannot be read or pages cannot be written.
pub fn render_site(places: &Places, environment: &Environment) -> Result<Vec<CaseResults>, CommandError> {
    let results = Results { cases: read_all(places)?, scene_keys: scene_keys() };
    let meta = SiteMeta {
        commit: environment.commit.clone(),
        date: environment.date.clone(),
        machine: machines(&results.cases),
        version: env!("CARGO_PKG_VERSION").into(),
    };
    let files = render(&results, &meta).map_err(|error| CommandError::input(format!("cannot render the site: {error}")))?;
    for file in &files {
        write_whole(&places.site.join(&file.path), &file.content)?;
    }
    Ok(results.cases)
}

/// Machines that a site's own rows were made on.
fn machines(cases: &[CaseResults]) -> String {
    let machines: BTreeSet<&str> = cases.iter().flat_map(CaseResults::own_rows).map(|(_, row)| row.machine.as_str()).collect();
    machines.into_iter().collect::<Vec<_>>().join("; ")
}

fn scene_keys() -> Vec<KeyTable> {
    let key = |key: solver::scene::keys::Key| KeyDoc {
        name: key.name,
        type_name: key.type_name,
        required: key.required,
        default: key.default,
        doc: key.doc,
    };
    let table = |table: solver::scene::keys::KeyTable| KeyTable {
        // Pages write the outer pair of brackets themselves.
        table: table.table.strip_prefix('[').and_then(|name| name.strip_suffix(']')).unwrap_or(&table.table).to_string(),
        doc: table.doc,
        keys: table.keys.into_iter().map(key).collect(),
    };
    solver::scene::keys::tables().into_iter().map(table).collect()
}

/// How many claims a case makes, and how many of them are met.
pub fn claims_met(case: &CaseResults) -> (usize, usize) {
    let verdicts: Vec<Verdict> = case.own_rows().map(|(_, row)| row.verdict()).filter(|verdict| *verdict != Verdict::NoClaim).collect();
    (verdicts.len(), verdicts.iter().filter(|verdict| **verdict != Verdict::NotMet).count())
}

/// Whether all expectations of some cases are met.
pub fn finish_of(cases: &[CaseResults]) -> Finish {
    let all_met = cases.iter().map(claims_met).all(|(claims, met)| claims == met);
    if all_met { Finish::Met } else { Finish::NotMet }
}
