//! [`Row`]: one measured number with everything a reviewer needs to believe or remake it. One JSON object a line.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Version of the row format. It rises only when the meaning of a field changes or one is taken away.
pub const SCHEMA: u32 = 1;

/// One measured quantity of one setup at one knob value: what was found, what it is held against, what it cost.
///
/// Units are SI and named in [`Row::unit`]; `1` means dimensionless. Numbers that do not exist are `null`, never NaN.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// Always [`SCHEMA`].
    pub schema: u32,
    /// Identifier of the case, also the stem of its result file.
    pub case: String,
    /// Everything that was held fixed, in words: model variant, end-of-contact rule, scheme.
    pub setup: String,
    /// What was measured, in field terms ("restitution").
    pub quantity: String,
    /// SI unit of `value`, or "1".
    pub unit: String,
    /// The swept parameter and its value here; absent for a number that belongs to the whole sweep (an observed order).
    pub knob: Option<Knob>,
    /// How the samples became one number ("median of 200 phases"), or "single run".
    pub statistic: String,
    /// Number of samples behind the statistic.
    pub n: u64,
    /// 95 % interval of the statistic of the *error*, in the unit of `error`.
    pub ci95: Option<[f64; 2]>,
    /// The statistic of the measured value; absent if the run failed.
    pub value: Option<f64>,
    /// What the value is held against; absent where nothing is expected.
    pub expected: Option<f64>,
    /// Where `expected` comes from.
    pub reference: Option<Reference>,
    /// The statistic of the error of the samples (never negative); absent if the run failed.
    pub error: Option<f64>,
    /// How `error` is formed.
    pub error_kind: ErrorKind,
    /// Smallest error that can mean anything here: round-off and reference uncertainty.
    pub floor: Option<f64>,
    /// Largest error the claim allows; absent for a number that only belongs to a curve.
    pub bound: Option<f64>,
    /// Why the bound is what it is: a floor or design error times a written factor.
    pub bound_reason: Option<String>,
    /// What is expected of the claim.
    pub expectation: Expectation,
    /// For a known limit or a source error: why it does not hold.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expectation_reason: Option<String>,
    /// Whether the claim itself holds (`error <= bound`); absent where there is no claim.
    pub pass: Option<bool>,
    /// Why the run failed, if it did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failed: Option<String>,
    /// What the samples cost together.
    pub cost: Cost,
    /// "quick", "standard" or "paper".
    pub tier: String,
    /// Seed of every random choice.
    pub random_seed: u64,
    /// Threads used inside the case.
    pub threads: u32,
    /// MPI ranks used inside the case.
    pub ranks: u32,
    /// Which code made the number; "touchstone" unless `touchstone compare` brought it in.
    #[serde(default = "our_own_code", skip_serializing_if = "is_our_own_code")]
    pub code: String,
    /// Version of that code.
    pub version: String,
    /// Commit the binary was built from ("unknown" outside a checkout).
    pub commit: String,
    /// Processor, cores and system the number was made on.
    pub machine: String,
    /// Files behind the number, relative to the results folder (curves, samples, picture geometry).
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub data: Vec<String>,
}

impl Default for Row {
    /// A single run of our own code at the quick tier that has measured nothing yet.
    fn default() -> Row {
        Row {
            schema: SCHEMA,
            case: String::new(),
            setup: String::new(),
            quantity: String::new(),
            unit: "1".into(),
            knob: None,
            statistic: "single run".into(),
            n: 1,
            ci95: None,
            value: None,
            expected: None,
            reference: None,
            error: None,
            error_kind: ErrorKind::Absolute,
            floor: None,
            bound: None,
            bound_reason: None,
            expectation: Expectation::Holds,
            expectation_reason: None,
            pass: None,
            failed: None,
            cost: Cost::default(),
            tier: "quick".into(),
            random_seed: 0,
            threads: 1,
            ranks: 1,
            code: our_own_code(),
            version: env!("CARGO_PKG_VERSION").into(),
            commit: String::new(),
            machine: String::new(),
            data: Vec::new(),
        }
    }
}

/// The swept parameter of a study and its value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Knob {
    /// Name in field terms, with underscores ("steps_per_contact").
    pub name: String,
    /// Its value at this row.
    pub value: f64,
}

/// Where an expected value comes from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reference {
    /// The kind of truth it is.
    pub kind: ReferenceKind,
    /// Its own uncertainty, in the unit of the row's error.
    pub uncertainty: f64,
    /// Equation, table, paper or computation.
    pub source: String,
}

/// The kinds of truth, best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ReferenceKind {
    /// A closed form of the model that is coded.
    Exact,
    /// An independent computation to stated digits.
    Computed,
    /// Another code.
    Code,
    /// A laboratory measurement.
    Experiment,
    /// Our own finest resolution.
    OwnFine,
    /// An engineering correlation: a band, never a truth.
    Correlation,
}

/// How an error is formed from a value and what was expected.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ErrorKind {
    /// `|value - expected|`
    Absolute,
    /// `|value - expected| / |expected|`
    Relative,
}

/// What is expected of a claim. Only an expectation that is not met is red.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Expectation {
    /// The claim holds.
    Holds,
    /// The claim does not hold, for a known and written reason; a pass is reported.
    KnownLimit,
    /// A formula as a source prints it, which must fail.
    SourceError,
}

/// What a number cost.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cost {
    /// Exact work counts of all samples together ("steps", "contacts", "pair_tests").
    pub work: BTreeMap<String, u64>,
    /// CPU seconds of the evaluating thread, all samples together: median over interleaved rounds.
    pub cpu_s: Option<f64>,
    /// Smallest and largest of the rounds behind `cpu_s`, too few for an interval of confidence; absent with fewer than three.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cpu_s_range: Option<[f64; 2]>,
    /// Interleaved timing rounds behind `cpu_s`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rounds: Option<u32>,
    /// `cpu_s` over the CPU seconds of the fixed reference kernel run in the same rounds: comparable between machines.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference_kernels: Option<f64>,
    /// Independent runs the cost covers (samples); cost per run is `cpu_s / runs`.
    pub runs: u64,
    /// Wall seconds, context only.
    pub wall_s: Option<f64>,
    /// Instructions, if counted.
    pub instructions: Option<u64>,
    /// Peak memory in bytes, if measured.
    pub peak_bytes: Option<u64>,
}

/// What a row says about its expectation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// No claim is made: the row is a point on a curve.
    NoClaim,
    /// The expectation is met.
    Met,
    /// A known limit or source error passed unexpectedly: reported, not red.
    UnexpectedPass,
    /// The expectation is not met: red.
    NotMet,
}

impl Row {
    /// Whether the row's expectation is met.
    ///
    /// A source error that passes is red (the test lost its power); a known limit that passes is good news to report.
    pub fn verdict(&self) -> Verdict {
        match (self.expectation, self.holds()) {
            (_, None) => Verdict::NoClaim,
            (Expectation::Holds, Some(true)) => Verdict::Met,
            (Expectation::Holds, Some(false)) => Verdict::NotMet,
            (Expectation::KnownLimit, Some(true)) => Verdict::UnexpectedPass,
            (Expectation::SourceError, Some(true)) => Verdict::NotMet,
            (Expectation::KnownLimit | Expectation::SourceError, Some(false)) => Verdict::Met,
        }
    }

    /// Whether the claim itself holds; absent where there is no claim.
    ///
    /// A claim whose run failed does not hold, and an error above its bound overrules a `pass` that says otherwise.
    pub fn holds(&self) -> Option<bool> {
        let above_bound = matches!((self.error, self.bound), (Some(error), Some(bound)) if error > bound);
        match self.pass {
            Some(pass) => Some(pass && !above_bound && self.failed.is_none()),
            None if self.bound.is_some() && self.failed.is_some() => Some(false),
            None => None,
        }
    }

    /// Whether this project measured the row, as opposed to `touchstone compare` having brought it in.
    pub fn is_own(&self) -> bool {
        is_our_own_code(&self.code)
    }

    /// CPU seconds of one run, where they were measured.
    pub fn cpu_s_per_run(&self) -> Option<f64> {
        self.cost.cpu_s.map(|seconds| seconds / self.cost.runs.max(1) as f64)
    }

    /// Smallest and largest CPU seconds of one run over the rounds of timing.
    pub fn cpu_s_per_run_range(&self) -> Option<[f64; 2]> {
        self.cost.cpu_s_range.map(|interval| interval.map(|seconds| seconds / self.cost.runs.max(1) as f64))
    }

    /// The factor that turns `error` into a relative error: 1 if it is one already, 1 / |expected| if it is absolute.
    ///
    /// A dimensionless number, or an angle, expected to be zero has been scaled by its case already, so its factor is 1 too.
    pub fn relative_error_factor(&self) -> Option<f64> {
        match (self.error_kind, self.expected) {
            (ErrorKind::Relative, _) => Some(1.0),
            (ErrorKind::Absolute, Some(expected)) if expected != 0.0 => Some(1.0 / expected.abs()),
            (ErrorKind::Absolute, _) if self.unit == "1" || self.unit == "rad" => Some(1.0),
            (ErrorKind::Absolute, _) => None,
        }
    }
}

impl ReferenceKind {
    /// The kind in plain words, for badges.
    pub fn words(self) -> &'static str {
        match self {
            ReferenceKind::Exact => "exact solution",
            ReferenceKind::Computed => "independent computation",
            ReferenceKind::Code => "another code",
            ReferenceKind::Experiment => "experiment",
            ReferenceKind::OwnFine => "own finest run",
            ReferenceKind::Correlation => "correlation",
        }
    }
}

fn our_own_code() -> String {
    "touchstone".into()
}

fn is_our_own_code(code: &str) -> bool {
    code == "touchstone"
}
