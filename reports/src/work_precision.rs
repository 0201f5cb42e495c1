//! Error against cost: what an accuracy costs, and which runs no other run beats.

use crate::series::Series;

/// Cost of reaching a target error with one setup.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum CostToTarget {
    /// Interpolated between two measured points, with the interval that follows from the intervals of their costs.
    Reached { cost: f64, interval: Option<[f64; 2]> },
    /// Even the cheapest run measured is better than the target.
    AtMost { cost: f64 },
    /// The finest run measured is still worse.
    NotReached,
    /// No costs, or no relative error to speak of.
    Unknown,
}

impl CostToTarget {
    /// The cost in seconds, where there is one.
    pub(crate) fn seconds(self) -> Option<f64> {
        match self {
            CostToTarget::Reached { cost, .. } | CostToTarget::AtMost { cost } => Some(cost),
            CostToTarget::NotReached | CostToTarget::Unknown => None,
        }
    }
}

/// One run as the interpolation sees it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Run {
    pub(crate) cost: f64,
    pub(crate) cost_interval: Option<[f64; 2]>,
    pub(crate) error: f64,
}

/// The runs of a series with relative errors, coarse to fine; absent if an error cannot be made relative.
pub(crate) fn relative_runs(series: &Series) -> Option<Vec<Run>> {
    series
        .costed()
        .into_iter()
        .map(|(cost, point)| {
            let factor = point.row.relative_error_factor()?;
            Some(Run { cost, cost_interval: point.row.cpu_s_per_run_range(), error: point.error * factor })
        })
        .collect()
}

/// What a series pays for a relative error of `target`.
pub(crate) fn series_cost_to_target(series: &Series, target: f64) -> CostToTarget {
    relative_runs(series).map_or(CostToTarget::Unknown, |runs| cost_to_target(&runs, target))
}

/// The cost from which on every finer run meets the target; log-log between measured points, never beyond them.
///
/// `runs` go from coarse to fine. A run that dips below the target and rises again does not count as reaching it.
pub(crate) fn cost_to_target(runs: &[Run], target: f64) -> CostToTarget {
    let (Some(first), Some(last)) = (runs.first(), runs.last()) else { return CostToTarget::Unknown };
    if last.error > target {
        return CostToTarget::NotReached;
    }
    match runs.iter().rposition(|run| run.error > target) {
        None => CostToTarget::AtMost { cost: first.cost },
        Some(coarse) => between(runs[coarse], runs[coarse + 1], target),
    }
}

fn between(coarse: Run, fine: Run, target: f64) -> CostToTarget {
    if fine.error <= 0.0 {
        // An error of exactly zero has no logarithm: the finer run itself is the only honest answer.
        return CostToTarget::Reached { cost: fine.cost, interval: fine.cost_interval };
    }
    let weight = (coarse.error / target).ln() / (coarse.error / fine.error).ln();
    let blend = |a: f64, b: f64| (a.ln() + weight * (b / a).ln()).exp();
    let interval = match (coarse.cost_interval, fine.cost_interval) {
        (Some(a), Some(b)) if a[0] > 0.0 && b[0] > 0.0 => Some([blend(a[0], b[0]), blend(a[1], b[1])]),
        _ => None,
    };
    CostToTarget::Reached { cost: blend(coarse.cost, fine.cost), interval }
}

/// The points no other point beats in both cost and error, by rising cost. Points are `[cost, error]`.
pub(crate) fn pareto_front(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted: Vec<[f64; 2]> = points.iter().copied().filter(|p| p.iter().all(|x| x.is_finite())).collect();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut front: Vec<[f64; 2]> = Vec::new();
    for point in sorted {
        if front.last().is_none_or(|best| point[1] < best[1]) {
            front.push(point);
        }
    }
    front
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(cost: f64, error: f64) -> Run {
        Run { cost, cost_interval: Some([cost * 0.5, cost * 2.0]), error }
    }

    #[test]
    fn cost_to_target_matches_a_number_computed_by_hand() {
        // Second order: error 4e-2 at 1 s, 1e-2 / 4 at 4 s. log-log slope is -2, so 1e-2 is met at exactly 2 s.
        let runs = [run(1.0, 4e-2), run(4.0, 2.5e-3)];
        let CostToTarget::Reached { cost, interval: Some(interval) } = cost_to_target(&runs, 1e-2) else {
            panic!("the target lies between the two runs");
        };
        assert!((cost - 2.0).abs() < 1e-12);
        assert!((interval[0] - 1.0).abs() < 1e-12 && (interval[1] - 4.0).abs() < 1e-12);
    }

    #[test]
    fn nothing_is_extrapolated() {
        let runs = [run(1.0, 4e-2), run(4.0, 2.5e-3)];
        assert_eq!(cost_to_target(&runs, 0.1), CostToTarget::AtMost { cost: 1.0 });
        assert_eq!(cost_to_target(&runs, 1e-3), CostToTarget::NotReached);
        assert_eq!(cost_to_target(&[], 1e-3), CostToTarget::Unknown);
    }

    #[test]
    fn a_lucky_dip_is_not_reaching_the_target() {
        let runs = [run(1.0, 5e-2), run(2.0, 5e-3), run(4.0, 2e-2), run(8.0, 5e-3)];
        assert!(matches!(cost_to_target(&runs, 1e-2), CostToTarget::Reached { cost, .. } if cost > 4.0));
    }

    #[test]
    fn pareto_front_equals_brute_force() {
        let mut state = 7_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 26)
        };
        // A coarse lattice, so that ties in either coordinate and equal points do occur.
        let points: Vec<[f64; 2]> = (0..200).map(|_| [1.0 + next(), 1.0 + next()]).collect();
        let beaten = |p: &[f64; 2]| points.iter().any(|q| q[0] <= p[0] && q[1] <= p[1] && q != p);
        let mut expected: Vec<[f64; 2]> = points.iter().copied().filter(|p| !beaten(p)).collect();
        expected.sort_by(|a, b| a[0].total_cmp(&b[0]));
        expected.dedup();
        assert_eq!(pareto_front(&points), expected);
    }
}
