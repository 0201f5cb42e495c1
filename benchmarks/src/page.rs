//! What a bench found as a page: rows, a card and data files, where `touchstone report` finds them.

use std::fs;
use std::path::Path;

use reports::card::{Headline, Picture};
use reports::row::ErrorKind;
use reports::{Card, Row};
use verification::cli::environment::Environment;

/// A row with nothing in it yet but what it is of.
pub fn measured(page: &str, setup: &str, quantity: &str, unit: &str, environment: &Environment) -> Row {
    Row {
        case: page.into(),
        setup: setup.into(),
        quantity: quantity.into(),
        unit: unit.into(),
        commit: environment.commit.clone(),
        machine: environment.machine.clone(),
        ..Row::default()
    }
}

/// The row as the claim that its value is no less than a goal: the goal over the value, which stands where other claims have their error, is at most one.
pub fn with_goal(row: Row, goal: f64, reason: &str) -> Row {
    let factor = row.value.map(|value| goal / value);
    Row {
        expected: Some(goal),
        error: factor,
        error_kind: ErrorKind::Relative,
        bound: Some(1.0),
        bound_reason: Some(reason.into()),
        pass: factor.map(|factor| factor <= 1.0),
        ..row
    }
}

/// A card with nothing on it yet but what every page of a bench must say.
pub fn card(page: &str, title: &str, question: &str, headline: [&str; 2]) -> Card {
    let [setup, quantity] = headline.map(str::to_string);
    Card {
        case: page.into(),
        title: title.into(),
        question: question.into(),
        model: Vec::new(),
        equations: Vec::new(),
        parameters: Vec::new(),
        reference: "None: costs are compared, not judged.".into(),
        picture: Picture::default(),
        plots: Vec::new(),
        headline: Headline { setup, quantity, statistic: String::new(), knob: 0.0, order_quantity: None },
        ledger: Vec::new(),
        mutants: Vec::new(),
        sources: Vec::new(),
        answers: Vec::new(),
        remarks: Vec::new(),
        budget_cpu_s: 600.0,
        command: Some(format!("cargo bench --bench {page}")),
    }
}

/// Paragraphs or list entries of a card.
pub fn lines<const N: usize>(lines: [&str; N]) -> Vec<String> {
    lines.map(str::to_string).to_vec()
}

/// Writes a page's data files, card and rows, in this order, and says where; data files are named relative to the folder of results.
///
/// # Errors
///
/// If a file cannot be written.
pub fn write(results: &Path, card: &Card, rows: &[Row], data: &[(&str, String)]) -> Result<(), Box<dyn std::error::Error>> {
    let folder = results.join(&card.case);
    fs::create_dir_all(&folder)?;
    for (path, text) in data {
        fs::write(results.join(path), text)?;
    }
    fs::write(folder.join("card.json"), serde_json::to_string_pretty(card)? + "\n")?;
    let path = results.join(format!("{}.jsonl", card.case));
    fs::write(&path, reports::write_rows(rows))?;
    println!("\nrows: {}; `touchstone report` makes their page", path.display());
    Ok(())
}
