//! [`Summary`]: the facts of a case that its verdict line, the head of its page and its row in the index share.

use crate::card::Plot;
use crate::row::{ReferenceKind, Verdict};
use crate::series::{Series, own_series};
use crate::work_precision::{CostToTarget, series_cost_to_target};
use crate::{CaseResults, Row, number};

/// How a whole case stands; the order is the order of the index, worst first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Standing {
    /// At least one expectation is not met.
    NotMet,
    /// There are no claims to judge, or no rows at all.
    NoResult,
    /// All expectations are met.
    Met,
}

/// The facts of a case.
pub(crate) struct Summary<'a> {
    pub(crate) standing: Standing,
    /// Rows with a claim, and those of them whose expectation is met (an unexpected pass is not red).
    pub(crate) claims: usize,
    pub(crate) met: usize,
    pub(crate) unexpected_passes: usize,
    /// Claims that are expected not to hold, by design.
    pub(crate) known_limits: usize,
    pub(crate) source_errors: usize,
    pub(crate) failed_runs: usize,
    /// The claim the verdict line quotes, with its line number.
    pub(crate) headline: Option<(usize, &'a Row)>,
    /// The row with the observed order, with its line number.
    pub(crate) order: Option<(usize, &'a Row)>,
    /// Relative error, setup and cost of the target the index quotes.
    pub(crate) cost_to_one_percent: Option<(&'a str, CostToTarget)>,
    /// CPU seconds of all runs behind the rows; a run that yields several rows counts once.
    pub(crate) cpu_s: f64,
}

impl<'a> Summary<'a> {
    /// Gathers the facts of a case; only this project's own rows count.
    pub(crate) fn new(case: &'a CaseResults) -> Summary<'a> {
        let verdicts: Vec<Verdict> = case.own_rows().map(|(_, row)| row.verdict()).collect();
        let count = |wanted: Verdict| verdicts.iter().filter(|verdict| **verdict == wanted).count();
        let expected = |wanted| case.own_rows().filter(|(_, row)| row.expectation == wanted && row.verdict() != Verdict::NoClaim).count();
        let claims = verdicts.len() - count(Verdict::NoClaim);
        let headline = find_headline(case);
        Summary {
            standing: match (claims, count(Verdict::NotMet)) {
                (0, _) => Standing::NoResult,
                (_, 0) => Standing::Met,
                _ => Standing::NotMet,
            },
            claims,
            met: claims - count(Verdict::NotMet),
            unexpected_passes: count(Verdict::UnexpectedPass),
            known_limits: expected(crate::row::Expectation::KnownLimit),
            source_errors: expected(crate::row::Expectation::SourceError),
            failed_runs: case.own_rows().filter(|(_, row)| row.failed.is_some()).count(),
            headline,
            order: find_order(case),
            cost_to_one_percent: cost_to_one_percent(case),
            cpu_s: total_cpu(case),
        }
    }

    /// Error over bound of the headline claim.
    pub(crate) fn margin(&self) -> Option<f64> {
        let (_, row) = self.headline?;
        Some(row.error? / row.bound.filter(|bound| *bound > 0.0)?)
    }

    /// Kind of the reference behind the headline claim.
    pub(crate) fn reference_kind(&self) -> Option<ReferenceKind> {
        self.headline.and_then(|(_, row)| row.reference.as_ref()).map(|reference| reference.kind)
    }

    /// The standing in one or two words.
    pub(crate) fn standing_words(&self) -> &'static str {
        match self.standing {
            Standing::NotMet => "NOT MET",
            Standing::NoResult => "no result",
            Standing::Met => "met",
        }
    }
}

/// The one line a terminal prints for a case.
pub fn verdict_line(case: &CaseResults) -> String {
    let summary = Summary::new(case);
    let mut facts = Vec::new();
    if summary.unexpected_passes > 0 {
        facts.push(format!("{} unexpected pass", summary.unexpected_passes));
    }
    if summary.failed_runs > 0 {
        facts.push(format!("{} failed run{}", summary.failed_runs, if summary.failed_runs == 1 { "" } else { "s" }));
    }
    facts.push(match summary.headline {
        Some((_, row)) => headline_words(row),
        None => "no headline row".into(),
    });
    if let Some(order) = summary.order.and_then(|(_, row)| row.value) {
        facts.push(format!("order {}", number::order(order)));
    }
    if let Some(cost) = summary.headline.and_then(|(_, row)| row.cpu_s_per_run()) {
        facts.push(format!("{} CPU a run", number::seconds(cost).replace('\u{a0}', " ")));
    }
    let standing = summary.standing_words();
    let head = format!("{}  {standing} {}/{}", case.card.case, summary.met, summary.claims);
    format!("{head}  {}{}", facts.join(", "), first_red(case).map(|red| format!("; {red}")).unwrap_or_default())
}

fn headline_words(row: &Row) -> String {
    match (row.error, &row.failed) {
        (Some(error), None) => {
            let bound = row.bound.map(number::terminal);
            let reason = row.bound_reason.as_deref().map(|reason| format!(" = {reason}")).unwrap_or_default();
            let allowed = bound.map(|bound| format!(" (bound {bound}{reason})")).unwrap_or_default();
            format!("{} error {}{allowed}", row.quantity, number::terminal(error))
        }
        (_, Some(reason)) => format!("{} failed: {reason}", row.quantity),
        (None, None) => format!("{} has no error", row.quantity),
    }
}

/// The first claim that is not met, so that a terminal names what to look at.
fn first_red(case: &CaseResults) -> Option<String> {
    let (_, row) = case.own_rows().find(|(_, row)| row.verdict() == Verdict::NotMet)?;
    let knob = row.knob.as_ref().map(|knob| format!(", {}={}", knob.name, number::knob(knob.value))).unwrap_or_default();
    Some(format!("first not met: {} [{}{knob}]", headline_words(row), row.setup))
}

fn find_headline(case: &CaseResults) -> Option<(usize, &Row)> {
    let headline = &case.card.headline;
    case.own_rows().find(|(_, row)| {
        row.setup == headline.setup
            && row.quantity == headline.quantity
            && row.statistic.starts_with(&headline.statistic)
            && row.knob.as_ref().is_none_or(|knob| same_knob(knob.value, headline.knob))
    })
}

/// Whether two knob values are the same setting; they went through text, so the last digit may differ.
pub(crate) fn same_knob(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * a.abs().max(b.abs())
}

/// The order row of the headline's setup, or of any setup if that one has none.
fn find_order(case: &CaseResults) -> Option<(usize, &Row)> {
    let quantity = case.card.headline.order_quantity.as_deref()?;
    let of_quantity = || case.own_rows().filter(|(_, row)| row.quantity == quantity && row.value.is_some());
    of_quantity().find(|(_, row)| row.setup == case.card.headline.setup).or_else(|| of_quantity().next())
}

/// Cost to 1 % of the headline's setup in the first error-against-cost plot, or of its cheapest setup.
fn cost_to_one_percent(case: &CaseResults) -> Option<(&str, CostToTarget)> {
    let (quantity, setups, statistic) = case.card.plots.iter().find_map(|plot| match plot {
        Plot::ErrorAgainstCost { quantity, setups, statistic, .. } => Some((quantity, setups, statistic)),
        _ => None,
    })?;
    let all: Vec<Series> = own_series(case, quantity, setups, statistic);
    let cost = |series: &Series<'_>| series_cost_to_target(series, 0.01);
    if let Some(series) = all.iter().find(|series| series.setup == case.card.headline.setup) {
        return Some((series.setup, cost(series)));
    }
    all.iter()
        .filter_map(|series| cost(series).seconds().map(|seconds| (seconds, series)))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, series)| (series.setup, cost(series)))
}

/// Rows of the same setup and knob come from the same runs (a median and a worst value do), so the largest one counts.
fn total_cpu(case: &CaseResults) -> f64 {
    let mut runs: std::collections::BTreeMap<(&str, Option<u64>), f64> = std::collections::BTreeMap::new();
    for (_, row) in case.own_rows() {
        let knob = row.knob.as_ref().map(|knob| knob.value.to_bits());
        let seconds = row.cost.cpu_s.unwrap_or(0.0);
        let largest = runs.entry((&row.setup, knob)).or_insert(0.0);
        *largest = largest.max(seconds);
    }
    runs.values().sum()
}
