//! What the inverses of the flow cost, beside a plain Fourier transform of as many cells.

use reports::card::Plot;
use reports::row::Cost;
use reports::{Card, Row};
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};
use std::sync::Arc;
use verification::cli::environment::Environment;

use crate::page::{card, lines, measured, with_goal};
use crate::pairs::Ratio;

/// Identifier of the page.
pub const PAGE: &str = "flow_kernels";
/// The bars, relative to the folder of results.
pub const BARS_FILE: &str = "flow_kernels/bars.csv";
const SOLVES: &str = "solves a second";

/// A plain transform of a cube there and back: complex numbers, line by line, each direction turned to the front as a whole.
pub struct PlainTransform {
    edge: usize,
    there: Arc<dyn Fft<f64>>,
    back: Arc<dyn Fft<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl PlainTransform {
    /// Of a cube of so many cells along an edge.
    pub fn new(edge: usize) -> PlainTransform {
        let mut planner = FftPlanner::new();
        let (there, back) = (planner.plan_fft_forward(edge), planner.plan_fft_inverse(edge));
        let scratch = vec![Complex::default(); there.get_inplace_scratch_len().max(back.get_inplace_scratch_len())];
        PlainTransform { edge, there, back, scratch }
    }

    /// Transforms there and back, which multiplies by the number of cells.
    pub fn apply(&mut self, field: &mut Vec<Complex<f64>>, turned: &mut Vec<Complex<f64>>) {
        for direction in [self.there.clone(), self.back.clone()] {
            for _ in 0..3 {
                direction.process_with_scratch(field, &mut self.scratch);
                self.turn(field, turned);
                std::mem::swap(field, turned);
            }
        }
    }

    /// The second direction becomes the first, the third the second, the first the third.
    fn turn(&self, field: &[Complex<f64>], turned: &mut [Complex<f64>]) {
        let (edge, square) = (self.edge, self.edge * self.edge);
        for (row, values) in field.chunks_exact(edge).enumerate() {
            for (place, value) in values.iter().enumerate() {
                turned[place * square + row] = *value;
            }
        }
    }
}

/// What is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kernel {
    /// A pressure from its right side.
    Poisson,
    /// Velocity and pressure of creeping flow from forces.
    Stokes,
}

/// A kernel on a cube, with what it took.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// What was solved.
    pub kernel: Kernel,
    /// Cells along an edge.
    pub edge: usize,
    /// Cost of a plain transform over that of a solve, one thread, in CPU time.
    pub plain: Ratio,
    /// Wall time of a solve on one thread over that on two, in turns.
    pub on_two: f64,
}

impl Entry {
    /// In words.
    pub fn name(&self) -> String {
        let kernel = match self.kernel {
            Kernel::Poisson => "pressure",
            Kernel::Stokes => "creeping flow",
        };
        format!("{kernel}, {0} x {0} x {0} cells", self.edge)
    }

    /// CPU time in s that a solve may take.
    fn goal(&self) -> Option<f64> {
        match (self.kernel, self.edge) {
            (Kernel::Poisson, 64) => Some(2.5e-3),
            (Kernel::Poisson, 128) => Some(25e-3),
            _ => None,
        }
    }

    /// Cost of a solve over that of a plain transform there and back, and its interval.
    fn over_plain(&self) -> (f64, [f64; 2]) {
        let Ratio { median, interval: [low, high], .. } = self.plain;
        (1.0 / median, [1.0 / high, 1.0 / low])
    }

    fn goal_in_words(&self) -> String {
        match self.goal() {
            Some(goal) if self.plain.base_cpu_s <= goal => format!("{:.1} ms: met", goal * 1e3),
            Some(goal) => format!("{:.1} ms: MISSED", goal * 1e3),
            None => "none".into(),
        }
    }

    /// What [`Entry::line`] tells.
    pub const HEAD: &str =
        "solve                              CPU ms  goal             over a plain transform [95 %]  ns a cell  two threads";

    /// A line of the table.
    pub fn line(&self) -> String {
        let (ratio, [low, high]) = self.over_plain();
        let (seconds, on_two) = (self.plain.base_cpu_s, self.on_two);
        let (name, goal, a_cell) = (self.name(), self.goal_in_words(), seconds * 1e9 / self.edge.pow(3) as f64);
        format!("{name:<33} {:7.2}  {goal:<15} {ratio:6.2} [{low:.2}, {high:.2}] {a_cell:18.2} {on_two:12.2}", seconds * 1e3)
    }

    /// As a row of the page; the value is that of one thread.
    pub fn row(&self, environment: &Environment) -> Row {
        let row = Row {
            statistic: format!("median of {} interleaved samples", self.plain.pairs),
            n: self.plain.pairs as u64,
            value: Some(1.0 / self.plain.base_cpu_s),
            cost: Cost {
                work: [("cells".to_string(), self.edge.pow(3) as u64)].into(),
                cpu_s: Some(self.plain.base_cpu_s),
                rounds: Some(self.plain.pairs as u32),
                runs: 1,
                ..Cost::default()
            },
            data: vec![BARS_FILE.into()],
            ..measured(PAGE, &self.name(), SOLVES, "1/s", environment)
        };
        match self.goal() {
            Some(seconds) => with_goal(row, 1.0 / seconds, "the goal on one core"),
            None => row,
        }
    }

    fn bar(&self) -> String {
        let (ratio, [low, high]) = self.over_plain();
        let (name, goal, on_two) = (self.name().replace(',', ":"), self.goal_in_words(), self.on_two);
        format!("{name},{ratio},{low},{high},{:.2} ms,{goal},{on_two:.2}\n", self.plain.base_cpu_s * 1e3)
    }
}

/// The file of bars.
pub fn bars(entries: &[Entry]) -> String {
    let header = "solve,over a plain transform,low,high,CPU time of a solve,goal,times as fast on two threads\n";
    header.to_string() + &entries.iter().map(Entry::bar).collect::<String>()
}

/// What the page says of itself.
pub fn page(headline: &str) -> Card {
    let question = "What does it cost to find a pressure, or a creeping flow, in a box that repeats?";
    let base = card(PAGE, "Kernels of the flow", question, [headline, SOLVES]);
    Card {
        model: lines([
            "Both inverses go there and back through real Fourier transforms, with the symbol of the operator applied on the way; creeping flow takes three fields at once. The plain transform beside them is of complex numbers there and back, by the same library, line by line with each direction turned to the front as a whole.",
            "Samples of a solve and of a plain transform take turns, in CPU time of one thread; one thread and two take turns in wall time.",
        ]),
        plots: vec![Plot::Bars {
            title: "Cost of a solve".into(),
            file: BARS_FILE.into(),
            x_label: "CPU time over that of a plain transform".into(),
            caption: "Whiskers: 95 % interval of the median over interleaved samples.".into(),
        }],
        ..base
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// There and back is the number of cells times what was there, with each direction in its place.
    #[test]
    fn a_plain_transform_there_and_back_is_what_it_was() {
        let edge = 6;
        let before: Vec<Complex<f64>> = (0..edge * edge * edge).map(|place| Complex::from((place as f64 * 0.7).sin())).collect();
        let (mut field, mut turned) = (before.clone(), vec![Complex::default(); before.len()]);
        PlainTransform::new(edge).apply(&mut field, &mut turned);
        let cells = before.len() as f64;
        assert!(field.iter().zip(&before).all(|(got, wanted)| (got / cells - wanted).norm() < 1e-14));
    }

    #[test]
    fn a_solve_that_is_too_slow_misses_its_goal() {
        let entry = |base_cpu_s| Entry {
            kernel: Kernel::Poisson,
            edge: 64,
            plain: Ratio { median: 2.0, interval: [1.0, 4.0], base_cpu_s, pairs: 5 },
            on_two: 1.5,
        };
        let holds = |base_cpu_s| entry(base_cpu_s).row(&Environment::of(None)).holds();
        assert_eq!([holds(2e-3), holds(3e-3)], [Some(true), Some(false)]);
        assert_eq!(entry(2e-3).over_plain(), (0.5, [0.25, 1.0]));
        let cells: Vec<usize> = bars(&[entry(2e-3)]).lines().map(|line| line.split(',').count()).collect();
        assert_eq!(cells, [7, 7]);
        let rows = vec![entry(2e-3).row(&Environment::of(None))];
        assert_eq!(reports::read_rows(&reports::write_rows(&rows)), Ok(rows));
    }
}
