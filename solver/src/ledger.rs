//! The ledger: for each physics or stage, whether a scene uses it, why, and how often it worked.
//!
//! It is the evidence for "leave out what a scene does not need": a stage that is left out has no counters that could rise.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// What a simulation uses and leaves out, in the order in which a step would run it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    /// One entry per physics or stage.
    pub entries: Vec<Entry>,
}

/// One physics or stage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// Name, unique in the ledger.
    pub stage: String,
    /// Whether the scene needs it.
    pub used: bool,
    /// The variant in use, or why it is left out.
    pub reason: String,
    /// Exact work counts since the start of the run; empty if left out.
    pub work: BTreeMap<String, u64>,
}

impl Ledger {
    /// Adds a stage that runs.
    pub fn used(&mut self, stage: &str, reason: impl Into<String>, work: impl IntoIterator<Item = (&'static str, u64)>) {
        let work = work.into_iter().map(|(name, count)| (name.to_string(), count)).collect();
        self.entries.push(Entry { stage: stage.to_string(), used: true, reason: reason.into(), work });
    }

    /// Adds a stage that is left out.
    pub fn left_out(&mut self, stage: &str, reason: impl Into<String>) {
        self.entries.push(Entry { stage: stage.to_string(), used: false, reason: reason.into(), work: BTreeMap::new() });
    }

    /// All work counts of all stages, summed by name.
    pub fn total_work(&self) -> BTreeMap<String, u64> {
        let mut total = BTreeMap::new();
        for (name, count) in self.entries.iter().flat_map(|entry| &entry.work) {
            *total.entry(name.clone()).or_insert(0) += count;
        }
        total
    }
}

impl std::fmt::Display for Ledger {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for entry in &self.entries {
            let mark = if entry.used { "used    " } else { "left out" };
            write!(formatter, "{mark}  {}: {}", entry.stage, entry.reason)?;
            for (name, count) in &entry.work {
                write!(formatter, "; {name} {count}")?;
            }
            writeln!(formatter)?;
        }
        Ok(())
    }
}
