//! What changed since the last release: the same row then and now.

use crate::summary::same_knob;
use crate::{CaseResults, Row};

/// How a number moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Direction {
    Better,
    Unchanged,
    Worse,
}

/// An error now and at the last release.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Change {
    pub(crate) before: f64,
    pub(crate) now: f64,
    pub(crate) direction: Direction,
}

impl Change {
    /// Compares two errors; within a thousandth, or below the floor both times, nothing has changed.
    pub(crate) fn new(before: f64, now: f64, floor: Option<f64>) -> Change {
        let unchanged = (now - before).abs() <= 1e-3 * before.abs() || now.max(before) <= floor.unwrap_or(0.0);
        let direction = match unchanged {
            true => Direction::Unchanged,
            false if now < before => Direction::Better,
            false => Direction::Worse,
        };
        Change { before, now, direction }
    }

    /// The arrow that stands for it: down is a smaller error.
    pub(crate) fn arrow(self) -> &'static str {
        match self.direction {
            Direction::Better => "↓",
            Direction::Unchanged => "→",
            Direction::Worse => "↑",
        }
    }
}

/// The change of a row's error since the last release; absent if the release has no such row.
pub(crate) fn change_of(case: &CaseResults, row: &Row) -> Option<Change> {
    let before = case.baseline.iter().find(|old| same_measurement(old, row))?;
    Some(Change::new(before.error?, row.error?, row.floor))
}

/// How many of the rows with an error also have one in the last release, and how many of those became worse.
pub(crate) fn count_changes(case: &CaseResults) -> (usize, usize, usize) {
    let changes: Vec<Change> = case.own_rows().filter_map(|(_, row)| change_of(case, row)).collect();
    let count = |direction| changes.iter().filter(|change| change.direction == direction).count();
    (changes.len(), count(Direction::Better), count(Direction::Worse))
}

fn same_measurement(old: &Row, new: &Row) -> bool {
    let knobs_agree = match (&old.knob, &new.knob) {
        (Some(a), Some(b)) => a.name == b.name && same_knob(a.value, b.value),
        (None, None) => true,
        _ => false,
    };
    knobs_agree
        && old.setup == new.setup
        && old.quantity == new.quantity
        && old.statistic == new.statistic
        && old.tier == new.tier
        && old.code == new.code
}
