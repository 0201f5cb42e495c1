//! A case: one canonical problem in one file. Its question, its scene, its measurement, its claims and its sources.

use std::collections::BTreeMap;

use reports::card::{Equation, Headline, Parameter, Picture, Plot};
use reports::row::{ErrorKind, Reference, ReferenceKind};
use serde::{Deserialize, Serialize};
use solver::Scene;

use crate::claim::Claim;

/// One canonical problem. [`Case::evaluate`] and [`Case::claims`] are its heart; the rest is what it says about itself.
pub trait Case: Send + Sync {
    /// What the case says about itself.
    fn description(&self) -> Description;

    /// Measures one setup at one knob value. Pure: the same arguments give the same measurement to the bit, without clocks or files.
    ///
    /// # Errors
    ///
    /// A [`Failure`] becomes a failed row; it never stops the others.
    fn evaluate(&self, setup: &Setup, knob: f64, random_seed: u64) -> Result<Measurement, Failure>;

    /// What must hold at a tier.
    fn claims(&self, tier: Tier) -> Vec<Claim>;

    /// The scene behind one setup and knob value, for ledgers and for other codes; by default the case has none.
    fn scene(&self, _setup: &Setup, _knob: f64) -> Option<Scene> {
        None
    }
}

/// How much a run may cost: one word everywhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[serde(rename_all = "snake_case")]
pub enum Tier {
    /// At most five CPU seconds a case.
    Quick,
    /// At most twenty minutes a case on two cores.
    Standard,
    /// The source's own size.
    Paper,
}

impl Tier {
    /// The word in rows and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Tier::Quick => "quick",
            Tier::Standard => "standard",
            Tier::Paper => "paper",
        }
    }
}

/// One variant of a case: everything that is held fixed along a sweep, in words. The label is its identity in rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// Model variant, rule, scheme.
    pub label: String,
    /// Place in the case's own list. Setups come from the description of their case alone, so that a case may index its list by it.
    pub index: usize,
}

/// The swept parameter of a case.
#[derive(Debug, Clone)]
pub struct Knob {
    /// Name in rows, of a setup.
    pub name: fn(&Setup) -> &'static str,
    /// Values of a setup at a tier, coarse to fine.
    pub values: fn(Tier, &Setup) -> Vec<f64>,
}

/// What a case says about itself: static text and lists. Numbers come from measurements.
#[derive(Debug, Clone)]
pub struct Description {
    /// Identifier: lower case, underscores.
    pub id: &'static str,
    /// Title in words.
    pub title: &'static str,
    /// The one-sentence question.
    pub question: &'static str,
    /// What is solved, paragraph by paragraph.
    pub model: Vec<&'static str>,
    /// The equations.
    pub equations: Vec<Equation>,
    /// Fixed parameters.
    pub parameters: Vec<Parameter>,
    /// The reference and its uncertainty in words.
    pub reference: &'static str,
    /// Still picture.
    pub picture: Picture,
    /// Plots in page order.
    pub plots: Vec<Plot>,
    /// The claim in the verdict line.
    pub headline: Headline,
    /// Where model and numbers come from.
    pub sources: Vec<&'static str>,
    /// Requirements, threads and complaints it answers.
    pub answers: Vec<&'static str>,
    /// What a reviewer should know.
    pub remarks: Vec<&'static str>,
    /// The swept parameter.
    pub knob: Knob,
    /// All setups, in the order of pages.
    pub setups: Vec<Setup>,
    /// What one sample of a quantity is ("start phase").
    pub sample: &'static str,
    /// CPU seconds the case may use at the quick, standard and paper tier.
    pub budget_cpu_s: [f64; 3],
}

impl Description {
    /// The budget in CPU seconds at a tier.
    pub fn budget(&self, tier: Tier) -> f64 {
        self.budget_cpu_s[tier as usize]
    }
}

/// Setups from their labels, in order.
pub fn setups(labels: impl IntoIterator<Item = String>) -> Vec<Setup> {
    labels.into_iter().enumerate().map(|(index, label)| Setup { label, index }).collect()
}

/// What one evaluation found.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Measurement {
    /// The measured quantities.
    pub quantities: Vec<Quantity>,
    /// Exact work counts of all runs together.
    pub work: BTreeMap<String, u64>,
    /// Independent runs behind it.
    pub runs: u64,
    /// Curves and samples worth keeping.
    pub curves: Vec<Curve>,
}

/// One measured quantity: its samples and what they are held against.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// Name in field terms.
    pub name: &'static str,
    /// SI unit, or "1".
    pub unit: &'static str,
    /// One value per sample.
    pub samples: Vec<f64>,
    /// What each should be.
    pub expected: f64,
    /// Where that comes from.
    pub reference: Reference,
    /// How errors are formed.
    pub error_kind: ErrorKind,
    /// Smallest error that means anything: round-off and reference uncertainty together, in the unit of the error.
    pub floor: f64,
}

impl Quantity {
    /// Values that should be nothing, and are known no better than an uncertainty.
    pub fn nothing(name: &'static str, samples: Vec<f64>, floor: f64, uncertainty: f64) -> Quantity {
        let reference = Reference { kind: ReferenceKind::Exact, uncertainty, source: "nothing".into() };
        Quantity { name, unit: "1", samples, expected: 0.0, reference, error_kind: ErrorKind::Absolute, floor }
    }

    /// A value that is judged as a part of what it should be, and no further than that is known.
    pub fn relative(name: &'static str, value: f64, expected: f64, reference: Reference) -> Quantity {
        let floor = reference.uncertainty / expected;
        Quantity { name, unit: "1", samples: vec![value], expected, reference, error_kind: ErrorKind::Relative, floor }
    }
}

impl Quantity {
    /// The error of each sample: never negative.
    pub fn errors(&self) -> Vec<f64> {
        let scale = match self.error_kind {
            ErrorKind::Absolute => 1.0,
            ErrorKind::Relative => self.expected.abs(),
        };
        self.samples.iter().map(|value| (value - self.expected).abs() / scale).collect()
    }
}

/// A table kept beside the rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// File name without folder; cases choose it so that setups and knobs do not collide.
    pub file: String,
    /// Column names.
    pub columns: Vec<&'static str>,
    /// Rows of numbers.
    pub rows: Vec<Vec<f64>>,
}

impl Curve {
    /// The table as CSV, exact.
    pub fn to_csv(&self) -> String {
        let mut text = self.columns.join(",");
        text.push('\n');
        for row in &self.rows {
            text.push_str(&row.iter().map(|value| solver::output::digits17(*value)).collect::<Vec<_>>().join(","));
            text.push('\n');
        }
        text
    }
}

/// Why an evaluation gave no measurement.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Failure {
    /// The scene was refused.
    #[error("{0}")]
    Scene(#[from] solver::SceneError),
    /// A guard stopped the run.
    #[error("{0}")]
    Run(#[from] solver::simulation::RunError),
    /// A run could not be continued.
    #[error("{0}")]
    Continuation(String),
    /// The run ended without what was to be measured.
    #[error("{0}")]
    NothingMeasured(String),
}

impl From<solver::output::checkpoint::CheckpointError> for Failure {
    fn from(error: solver::output::checkpoint::CheckpointError) -> Failure {
        Failure::Continuation(error.to_string())
    }
}
