//! [`Layer`]: one series as a plot shows it, and the parts both error plots share: ranges, whiskers, floor, failures.

use super::canvas::{DrawError, Ink};
use super::marker::{Look, failure_cross};
use super::panel::Frame;
use crate::series::{Point, Series, distinguish, foreign_series, own_series};
use crate::{CaseResults, Row, number};

/// One series with its look.
pub(crate) struct Layer<'a> {
    pub(crate) series: Series<'a>,
    pub(crate) look: Look,
    /// Whether a line joins its points; worst cases and other codes follow no trend that a line could claim.
    pub(crate) joined: bool,
    pub(crate) name: String,
}

/// The layers of an error plot, and what all its own setups share.
pub(crate) struct Layers<'a> {
    pub(crate) all: Vec<Layer<'a>>,
    pub(crate) shared: String,
}

/// Collects the series of a quantity: the first statistic joined, the others as hollow markers, then other codes.
pub(crate) fn layers<'a>(case: &'a CaseResults, quantity: &str, setups: &'a [String], statistics: &[String]) -> Layers<'a> {
    let (names, shared) = distinguish(&setups.iter().map(String::as_str).collect::<Vec<_>>());
    let mut all = Vec::new();
    for (order, statistic) in statistics.iter().enumerate() {
        for series in own_series(case, quantity, setups, statistic) {
            let look = Look::own(series.index);
            let name = names.get(series.index).cloned().unwrap_or_default();
            all.push(match order {
                0 => Layer { look, joined: true, name, series },
                _ => Layer { look: look.hollow(), joined: false, name: format!("{name} ({statistic})"), series },
            });
        }
    }
    let foreign = foreign_series(case, quantity, setups);
    let at_one_setup = foreign.windows(2).all(|pair| pair[0].setup == pair[1].setup);
    for series in foreign {
        let look = Look::foreign(series.index);
        let code = series.code.unwrap_or("other code");
        let name =
            if at_one_setup && setups.len() > 1 { code.to_string() } else { format!("{code}: {}", without_shared(series.setup, &shared)) };
        all.push(Layer { look, joined: false, name, series });
    }
    Layers { all, shared }
}

/// What is left of a setup when the parts all setups of the plot share are named once.
fn without_shared(setup: &str, shared: &str) -> String {
    let shared: Vec<&str> = shared.split(", ").collect();
    let rest: Vec<&str> = setup.split(", ").filter(|part| !shared.contains(part)).collect();
    if rest.is_empty() { setup.to_string() } else { rest.join(", ") }
}

impl Layers<'_> {
    /// Smallest and largest error drawn; the floor is included if it is not far below all points.
    pub(crate) fn error_range(&self) -> Option<[f64; 2]> {
        let whiskers = self.points().filter_map(|point| point.row.ci95).flatten();
        let errors: Vec<f64> = self.points().map(|point| point.error).filter(|error| *error > 0.0).collect();
        let [low, high] = range(errors.iter().copied())?;
        let whisker_range = range(whiskers.filter(|end| *end > low / 3.0)).unwrap_or([low, high]);
        let [low, high] = [low.min(whisker_range[0]), high.max(whisker_range[1])];
        match self.floor() {
            Some(floor) if floor > low / 30.0 => Some([low.min(floor / 2.0), high.max(floor)]),
            _ => Some([low, high]),
        }
    }

    /// The largest floor of all rows drawn.
    pub(crate) fn floor(&self) -> Option<f64> {
        self.all.iter().filter_map(|layer| layer.series.floor()).filter(|f| *f > 0.0).max_by(f64::total_cmp)
    }

    /// All points of all layers.
    pub(crate) fn points(&self) -> impl Iterator<Item = Point<'_>> {
        self.all.iter().flat_map(|layer| layer.series.points.iter().copied())
    }

    /// Failed runs in words, with their lines.
    pub(crate) fn failures(&self) -> Vec<(usize, String)> {
        let mut failures: Vec<(usize, String)> = self
            .all
            .iter()
            .flat_map(|layer| layer.series.failed.iter().map(|(line, row)| (*line, failure_words(&layer.name, row))))
            .collect();
        failures.sort_unstable();
        failures
    }

    /// The numbers behind the drawing, for those who cannot see it.
    pub(crate) fn words(&self, x: impl Fn(&Point) -> Option<String>) -> String {
        let sentences = self.all.iter().filter_map(|layer| {
            let numbers: Vec<String> = layer
                .series
                .points
                .iter()
                .filter_map(|point| Some(format!("{} at {}", number::terminal(point.error), x(point)?)))
                .collect();
            (!numbers.is_empty()).then(|| format!("{}: {}.", layer.name, numbers.join(", ")))
        });
        sentences.collect::<Vec<_>>().join(" ")
    }
}

fn failure_words(name: &str, row: &Row) -> String {
    let knob = row.knob.as_ref().map(|knob| format!(", {} = {}", knob.name.replace('_', " "), number::knob(knob.value)));
    let reason = row.failed.as_deref().unwrap_or("the row has no error");
    format!("{name}{}: {reason}", knob.unwrap_or_default())
}

/// Smallest and largest of finite positive numbers.
pub(crate) fn range(numbers: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    numbers.filter(|number| number.is_finite() && *number > 0.0).fold(None, |range, number| match range {
        None => Some([number, number]),
        Some([low, high]) => Some([number.min(low), number.max(high)]),
    })
}

/// The grey band below the floor: points inside it say nothing about the method.
pub(crate) fn draw_floor(frame: &Frame, floor: Option<f64>) -> Result<(), DrawError> {
    match floor {
        Some(floor) if frame.panel.y.place(floor) > 0.0 => {
            let top = frame.place(0.0, frame.panel.y.place(floor));
            frame.canvas.rectangle(top, frame.place(1.0, 0.0), Ink::Band)
        }
        _ => Ok(()),
    }
}

/// Lines, whiskers and markers of all layers; `x` says where a point stands and how wide its interval is.
pub(crate) fn draw_points(frame: &Frame, layers: &Layers, x: impl Fn(&Point) -> Option<(f64, Option<[f64; 2]>)>) -> Result<(), DrawError> {
    for layer in layers.all.iter().filter(|layer| layer.joined) {
        let line: Vec<[f64; 2]> = layer.series.points.iter().filter_map(|point| Some(frame.at(x(point)?.0, point.error))).collect();
        if line.len() > 1 {
            frame.canvas.line(&line, layer.look.ink, 1.6)?;
        }
    }
    // Hollow markers first, so that the statistic a line joins stays on top.
    for layer in layers.all.iter().rev() {
        for point in &layer.series.points {
            let Some((place, interval)) = x(point) else { continue };
            if let Some([low, high]) = interval {
                whisker(frame, frame.at(low, point.error), frame.at(high, point.error), layer.look.ink)?;
            }
            if let Some([low, high]) = point.row.ci95 {
                whisker(frame, frame.at(place, low), frame.at(place, high), layer.look.ink)?;
            }
            layer.look.draw(frame.canvas, frame.at(place, point.error))?;
        }
    }
    Ok(())
}

/// An interval with caps across its ends.
fn whisker(frame: &Frame, a: [f64; 2], b: [f64; 2], ink: Ink) -> Result<(), DrawError> {
    // An interval shorter than its marker would only thicken it.
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    if length < 10.0 {
        return Ok(());
    }
    let cap = [(a[1] - b[1]) / length * 3.0, (b[0] - a[0]) / length * 3.0];
    frame.canvas.line(&[a, b], ink, 1.0)?;
    [a, b]
        .into_iter()
        .try_for_each(|end| frame.canvas.line(&[[end[0] - cap[0], end[1] - cap[1]], [end[0] + cap[0], end[1] + cap[1]]], ink, 1.0))
}

/// Crosses of failed runs on the top edge; a run whose place is unknown stands at the left end.
pub(crate) fn draw_failures(frame: &Frame, layers: &Layers, x: impl Fn(&Row) -> Option<f64>) -> Result<(), DrawError> {
    let mut unplaced = 0;
    for (_, row) in layers.all.iter().flat_map(|layer| &layer.series.failed) {
        let place = match x(row) {
            Some(value) => frame.at(value, f64::INFINITY),
            None => {
                unplaced += 1;
                let [left, top] = frame.place(0.0, 1.0);
                [left + 13.0 * f64::from(unplaced), top]
            }
        };
        failure_cross(frame.canvas, place)?;
    }
    Ok(())
}
