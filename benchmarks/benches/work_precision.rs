//! Error against run time of every case, and how finely this machine resolves a difference in cost.
//!
//! The instrument is tested first: the same work against itself must give 1, and against itself with 5 % more steps 1.05. Then the cost of each
//! choice of numerics is given as a ratio to its plain variant at equal steps, and the table of every case as error and CPU time a run.

use benchmarks::pairs::{Ratio, compare};
use solver::Simulation;
use verification::cli::clock::SystemClock;
use verification::study::{Context, run};
use verification::{CASES, Tier};

const PAIRS: usize = 60;
const STEPS: u64 = 20_000;

fn main() {
    resolution_of_the_instrument();
    cost_of_choices();
    for case in CASES {
        error_against_run_time(*case);
    }
}

fn simulation_of(case: &str, setup: &str, knob: f64) -> Simulation {
    let case = CASES.iter().find(|candidate| candidate.description().id == case).expect("the case is in the list");
    let description = case.description();
    let setup = description.setups.iter().find(|candidate| candidate.label.starts_with(setup)).expect("the setup is in the case");
    case.scene(setup, knob).expect("the case has a scene").build().expect("the scene of a case builds")
}

fn stepper(case: &'static str, setup: &'static str, knob: f64, steps: u64) -> impl FnMut() {
    // A fresh simulation each time: one that stays where it was allocated would carry the luck of its place through all pairs.
    move || {
        let mut simulation = simulation_of(case, setup, knob);
        (0..steps).for_each(|_| simulation.step());
    }
}

fn show(what: &str, ratio: Ratio) {
    println!("{what:<60} {ratio}");
}

fn resolution_of_the_instrument() {
    println!("resolution: ratio [95 % interval] x cost of the base");
    let bouncing = |steps| stepper("sphere_bounce_long", "resolved edges", 20.0, steps);
    show("  the same work twice", compare(bouncing(STEPS), bouncing(STEPS), PAIRS));
    show("  5 % more steps", compare(bouncing(STEPS), bouncing(STEPS + STEPS / 20), PAIRS));
}

fn cost_of_choices() {
    println!("cost of a choice at equal steps");
    let bouncing = |setup: &'static str| stepper("sphere_bounce_long", setup, 20.0, STEPS);
    show("  resolved edges over sampled", compare(bouncing("sampled edges"), bouncing("resolved edges"), PAIRS));
    let rolling = |setup: &'static str| stepper("sphere_on_incline", setup, 50.0, STEPS);
    show("  centred over lagged damping, history spring", {
        compare(rolling("rolls: 15 degrees, friction 0.5, lagged"), rolling("rolls: 15 degrees, friction 0.5"), PAIRS)
    });
    show("  history spring over viscous law", compare(rolling("creeps: viscous"), rolling("rolls: 15 degrees, friction 0.5"), PAIRS));
}

fn error_against_run_time(case: &dyn verification::Case) {
    let clock = SystemClock::default();
    let context = Context {
        tier: Tier::Quick,
        random_seed: 1,
        commit: "bench".into(),
        machine: "bench".into(),
        only: None,
        clock: Some(&clock),
        progress: &|_, _| {},
    };
    let outcome = run(case, &context);
    println!("\n{}: quantity | setup | knob | error | CPU s a run | reference kernels a run", outcome.card.case);
    for row in outcome.rows.iter().filter(|row| row.knob.is_some() && !row.statistic.starts_with("worst")) {
        let runs = row.cost.runs.max(1) as f64;
        let (knob, error) = (row.knob.as_ref().map_or(f64::NAN, |knob| knob.value), row.error.unwrap_or(f64::NAN));
        let (cpu, kernels) = (row.cost.cpu_s.unwrap_or(f64::NAN) / runs, row.cost.reference_kernels.unwrap_or(f64::NAN) / runs);
        println!("  {} | {} | {knob} | {error:.3e} | {cpu:.3e} | {kernels:.3e}", row.quantity, row.setup);
    }
}
