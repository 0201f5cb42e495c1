//! A study: every setup at every knob value, measured, timed in interleaved rounds, and turned into rows.

mod rows;
mod timing;

use std::collections::BTreeMap;

use reports::card::{Card, LedgerLine, Mutant};
use reports::row::Row;

use crate::case::{Case, Curve, Description, Setup, Tier};
use crate::claim::{Claim, Subject};
use crate::mutants;
use rows::{Measured, apply_claims, budget_row, repeat_row};
use timing::{Round, Timing, number_of_rounds};

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
    pub only: Option<&'a PointFilter<'a>>,
    /// Clock, if times are wanted.
    pub clock: Option<&'a dyn Clock>,
    /// Told after every evaluation how many are done and how many there are in this round.
    pub progress: &'a dyn Fn(usize, usize),
}

/// Whether a setup at a knob value is wanted.
pub type PointFilter<'a> = dyn Fn(&Setup, f64) -> bool + Sync + 'a;

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
    let others = rounds.iter().filter(|round| round.results != rounds[0].results).count();
    let (timing, repeats) = (Timing::new(&rounds), rounds.len());
    let spent: f64 = rounds.iter().map(Round::cpu_seconds).sum();
    let measured = Measured::new(&points, rounds.swap_remove(0).results, &timing, description.knob.name);
    let mut rows = measured.rows(context, &description);
    let mut claims = case.claims(context.tier);
    if context.only.is_some() {
        claims.retain(|claim| can_be_judged(claim, &points));
    }
    apply_claims(&mut rows, &claims, context, &description);
    if context.clock.is_some() && context.only.is_none() {
        rows.push(budget_row(spent, context, &description));
        rows.push(repeat_row(others, repeats, context, &description));
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
fn card(case: &dyn Case, description: &Description, tier: Tier) -> Card {
    let words = |texts: &[&str]| texts.iter().map(|text| (*text).to_string()).collect();
    let caught = mutants::all().filter(|mutant| mutant.caught_by_case(description.id));
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
        command: None,
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
