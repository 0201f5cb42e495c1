//! Curves of the page: the front over time, the heap at several times, profiles of two sizes.

use super::collapse::{Collapse, Look, stretch};
use super::setting::{Column, DIAMETER};
use super::variants::Setting;
use crate::case::Curve;

/// Times, over the root of height over gravity, at which profiles are kept; the last is the end.
pub(super) const TIMES: [f64; 5] = [0.0, 0.5, 1.0, 1.5, 2.0];
/// Columns of the file of profiles.
pub(super) const PROFILE_COLUMNS: [&str; 7] = ["x", "at_the_opening", "after_0.5", "after_1", "after_1.5", "after_2", "at_rest"];
/// Columns of the file of fronts.
pub(super) const FRONT_COLUMNS: [&str; 5] = ["time", "mean", "least", "most", "height_at_the_wall"];

/// Name of a file of a setup at a value of its knob.
pub(super) fn file(kind: &str, setting: Setting, knob: f64) -> String {
    format!("{kind}_{}_{knob:.3}.csv", format!("{setting:?}").to_lowercase())
}

/// Front, profiles and final grains of a setup.
pub(super) fn curves(setting: Setting, column: &Column, knob: f64, runs: &[Collapse]) -> Vec<Curve> {
    let mut curves = vec![Curve { file: file("front", setting, knob), columns: FRONT_COLUMNS.to_vec(), rows: fronts(column, runs) }];
    if let Some(first) = runs.first() {
        curves.push(Curve { file: file("profiles", setting, knob), columns: PROFILE_COLUMNS.to_vec(), rows: profiles(column, first) });
    }
    curves
}

/// A look at a run, or its last one where it has ended before.
fn look_at(run: &Collapse, place: usize) -> &Look {
    &run.looks[place.min(run.looks.len() - 1)]
}

/// Front over time: run-out over length, mean and range over the fillings, with the height at the back wall.
fn fronts(column: &Column, runs: &[Collapse]) -> Vec<Vec<f64>> {
    let length = column.length * DIAMETER;
    let longest = runs.iter().max_by_key(|run| run.looks.len());
    let times = longest.map_or(&[][..], |run| &run.looks);
    let row = |(place, at): (usize, &Look)| {
        let reaches: Vec<f64> = runs.iter().map(|run| look_at(run, place).reach / length - 1.0).collect();
        let mean = reaches.iter().sum::<f64>() / reaches.len() as f64;
        let (least, most) =
            reaches.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), reach| (least.min(*reach), most.max(*reach)));
        let height = runs.iter().map(|run| look_at(run, place).profile[0]).sum::<f64>() / (runs.len() as f64 * length);
        vec![at.time / column.time_scale(), mean, least, most, height]
    };
    times.iter().enumerate().map(row).collect()
}

/// Heights over length at several times, by place over length.
fn profiles(column: &Column, run: &Collapse) -> Vec<Vec<f64>> {
    let length = column.length * DIAMETER;
    let at = |time: f64| {
        run.looks.iter().min_by(|one, other| {
            let off = |look: &Look| (look.time / column.time_scale() - time).abs();
            off(one).total_cmp(&off(other))
        })
    };
    let looks: Vec<&Look> = TIMES.into_iter().filter_map(at).chain(run.looks.last()).collect();
    // Single grains roll far beyond the heap.
    let places = run.looks.last().map_or(0, |last| (last.reach / stretch(column)).ceil() as usize + 2);
    let row = |place: usize| {
        let heights = looks.iter().map(|look| look.profile.get(place).copied().unwrap_or(0.0) / length);
        std::iter::once((place as f64 + 0.5) * stretch(column) / length).chain(heights).collect()
    };
    (0..places).map(row).collect()
}

/// Mean profile of all fillings at the end, over the length of the column.
pub(super) fn mean_profile(runs: &[Collapse], column: &Column) -> Vec<f64> {
    let ends: Vec<&Vec<f64>> = runs.iter().filter_map(|run| run.looks.last()).map(|look| &look.profile).collect();
    let places = ends.iter().map(|profile| profile.len()).max().unwrap_or(0);
    let scale = ends.len() as f64 * column.length * DIAMETER;
    (0..places).map(|place| ends.iter().filter_map(|profile| profile.get(place)).sum::<f64>() / scale).collect()
}

/// Root of the mean square difference of two scaled profiles over the longer one, over the greatest height.
pub(super) fn distance(one: &[f64], other: &[f64]) -> f64 {
    let places = one.len().max(other.len());
    let at = |profile: &[f64], place: usize| profile.get(place).copied().unwrap_or(0.0);
    let squares: f64 = (0..places).map(|place| (at(one, place) - at(other, place)).powi(2)).sum();
    let highest = one.iter().chain(other).copied().fold(0.0, f64::max);
    (squares / places as f64).sqrt() / highest
}

/// Scaled profiles of a column and of one half its size.
pub(super) fn scaled_profiles(knob: f64, large: &[f64], small: &[f64]) -> Curve {
    let at = |profile: &[f64], place: usize| profile.get(place).copied().unwrap_or(0.0);
    let row = |place: usize| vec![0.25 * (place as f64 + 0.5), at(large, place), at(small, place)];
    let rows = (0..large.len().max(small.len())).map(row).collect();
    Curve { file: file("scaled", Setting::Size, knob), columns: vec!["x", "whole", "half"], rows }
}
