//! The table another code comes back with: every cell checked against what the case knows.

use std::collections::BTreeMap;

use crate::Tier;
use crate::case::{Description, Quantity, Setup};
use crate::cli::CommandError;
use crate::cli::select::nearest;
use crate::export::{COMPARE_COLUMNS, slug};

/// The lines of a table that have a value.
pub struct Table {
    /// Name of the file, for errors.
    pub file: String,
    /// Lines with a value.
    pub entries: Vec<Entry>,
    /// Number of lines without one.
    pub passed_over: usize,
}

/// One value of another code.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Line in the file, from 1.
    pub line: u64,
    /// The setup it is of.
    pub setup: Setup,
    /// Name of the quantity.
    pub quantity: String,
    /// Unit that the other code says it is in.
    pub unit: String,
    /// Name of the swept parameter.
    pub knob_name: String,
    /// Its value: one of the case's own.
    pub knob: f64,
    /// The value.
    pub value: f64,
    /// CPU seconds of the run.
    pub cpu_s: Option<f64>,
    /// Name of the code.
    pub code: String,
    /// Its version.
    pub version: String,
}

/// Reads a table and checks everything but its quantities, which [`find_quantity`] checks once they have been measured.
pub fn read(file: &str, text: &str, description: &Description) -> Result<Table, CommandError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).trim(csv::Trim::All).from_reader(text.as_bytes());
    let mut records = reader.records();
    let wanted = COMPARE_COLUMNS.join(",");
    let header = match records.next() {
        Some(header) => header.map_err(|error| not_csv(file, &error))?,
        None => return Err(CommandError::input(format!("{file}: the file is empty; its header must be `{wanted}`"))),
    };
    if header != COMPARE_COLUMNS[..] {
        let found = header.iter().collect::<Vec<_>>().join(",");
        return Err(CommandError::input(format!("{file}:1: the header is `{found}`; it must be `{wanted}`")));
    }
    let mut table = Table { file: file.to_string(), entries: Vec::new(), passed_over: 0 };
    for record in records {
        let record = record.map_err(|error| not_csv(file, &error))?;
        match Line::new(file, &record)?.entry(description)? {
            Some(entry) => table.entries.push(entry),
            None => table.passed_over += 1,
        }
    }
    check_codes(&table)?;
    Ok(table)
}

fn not_csv(file: &str, error: &csv::Error) -> CommandError {
    CommandError::input(format!("{file}: not CSV: {error}"))
}

/// One line before it is understood.
struct Line<'a> {
    file: &'a str,
    number: u64,
    cells: &'a csv::StringRecord,
}

impl<'a> Line<'a> {
    fn new(file: &'a str, cells: &'a csv::StringRecord) -> Result<Line<'a>, CommandError> {
        let line = Line { file, number: cells.position().map_or(0, csv::Position::line), cells };
        let (found, wanted) = (cells.len(), COMPARE_COLUMNS.len());
        if found != wanted {
            let hint = "a setup with a comma in it needs quotation marks";
            return Err(CommandError::input(format!("{file}:{}: {found} columns instead of {wanted} ({hint})", line.number)));
        }
        Ok(line)
    }

    fn cell(&self, column: &str) -> &'a str {
        let place = COMPARE_COLUMNS.iter().position(|known| *known == column);
        place.and_then(|place| self.cells.get(place)).unwrap_or_default()
    }

    fn wrong(&self, column: &str, what: &str) -> CommandError {
        wrong(self.file, self.number, column, self.cell(column), what)
    }

    /// The entry, or nothing if the line has no value.
    fn entry(&self, description: &Description) -> Result<Option<Entry>, CommandError> {
        if self.cell("value").is_empty() {
            return Ok(None);
        }
        let labels = || description.setups.iter().map(|setup| setup.label.as_str());
        let setup = description.setups.iter().find(|setup| setup.label == self.cell("setup"));
        let setup = setup.ok_or_else(|| self.wrong("setup", &not_one_of("a setup of the case", self.cell("setup"), labels())))?;
        let knob_name = (description.knob.name)(setup);
        if self.cell("knob_name") != knob_name {
            return Err(self.wrong("knob_name", &format!("the knob of this setup is `{knob_name}`")));
        }
        let code = self.cell("code");
        if slug(code).is_empty() || slug(code) == "touchstone" {
            return Err(self.wrong("code", "name the code that made the value; `touchstone` is this one"));
        }
        Ok(Some(Entry {
            line: self.number,
            setup: setup.clone(),
            quantity: self.cell("quantity").into(),
            unit: self.cell("unit").into(),
            knob_name: self.cell("knob_name").into(),
            knob: self.knob(description, setup)?,
            value: self.number("value")?,
            cpu_s: if self.cell("cpu_s").is_empty() { None } else { Some(self.seconds("cpu_s")?) },
            code: code.into(),
            version: self.cell("version").into(),
        }))
    }

    fn number(&self, column: &str) -> Result<f64, CommandError> {
        let value: f64 = self.cell(column).parse().map_err(|_| self.wrong(column, "a number is needed"))?;
        if value.is_finite() { Ok(value) } else { Err(self.wrong(column, "a finite number is needed")) }
    }

    fn seconds(&self, column: &str) -> Result<f64, CommandError> {
        let value = self.number(column)?;
        if value > 0.0 { Ok(value) } else { Err(self.wrong(column, "a number above zero is needed, or nothing")) }
    }

    /// The case's own knob value that the line means.
    fn knob(&self, description: &Description, setup: &Setup) -> Result<f64, CommandError> {
        let value = self.number("knob_value")?;
        let tiers = [Tier::Quick, Tier::Standard, Tier::Paper];
        let mut allowed: Vec<f64> = tiers.into_iter().flat_map(|tier| (description.knob.values)(tier, setup)).collect();
        allowed.sort_by(f64::total_cmp);
        allowed.dedup();
        let distance = |allowed: &f64| (allowed - value).abs();
        let nearest = allowed.iter().copied().min_by(|left, right| distance(left).total_cmp(&distance(right)));
        match nearest {
            Some(nearest) if is_same_knob(nearest, value) => Ok(nearest),
            _ => {
                let nearest = nearest.map_or(String::new(), |nearest| format!("; the nearest is {nearest}"));
                let allowed = allowed.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
                Err(self.wrong("knob_value", &format!("not a value of the knob{nearest} (values: {allowed})")))
            }
        }
    }
}

/// Whether two knob values are the same: they go through text, so the last digits may differ.
pub fn is_same_knob(one: f64, other: f64) -> bool {
    (one - other).abs() <= 1e-12 * one.abs().max(other.abs())
}

/// The quantity that an entry names, in the unit that the case has it in.
pub fn find_quantity<'a>(table: &Table, entry: &Entry, quantities: &'a [Quantity]) -> Result<&'a Quantity, CommandError> {
    let wrong = |column: &str, value: &str, what: &str| wrong(&table.file, entry.line, column, value, what);
    let names = || quantities.iter().map(|quantity| quantity.name);
    let found = quantities.iter().find(|quantity| quantity.name == entry.quantity);
    let found = found.ok_or_else(|| wrong("quantity", &entry.quantity, &not_one_of("a quantity of the case", &entry.quantity, names())))?;
    if found.unit != entry.unit {
        return Err(wrong("unit", &entry.unit, &format!("the case has it in `{}`", found.unit)));
    }
    Ok(found)
}

fn wrong(file: &str, line: u64, column: &str, value: &str, what: &str) -> CommandError {
    CommandError::input(format!("{file}:{line}: column `{column}`: `{value}`: {what}"))
}

fn not_one_of<'a>(what: &str, name: &str, known: impl Iterator<Item = &'a str> + Clone) -> String {
    let nearest = nearest(name, known.clone()).map_or(String::new(), |near| format!("; the nearest is `{near}`"));
    format!("not {what}{nearest} (known: {})", known.map(|known| format!("`{known}`")).collect::<Vec<_>>().join(", "))
}

/// There is at least one value, none is given twice, and no two codes would share a file.
fn check_codes(table: &Table) -> Result<(), CommandError> {
    if table.entries.is_empty() {
        return Err(CommandError::input(format!("{}: no line has a value", table.file)));
    }
    let mut code_of_slug: BTreeMap<String, &str> = BTreeMap::new();
    let mut seen = BTreeMap::new();
    for entry in &table.entries {
        let here = |what: String, column: &str, value: &str| wrong(&table.file, entry.line, column, value, &what);
        let code = *code_of_slug.entry(slug(&entry.code)).or_insert(&entry.code);
        if code != entry.code {
            return Err(here(format!("too like the code `{code}` of another line"), "code", &entry.code));
        }
        let number = (&entry.code, &entry.version, entry.setup.index, &entry.quantity, entry.knob.to_bits());
        if let Some(line) = seen.insert(number, entry.line) {
            return Err(here(format!("given already in line {line}"), "quantity", &entry.quantity));
        }
    }
    Ok(())
}
