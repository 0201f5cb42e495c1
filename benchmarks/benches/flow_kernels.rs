//! Solves for a pressure and for a creeping flow in a box that repeats: how long they take on one thread and on two, beside a plain Fourier transform.
//!
//! Results go to `reports/results/flow_kernels.jsonl` and the page of `touchstone report`.

use std::path::Path;
use std::time::Instant;

use benchmarks::flow::{BARS_FILE, Entry, Kernel, PlainTransform, bars, page};
use benchmarks::page::write;
use benchmarks::pairs::compare;
use rayon::{ThreadPool, ThreadPoolBuilder};
use rustfft::num_complex::Complex;
use solver::Vector;
use solver::fluid::grid::{FaceField, Grid, cell_field};
use solver::fluid::periodic::PeriodicBox;
use verification::cli::environment::Environment;
use verification::statistics::median;

/// Samples of each solve; odd, so that the median is one of them.
const SAMPLES: usize = 41;
const EDGES: [usize; 2] = [64, 128];

type Failure = Box<dyn std::error::Error + Send + Sync>;

fn main() -> Result<(), Failure> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let pool = |threads| ThreadPoolBuilder::new().num_threads(threads).build();
    let pools = [pool(1)?, pool(2)?];
    let kernels = [Kernel::Poisson, Kernel::Stokes];
    let all = kernels.into_iter().flat_map(|kernel| EDGES.map(|edge| (kernel, edge)));
    let entries = all.map(|(kernel, edge)| measure(kernel, edge, &pools)).collect::<Result<Vec<Entry>, Failure>>()?;
    println!("{}", Entry::HEAD);
    entries.iter().for_each(|entry| println!("{}", entry.line()));
    let environment = Environment::of(Some(&root));
    let rows: Vec<_> = entries.iter().map(|entry| entry.row(&environment)).collect();
    write(&root.join("reports/results"), &page(&entries[0].name()), &rows, &[(BARS_FILE, bars(&entries))])
        .map_err(|error| error.to_string().into())
}

fn measure(kernel: Kernel, edge: usize, pools: &[ThreadPool; 2]) -> Result<Entry, Failure> {
    let grid = Grid::new([edge; 3], 1.0 / edge as f64, Vector::zeros())?;
    let flow = PeriodicBox::new(grid);
    let wavy = |place: Vector| (3.0 * place.x + place.y).sin() + (2.0 * place.z - place.x).cos();
    let mut pressure = cell_field(&grid, wavy);
    let mut velocity = FaceField::from_fn(&grid, |component, place| wavy(place * (component + 1) as f64));
    let mut solve = || match kernel {
        Kernel::Poisson => flow.solve_poisson(&mut pressure),
        Kernel::Stokes => flow.solve_stokes(&mut velocity, 1.0, 0.0, Vector::x()),
    };
    let mut plain = PlainTransform::new(edge);
    let mut field = vec![Complex::from(1e-300); grid.len()];
    let mut turned = field.clone();
    pools[0].install(&mut solve);
    // CPU time is that of a thread: the one of the pool does all the work.
    let ratio = pools[0].install(|| compare(&mut solve, || plain.apply(&mut field, &mut turned), SAMPLES));
    let mut walls: [Vec<f64>; 2] = Default::default();
    for _ in 0..SAMPLES {
        for (pool, walls) in pools.iter().zip(&mut walls) {
            let begin = Instant::now();
            pool.install(&mut solve);
            walls.push(begin.elapsed().as_secs_f64());
        }
    }
    let [one, two] = walls.map(|walls| median(&walls));
    Ok(Entry { kernel, edge, plain: ratio, on_two: one / two })
}
