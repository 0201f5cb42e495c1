//! Each formula that source S prints wrong: one number as printed, one as coded.

mod collisions;
mod geometry;
mod page;

use reports::row::{ErrorKind, Reference, ReferenceKind};

use crate::case::{Case, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};

/// The case.
pub struct ErrataS;

/// One wrong formula, and a number that shows it.
pub struct Erratum {
    /// Number of the equation; the first of several.
    pub equation: f64,
    /// What is wrong.
    pub what: &'static str,
    /// What is measured.
    pub quantity: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// What it must be, from definitions or by hand.
    pub expected: f64,
    /// Rounding of the number as coded, in its unit, or the error of the run behind it.
    pub floor: f64,
    /// By the formula as printed.
    pub printed: fn() -> Result<f64, Failure>,
    /// By the solver.
    pub coded: fn() -> Result<f64, Failure>,
}

impl Erratum {
    /// Of an equation: what is wrong, name and unit of the number that shows it, what that must be and how far it may round.
    fn new(
        equation: f64,
        what: &'static str,
        [quantity, unit]: [&'static str; 2],
        [expected, floor]: [f64; 2],
        printed: fn() -> Result<f64, Failure>,
        coded: fn() -> Result<f64, Failure>,
    ) -> Erratum {
        Erratum { equation, what, quantity, unit, expected, floor, printed, coded }
    }
}

/// Rounding of a number of the size of one after a few dozen operations.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

fn errata() -> Vec<Erratum> {
    geometry::errata().into_iter().chain(collisions::errata()).collect()
}

/// Whose formula is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Printed,
    Coded,
}

const FORMS: [Form; 2] = [Form::Printed, Form::Coded];

fn label(erratum: &Erratum, form: Form) -> String {
    let form = if form == Form::Printed { "as printed" } else { "as coded" };
    format!("S {}: {}, {form}", erratum.equation, erratum.what)
}

fn labels() -> Vec<String> {
    errata().iter().flat_map(|erratum| FORMS.map(|form| label(erratum, form))).collect()
}

impl Case for ErrataS {
    fn evaluate(&self, setup: &Setup, _knob: f64, _random_seed: u64) -> Result<Measurement, Failure> {
        let all = errata();
        let erratum = all.get(setup.index / FORMS.len()).ok_or_else(|| Failure::NothingMeasured(setup.label.clone()))?;
        let value = match FORMS[setup.index % FORMS.len()] {
            Form::Printed => (erratum.printed)()?,
            Form::Coded => (erratum.coded)()?,
        };
        let quantity = Quantity {
            name: erratum.quantity,
            unit: erratum.unit,
            samples: vec![value],
            expected: erratum.expected,
            reference: Reference { kind: ReferenceKind::Exact, uncertainty: 0.0, source: "definitions, by hand".into() },
            error_kind: ErrorKind::Absolute,
            floor: erratum.floor,
        };
        Ok(Measurement { quantities: vec![quantity], runs: 1, ..Measurement::default() })
    }

    fn claims(&self, _tier: Tier) -> Vec<Claim> {
        let claim = |erratum: &Erratum, form: Form| Claim {
            setup: label(erratum, form),
            quantity: erratum.quantity,
            statistic: Statistic::Single,
            subject: Subject::ErrorAt(erratum.equation),
            bound: Bound::new(10.0, erratum.floor, "rounding, or the step of the run"),
            expected: if form == Form::Printed { Expected::SourceError(erratum.what.into()) } else { Expected::Holds },
        };
        errata().iter().flat_map(|erratum| FORMS.map(|form| claim(erratum, form))).collect()
    }

    fn description(&self) -> Description {
        page::description()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_unique() {
        let unique: std::collections::BTreeSet<String> = labels().into_iter().collect();
        assert_eq!(unique.len(), labels().len());
    }
}
