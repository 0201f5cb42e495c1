//! Curves from a data file.

use maud::{Markup, html};

use super::axis::{Axis, Labels, Scale};
use super::canvas::DrawError;
use super::figure::{Drawn, Entry, Figure, legend};
use super::marker::Look;
use super::panel::{Format, NARROW, Panel, WIDE};
use crate::curve_file::{Curve, read_curves};
use crate::{CaseResults, number};

/// What the plot shows; fields of [`crate::card::Plot::Curves`].
pub(crate) struct Curves<'a> {
    pub(crate) title: &'a str,
    pub(crate) file: &'a str,
    pub(crate) labels: [&'a str; 2],
    pub(crate) columns: &'a [[String; 2]],
    pub(crate) logarithmic: [bool; 2],
    pub(crate) caption: &'a str,
}

/// Curves with at most this many points show each of them.
const MOST_MARKED_POINTS: usize = 40;

impl Curves<'_> {
    /// Draws the plot in both formats.
    pub(crate) fn draw(&self, case: &CaseResults) -> Result<Drawn, DrawError> {
        let Some(text) = case.file(self.file) else {
            return Ok(Err(format!("the file {} is missing.", self.file)));
        };
        let curves = match read_curves(text, self.columns) {
            Ok(curves) => curves,
            Err(reason) => return Ok(Err(format!("{}: {reason}.", self.file))),
        };
        let (Some(wide), Some(narrow)) = (self.format(&curves, WIDE)?, self.format(&curves, NARROW)?) else {
            return Ok(Err(format!("{} has no numbers these axes can show.", self.file)));
        };
        let entries: Vec<Entry> = self
            .columns
            .iter()
            .zip(&curves)
            .enumerate()
            .map(|(index, ([_, name], curve))| Entry {
                look: Look::own(index),
                joined: true,
                marked: curve.points <= MOST_MARKED_POINTS,
                name: name.clone(),
            })
            .collect();
        let longest = curves.iter().map(|curve| curve.points).max().unwrap_or(0);
        let drawn = |curve: &Curve| curve.stretches.iter().map(Vec::len).sum::<usize>();
        let mut notes = vec![html! { (self.caption) }];
        if curves.iter().any(|curve| drawn(curve) + 2 < curve.points / 2) {
            notes.push(html! {
                "Drawn from " (number::grouped(longest as u64))
                " points a curve, thinned to local extremes; the file has all of them."
            });
        }
        Ok(Ok(Figure { wide, narrow, legend: legend(&entries)?, notes, failures: Vec::new() }))
    }

    fn format(&self, curves: &[Curve], format: Format) -> Result<Option<Markup>, DrawError> {
        let axis = |direction: usize| {
            let logarithmic = self.logarithmic[direction];
            let values = curves.iter().flat_map(|curve| curve.stretches.iter().flatten()).map(|point| point[direction]);
            let (low, high) = values
                .filter(|value| !logarithmic || *value > 0.0)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
            let scale = if logarithmic { Scale::Logarithmic } else { Scale::Linear };
            Axis::new(scale, low, high, Labels::Plain, format.labels[direction])
        };
        let (Some(x), Some(y)) = (axis(0), axis(1)) else { return Ok(None) };
        let panel = Panel { x, y, x_label: self.labels[0].to_string(), y_label: self.labels[1].to_string() };
        let drawing = panel.draw(format, [self.title, &self.words(curves)], |frame| {
            for (index, curve) in curves.iter().enumerate() {
                let look = Look::own(index);
                for stretch in &curve.stretches {
                    let pixels: Vec<[f64; 2]> = stretch.iter().map(|[x, y]| frame.at(*x, *y)).collect();
                    frame.canvas.line(&pixels, look.ink, 2.0)?;
                    if curve.points <= MOST_MARKED_POINTS {
                        pixels.iter().try_for_each(|pixel| look.draw(frame.canvas, *pixel))?;
                    }
                }
            }
            Ok(())
        })?;
        Ok(Some(drawing))
    }

    fn words(&self, curves: &[Curve]) -> String {
        let sentences = self.columns.iter().zip(curves).filter_map(|([_, name], curve)| {
            let points = || curve.stretches.iter().flatten();
            let lowest = points().min_by(|a, b| a[1].total_cmp(&b[1]))?;
            let highest = points().max_by(|a, b| a[1].total_cmp(&b[1]))?;
            Some(format!(
                "{name}: from {} to {}, highest at {}.",
                number::terminal(lowest[1]),
                number::terminal(highest[1]),
                number::terminal(highest[0])
            ))
        });
        sentences.collect::<Vec<_>>().join(" ")
    }
}
