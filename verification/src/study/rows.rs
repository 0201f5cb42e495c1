//! Measurements and claims to rows.

use reports::row::{Cost, Knob, Row};

use super::Context;
use super::timing::Timing;
use crate::case::{Curve, Description, Failure, Measurement, Quantity, Setup};
use crate::claim::{Claim, Statistic, Subject};
use crate::statistics::{OrderPoint, index_of_largest, median, median_interval, observed_order};

/// All measurements with their costs.
pub(super) struct Measured {
    points: Vec<Point>,
}

struct Point {
    setup: String,
    knob_name: &'static str,
    knob: f64,
    result: Result<Measurement, Failure>,
    cost: Cost,
}

impl Measured {
    pub(super) fn new(
        points: &[(&Setup, f64)],
        results: Vec<Result<Measurement, Failure>>,
        timing: &Timing,
        knob_name: fn(&Setup) -> &'static str,
    ) -> Measured {
        let nothing = Measurement::default();
        let measured = results.into_iter().zip(points).enumerate().map(|(index, (result, (setup, knob)))| {
            let cost = timing.cost(index, result.as_ref().unwrap_or(&nothing));
            Point { setup: setup.label.clone(), knob_name: knob_name(setup), knob: *knob, result, cost }
        });
        Measured { points: measured.collect() }
    }

    pub(super) fn rows(&self, context: &Context<'_>, description: &Description) -> Vec<Row> {
        let mut rows = Vec::new();
        for point in &self.points {
            let mut row = empty_row(context, description);
            row.setup.clone_from(&point.setup);
            row.knob = Some(Knob { name: point.knob_name.into(), value: point.knob });
            row.cost = point.cost.clone();
            match &point.result {
                Ok(measurement) => {
                    for quantity in &measurement.quantities {
                        rows.extend(rows_of_quantity(&row, quantity, description.sample));
                    }
                }
                Err(failure) => rows.push(Row { failed: Some(failure.to_string()), quantity: "run".into(), ..row }),
            }
        }
        rows
    }

    pub(super) fn curves(&self) -> Vec<Curve> {
        self.points.iter().filter_map(|point| point.result.as_ref().ok()).flat_map(|measurement| measurement.curves.clone()).collect()
    }
}

fn empty_row(context: &Context<'_>, description: &Description) -> Row {
    Row {
        case: description.id.into(),
        tier: context.tier.name().into(),
        random_seed: context.random_seed,
        commit: context.commit.clone(),
        machine: context.machine.clone(),
        ..Row::default()
    }
}

/// Median and worst of many samples, or the only one.
fn rows_of_quantity(row: &Row, quantity: &Quantity, sample: &str) -> Vec<Row> {
    let errors = quantity.errors();
    let row = Row {
        quantity: quantity.name.into(),
        unit: quantity.unit.into(),
        n: errors.len() as u64,
        expected: Some(quantity.expected),
        reference: Some(quantity.reference.clone()),
        error_kind: quantity.error_kind,
        floor: Some(quantity.floor),
        ..row.clone()
    };
    let finite = |value: f64| value.is_finite().then_some(value);
    if errors.len() == 1 {
        return vec![with_failure(Row { value: finite(quantity.samples[0]), error: finite(errors[0]), ..row })];
    }
    let statistic = |kind: Statistic| format!("{} of {} {sample}s", kind.name(), errors.len());
    let middle = Row {
        statistic: statistic(Statistic::Median),
        ci95: median_interval(&errors).filter(|interval| interval.iter().all(|bound| bound.is_finite())),
        value: finite(median(&quantity.samples)),
        error: finite(median(&errors)),
        ..row.clone()
    };
    let largest = index_of_largest(&errors);
    let worst = Row {
        statistic: statistic(Statistic::Worst),
        value: largest.and_then(|index| finite(quantity.samples[index])),
        error: largest.and_then(|index| finite(errors[index])),
        ..row
    };
    vec![with_failure(middle), with_failure(worst)]
}

fn with_failure(row: Row) -> Row {
    let failed = row.error.is_none().then(|| "the measured value is not a finite number".to_string());
    Row { failed, ..row }
}

/// Writes what a claim says into the row it speaks of, or adds a row for an order.
pub(super) fn apply_claims(rows: &mut Vec<Row>, claims: &[Claim], context: &Context<'_>, description: &Description) {
    for claim in claims {
        match claim.subject {
            Subject::ErrorAt(knob) => {
                let about = |row: &&mut Row| is_about(row, claim) && row.knob.as_ref().is_some_and(|at| at.value == knob);
                match rows.iter_mut().find(about) {
                    Some(row) => {
                        let observed = row.error.unwrap_or(f64::NAN);
                        write_verdict(row, claim, observed);
                    }
                    None => rows.push(missing(claim, context, description)),
                }
            }
            Subject::OrderAtLeast { order, range } | Subject::OrderAbout { order, range } => {
                let row = order_row(rows, claim, order, range, empty_row(context, description));
                rows.push(row);
            }
        }
    }
}

/// Whether a row holds the quantity, setup and statistic that a claim speaks of.
fn is_about(row: &Row, claim: &Claim) -> bool {
    row.setup == claim.setup && row.quantity == claim.quantity && row.statistic.starts_with(claim.statistic.name())
}

/// A claim about a row that does not exist is a claim that fails: it must not pass in silence.
fn missing(claim: &Claim, context: &Context<'_>, description: &Description) -> Row {
    let mut row = empty_row(context, description);
    row.setup.clone_from(&claim.setup);
    row.quantity = claim.quantity.into();
    row.failed = Some("the claim speaks of a measurement that was not made".into());
    write_verdict(&mut row, claim, f64::NAN);
    row
}

fn write_verdict(row: &mut Row, claim: &Claim, observed: f64) {
    let checked = claim.check(observed);
    row.error = checked.error.is_finite().then_some(checked.error);
    row.bound = Some(claim.bound.value());
    row.bound_reason = Some(claim.bound.reason());
    row.expectation = claim.expected.expectation();
    row.expectation_reason = claim.expected.reason();
    row.pass = Some(checked.pass);
}

fn order_row(rows: &[Row], claim: &Claim, order: f64, range: [f64; 2], empty: Row) -> Row {
    let [coarse, fine] = if range[0] <= range[1] { range } else { [range[1], range[0]] };
    let point = |row: &Row| {
        let resolution = row.knob.as_ref()?.value;
        let inside = (coarse..=fine).contains(&resolution);
        inside.then_some(OrderPoint { resolution, error: row.error?, floor: row.floor.unwrap_or(0.0) })
    };
    let points: Vec<OrderPoint> = rows.iter().filter(|row| is_about(row, claim)).filter_map(point).collect();
    let observed = observed_order(&points);
    let mut row = Row {
        setup: claim.setup.clone(),
        quantity: format!("observed order of {}", claim.quantity),
        statistic: format!("fit of {} errors over {} points", claim.statistic.name(), points.len()),
        n: points.len() as u64,
        value: observed,
        expected: Some(order),
        reference: Some(reports::row::Reference {
            kind: reports::row::ReferenceKind::Exact,
            uncertainty: claim.bound.floor,
            source: "design order of the scheme".into(),
        }),
        floor: Some(claim.bound.floor),
        ..empty
    };
    write_verdict(&mut row, claim, observed.unwrap_or(f64::NAN));
    if observed.is_none() {
        row.failed = Some("fewer than two errors stand above their floors".into());
    }
    row
}

pub(super) fn budget_row(spent: f64, context: &Context<'_>, description: &Description) -> Row {
    let budget = description.budget(context.tier);
    Row {
        setup: "all setups and rounds".into(),
        quantity: "cpu time of the case".into(),
        unit: "s".into(),
        value: Some(spent),
        expected: Some(0.0),
        error: Some(spent),
        floor: Some(budget),
        bound: Some(budget),
        bound_reason: Some("1 x the budget that the case declares for this tier".into()),
        pass: Some(spent <= budget),
        ..empty_row(context, description)
    }
}

/// Every round must measure the same bits.
pub(super) fn repeat_row(others: usize, rounds: usize, context: &Context<'_>, description: &Description) -> Row {
    Row {
        setup: "all setups and rounds".into(),
        quantity: "rounds that measured other bits".into(),
        statistic: "comparison of the rounds of timing".into(),
        cost: Cost { rounds: Some(rounds as u32), ..Cost::default() },
        value: Some(others as f64),
        expected: Some(0.0),
        error: Some(others as f64),
        floor: Some(0.0),
        bound: Some(0.0),
        bound_reason: Some("the same input gives the same bits: not one round may differ".into()),
        pass: Some(others == 0),
        ..empty_row(context, description)
    }
}
