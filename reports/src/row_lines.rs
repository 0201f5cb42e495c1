//! Rows as text: one JSON object a line.

use crate::Row;
use crate::row::SCHEMA;

/// A line that is not a row.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {message}")]
pub struct ReadError {
    /// Line number, counted from 1.
    pub line: usize,
    /// What is wrong with it.
    pub message: String,
}

/// Reads rows, one JSON object a line; blank lines are skipped.
///
/// # Errors
/// The first line that is not JSON, has an unknown or missing field, or is of another schema.
pub fn read_rows(text: &str) -> Result<Vec<Row>, ReadError> {
    text.lines()
        .enumerate()
        .filter(|(_, line)| !line.trim().is_empty())
        .map(|(index, line)| read_row(line).map_err(|message| ReadError { line: index + 1, message }))
        .collect()
}

fn read_row(line: &str) -> Result<Row, String> {
    let row: Row = serde_json::from_str(line).map_err(|error| error.to_string())?;
    if row.schema == SCHEMA { Ok(row) } else { Err(format!("schema {} is not supported, this version reads schema {SCHEMA}", row.schema)) }
}

/// Writes rows, one JSON object a line, each line ended.
pub fn write_rows(rows: &[Row]) -> String {
    rows.iter().map(|row| row_line(row) + "\n").collect()
}

/// One row as one JSON line without its end.
pub fn row_line(row: &Row) -> String {
    // A row is plain data with text keys, which JSON can always hold; an error text keeps the line count right anyway.
    serde_json::to_string(row).unwrap_or_else(|error| format!("{{\"unwritable\":\"{error}\"}}"))
}
