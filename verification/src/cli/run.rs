//! `touchstone run` and the main job: run cases, write their rows, render the site.

use reports::{CaseResults, verdict_line};
use serde_json::json;

use super::arguments::DEFAULT_SEED;
use super::clock::SystemClock;
use super::environment::Environment;
use super::packings::Packings;
use super::places::Places;
use super::progress::Progress;
use super::select::Points;
use super::{CommandError, Finish, compare, print, store};
use crate::case::Setup;
use crate::study::{self, Context};
use crate::{CASES, Case, Tier, packing};

/// How cases are run.
#[derive(Debug, Clone)]
pub struct RunOptions {
    /// How much may be spent.
    pub tier: Tier,
    /// Which points of a case.
    pub points: Points,
    /// Cases run side by side.
    pub threads: usize,
    /// Seed of every random choice.
    pub random_seed: u64,
    /// Print JSON instead of lines.
    pub json: bool,
}

/// Every case at the quick tier, the site, one verdict line a case and the site's path.
///
/// # Errors
///
/// If results or pages cannot be written.
pub fn main_job(places: &Places) -> Result<Finish, CommandError> {
    let options = RunOptions { tier: Tier::Quick, points: Points::default(), threads: 1, random_seed: DEFAULT_SEED, json: false };
    run(places, CASES, &options)
}

/// Runs some cases, writes their rows and renders the site.
///
/// # Errors
///
/// If results or pages cannot be written.
pub fn run(places: &Places, cases: &[&dyn Case], options: &RunOptions) -> Result<Finish, CommandError> {
    let environment = Environment::of(places.root.as_deref());
    packing::install_store(Box::new(Packings { folder: places.packings() }));
    let progress = Progress::new();
    let results = side_by_side(options.threads, cases, |case| run_case(places, *case, options, &environment, &progress))?;
    store::render_site(places, &environment)?;
    if options.json {
        print::json(&results.iter().map(verdict).collect());
    } else {
        print::line(&format!("site: {}", places.site.join("index.html").display()));
    }
    Ok(store::finish_of(&results))
}

/// Runs one case, writes its rows and prints its verdict line.
fn run_case(
    places: &Places,
    case: &dyn Case,
    options: &RunOptions,
    environment: &Environment,
    progress: &Progress,
) -> Result<CaseResults, CommandError> {
    let identifier = case.description().id;
    let bar = progress.bar(identifier);
    let clock = SystemClock::default();
    let wanted = |setup: &Setup, knob: f64| options.points.wants(setup, knob);
    let context = Context {
        tier: options.tier,
        random_seed: options.random_seed,
        commit: environment.commit.clone(),
        machine: environment.machine.clone(),
        only: if options.points.are_all() { None } else { Some(&wanted) },
        clock: Some(&clock),
        progress: &|done, total| bar.set(done as u64, total as u64),
    };
    let outcome = study::run(case, &context);
    if options.points.are_all() {
        store::write_outcome(places, &outcome)?;
    } else {
        store::write_part(places, &outcome)?;
    }
    compare::put_kept_results(places, case, options.tier)?;
    let results = CaseResults { card: outcome.card, rows: outcome.rows, baseline: Vec::new(), data: Vec::new() };
    if !options.json {
        progress.suspended(|| print::line(&verdict_line(&results)));
    }
    Ok(results)
}

fn verdict(case: &CaseResults) -> serde_json::Value {
    let (claims, met) = store::claims_met(case);
    json!({ "case": case.card.case, "claims": claims, "met": met, "verdict": verdict_line(case) })
}

/// Applies a function to every case in a pool of threads; results keep the order of the cases.
#[cfg(feature = "threads")]
fn side_by_side<T: Send>(
    threads: usize,
    cases: &[&dyn Case],
    apply: impl Fn(&&dyn Case) -> Result<T, CommandError> + Send + Sync,
) -> Result<Vec<T>, CommandError> {
    use rayon::prelude::*;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| CommandError::input(format!("cannot start {threads} threads: {error}")))?;
    // One case at a time per thread: a case is the smallest piece of work whose time is measured.
    pool.install(|| cases.par_iter().with_max_len(1).map(apply).collect())
}

/// Applies a function to every case, one after another: this build has no threads.
#[cfg(not(feature = "threads"))]
fn side_by_side<T: Send>(
    threads: usize,
    cases: &[&dyn Case],
    apply: impl Fn(&&dyn Case) -> Result<T, CommandError> + Send + Sync,
) -> Result<Vec<T>, CommandError> {
    if threads != 1 {
        return Err(CommandError::input("this build has no threads (feature `threads`): `--threads` must be 1"));
    }
    cases.iter().map(apply).collect()
}
