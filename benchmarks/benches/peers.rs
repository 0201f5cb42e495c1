//! One step of one sphere in a settled packing: ours beside LAMMPS, LIGGGHTS and YADE, in interleaved rounds.
//!
//! A code that is not installed is shown as missing. `PEER_LAMMPS`, `PEER_LIGGGHTS` and `PEER_YADE` name other programs than the usual ones, several as in
//! `PATH`. `cargo bench --bench peers -- history` runs what has the word in its name ("history, 1 core"). Results go to `reports/results/peers.jsonl` and the page of `touchstone report`. What is compared: `benchmarks/peers/README.md`.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use benchmarks::page::write;
use benchmarks::peers::codes::{Code, Kind, Run, find};
use benchmarks::peers::packing::{Law, Packing};
use benchmarks::peers::process::Spent;
use benchmarks::peers::results::{Entry, ROUNDS_FILE, card, rounds_csv};
use cpu_time::ProcessTime;
use verification::cli::environment::Environment;

const ROUNDS: usize = 5;
/// No round begins that would not end by then.
const BUDGET: Duration = Duration::from_secs(330);
const OWN_STEPS: u64 = 200;
const OWN: &str = "touchstone";

/// One kind of work: a law on a number of cores.
#[derive(Clone, Copy)]
struct Work {
    law: Law,
    cores: u32,
}

const WORKS: [Work; 4] = [
    Work { law: Law::History, cores: 1 },
    Work { law: Law::Viscous, cores: 1 },
    Work { law: Law::Frictionless, cores: 1 },
    Work { law: Law::History, cores: 2 },
];

/// Who does the work of an entry.
enum Runner {
    Own,
    Other(Code),
    Missing,
}

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let decks = root.join("benchmarks/peers/packing");
    let folder = tempfile::tempdir()?;
    let packings = [Law::History, Law::Viscous, Law::Frictionless].map(|law| read(&decks, law));
    let packings = packings.into_iter().collect::<Result<Vec<Packing>, Failure>>()?;
    for (law, packing) in Law::ALL.iter().zip(&packings) {
        fs::write(folder.path().join(format!("{}.data", law.name())), packing.data())?;
        fs::write(folder.path().join(format!("{}.txt", law.name())), packing.text())?;
    }
    let mut entries = entries(&packings, folder.path());
    let rounds = run_rounds(&mut entries, &packings, &decks, folder.path());
    println!(
        "cost of one step of one sphere in a settled packing, medians of {rounds} interleaved rounds; Z: contacts of a sphere at the end"
    );
    for work in WORKS {
        print_table(&entries, &work);
    }
    if entries.is_empty() {
        return Err("nothing has that word in its name; known are history, viscous, frictionless, 1 core, 2 cores".into());
    }
    write_results(&root.join("reports/results"), &entries, &root)
}

fn read(decks: &Path, law: Law) -> Result<Packing, Failure> {
    let path = decks.join(law.packing());
    let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    Packing::parse(&text).ok_or_else(|| format!("{}: not nine whole numbers in each line", path.display()).into())
}

/// Ours and every code, at every kind of work.
fn entries(packings: &[Packing], folder: &Path) -> Vec<(Work, Runner, Entry)> {
    let codes = Kind::ALL.map(|kind| (kind, find(kind, folder)));
    let mut entries = Vec::new();
    for work in WORKS {
        let packing = &packings[work.law as usize];
        let setup = format!("{}, {} core{}", work.law.name(), work.cores, if work.cores == 1 { "" } else { "s" });
        if !is_asked_for(&setup) {
            continue;
        }
        let entry = |code: &str, version: String, build: String, bodies, steps, parallel| Entry {
            code: code.into(),
            version,
            build,
            setup: setup.clone(),
            parallel,
            bodies,
            steps,
            runs: Vec::new(),
        };
        let bodies = packing.scene(work.law).bodies.len();
        let build = "rustc, opt-level 3, wide registers as found at run time".into();
        entries.push((work, Runner::Own, entry(OWN, env!("CARGO_PKG_VERSION").into(), build, bodies, OWN_STEPS, [work.cores, 1])));
        for (kind, found) in &codes {
            if found.is_empty() {
                let wanted = format!("no program as usual or as in {}", kind.variable());
                entries.push((work, Runner::Missing, entry(kind.name(), wanted, String::new(), 0, 0, [1, 1])));
            }
            for code in found {
                let parallel = if *kind == Kind::Yade { [work.cores, 1] } else { [1, work.cores] };
                let entry = entry(kind.name(), code.version.clone(), code.build.clone(), packing.0.len(), kind.steps(), parallel);
                entries.push((work, Runner::Other(code.clone()), entry));
            }
        }
    }
    entries
}

/// Whether the command line names a part of a setup, or nothing; options belong to cargo.
fn is_asked_for(setup: &str) -> bool {
    let mut words = std::env::args().skip(1).filter(|word| !word.starts_with('-')).peekable();
    words.peek().is_none() || words.any(|word| setup.contains(&word))
}

/// Runs rounds, forwards and backwards in turn, as many as the budget allows; returns their number.
fn run_rounds(entries: &mut [(Work, Runner, Entry)], packings: &[Packing], decks: &Path, folder: &Path) -> usize {
    let (start, mut longest) = (Instant::now(), Duration::ZERO);
    for round in 0..ROUNDS {
        if start.elapsed() + longest > BUDGET {
            println!("only {round} of {ROUNDS} rounds: the machine is too busy for more within {} s", BUDGET.as_secs());
            return round;
        }
        let begin = Instant::now();
        let mut order: Vec<_> = entries.iter_mut().collect();
        if round % 2 == 1 {
            order.reverse();
        }
        for (work, runner, entry) in order {
            match runner {
                Runner::Own => entry.runs.push(run_own(&packings[work.law as usize], work)),
                Runner::Other(code) => entry.runs.push(code.run(decks, folder, work.law, work.cores)),
                Runner::Missing => {}
            }
        }
        longest = longest.max(begin.elapsed());
    }
    ROUNDS
}

/// Our own steps, in this process, on as many threads as the work has cores.
fn run_own(packing: &Packing, work: &Work) -> Result<Run, String> {
    let threads = rayon::ThreadPoolBuilder::new().num_threads(work.cores as usize).build().map_err(|error| error.to_string())?;
    threads.install(|| step_own(packing, work.law))
}

/// The first step finds contacts and is not counted.
fn step_own(packing: &Packing, law: Law) -> Result<Run, String> {
    let mut simulation = packing.scene(law).build().map_err(|error| error.to_string())?;
    let bodies = simulation.bodies().len() as f64;
    simulation.step();
    let (cpu, wall) = (ProcessTime::now(), Instant::now());
    (1..OWN_STEPS).for_each(|_| simulation.step());
    let contacts = |simulation: &solver::Simulation| simulation.ledger().total_work().get("contacts").copied().unwrap_or(0);
    let before = contacts(&simulation);
    simulation.step();
    let spent = Spent { cpu_s: Some(cpu.elapsed().as_secs_f64()), wall_s: wall.elapsed().as_secs_f64() };
    simulation.check_guards().map_err(|error| error.to_string())?;
    Ok(Run { spent, coordination: Some(2.0 * (contacts(&simulation) - before) as f64 / bodies) })
}

fn print_table(entries: &[(Work, Runner, Entry)], work: &Work) {
    let of_work = |cores| entries.iter().filter(move |(other, ..)| other.law == work.law && other.cores == cores).map(|(.., entry)| entry);
    let Some(base) = of_work(work.cores).find(|entry| !entry.is_missing()) else { return };
    println!("\n{}, {} core(s)\n{}", work.law.name(), work.cores, Entry::head(&base.code));
    of_work(work.cores).for_each(|entry| println!("{}", entry.line(base)));
    if work.cores == 1 {
        return;
    }
    for entry in of_work(work.cores) {
        let alone = of_work(1).find(|other| other.code == entry.code && other.version == entry.version);
        if let Some(alone) = alone.filter(|alone| !alone.is_missing()) {
            println!("  {:<11} {:.2} times as fast as on one core (wall time)", entry.code, alone.cost()[1] / entry.cost()[1]);
        }
    }
}

fn write_results(results: &Path, entries: &[(Work, Runner, Entry)], root: &Path) -> Result<(), Failure> {
    let environment = Environment::of(Some(root));
    let entries: Vec<Entry> = entries.iter().map(|(.., entry)| entry.clone()).collect();
    let ours = |entry: &Entry| entries.iter().find(|other| other.code == OWN && other.setup == entry.setup);
    let of_goals = entries.iter().filter_map(|entry| entry.row_of_goal(ours(entry)?, &environment));
    let rows: Vec<_> = of_goals.chain(entries.iter().map(|entry| entry.row(&environment))).collect();
    write(results, &card(&rows), &rows, &[(ROUNDS_FILE, rounds_csv(&entries))])
}
