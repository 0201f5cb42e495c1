//! Rows, data files and the card of the page.

use reports::card::Plot;
use reports::row::{Cost, Knob};
use reports::{Card, Row};
use verification::cli::environment::Environment;
use verification::statistics::{median, median_interval};

use crate::page::{card, lines, measured};

/// Identifier of the page.
pub const PAGE: &str = "scaling";
/// Cost of a sphere's step from the fewest spheres to the most may differ by this factor.
pub const FLAT_WITHIN: f64 = 1.6;
/// How it all is set up.
pub const SETUP: &str = "settled bed, friction with memory, 1 thread";
const COST: &str = "CPU time of one sphere's step";
const SPREAD: &str = "largest over smallest cost of a sphere's step";

/// What was found at one number of spheres.
#[derive(Debug, Clone, Default)]
pub struct Size {
    /// Spheres.
    pub spheres: usize,
    /// CPU time in s of one sphere's step, a round each.
    pub costs: Vec<f64>,
    /// Touching contacts of a sphere.
    pub contacts: f64,
    /// Bytes of a sphere that the stages hold between steps.
    pub held: f64,
    /// Bytes of a sphere that the scene they were made from takes.
    pub scene: f64,
    /// Bytes of a sphere at the peak, while it is built.
    pub peak: f64,
    /// CPU time in s of one list of neighbours for each sphere, a round each.
    pub lists: Vec<f64>,
}

/// What was found on some threads.
#[derive(Debug, Clone)]
pub struct Parallel {
    /// Threads.
    pub threads: usize,
    /// Wall time in s of one sphere's step, all samples in the order in which they were taken.
    pub samples: Vec<f64>,
    /// Bytes a second that these threads move in the triad.
    pub bandwidth: f64,
    /// Wall time in s of one sphere's step if all that the stages hold is moved once.
    pub bound: f64,
}

/// All that was found.
#[derive(Debug, Clone)]
pub struct Found {
    /// From the fewest spheres to the most.
    pub sizes: Vec<Size>,
    /// On one thread and on two.
    pub parallel: [Parallel; 2],
    /// Spheres of the parallel runs.
    pub spheres_in_parallel: usize,
    /// Part of the CPU time that lists take in a flow of 1 m/s, and steps from one list to the next.
    pub list_share: [f64; 2],
}

impl Found {
    /// Largest over smallest cost, taken round by round so that a slow round of the machine cancels: median and interval.
    pub fn spread(&self) -> (f64, Option<[f64; 2]>) {
        let rounds = self.sizes.iter().map(|size| size.costs.len()).min().unwrap_or(0);
        let cost = |round: usize| self.sizes.iter().map(move |size| size.costs[round]);
        let ratio = |round: usize| cost(round).fold(0.0, f64::max) / cost(round).fold(f64::INFINITY, f64::min);
        let ratios: Vec<f64> = (0..rounds).map(ratio).collect();
        (median(&ratios), median_interval(&ratios))
    }

    /// Wall time on one thread over that on two, of neighbouring samples.
    pub fn speed_up(&self) -> (f64, Option<[f64; 2]>) {
        let pairs = self.parallel[0].samples.iter().zip(&self.parallel[1].samples);
        let ratios: Vec<f64> = pairs.map(|(one, two)| one / two).collect();
        (median(&ratios), median_interval(&ratios))
    }

    /// Rows of the page.
    pub fn rows(&self, environment: &Environment) -> Vec<Row> {
        let row = |setup: &str, quantity: &str, unit: &str| measured(PAGE, setup, quantity, unit, environment);
        let at = |spheres: usize| Some(Knob { name: "spheres".into(), value: spheres as f64 });
        let mut rows = Vec::new();
        for size in &self.sizes {
            let of_rounds = |quantity: &str, costs: &[f64]| Row {
                knob: at(size.spheres),
                value: Some(median(costs)).filter(|value| value.is_finite()),
                statistic: format!("median of {} rounds", costs.len()),
                n: costs.len() as u64,
                // Of one step of the bed.
                cost: Cost {
                    cpu_s: Some(median(costs) * size.spheres as f64).filter(|cpu_s| cpu_s.is_finite()),
                    runs: 1,
                    ..Cost::default()
                },
                data: vec![format!("{PAGE}/cost.csv")],
                ..row(SETUP, quantity, "s")
            };
            let single =
                |quantity: &str, unit: &str, value: f64| Row { knob: at(size.spheres), value: Some(value), ..row(SETUP, quantity, unit) };
            rows.push(of_rounds(COST, &size.costs));
            rows.push(of_rounds("CPU time of one list for each sphere", &size.lists));
            rows.push(single("contacts of a sphere", "1", size.contacts));
            rows.push(Row {
                cost: Cost { peak_bytes: Some((size.peak * size.spheres as f64) as u64), runs: 1, ..Cost::default() },
                ..single("memory of a sphere between steps", "B", size.held)
            });
            rows.push(single("memory of a sphere in the scene", "B", size.scene));
            rows.push(single("memory of a sphere at the peak", "B", size.peak));
        }
        rows.retain(|row| row.value.is_some());
        let (spread, interval) = self.spread();
        rows.push(Row {
            value: Some(spread),
            expected: Some(1.0),
            error: Some(spread - 1.0),
            ci95: interval.map(|interval| interval.map(|end| end - 1.0)),
            floor: Some(0.0),
            bound: Some(FLAT_WITHIN - 1.0),
            bound_reason: Some(format!("flat within a factor of {FLAT_WITHIN} from 10³ to 10⁶ spheres: the goal")),
            pass: Some(spread <= FLAT_WITHIN),
            statistic: "median of rounds".into(),
            ..row(SETUP, SPREAD, "1")
        });
        rows.push(Row {
            value: Some(self.list_share[0]),
            ..row("flow of 1 m/s at the top, 1 thread", "part of the CPU time that lists take", "1")
        });
        rows.push(Row { value: Some(self.list_share[1]), ..row("flow of 1 m/s at the top, 1 thread", "steps from list to list", "1") });
        for parallel in &self.parallel {
            let Parallel { threads, samples, bandwidth, bound } = parallel;
            let setup = format!("{} spheres, {threads} thread{}", self.spheres_in_parallel, if *threads == 1 { "" } else { "s" });
            let threads = *threads as u32;
            let single = |quantity: &str, unit: &str, value: f64| Row { threads, value: Some(value), ..row(&setup, quantity, unit) };
            rows.push(Row {
                statistic: format!("median of {} samples", samples.len()),
                n: samples.len() as u64,
                data: vec![format!("{PAGE}/samples.csv")],
                ..single("wall time of one sphere's step", "s", median(samples))
            });
            rows.push(single("bandwidth of the triad", "B/s", *bandwidth));
            rows.push(single("wall time of one sphere's step if memory is all", "s", *bound));
        }
        rows.push(Row { threads: 2, value: Some(self.speed_up().0), ..row("1 thread over 2", "speed-up of neighbouring samples", "1") });
        rows
    }

    /// Data files: path and content.
    pub fn files(&self) -> [(&'static str, String); 3] {
        [("scaling/cost.csv", self.cost_csv()), ("scaling/memory.csv", self.memory_csv()), ("scaling/samples.csv", self.samples_csv())]
    }

    fn cost_csv(&self) -> String {
        let line = |size: &Size| {
            let ends = size.costs.iter().fold([f64::INFINITY, 0.0_f64], |[low, high], cost| [low.min(*cost), high.max(*cost)]);
            let [median, low, high] = [median(&size.costs), ends[0], ends[1]].map(nanoseconds);
            format!("{},{median},{low},{high},{}\n", size.spheres, nanoseconds(self::median(&size.lists)))
        };
        "spheres,median,least,most,list\n".to_string() + &self.sizes.iter().map(line).collect::<String>()
    }

    fn memory_csv(&self) -> String {
        let line = |size: &Size| format!("{},{:.1},{:.1},{:.1}\n", size.spheres, size.held, size.scene, size.peak);
        "spheres,held,scene,peak\n".to_string() + &self.sizes.iter().map(line).collect::<String>()
    }

    /// The part of all samples that took no longer, for each number of threads, and the bounds as upright lines.
    fn samples_csv(&self) -> String {
        let [one, two] = &self.parallel;
        let ideal = 0.5 * median(&one.samples);
        let mut text = String::from("nanoseconds,one,two,half of one,memory of one,memory of two\n");
        let mut line = |column: usize, seconds: f64, part: f64| {
            let cells: Vec<String> = (0..5).map(|other| if other == column { part.to_string() } else { String::new() }).collect();
            text += &format!("{},{}\n", nanoseconds(seconds), cells.join(","));
        };
        for (column, parallel) in self.parallel.iter().enumerate() {
            let mut sorted = parallel.samples.clone();
            sorted.sort_by(f64::total_cmp);
            let count = sorted.len() as f64;
            for (place, sample) in sorted.iter().enumerate() {
                line(column, *sample, place as f64 / count);
                line(column, *sample, (place + 1) as f64 / count);
            }
        }
        for (column, seconds) in [(2, ideal), (3, one.bound), (4, two.bound)] {
            line(column, seconds, 0.0);
            line(column, seconds, 1.0);
        }
        text
    }

    /// What the page says of itself.
    pub fn card(&self) -> Card {
        let question = "What does one step of one sphere cost from a thousand to a million of them, how much memory does it take, and what does a second thread gain?";
        Card {
            model: lines([
                "A bed of 1000 spheres of 3 mm, settled on a floor 12 x 12 diameters wide and periodic, is copied side by side along x and y: as many contacts a sphere at every number of spheres, so that only the memory grows. Stiffness 10⁵ N/m, restitution 0.75, friction 0.5 with memory, time step 2 µs.",
                "Numbers of spheres take turns, in turn forwards and backwards; a cost is CPU time of the only thread, a ratio is taken within a round. Runs on one thread and on two take turns too; there wall time is all that tells, so all samples are shown.",
                "Memory is counted at the allocator: what the stages hold between steps, what the scene takes that they were made from, and the peak while they are made.",
            ]),
            plots: vec![
                curves(
                    "Cost of a step against the number of spheres",
                    "cost.csv",
                    ["spheres", "CPU time of one sphere's step, ns"],
                    &[
                        ["median", "step, median of rounds"],
                        ["least", "step, least of rounds"],
                        ["most", "step, most of rounds"],
                        ["list", "one list of neighbours (made when a sphere has moved by half the skin)"],
                    ],
                    [true, true],
                    "A flat line is a cost that does not depend on the number of spheres; the goal is flat within 1.6.",
                ),
                curves(
                    "Memory against the number of spheres",
                    "memory.csv",
                    ["spheres", "bytes a sphere"],
                    &[["held", "stages, between steps"], ["scene", "scene they were made from"], ["peak", "peak, while they are made"]],
                    [true, false],
                    "The scene is kept by the simulation for checkpoints; the peak has it twice.",
                ),
                curves(
                    "One thread and two: all samples",
                    "samples.csv",
                    ["wall time of one sphere's step, ns", "part of the samples that took no longer"],
                    &[
                        ["one", "1 thread (the base case)"],
                        ["two", "2 threads"],
                        ["half of one", "half of the median on 1 thread"],
                        ["memory of one", "memory bound, 1 thread"],
                        ["memory of two", "memory bound, 2 threads"],
                    ],
                    [true, false],
                    "Memory bound: all that the stages hold is moved once, as fast as the triad a = b + s c moves arrays of that size on as many threads. Two threads at the dotted half would be twice as fast.",
                ),
            ],
            sources: lines(["benchmarks/peers/packing/settle.py: how the bed was settled"]),
            ..card(PAGE, "Scaling with spheres and threads", question, [SETUP, SPREAD])
        }
    }
}

fn nanoseconds(seconds: f64) -> String {
    if seconds.is_finite() { format!("{:.3}", seconds * 1e9) } else { String::new() }
}

fn curves(title: &str, file: &str, labels: [&str; 2], columns: &[[&str; 2]], logarithmic: [bool; 2], caption: &str) -> Plot {
    Plot::Curves {
        title: title.into(),
        file: format!("{PAGE}/{file}"),
        x_label: labels[0].into(),
        y_label: labels[1].into(),
        columns: columns.iter().map(|column| column.map(str::to_string)).collect(),
        log_x: logarithmic[0],
        log_y: logarithmic[1],
        caption: caption.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(costs: [&[f64]; 2]) -> Found {
        let size = |spheres, costs: &[f64]| Size { spheres, costs: costs.to_vec(), ..Size::default() };
        let parallel = |threads, samples: &[f64]| Parallel { threads, samples: samples.to_vec(), bandwidth: 1e10, bound: 1e-8 };
        Found {
            sizes: vec![size(1000, costs[0]), size(10_000, costs[1])],
            parallel: [parallel(1, &[4e-7, 2e-7, 3e-7]), parallel(2, &[2e-7, 1e-7, 3e-7])],
            spheres_in_parallel: 10_000,
            list_share: [0.1, 70.0],
        }
    }

    /// A machine that is ten times slower in one round does not spread the costs.
    #[test]
    fn spreads_are_those_of_rounds() {
        let found = found([&[1.0, 10.0, 1.0], &[1.5, 15.0, 1.5]]);
        assert_eq!(found.spread().0, 1.5);
        assert_eq!(found.speed_up().0, 2.0);
    }

    #[test]
    fn the_goal_is_a_claim_that_can_fail() {
        let claim =
            |costs| found(costs).rows(&Environment::of(None)).into_iter().find(|row| row.bound.is_some()).and_then(|row| row.holds());
        assert_eq!(claim([&[1.0], &[1.59]]), Some(true));
        assert_eq!(claim([&[1.7], &[1.0]]), Some(false));
    }

    /// Samples are steps from 0 to 1, in order, and each curve of the page has a column.
    #[test]
    fn the_samples_are_a_distribution() {
        let found = found([&[1.0], &[1.0]]);
        let text = found.samples_csv();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[1], "200.000,0,,,,");
        assert_eq!(lines[6], "400.000,1,,,,");
        assert_eq!(lines.len(), 1 + 12 + 6);
        for plot in found.card().plots {
            let Plot::Curves { file, columns, .. } = plot else { panic!("a curve") };
            let (_, text) = found.files().into_iter().find(|(path, _)| *path == file).expect("the file is written");
            let header: Vec<String> = text.lines().next().expect("a header").split(',').map(str::to_string).collect();
            assert!(columns.iter().all(|[name, _]| header.contains(name)), "{file}");
        }
    }
}
