//! `touchstone compare`: another code's results against a case's claims.

mod table;

use std::collections::BTreeMap;
use std::path::Path;

use reports::Row;
use reports::row::{Cost, Knob, Verdict};
use serde_json::json;

use super::arguments::DEFAULT_SEED;
use super::environment::Environment;
use super::files::{read_text, read_text_if_there};
use super::places::Places;
use super::progress::Progress;
use super::{CommandError, Finish, print, store};
use crate::case::{Quantity, Setup};
use crate::claim::{Claim, Statistic, Subject};
use crate::export::slug;
use crate::{Case, Tier};
use table::Entry;

/// Holds another code's results against what the case expects and claims, writes them as rows of that code and renders the site.
///
/// # Errors
///
/// If the table is not right; the message names line, column, value and the nearest that is allowed. Then nothing is written.
pub fn compare(places: &Places, case: &dyn Case, file: &Path, tier: Tier, json: bool) -> Result<Finish, CommandError> {
    let identifier = case.description().id;
    if store::read_case(places, identifier)?.is_none() {
        let message = format!("the case has no page yet to put these results on; run `touchstone run {identifier}` first");
        return Err(CommandError::input(message));
    }
    let table = table::read(&file.display().to_string(), &read_text(file)?, &case.description())?;
    let rows_of_code = rows_of_codes(case, &table, tier)?;
    for (code, rows) in &rows_of_code {
        store::write_compared(places, identifier, code, rows)?;
    }
    store::render_site(places, &Environment::of(places.root.as_deref()))?;
    let rows: Vec<&Row> = rows_of_code.values().flatten().collect();
    if json {
        print::json(&json!(rows));
    } else {
        print_rows(&rows, table.passed_over);
        print::line(&format!("page: {}", places.site.join(format!("{identifier}.html")).display()));
    }
    let is_red = rows.iter().any(|row| row.verdict() == Verdict::NotMet);
    Ok(if is_red { Finish::NotMet } else { Finish::Met })
}

/// Does the same with the table of the case that the checkout keeps, if it keeps one: pages of a fresh clone show other codes too.
///
/// # Errors
///
/// If the table is not right, or rows cannot be written.
pub fn put_kept_results(places: &Places, case: &dyn Case, tier: Tier) -> Result<(), CommandError> {
    let identifier = case.description().id;
    let file = places.other_codes().join(format!("{identifier}.csv"));
    let Some(text) = read_text_if_there(&file)? else { return Ok(()) };
    let table = table::read(&file.display().to_string(), &text, &case.description())?;
    rows_of_codes(case, &table, tier)?.iter().try_for_each(|(code, rows)| store::write_kept(places, identifier, code, rows))
}

/// The rows of each code in a table, by a name of it that can be a part of a file's.
fn rows_of_codes(case: &dyn Case, table: &table::Table, tier: Tier) -> Result<BTreeMap<String, Vec<Row>>, CommandError> {
    let quantities = measure(case, table)?;
    let claims = case.claims(tier);
    let mut rows_of_code: BTreeMap<String, Vec<Row>> = BTreeMap::new();
    for (place, entry) in table.entries.iter().enumerate() {
        let quantity = table::find_quantity(table, entry, &quantities[place])?;
        let row = row(case.description().id, entry, quantity, claim_about(&claims, entry), tier);
        rows_of_code.entry(slug(&entry.code)).or_default().push(row);
    }
    Ok(rows_of_code)
}

/// What the case measures at the setups and knob values of a table, for each entry: what it expects of each quantity comes with it.
fn measure(case: &dyn Case, table: &table::Table) -> Result<Vec<Vec<Quantity>>, CommandError> {
    let progress = Progress::new();
    let bar = progress.bar(case.description().id);
    let mut known: BTreeMap<(usize, u64), Vec<Quantity>> = BTreeMap::new();
    let mut all = Vec::new();
    for (done, entry) in table.entries.iter().enumerate() {
        let place = (entry.setup.index, entry.knob.to_bits());
        let quantities = match known.get(&place) {
            Some(quantities) => quantities.clone(),
            None => {
                let measured = case.evaluate(&entry.setup, entry.knob, DEFAULT_SEED);
                let failed = |error| CommandError::input(format!("the case itself fails at setup `{}`: {error}", entry.setup.label));
                known.entry(place).or_insert(measured.map_err(failed)?.quantities).clone()
            }
        };
        all.push(quantities);
        bar.set(done as u64 + 1, table.entries.len() as u64);
    }
    Ok(all)
}

/// The claim about the median or the only sample of what an entry measured.
fn claim_about<'a>(claims: &'a [Claim], entry: &Entry) -> Option<&'a Claim> {
    claims.iter().find(|claim| {
        let is_at_knob = matches!(claim.subject, Subject::ErrorAt(knob) if table::is_same_knob(knob, entry.knob));
        let Setup { label, .. } = &entry.setup;
        is_at_knob && claim.statistic != Statistic::Worst && claim.setup == *label && claim.quantity == entry.quantity
    })
}

fn row(case: &str, entry: &Entry, quantity: &Quantity, claim: Option<&Claim>, tier: Tier) -> Row {
    let error = Quantity { samples: vec![entry.value], ..quantity.clone() }.errors()[0];
    let checked = claim.map(|claim| claim.check(error));
    Row {
        case: case.into(),
        setup: entry.setup.label.clone(),
        quantity: quantity.name.into(),
        unit: quantity.unit.into(),
        knob: Some(Knob { name: entry.knob_name.clone(), value: entry.knob }),
        value: Some(entry.value),
        expected: Some(quantity.expected),
        reference: Some(quantity.reference.clone()),
        error: error.is_finite().then_some(error),
        error_kind: quantity.error_kind,
        floor: Some(quantity.floor),
        bound: claim.map(|claim| claim.bound.value()),
        bound_reason: claim.map(|claim| claim.bound.reason()),
        expectation: claim.map_or(reports::row::Expectation::Holds, |claim| claim.expected.expectation()),
        expectation_reason: claim.and_then(|claim| claim.expected.reason()),
        pass: checked.map(|checked| checked.pass),
        cost: Cost { cpu_s: entry.cpu_s, runs: 1, ..Cost::default() },
        tier: tier.name().into(),
        code: entry.code.clone(),
        version: entry.version.clone(),
        commit: "unknown".into(),
        machine: "not stated".into(),
        ..Row::default()
    }
}

fn print_rows(rows: &[&Row], passed_over: usize) {
    for row in rows {
        let number = |value: Option<f64>| value.map_or("-".to_string(), |value| format!("{value:.6e}"));
        let verdict = match row.verdict() {
            Verdict::NoClaim => "no claim here",
            Verdict::Met => "met",
            Verdict::UnexpectedPass => "passes although not expected to",
            Verdict::NotMet => "NOT MET",
        };
        let knob = row.knob.as_ref().map_or(String::new(), |knob| format!("{} = {}", knob.name, knob.value));
        print::line(&format!("{} {}: {} [{}; {knob}]", row.code, row.version, row.quantity, row.setup));
        let numbers = [("value", row.value), ("expected", row.expected), ("error", row.error), ("bound", row.bound)];
        let numbers = numbers.map(|(name, value)| format!("{name} {:>13}", number(value))).join("  ");
        print::line(&format!("    {numbers}  {verdict}"));
    }
    if passed_over > 0 {
        print::line(&format!("{passed_over} lines without a value were passed over"));
    }
}
