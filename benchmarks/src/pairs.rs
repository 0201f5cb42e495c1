//! Two pieces of work compared on a busy machine: interleaved, in CPU time of the thread, as the median of ratios of neighbours.
//!
//! Wall times of separate batches differ by tens of per cent on shared machines. Run side by side in the order A B B A, two variants see the same
//! machine, and the median of their pair ratios resolves a few per cent.

use cpu_time::ThreadTime;

/// Cost of B over cost of A.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ratio {
    /// Median of the pair ratios.
    pub median: f64,
    /// 95 % interval of that median, from order statistics.
    pub interval: [f64; 2],
    /// Median CPU seconds of A: the base without which a ratio says nothing.
    pub base_cpu_s: f64,
    /// Pairs behind it.
    pub pairs: usize,
}

/// Times two pieces of work in interleaved pairs.
pub fn compare(mut first: impl FnMut(), mut second: impl FnMut(), pairs: usize) -> Ratio {
    compare_parts((|| (), |()| first()), (|| (), |()| second()), pairs)
}

/// The same where each piece of work has a part before it that is not timed: what that returns is what the work is done on.
pub fn compare_parts<A, B>(
    mut first: (impl FnMut() -> A, impl FnMut(A)),
    mut second: (impl FnMut() -> B, impl FnMut(B)),
    pairs: usize,
) -> Ratio {
    let (mut ratios, mut base) = (Vec::with_capacity(pairs), Vec::with_capacity(pairs));
    for pair in 0..pairs {
        let (one, other) = if pair % 2 == 0 {
            let one = cpu_seconds(&mut first);
            (one, cpu_seconds(&mut second))
        } else {
            let other = cpu_seconds(&mut second);
            (cpu_seconds(&mut first), other)
        };
        ratios.push(other / one);
        base.push(one);
    }
    Ratio {
        median: verification::statistics::median(&ratios),
        interval: verification::statistics::median_interval(&ratios).unwrap_or([f64::NAN; 2]),
        base_cpu_s: verification::statistics::median(&base),
        pairs,
    }
}

fn cpu_seconds<Prepared>((prepare, work): &mut (impl FnMut() -> Prepared, impl FnMut(Prepared))) -> f64 {
    let prepared = prepare();
    let start = ThreadTime::now();
    work(prepared);
    start.elapsed().as_secs_f64()
}

impl std::fmt::Display for Ratio {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [low, high] = self.interval;
        let base = self.base_cpu_s * 1e3;
        write!(formatter, "{:.3} [{low:.3}, {high:.3}] x {base:.3} ms over {} pairs", self.median, self.pairs)
    }
}
