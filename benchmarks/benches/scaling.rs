//! Cost of a sphere's step from 10^3 to 10^6 spheres, memory, lists of neighbours, and one thread beside two.
//!
//! Results go to `reports/results/scaling.jsonl` and the page of `touchstone report`. It takes about two minutes and 2 GB on an idle machine.

use std::path::Path;
use std::time::{Duration, Instant};

use benchmarks::page::write;
use benchmarks::scaling::bed::{Bed, SPHERES_OF_A_COPY, scene, sheared};
use benchmarks::scaling::results::{FLAT_WITHIN, Found, Parallel, Size};
use benchmarks::scaling::triad;
use peak_alloc::PeakAlloc;
use verification::cli::environment::Environment;
use verification::statistics::median;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// Copies along x and y: 10^3 to 10^6 spheres.
const COPIES: [[usize; 2]; 4] = [[1, 1], [2, 5], [10, 10], [25, 40]];
/// Steps of spheres in one sample.
const SPHERE_STEPS: usize = 2_000_000;
const ROUNDS: usize = 9;
/// No round begins that would not end by then.
const BUDGET_OF_ROUNDS: Duration = Duration::from_secs(75);
/// Copies and steps of a sample on one thread and on two.
const PARALLEL_COPIES: [usize; 2] = [10, 10];
const PARALLEL_STEPS: usize = 4;
const PARALLEL_SAMPLES: usize = 30;
const BUDGET_IN_PARALLEL: Duration = Duration::from_secs(40);
/// A skin so thin that every step makes a list, in m, and steps of spheres in a sample of them.
const NO_SKIN: f64 = 1e-18;
const SPHERE_STEPS_WITH_LISTS: usize = 200_000;
/// The flow in which lists are counted: speed at the top in m/s, copies, steps.
const FLOW: (f64, [usize; 2], usize) = (1.0, [2, 5], 300);

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let sizes = sizes()?;
    let list_share = list_share()?;
    let spheres_in_parallel = PARALLEL_COPIES[0] * PARALLEL_COPIES[1] * SPHERES_OF_A_COPY;
    let held = sizes.iter().find(|size| size.spheres == spheres_in_parallel).map_or(0.0, |size| size.held);
    let found = Found { sizes, parallel: in_parallel(held)?, spheres_in_parallel, list_share };
    print(&found);
    write(&root.join("reports/results"), &found.card(), &found.rows(&Environment::of(Some(&root))), &found.files())
}

fn scene_of(copies: [usize; 2]) -> Result<solver::Scene, Failure> {
    scene(copies).ok_or_else(|| "the settled bed is not a packing".into())
}

/// All numbers of spheres, each in every round.
fn sizes() -> Result<Vec<Size>, Failure> {
    let mut beds = Vec::new();
    for copies in COPIES {
        beds.push(measured_bed(copies)?);
    }
    let (start, mut longest) = (Instant::now(), Duration::ZERO);
    for round in 0..ROUNDS {
        if start.elapsed() + longest > BUDGET_OF_ROUNDS {
            println!("only {round} of {ROUNDS} rounds: the machine is too busy for more within {} s", BUDGET_OF_ROUNDS.as_secs());
            break;
        }
        let begin = Instant::now();
        let mut order: Vec<_> = beds.iter_mut().collect();
        if round % 2 == 1 {
            order.reverse();
        }
        for (bed, size) in order {
            let steps = SPHERE_STEPS / bed.spheres;
            let before = bed.work("contacts");
            size.costs.push(bed.step(steps).cpu_s / (steps * bed.spheres) as f64);
            size.contacts = 2.0 * (bed.work("contacts") - before) as f64 / (steps * bed.spheres) as f64;
        }
        longest = longest.max(begin.elapsed());
    }
    let mut sizes: Vec<Size> = beds.into_iter().map(|(_, size)| size).collect();
    for (copies, size) in COPIES.into_iter().zip(&mut sizes).take(COPIES.len() - 1) {
        size.lists = cost_of_lists(copies)?;
    }
    Ok(sizes)
}

/// A bed whose first step is done, and the memory it takes.
fn measured_bed(copies: [usize; 2]) -> Result<(Bed, Size), Failure> {
    let before = MEMORY.current_usage();
    let scene = scene_of(copies)?;
    let of_scene = MEMORY.current_usage() - before;
    MEMORY.reset_peak_usage();
    let mut bed = Bed::build(&scene, 1)?;
    bed.step(1);
    let peak = MEMORY.peak_usage() - before;
    drop(scene);
    let held = MEMORY.current_usage() - before - of_scene;
    let [held, scene, peak] = [held, of_scene, peak].map(|bytes| bytes as f64 / bed.spheres as f64);
    let size = Size { spheres: bed.spheres, held, scene, peak, ..Size::default() };
    Ok((bed, size))
}

/// CPU time of a list for each sphere: steps that all make one, less steps that make none, in neighbouring samples.
fn cost_of_lists(copies: [usize; 2]) -> Result<Vec<f64>, Failure> {
    let scene = scene_of(copies)?;
    let mut with_lists = scene.clone();
    with_lists.numerics.neighbours.skin = Some(NO_SKIN);
    let mut without = Bed::build(&scene, 1)?;
    let mut with = Bed::build(&with_lists, 1)?;
    let steps = (SPHERE_STEPS_WITH_LISTS / with.spheres).max(2);
    without.step(1);
    let costs = (0..ROUNDS).map(|_| (with.step(steps).cpu_s - without.step(steps).cpu_s) / (steps * with.spheres) as f64).collect();
    let lists = with.work("lists");
    if lists < (ROUNDS * steps) as u64 {
        return Err(format!("only {lists} lists in {} steps", ROUNDS * steps).into());
    }
    Ok(costs)
}

/// Part of the CPU time of a flow that goes into lists, and steps from one to the next.
fn list_share() -> Result<[f64; 2], Failure> {
    let (speed, copies, steps) = FLOW;
    let mut bed = Bed::build(&sheared(scene_of(copies)?, speed), 1)?;
    let (mut plain, mut with_list) = (Vec::new(), Vec::new());
    for _ in 0..steps {
        let before = bed.work("lists");
        let cpu_s = bed.step(1).cpu_s;
        if bed.work("lists") > before { with_list.push(cpu_s) } else { plain.push(cpu_s) }
    }
    let of_lists: f64 = with_list.iter().map(|cpu_s| cpu_s - median(&plain)).sum();
    Ok([of_lists / (plain.iter().sum::<f64>() + with_list.iter().sum::<f64>()), steps as f64 / with_list.len() as f64])
}

/// One thread and two in turn, from the same scene to the same answer.
fn in_parallel(held: f64) -> Result<[Parallel; 2], Failure> {
    let scene = scene_of(PARALLEL_COPIES)?;
    let mut beds = [Bed::build(&scene, 1)?, Bed::build(&scene, 2)?];
    let mut samples = [Vec::new(), Vec::new()];
    beds.iter_mut().for_each(|bed| {
        bed.step(1);
    });
    let start = Instant::now();
    for sample in 0..PARALLEL_SAMPLES {
        if start.elapsed() > BUDGET_IN_PARALLEL {
            println!("only {sample} of {PARALLEL_SAMPLES} samples on one thread and two");
            break;
        }
        for place in if sample % 2 == 0 { [0, 1] } else { [1, 0] } {
            let wall_s = beds[place].step(PARALLEL_STEPS).wall_s;
            samples[place].push(wall_s / (PARALLEL_STEPS * beds[place].spheres) as f64);
        }
    }
    if !beds[0].is_same(&beds[1]) {
        return Err("two threads do not give the bits of one".into());
    }
    let size = held * beds[0].spheres as f64;
    let [one, two] = samples;
    let parallel = |threads: usize, samples: Vec<f64>| -> Result<Parallel, Failure> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        let bandwidth = pool.install(|| triad::bandwidth(size as usize));
        Ok(Parallel { threads, samples, bandwidth, bound: held / bandwidth })
    };
    Ok([parallel(1, one)?, parallel(2, two)?])
}

fn print(found: &Found) {
    println!("spheres | step, ns CPU a sphere | list, ns a sphere | contacts a sphere | bytes a sphere: stages, scene, peak");
    for size in &found.sizes {
        let [cost, list] = [&size.costs, &size.lists].map(|costs| median(costs) * 1e9);
        let Size { spheres, contacts, held, scene, peak, .. } = size;
        println!("{spheres:8} | {cost:6.1} | {list:6.1} | {contacts:.3} | {held:.0}, {scene:.0}, {peak:.0}");
    }
    let (spread, interval) = found.spread();
    println!("largest over smallest: {spread:.3} {interval:.3?} (goal: {FLAT_WITHIN})");
    let [share, steps] = found.list_share;
    println!("flow of 1 m/s: lists are {:.1} % of the CPU time, one in {steps:.0} steps", 100.0 * share);
    println!("threads | wall ns a sphere's step, median | triad, GB/s | ns if memory is all");
    for Parallel { threads, samples, bandwidth, bound } in &found.parallel {
        println!("{threads:7} | {:6.1} | {:.1} | {:.1}", median(samples) * 1e9, bandwidth * 1e-9, bound * 1e9);
    }
    let (speed_up, interval) = found.speed_up();
    println!("two threads are {speed_up:.3} {interval:.3?} times as fast as one, to the same bits");
}
