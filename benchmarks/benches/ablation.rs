//! What a scene does not need, forced on: the same answer, and its cost.
//!
//! Costs are CPU time of one thread in interleaved pairs and, where valgrind is installed, instructions by callgrind: this program calls itself under it with
//! `--count`, the number of an ablation, 0 or 1 for without or with, and steps. Results go to `reports/results/ablation.jsonl` and the page of `touchstone report`.

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use benchmarks::ablation::answer::difference;
use benchmarks::ablation::list::{Ablation, STEPS, ablations};
use benchmarks::ablation::results::{BARS_FILE, Entry, bars, page, rows};
use benchmarks::page::write;
use benchmarks::pairs::{Ratio, compare_parts};
use benchmarks::peers::process;
use solver::{Scene, Simulation};
use verification::cli::environment::Environment;

/// Balls along each edge.
const PER_EDGE: usize = 10;
const TIMED_STEPS: u64 = 50;
const PAIRS: usize = 20;
/// Balls along each edge where instructions are counted, and steps of the two runs whose difference counts.
const COUNTED_PER_EDGE: usize = 5;
const COUNTED_STEPS: [u64; 2] = [1, 6];
/// No count begins later.
const BUDGET_OF_COUNTS: Duration = Duration::from_secs(120);
const LIMIT_OF_A_COUNT: Duration = Duration::from_secs(60);

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().collect();
    if let Some(place) = arguments.iter().position(|argument| argument == "--count") {
        return run_to_be_counted(&arguments[place + 1..]);
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    println!(
        "forced on                            CPU time with it over without [95 %] x a ball's step without  instructions  same answer"
    );
    let start = Instant::now();
    let mut entries = Vec::new();
    for (index, ablation) in ablations(PER_EDGE).into_iter().enumerate() {
        let mut entry = measure(&ablation)?;
        if start.elapsed() < BUDGET_OF_COUNTS {
            entry.instructions = count(index);
        }
        println!("{}", entry.line());
        entries.push(entry);
    }
    let headline = entries.iter().max_by(|one, other| one.ratio.median.total_cmp(&other.ratio.median)).map_or("", |entry| entry.name);
    let environment = Environment::of(Some(&root));
    write(&root.join("reports/results"), &page(headline), &rows(&entries, &environment), &[(BARS_FILE, bars(&entries))])?;
    match entries.iter().find(|entry| !entry.is_same()) {
        Some(entry) => Err(format!("{}: the answer is another one: {}", entry.name, entry.answer()).into()),
        None => Ok(()),
    }
}

fn after(scene: &Scene, steps: u64) -> Result<Simulation, Failure> {
    let mut simulation = scene.build()?;
    (0..steps).for_each(|_| simulation.step());
    Ok(simulation)
}

fn measure(ablation: &Ablation) -> Result<Entry, Failure> {
    let [left_out, forced] = [&ablation.left_out, &ablation.forced];
    let [one, other] = [after(left_out, STEPS)?, after(forced, STEPS)?];
    // A fresh simulation each time, or one would carry the luck of its place in memory through all pairs; its first step makes lists.
    let prepare = |scene: &Scene| after(scene, 1).expect("the scene has been built before");
    let step = |mut simulation: Simulation| (0..TIMED_STEPS).for_each(|_| simulation.step());
    let ratio: Ratio = compare_parts((|| prepare(left_out), step), (|| prepare(forced), step), PAIRS);
    let work = [left_out.bodies.len() as u64, TIMED_STEPS];
    let Ablation { name, reason, agreement, .. } = *ablation;
    Ok(Entry { name, reason, difference: difference(&one, &other), agreement, ratio, work, instructions: None })
}

/// Instructions of a ball's step without and with, from the difference of a long and a short run; `None` without valgrind.
fn count(index: usize) -> Option<[f64; 2]> {
    let [short, long] = COUNTED_STEPS;
    let per = (long - short) as f64 * COUNTED_PER_EDGE.pow(3) as f64;
    let of = |forced: u64| Some((instructions(index, forced, long)? - instructions(index, forced, short)?) / per);
    Some([of(0)?, of(1)?])
}

fn instructions(index: usize, forced: u64, steps: u64) -> Option<f64> {
    let folder = tempfile::tempdir().ok()?;
    let mut command = Command::new("valgrind");
    command.args(["--tool=callgrind", "--callgrind-out-file=counts"]).arg(std::env::current_exe().ok()?).arg("--count");
    command.args([index as u64, forced, steps].map(|number| number.to_string()));
    let (_, printed) = process::run(&mut command, folder.path(), LIMIT_OF_A_COUNT).ok()?;
    let line = printed.lines().find_map(|line| line.split_once("Collected : "))?;
    line.1.trim().parse().ok()
}

/// One run of one ablation and nothing else.
fn run_to_be_counted(arguments: &[String]) -> Result<(), Failure> {
    let [index, forced, steps] = arguments else { return Err("--count INDEX 0|1 STEPS".into()) };
    let all = ablations(COUNTED_PER_EDGE);
    let ablation = all.get(index.parse::<usize>()?).ok_or("no such ablation")?;
    after(if forced == "1" { &ablation.forced } else { &ablation.left_out }, steps.parse()?).map(drop)
}
