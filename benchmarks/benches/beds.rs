//! Steps of settled beds of every kind of shape: how many a second on one core, beside the goals and beside spheres.
//!
//! `cargo bench --bench beds -- cubes` times what has the word in its name. Results go to `reports/results/beds.jsonl` and the page of `touchstone report`. The
//! settled states are `benchmarks/beds/*.csv`; `cargo run --release -p benchmarks --example settle_beds` made them.

use std::fs;
use std::path::Path;

use benchmarks::beds::kinds::Kind;
use benchmarks::beds::results::{BARS_FILE, Entry, Work, bars, page};
use benchmarks::beds::states::States;
use benchmarks::page::write;
use benchmarks::pairs::compare;
use rayon::ThreadPoolBuilder;
use solver::Simulation;
use verification::cli::environment::Environment;

/// Samples of each bed; odd, so that the median is one of them.
const SAMPLES: usize = 25;
/// Steps of a sample.
const STEPS: u64 = 100;
const STEPS_OF_SPHERES: u64 = 1000;
/// Steps before the first sample, in which the springs of friction are stretched.
const STEPS_BEFORE: u64 = 500;

type Failure = Box<dyn std::error::Error + Send + Sync>;

fn main() -> Result<(), Failure> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    // CPU time is that of a thread: all work must be done by the one that is timed.
    let one_thread = ThreadPoolBuilder::new().num_threads(1).build()?;
    let entries = one_thread
        .install(|| Kind::ALL.into_iter().filter(is_asked_for).map(|kind| measure(kind, &root)).collect::<Result<Vec<_>, _>>())?;
    let Some(first) = entries.first() else { return Err("no bed has that word in its name".into()) };
    println!("{}", Entry::HEAD);
    entries.iter().for_each(|entry| println!("{}", entry.line()));
    let environment = Environment::of(Some(&root));
    let rows: Vec<_> = entries.iter().map(|entry| entry.row(&environment)).collect();
    write(&root.join("reports/results"), &page(first.kind.name()), &rows, &[(BARS_FILE, bars(&entries))])
        .map_err(|error| error.to_string().into())
}

/// Whether the command line names a part of its name, or nothing; options belong to cargo.
fn is_asked_for(kind: &Kind) -> bool {
    let mut words = std::env::args().skip(1).filter(|word| !word.starts_with('-')).peekable();
    words.peek().is_none() || words.any(|word| kind.name().contains(&word))
}

fn settled(kind: Kind, root: &Path) -> Result<Simulation, Failure> {
    let path = root.join("benchmarks/beds").join(kind.file());
    let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let states = States::parse(&text).ok_or_else(|| format!("{}: not seven whole numbers in each line", path.display()))?;
    let mut simulation = kind.bed(&states)?.build()?;
    (0..STEPS_BEFORE).for_each(|_| simulation.step());
    Ok(simulation)
}

fn measure(kind: Kind, root: &Path) -> Result<Entry, Failure> {
    let (mut bed, mut spheres) = (settled(kind, root)?, settled(Kind::Sphere, root)?);
    let steps = if kind == Kind::Sphere { STEPS_OF_SPHERES } else { STEPS };
    let before = work(&bed);
    let ratio = compare(|| (0..steps).for_each(|_| bed.step()), || (0..STEPS_OF_SPHERES).for_each(|_| spheres.step()), SAMPLES);
    bed.check_guards()?;
    let [contacts, pair_tests, lists] = std::array::from_fn(|count| work(&bed)[count] - before[count]);
    let bodies = bed.bodies().len() as u64;
    Ok(Entry { kind, bodies, steps: [steps, STEPS_OF_SPHERES], ratio, work: Work { contacts, pair_tests, lists } })
}

fn work(simulation: &Simulation) -> [u64; 3] {
    let ledger = simulation.ledger();
    ["contacts", "pair_tests", "lists"].map(|name| ledger.total_work().get(name).copied().unwrap_or(0))
}
