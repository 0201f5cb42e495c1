//! Which cases an identifier or a pattern means.

use regex::Regex;

use super::CommandError;
use crate::{CASES, Case};

/// The case of an identifier.
pub fn by_id(identifier: &str) -> Result<&'static dyn Case, CommandError> {
    CASES.iter().copied().find(|case| case.description().id == identifier).ok_or_else(|| unknown(identifier))
}

/// The case whose identifier is the pattern; else all cases whose identifier the pattern, as a regular expression, is found in.
pub fn matching(pattern: &str) -> Result<Vec<&'static dyn Case>, CommandError> {
    if let Ok(case) = by_id(pattern) {
        return Ok(vec![case]);
    }
    let expression = Regex::new(pattern)
        .map_err(|error| CommandError::input(format!("`{pattern}` is neither a case nor a regular expression: {error}")))?;
    let found: Vec<_> = CASES.iter().copied().filter(|case| expression.is_match(case.description().id)).collect();
    if found.is_empty() { Err(unknown(pattern)) } else { Ok(found) }
}

fn unknown(identifier: &str) -> CommandError {
    let known: Vec<&str> = CASES.iter().map(|case| case.description().id).collect();
    let hint = nearest(identifier, known.iter().copied()).map_or(String::new(), |near| format!("; did you mean `{near}`?"));
    CommandError::input(format!("there is no case `{identifier}`{hint} (cases: {})", known.join(", ")))
}

/// The candidate most like a name, if any is like it at all.
pub fn nearest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    candidates
        .map(|candidate| (strsim::jaro_winkler(name, candidate), candidate))
        .filter(|(likeness, _)| *likeness > 0.6)
        .max_by(|left, right| left.0.total_cmp(&right.0))
        .map(|(_, candidate)| candidate)
}
