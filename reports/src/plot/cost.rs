//! Error against run time: error up, CPU seconds of one run to the right, the Pareto front thick.

use maud::{Markup, html};

use super::axis::{Axis, Labels, Scale};
use super::canvas::{DrawError, Ink};
use super::convergence::{error_label, floor_note};
use super::figure::{Drawn, Figure, front_entry, layer_entries, layers_legend, legend};
use super::layer::{Layers, draw_failures, draw_floor, draw_points, layers, range};
use super::panel::{Format, Frame, NARROW, Panel, THUMBNAIL, WIDE};
use crate::series::Point;
use crate::work_precision::pareto_front;
use crate::{CaseResults, number};

/// A thumbnail's legend is left to the large plot if it would be longer than this.
const MOST_LEGEND_LINES: usize = 5;

/// What the plot shows; fields of [`crate::card::Plot::ErrorAgainstCost`].
pub(crate) struct ErrorAgainstCost<'a> {
    pub(crate) title: &'a str,
    pub(crate) quantity: &'a str,
    pub(crate) setups: &'a [String],
    pub(crate) statistic: &'a String,
}

impl ErrorAgainstCost<'_> {
    /// Draws the plot in both formats.
    pub(crate) fn draw(&self, case: &CaseResults) -> Result<Drawn, DrawError> {
        let layers = self.layers(case);
        let (Some(wide), Some(narrow)) = (self.format(case, &layers, WIDE)?, self.format(case, &layers, NARROW)?) else {
            return Ok(Err(format!("no row of \"{}\" has both a measured cost and an error.", self.quantity)));
        };
        let lines = layers_legend(&layers, std::slice::from_ref(self.statistic))?;
        let legend = html! { (lines) (front_entry()?) };
        let mut notes = Vec::new();
        if let (Some(floor), Some(errors)) = (layers.floor(), layers.error_range()) {
            notes.push(floor_note(floor, errors));
        }
        Ok(Ok(Figure { wide, narrow, legend, notes, failures: layers.failures() }))
    }

    /// Draws the small picture for the head of the page with its legend, if there is anything to draw.
    pub(crate) fn thumbnail(&self, case: &CaseResults) -> Result<Option<[Markup; 2]>, DrawError> {
        let layers = self.layers(case);
        let Some(drawing) = self.format(case, &layers, THUMBNAIL)? else {
            return Ok(None);
        };
        let legend = if layers.all.len() <= MOST_LEGEND_LINES {
            legend(&layer_entries(&layers))?
        } else {
            html! {}
        };
        Ok(Some([drawing, legend]))
    }

    fn layers<'b>(&'b self, case: &'b CaseResults) -> Layers<'b> {
        layers(case, self.quantity, self.setups, std::slice::from_ref(self.statistic))
    }

    fn format(&self, case: &CaseResults, layers: &Layers, format: Format) -> Result<Option<Markup>, DrawError> {
        let costs =
            layers.points().filter_map(|point| cost(&point)).flat_map(|(cost, interval)| interval.into_iter().flatten().chain([cost]));
        let (Some(costs), Some(errors)) = (range(costs), layers.error_range()) else { return Ok(None) };
        let x = Axis::new(Scale::Logarithmic, costs[0], costs[1], Labels::Seconds, format.labels[0]);
        let y = Axis::new(Scale::Logarithmic, errors[0], errors[1], Labels::Powers, format.labels[1]);
        let (Some(x), Some(y)) = (x, y) else { return Ok(None) };
        let panel = Panel { x, y, x_label: "CPU time of one run".into(), y_label: error_label(case, self.quantity) };
        let words = layers.words(|point| cost(point).map(|(cost, _)| number::seconds(cost).replace('\u{a0}', " ")));
        let drawing = panel.draw(format, [self.title, &words], |frame| {
            draw_floor(frame, layers.floor())?;
            draw_front(frame, layers)?;
            draw_points(frame, layers, cost)?;
            draw_failures(frame, layers, crate::Row::cpu_s_per_run)
        })?;
        Ok(Some(drawing))
    }
}

fn cost(point: &Point) -> Option<(f64, Option<[f64; 2]>)> {
    let cost = point.row.cpu_s_per_run().filter(|cost| *cost > 0.0)?;
    Some((cost, point.row.cpu_s_per_run_range().filter(|interval| interval[0] > 0.0)))
}

/// The front as a staircase: what is left of and below it nobody reached; nothing is claimed between its points.
fn draw_front(frame: &Frame, layers: &Layers) -> Result<(), DrawError> {
    let own = layers.all.iter().filter(|layer| layer.joined).flat_map(|layer| &layer.series.points);
    let points: Vec<[f64; 2]> = own.filter_map(|point| Some([cost(point)?.0, point.error])).filter(|[_, error]| *error > 0.0).collect();
    let front = pareto_front(&points);
    let mut stairs: Vec<[f64; 2]> = Vec::new();
    for [cost, error] in front {
        let [x, y] = frame.at(cost, error);
        if let Some([_, above]) = stairs.last().copied() {
            stairs.push([x, above]);
        }
        stairs.push([x, y]);
    }
    if stairs.len() > 1 { frame.canvas.line(&stairs, Ink::Front, 6.0) } else { Ok(()) }
}
