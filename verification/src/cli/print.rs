//! Printing that survives a closed pipe: the work goes on, the text is lost.

use std::io::Write;

/// Prints a line to standard output.
pub fn line(text: &str) {
    // A reader that has gone away (`| head`) is no reason to stop.
    let _ = writeln!(std::io::stdout().lock(), "{text}");
}

/// Prints a line to standard error.
pub fn error_line(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// Prints a value as indented JSON.
pub fn json(value: &serde_json::Value) {
    line(&format!("{value:#}"));
}
