//! Interleaved rounds of evaluation: every point once a round, forwards and backwards in turn, beside a reference kernel.

use reports::row::Cost;

use super::{Clock, Context};
use crate::case::{Case, Curve, Failure, Measurement, Setup};
use crate::reference_kernel;
use crate::statistics::median;

/// Rounds of interleaved timing: more tell the interval, fewer save time.
const LARGEST_NUMBER_OF_ROUNDS: usize = 5;

/// CPU seconds beyond which no further round is begun, whatever the budget.
const LONGEST_TIMING: f64 = 300.0;

/// A round in which the reference kernel took this much more or less than its median is not used.
const REJECTION: f64 = 0.1;

pub(super) fn number_of_rounds(budget: f64, first: &Round, context: &Context<'_>) -> usize {
    if context.clock.is_none() {
        return 1;
    }
    // Half of the budget is for timing; the rest is slack for slower machines. One round that takes minutes tells its time well enough.
    let affordable = (0.5 * budget).min(LONGEST_TIMING) / first.cpu_seconds().max(1e-9);
    (affordable as usize).clamp(1, LARGEST_NUMBER_OF_ROUNDS)
}

/// One evaluation of every point, with times.
pub(super) struct Round {
    pub(super) results: Vec<Result<Measurement, Failure>>,
    cpu: Vec<f64>,
    wall: Vec<f64>,
    reference_cpu: f64,
}

impl Round {
    pub(super) fn run(case: &dyn Case, context: &Context<'_>, points: &[(&Setup, f64)], backwards: bool) -> Round {
        let cpu_now = || context.clock.map_or(0.0, Clock::cpu_seconds);
        let wall_now = || context.clock.map_or(0.0, Clock::wall_seconds);
        let reference_start = cpu_now();
        if context.clock.is_some() {
            std::hint::black_box(reference_kernel::run());
        }
        let reference_cpu = cpu_now() - reference_start;
        let count = points.len();
        let mut round =
            Round { results: vec![Ok(Measurement::default()); count], cpu: vec![0.0; count], wall: vec![0.0; count], reference_cpu };
        // Every other round runs backwards, so that a machine that slows down or speeds up does so evenly for all.
        for turn in 0..count {
            let index = if backwards { count - 1 - turn } else { turn };
            let (setup, knob) = points[index];
            let (cpu, wall) = (cpu_now(), wall_now());
            round.results[index] = case.evaluate(setup, knob, context.random_seed);
            round.cpu[index] = cpu_now() - cpu;
            round.wall[index] = wall_now() - wall;
            (context.progress)(turn + 1, count);
        }
        round
    }

    pub(super) fn cpu_seconds(&self) -> f64 {
        self.cpu.iter().sum()
    }
}

/// Times of all points over the rounds.
pub(super) struct Timing {
    cpu: Vec<Vec<f64>>,
    wall: Vec<Vec<f64>>,
    reference_cpu: Vec<f64>,
    accepted: Vec<bool>,
}

impl Timing {
    pub(super) fn new(rounds: &[Round]) -> Timing {
        let reference_cpu: Vec<f64> = rounds.iter().map(|round| round.reference_cpu).collect();
        let usual = median(&reference_cpu);
        let mut accepted: Vec<bool> = reference_cpu.iter().map(|time| (time / usual - 1.0).abs() <= REJECTION).collect();
        if !accepted.contains(&true) {
            accepted.fill(true);
        }
        let columns = |of: fn(&Round) -> &Vec<f64>| {
            let points = rounds.first().map_or(0, |round| of(round).len());
            (0..points).map(|point| rounds.iter().map(|round| of(round)[point]).collect()).collect()
        };
        Timing { cpu: columns(|round| &round.cpu), wall: columns(|round| &round.wall), reference_cpu, accepted }
    }

    fn used(&self, times: &[f64]) -> Vec<f64> {
        times.iter().zip(&self.accepted).filter(|(_, accepted)| **accepted).map(|(time, _)| *time).collect()
    }

    pub(super) fn cost(&self, point: usize, measurement: &Measurement) -> Cost {
        let mut cost = Cost { work: measurement.work.clone(), runs: measurement.runs, ..Cost::default() };
        let cpu = self.used(&self.cpu[point]);
        if self.reference_cpu.iter().all(|time| *time <= 0.0) {
            return cost;
        }
        cost.cpu_s = Some(median(&cpu));
        cost.wall_s = Some(median(&self.used(&self.wall[point])));
        cost.rounds = Some(cpu.len() as u32);
        cost.reference_kernels = Some(median(&cpu) / median(&self.used(&self.reference_cpu)));
        if cpu.len() >= 3 {
            // Too few for a rank interval: the range of the rounds is shown.
            let (low, high) = cpu.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), time| (low.min(*time), high.max(*time)));
            cost.cpu_s_range = Some([low, high]);
        }
        cost
    }

    /// Every time that was taken, rejected rounds included.
    pub(super) fn curve(&self, points: &[(&Setup, f64)]) -> Option<Curve> {
        if self.reference_cpu.iter().all(|time| *time <= 0.0) {
            return None;
        }
        let mut rows = Vec::new();
        for (round, reference) in self.reference_cpu.iter().enumerate() {
            for (point, (setup, knob)) in points.iter().enumerate() {
                let accepted = f64::from(u8::from(self.accepted[round]));
                let (cpu, wall) = (self.cpu[point][round], self.wall[point][round]);
                rows.push(vec![round as f64, setup.index as f64, *knob, cpu, wall, *reference, accepted]);
            }
        }
        let columns = vec!["round", "setup_index", "knob", "cpu_s", "wall_s", "reference_kernel_cpu_s", "round_used"];
        Some(Curve { file: "timing.csv".into(), columns, rows })
    }
}
