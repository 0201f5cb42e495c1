//! Deliberate bugs and what catches them: the power of the suite, not only its verdict.
//!
//! `cargo run -p verification --example plant_bugs` plants each in a copy of the workspace, runs `cargo test` there, and prints what turned red. A
//! test keeps the list honest: every bug can still be planted.

mod contact;
mod coupled;
mod fluid;
mod hard;
mod law;
mod motion;
mod packed_bed;
mod shape;
mod surroundings;

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
    /// Tests that turned red when it was planted.
    pub caught_by: &'static [&'static str],
}

impl Mutant {
    /// Whether the claims or the snapshot of a case turn red on it.
    pub fn caught_by_case(&self, id: &str) -> bool {
        self.caught_by.iter().any(|test| test.contains(id))
    }
}

/// All deliberate bugs.
pub fn all() -> impl Iterator<Item = &'static Mutant> {
    [
        motion::MUTANTS,
        law::MUTANTS,
        contact::MUTANTS,
        shape::MUTANTS,
        hard::MUTANTS,
        surroundings::MUTANTS,
        fluid::MUTANTS,
        coupled::MUTANTS,
        packed_bed::MUTANTS,
    ]
    .into_iter()
    .flatten()
}
