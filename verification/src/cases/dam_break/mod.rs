//! A column of grains behind a gate that is taken away: how far does the heap run, how high does it stand, and on what does that depend?

mod collapse;
mod figures;
mod heap;
mod laws;
mod setting;
mod variants;
mod words;

use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::Scene;

use crate::case::{Case, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::statistics::mean_and_half_width;
use crate::study::add_work;
use crate::variant::Variant;
use collapse::Collapse;
use laws::{Scaled, band, law};
use setting::Column;
use variants::Setting;

/// The case.
pub struct DamBreak;

const SPREAD: &str = "run-out over length";
const RUN_OUT: &str = "run-out over length, mean, in the band of laws";
const HEIGHT: &str = "final height over length, mean, in the band of laws";
const STIFFER: &str = "mean run-out over length against grains four times as stiff";
const FILLING: &str = "solid fraction of the column";
const UNSETTLED: &str = "part of the grains that move when the gate opens";
const REST: &str = "time until the front stops over the root of height over gravity";
const LOST: &str = "volume in the profile of the heap against that of the grains";
const SELF_SIMILAR: &str = "distance of the scaled profile from that of half the size";

fn quantity(name: &'static str, samples: Vec<f64>, expected: f64, floor: f64, kind: ReferenceKind, source: &str) -> Quantity {
    let reference = Reference { kind, uncertainty: floor, source: source.into() };
    Quantity { name, unit: "1", samples, expected, reference, error_kind: ErrorKind::Absolute, floor }
}

/// A value of a law, as if it were measured.
fn of_law(source: &str, aspect_ratio: f64) -> Measurement {
    let mut measurement = Measurement { runs: 1, ..Measurement::default() };
    let value = law(Scaled::RunOut, source, aspect_ratio).unwrap_or(f64::NAN);
    measurement.quantities.push(spread(vec![value], 0.0));
    measurement
}

fn spread(samples: Vec<f64>, floor: f64) -> Quantity {
    quantity(SPREAD, samples, 0.0, floor, ReferenceKind::Exact, "a column that does not spread")
}

/// The mean of all fillings, against the middle of the band that published laws span; its floor is the half width of its own 95 % interval.
fn in_band(name: &'static str, scaled: Scaled, samples: &[f64], aspect_ratio: f64) -> Quantity {
    let [least, most] = band(scaled, aspect_ratio);
    let (mean, half_width) = mean_and_half_width(samples);
    let floor = if half_width.is_finite() { half_width } else { 0.0 };
    quantity(name, vec![mean], 0.5 * (least + most), floor, ReferenceKind::Correlation, "middle of the band that published laws span")
}

/// All fillings of a setup.
fn collapses(column: &Column, fillings: u64, random_seed: u64) -> Result<Vec<Collapse>, Failure> {
    (0..fillings).map(|filling| column.collapse(fillings * random_seed + filling)).collect()
}

fn measure(setting: Setting, column: &Column, knob: f64, random_seed: u64) -> Result<Measurement, Failure> {
    let fillings = setting.fillings(column);
    let runs = collapses(column, fillings, random_seed)?;
    let mut measurement = Measurement { quantities: quantities(column, &runs), runs: fillings, ..Measurement::default() };
    measurement.curves = figures::curves(setting, column, knob, &runs);
    if let Some(partner) = setting.partner(column) {
        let others = collapses(&partner, fillings, random_seed)?;
        if setting == Setting::Size {
            let [large, small] = [figures::mean_profile(&runs, column), figures::mean_profile(&others, &partner)];
            let distance = figures::distance(&large, &small);
            let source = "profiles of all sizes are one";
            measurement.quantities.push(quantity(SELF_SIMILAR, vec![distance], 0.0, 1.0 / column.length, ReferenceKind::Exact, source));
            measurement.curves.push(figures::scaled_profiles(knob, &large, &small));
        } else {
            measurement.quantities.push(against_stiffer(&run_outs(column, &runs), &run_outs(&partner, &others)));
        }
        others.into_iter().for_each(|run| add_work(&mut measurement.work, run.work));
        measurement.runs += fillings;
    }
    runs.into_iter().for_each(|run| add_work(&mut measurement.work, run.work));
    Ok(measurement)
}

fn run_outs(column: &Column, runs: &[Collapse]) -> Vec<f64> {
    runs.iter().map(|run| run.run_out(column)).collect()
}

/// The floor is what both means are uncertain by.
fn against_stiffer(soft: &[f64], stiff: &[f64]) -> Quantity {
    let ((value, soft_width), (expected, stiff_width)) = (mean_and_half_width(soft), mean_and_half_width(stiff));
    let floor = soft_width.hypot(stiff_width);
    quantity(STIFFER, vec![value], expected, floor, ReferenceKind::OwnFine, "the same column of grains four times as stiff")
}

/// What is measured of every column.
fn quantities(column: &Column, runs: &[Collapse]) -> Vec<Quantity> {
    let of_each = |value: &dyn Fn(&Collapse) -> f64| runs.iter().map(value).collect::<Vec<f64>>();
    let run_outs = run_outs(column, runs);
    let heights = of_each(&|run| run.final_height(column));
    let aspect_ratio = mean_and_half_width(&of_each(&|run| run.aspect_ratio(column))).0;
    let (filling, unsettled) = (of_each(&|run| run.solid_fraction), of_each(&|run| run.unsettled));
    let (rest, volume) = (of_each(&|run| run.time_of_rest(column)), of_each(&|run| run.volume_of_profile(column)));
    let one_grain = 1.0 / f64::from(column.number_of_grains());
    let (packings, lube) = ("random packings of spheres, loose to close", "Lube et al. 2005, from a = 2 on");
    vec![
        spread(run_outs.clone(), 0.1 / column.length),
        in_band(RUN_OUT, Scaled::RunOut, &run_outs, aspect_ratio),
        in_band(HEIGHT, Scaled::FinalHeight, &heights, aspect_ratio),
        quantity(FILLING, filling, RANDOM_PACKING, RANDOM_PACKING_WIDTH, ReferenceKind::Experiment, packings),
        quantity(UNSETTLED, unsettled, 0.0, one_grain, ReferenceKind::Exact, "a column at rest"),
        quantity(REST, rest, LUBE_TIME, 0.1, ReferenceKind::Correlation, lube),
        quantity(LOST, volume, 1.0, f64::EPSILON, ReferenceKind::Exact, "no grain is lost"),
    ]
}

/// Solid fractions of random packings of spheres, walls included, lie about this, not farther than that: above the cubic lattice, below the densest.
const RANDOM_PACKING: f64 = 0.585;
const RANDOM_PACKING_WIDTH: f64 = 0.055;
/// When the front stops, over the root of height over gravity.
const LUBE_TIME: f64 = 3.3;

impl Case for DamBreak {
    fn evaluate(&self, setup: &Setup, knob: f64, random_seed: u64) -> Result<Measurement, Failure> {
        let setting = Setting::of(setup)?;
        match (setting.column(knob), setting.law()) {
            (Some(column), _) => measure(setting, &column, knob, random_seed),
            (None, Some(source)) => Ok(of_law(source, knob)),
            (None, None) => Err(Failure::NothingMeasured(setup.label.clone())),
        }
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        let mut claims = Setting::claims(tier, claims_at);
        claims.extend(exponents(tier));
        claims
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        let setting = Setting::of(setup).ok()?;
        // Other values may be none that a column can have.
        let column = setting.knobs(Tier::Paper).contains(&knob).then(|| setting.column(knob))??;
        Some(column.scene(column.latest_opening(), 0))
    }

    fn description(&self) -> Description {
        words::description()
    }
}

fn claims_at(setting: &Setting, knob: f64) -> Vec<Claim> {
    let Some(column) = setting.column(knob) else { return Vec::new() };
    let claim = |quantity, statistic, bound| setting.claim_at(knob, quantity, statistic, bound, Expected::Holds);
    let of_fillings = if setting.fillings(&column) == 1 { Statistic::Single } else { Statistic::Worst };
    let rounding = f64::EPSILON * f64::from(column.number_of_grains());
    let mut claims =
        vec![claim(LOST, of_fillings, Bound::new(1.0, rounding, "one rounding a grain")), unsettled(setting, knob, of_fillings)];
    if matches!(setting, Setting::Short | Setting::Long | Setting::LongOften | Setting::Sweep) {
        let half_width = |scaled| {
            let [least, most] = band(scaled, column.aspect_ratio);
            0.5 * (most - least)
        };
        claims.push(claim(RUN_OUT, Statistic::Single, Bound::new(1.0, half_width(Scaled::RunOut), "half the width of the band of laws")));
    }
    if matches!(setting, Setting::Long | Setting::LongOften) {
        claims.push(claim(FILLING, of_fillings, Bound::new(1.0, RANDOM_PACKING_WIDTH, "half the width of the band of random packings")));
    }
    claims
}

/// Grains that are softer than softened ones ring on for longer than a gate waits.
fn unsettled(setting: &Setting, knob: f64, of_fillings: Statistic) -> Claim {
    let bound = Bound::new(2.0, 0.01, "one grain in a hundred");
    let is_too_soft = *setting == Setting::Stiffness && knob < 1.0;
    let rings = "grains a quarter as stiff as the softened ones ring on: after eight times the root of height over gravity six in a hundred still move";
    setting.claim_at(knob, UNSETTLED, of_fillings, bound, if is_too_soft { Expected::KnownLimit(rings.into()) } else { Expected::Holds })
}

/// Lajeunesse et al. and Lube et al.: run-out grows with the two-thirds power of the aspect ratio of tall columns; Balmforth and Kerswell: up to the power 0.9.
fn exponents(tier: Tier) -> Vec<Claim> {
    let knobs = Setting::Sweep.knobs(tier);
    let Some(tallest) = knobs.last() else { return Vec::new() };
    vec![Claim {
        setup: Setting::Sweep.label(),
        quantity: SPREAD,
        statistic: Statistic::Median,
        // Run-out rises with the knob: its power is minus the order of an error.
        subject: Subject::OrderAbout { order: -0.78, range: [2.0, *tallest] },
        bound: Bound::new(1.0, 0.12, "half of what the exponents of the sources differ by, 2/3 to 0.9"),
        expected: Expected::Holds,
    }]
}
