//! A study: every setup at every knob value, measured, timed in interleaved rounds, and turned into rows.

use std::collections::BTreeMap;

use reports::card::{Card, LedgerLine, Mutant};
use reports::row::{Cost, ErrorKind, Expectation, Knob, Row, SCHEMA};

use crate::case::{Case, Curve, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::{Claim, Statistic, Subject};
use crate::statistics::{OrderPoint, index_of_largest, median, median_interval, observed_order};
use crate::{mutants, reference_kernel};

/// What a study needs from outside: it has no clock and no environment of its own.
pub struct Context<'a> {
    /// How much may be spent.
    pub tier: Tier,
    /// Seed of every random choice.
    pub random_seed: u64,
    /// Commit of the source.
    pub commit: String,
    /// Machine in words.
    pub machine: String,
    /// Only these points, for a quick look; claims about others are then left aside. `None`: all.
    pub only: Option<&'a PointFilter>,
    /// Clock, if times are wanted.
    pub clock: Option<&'a dyn Clock>,
    /// Told after every evaluation how many are done and how many there are in this round.
    pub progress: &'a dyn Fn(usize, usize),
}

/// Whether a setup at a knob value is wanted.
pub type PointFilter = dyn Fn(&Setup, f64) -> bool + Sync;

/// A clock.
pub trait Clock: Sync {
    /// CPU seconds of the calling thread.
    fn cpu_seconds(&self) -> f64;
    /// Wall seconds.
    fn wall_seconds(&self) -> f64;
}

/// What a study found.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// One row per number.
    pub rows: Vec<Row>,
    /// What the case says about itself.
    pub card: Card,
    /// Curves and samples.
    pub curves: Vec<Curve>,
}

/// Rounds of interleaved timing: more tell the interval, fewer save time.
const LARGEST_NUMBER_OF_ROUNDS: usize = 5;

/// A round in which the reference kernel took this much more or less than its median is not used.
const REJECTION: f64 = 0.1;

/// Runs a case at a tier.
pub fn run(case: &dyn Case, context: &Context<'_>) -> Outcome {
    let description = case.description();
    let knobs = |setup| (description.knob.values)(context.tier, setup);
    let wanted = |setup: &Setup, knob: f64| context.only.is_none_or(|only| only(setup, knob));
    let all = description.setups.iter().flat_map(|setup| knobs(setup).into_iter().map(move |knob| (setup, knob)));
    let points: Vec<(&Setup, f64)> = all.filter(|(setup, knob)| wanted(setup, *knob)).collect();
    let mut rounds = vec![Round::run(case, context, &points, false)];
    let wanted = number_of_rounds(description.budget(context.tier), &rounds[0], context);
    for index in 1..wanted {
        rounds.push(Round::run(case, context, &points, index % 2 == 1));
    }
    let timing = Timing::new(&rounds);
    let spent: f64 = rounds.iter().map(Round::cpu_seconds).sum();
    let measured = Measured::new(&points, rounds.swap_remove(0).results, &timing);
    let mut rows = measured.rows(context, &description);
    let mut claims = case.claims(context.tier);
    if context.only.is_some() {
        claims.retain(|claim| can_be_judged(claim, &points));
    }
    apply_claims(&mut rows, &claims, context, &description);
    if context.clock.is_some() {
        rows.push(budget_row(spent, context, &description));
    }
    let mut curves = measured.curves();
    curves.extend(timing.curve(&points));
    for row in &mut rows {
        row.data = curves.iter().map(|curve| format!("{}/{}", description.id, curve.file)).collect();
        row.data.push(format!("{}/card.json", description.id));
    }
    Outcome { rows, card: card(case, &description, context.tier), curves }
}

/// Whether the points that were run are enough for a claim: its own point, or three of the range of an order.
fn can_be_judged(claim: &Claim, points: &[(&Setup, f64)]) -> bool {
    let mut of_setup = points.iter().filter(|(setup, _)| setup.label == claim.setup).map(|(_, knob)| *knob);
    match claim.subject {
        Subject::ErrorAt(at) => of_setup.any(|knob| knob == at),
        Subject::OrderAtLeast { range, .. } | Subject::OrderAbout { range, .. } => {
            of_setup.filter(|knob| (range[0]..=range[1]).contains(knob)).count() >= 3
        }
    }
}

fn number_of_rounds(budget: f64, first: &Round, context: &Context<'_>) -> usize {
    if context.clock.is_none() {
        return 1;
    }
    // Half of the budget is for timing; the rest is slack for slower machines.
    let affordable = 0.5 * budget / first.cpu_seconds().max(1e-9);
    (affordable as usize).clamp(1, LARGEST_NUMBER_OF_ROUNDS)
}

/// One evaluation of every point, with times.
struct Round {
    results: Vec<Result<Measurement, Failure>>,
    cpu: Vec<f64>,
    wall: Vec<f64>,
    reference_cpu: f64,
}

impl Round {
    fn run(case: &dyn Case, context: &Context<'_>, points: &[(&Setup, f64)], backwards: bool) -> Round {
        let cpu_now = || context.clock.map_or(0.0, Clock::cpu_seconds);
        let wall_now = || context.clock.map_or(0.0, Clock::wall_seconds);
        let reference_start = cpu_now();
        if context.clock.is_some() {
            std::hint::black_box(reference_kernel::run());
        }
        let reference_cpu = cpu_now() - reference_start;
        let count = points.len();
        let mut round =
            Round { results: vec![Ok(Measurement::default()); count], cpu: vec![0.0; count], wall: vec![0.0; count], reference_cpu };
        // Every other round runs backwards, so that a machine that slows down or speeds up does so evenly for all.
        for turn in 0..count {
            let index = if backwards { count - 1 - turn } else { turn };
            let (setup, knob) = points[index];
            let (cpu, wall) = (cpu_now(), wall_now());
            round.results[index] = case.evaluate(setup, knob, context.random_seed);
            round.cpu[index] = cpu_now() - cpu;
            round.wall[index] = wall_now() - wall;
            (context.progress)(turn + 1, count);
        }
        round
    }

    fn cpu_seconds(&self) -> f64 {
        self.cpu.iter().sum()
    }
}

/// Times of all points over the rounds.
struct Timing {
    cpu: Vec<Vec<f64>>,
    wall: Vec<Vec<f64>>,
    reference_cpu: Vec<f64>,
    accepted: Vec<bool>,
}

impl Timing {
    fn new(rounds: &[Round]) -> Timing {
        let reference_cpu: Vec<f64> = rounds.iter().map(|round| round.reference_cpu).collect();
        let usual = median(&reference_cpu);
        let mut accepted: Vec<bool> = reference_cpu.iter().map(|time| (time / usual - 1.0).abs() <= REJECTION).collect();
        if !accepted.contains(&true) {
            accepted.fill(true);
        }
        let columns = |of: fn(&Round) -> &Vec<f64>| {
            let points = rounds.first().map_or(0, |round| of(round).len());
            (0..points).map(|point| rounds.iter().map(|round| of(round)[point]).collect()).collect()
        };
        Timing { cpu: columns(|round| &round.cpu), wall: columns(|round| &round.wall), reference_cpu, accepted }
    }

    fn used(&self, times: &[f64]) -> Vec<f64> {
        times.iter().zip(&self.accepted).filter(|(_, accepted)| **accepted).map(|(time, _)| *time).collect()
    }

    fn cost(&self, point: usize, measurement: &Measurement) -> Cost {
        let mut cost = Cost { work: measurement.work.clone(), runs: measurement.runs, ..Cost::default() };
        let cpu = self.used(&self.cpu[point]);
        if self.reference_cpu.iter().all(|time| *time <= 0.0) {
            return cost;
        }
        cost.cpu_s = Some(median(&cpu));
        cost.wall_s = Some(median(&self.used(&self.wall[point])));
        cost.rounds = Some(cpu.len() as u32);
        cost.reference_kernels = Some(median(&cpu) / median(&self.used(&self.reference_cpu)));
        if cpu.len() >= 3 {
            // Too few for a rank interval: the range of the rounds is shown.
            let (low, high) = cpu.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), time| (low.min(*time), high.max(*time)));
            cost.cpu_s_ci95 = Some([low, high]);
        }
        cost
    }

    /// Every time that was taken, rejected rounds included.
    fn curve(&self, points: &[(&Setup, f64)]) -> Option<Curve> {
        if self.reference_cpu.iter().all(|time| *time <= 0.0) {
            return None;
        }
        let mut rows = Vec::new();
        for (round, reference) in self.reference_cpu.iter().enumerate() {
            for (point, (setup, knob)) in points.iter().enumerate() {
                let accepted = f64::from(u8::from(self.accepted[round]));
                let (cpu, wall) = (self.cpu[point][round], self.wall[point][round]);
                rows.push(vec![round as f64, setup.index as f64, *knob, cpu, wall, *reference, accepted]);
            }
        }
        let columns = vec!["round", "setup_index", "knob", "cpu_s", "wall_s", "reference_kernel_cpu_s", "round_used"];
        Some(Curve { file: "timing.csv".into(), columns, rows })
    }
}

/// All measurements with their costs.
struct Measured {
    points: Vec<Point>,
}

struct Point {
    setup: String,
    knob: f64,
    result: Result<Measurement, Failure>,
    cost: Cost,
}

impl Measured {
    fn new(points: &[(&Setup, f64)], results: Vec<Result<Measurement, Failure>>, timing: &Timing) -> Measured {
        let nothing = Measurement::default();
        let measured = results.into_iter().zip(points).enumerate().map(|(index, (result, (setup, knob)))| {
            let cost = timing.cost(index, result.as_ref().unwrap_or(&nothing));
            Point { setup: setup.label.clone(), knob: *knob, result, cost }
        });
        Measured { points: measured.collect() }
    }

    fn rows(&self, context: &Context<'_>, description: &Description) -> Vec<Row> {
        let mut rows = Vec::new();
        for point in &self.points {
            let mut row = empty_row(context, description);
            row.setup.clone_from(&point.setup);
            row.knob = Some(Knob { name: description.knob.name.into(), value: point.knob });
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

    fn curves(&self) -> Vec<Curve> {
        self.points.iter().filter_map(|point| point.result.as_ref().ok()).flat_map(|measurement| measurement.curves.clone()).collect()
    }
}

fn empty_row(context: &Context<'_>, description: &Description) -> Row {
    Row {
        schema: SCHEMA,
        case: description.id.into(),
        setup: String::new(),
        quantity: String::new(),
        unit: "1".into(),
        knob: None,
        statistic: Statistic::Single.name().into(),
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
        tier: context.tier.name().into(),
        random_seed: context.random_seed,
        threads: 1,
        ranks: 1,
        code: "touchstone".into(),
        version: env!("CARGO_PKG_VERSION").into(),
        commit: context.commit.clone(),
        machine: context.machine.clone(),
        data: Vec::new(),
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
fn apply_claims(rows: &mut Vec<Row>, claims: &[Claim], context: &Context<'_>, description: &Description) {
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

fn budget_row(spent: f64, context: &Context<'_>, description: &Description) -> Row {
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

fn card(case: &dyn Case, description: &Description, tier: Tier) -> Card {
    let words = |texts: &[&str]| texts.iter().map(|text| (*text).to_string()).collect();
    let caught = mutants::MUTANTS.iter().filter(|mutant| mutant.caught_by_case(description.id));
    Card {
        case: description.id.into(),
        title: description.title.into(),
        question: description.question.into(),
        model: words(&description.model),
        equations: description.equations.clone(),
        parameters: description.parameters.clone(),
        reference: description.reference.into(),
        picture: description.picture.clone(),
        plots: description.plots.clone(),
        headline: description.headline.clone(),
        ledger: ledger_lines(case, description),
        mutants: caught.map(|mutant| Mutant { name: mutant.name.into(), caught_by: mutant.caught_by.join(", ") }).collect(),
        sources: words(&description.sources),
        answers: words(&description.answers),
        remarks: words(&description.remarks),
        budget_cpu_s: description.budget(tier),
    }
}

/// What the scene of the headline uses and leaves out, with the work of a short run.
fn ledger_lines(case: &dyn Case, description: &Description) -> Vec<LedgerLine> {
    let headline = &description.headline;
    let setup = description.setups.iter().find(|setup| setup.label == headline.setup);
    let simulation = setup.and_then(|setup| case.scene(setup, headline.knob)).and_then(|scene| scene.build().ok());
    let Some(mut simulation) = simulation else { return Vec::new() };
    for _ in 0..LEDGER_STEPS.min(simulation.steps_to(simulation.scene().scene.end_time)) {
        simulation.step();
    }
    let line = |entry: solver::ledger::Entry| LedgerLine { stage: entry.stage, used: entry.used, reason: entry.reason, work: entry.work };
    simulation.ledger().entries.into_iter().map(line).collect()
}

/// Steps of the run whose work counts a page shows.
const LEDGER_STEPS: u64 = 1000;

/// Work of several runs together.
pub fn add_work(total: &mut BTreeMap<String, u64>, work: BTreeMap<String, u64>) {
    for (name, count) in work {
        *total.entry(name).or_insert(0) += count;
    }
}
