//! Deliberate bugs and what catches them. The list is kept honest by a test: every bug must still be possible to plant.

/// A deliberate bug: a change of the solver's source text that must turn a test red.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mutant {
    /// The bug in words.
    pub name: &'static str,
    /// File, relative to the workspace.
    pub file: &'static str,
    /// Text that stands there exactly once.
    pub original: &'static str,
    /// Text that the bug puts in its place.
    pub planted: &'static str,
    /// What turned red when it was planted: tests by path, cases by `case <id>`.
    pub caught_by: &'static [&'static str],
}

impl Mutant {
    /// Whether a case's claims turn red on it.
    pub fn caught_by_case(&self, id: &str) -> bool {
        self.caught_by.iter().any(|catcher| catcher.strip_prefix("case ") == Some(id))
    }
}

/// All deliberate bugs.
pub const MUTANTS: &[Mutant] = &[];
