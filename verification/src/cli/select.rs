//! Which cases an identifier or a pattern means, and which of their points are wanted.

use regex::Regex;

use super::CommandError;
use crate::case::Setup;
use crate::{CASES, Case, Tier};

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

/// Points of cases: setups by label, values of the knob. All of them by default.
#[derive(Debug, Clone, Default)]
pub struct Points {
    setups: Option<Regex>,
    knobs: Vec<f64>,
}

impl Points {
    /// Setups in whose label a regular expression is found, if one is given, at some values of the knob, if any are given.
    ///
    /// # Errors
    ///
    /// If the expression is none.
    pub fn new(setups: Option<&str>, knobs: &[f64]) -> Result<Points, CommandError> {
        let expression = |pattern: &str| {
            Regex::new(pattern).map_err(|error| CommandError::input(format!("--setup `{pattern}` is not a regular expression: {error}")))
        };
        Ok(Points { setups: setups.map(expression).transpose()?, knobs: knobs.to_vec() })
    }

    /// Whether nothing is left out.
    pub fn are_all(&self) -> bool {
        self.setups.is_none() && self.knobs.is_empty()
    }

    /// Whether a point is among them.
    pub fn wants(&self, setup: &Setup, knob: f64) -> bool {
        self.setups.as_ref().is_none_or(|pattern| pattern.is_match(&setup.label)) && (self.knobs.is_empty() || self.knobs.contains(&knob))
    }

    /// Checks that something of each case is wanted.
    ///
    /// # Errors
    ///
    /// If nothing is; the message names the setups and the values that there are.
    pub fn of_each(&self, cases: &[&dyn Case], tier: Tier) -> Result<(), CommandError> {
        for case in cases {
            let description = case.description();
            let knobs = |setup: &Setup| (description.knob.values)(tier, setup);
            if !description.setups.iter().any(|setup| knobs(setup).into_iter().any(|knob| self.wants(setup, knob))) {
                let there = description.setups.iter().map(|setup| (setup, knobs(setup))).filter(|(_, knobs)| !knobs.is_empty());
                let there: Vec<String> = there.map(|(setup, knobs)| format!("`{}` at {knobs:?}", setup.label)).collect();
                let message = format!("--setup and --knob leave nothing of `{}` at the {} tier", description.id, tier.name());
                return Err(CommandError::input(format!("{message} (there are: {})", there.join(", "))));
            }
        }
        Ok(())
    }
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
