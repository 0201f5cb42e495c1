//! The convergence plot: error against the knob, with slope triangles.

use maud::{Markup, html};

use super::axis::{Axis, Labels, Scale};
use super::canvas::{Anchor, DrawError, Ink};
use super::figure::{Drawn, Figure, layers_legend};
use super::layer::{Layers, draw_failures, draw_floor, draw_points, layers, range};
use super::panel::{Format, Frame, NARROW, Panel, WIDE};
use crate::{CaseResults, number, words};

/// What a convergence plot shows; the fields of [`crate::card::Plot::Convergence`].
pub(crate) struct Convergence<'a> {
    pub(crate) title: &'a str,
    pub(crate) quantity: &'a str,
    pub(crate) setups: &'a [String],
    pub(crate) statistics: &'a [String],
    pub(crate) orders: &'a [f64],
    pub(crate) knob_is_resolution: bool,
    pub(crate) knob_label: &'a str,
}

/// Fewest points of a series for which a slope is worth showing.
const FEWEST_POINTS_FOR_SLOPE: usize = 4;

impl Convergence<'_> {
    /// Draws the plot in both formats.
    pub(crate) fn draw(&self, case: &CaseResults) -> Result<Drawn, DrawError> {
        let layers = layers(case, self.quantity, self.setups, self.statistics);
        let knobs = layers.all.iter().flat_map(|layer| {
            let failed = layer.series.failed.iter().filter_map(|(_, row)| row.knob.as_ref().map(|knob| knob.value));
            layer.series.points.iter().map(|point| point.knob).chain(failed)
        });
        let (Some(knobs), Some(errors)) = (range(knobs), layers.error_range()) else {
            return Ok(Err(format!("no row of \"{}\" has both a knob value and an error above zero.", self.quantity)));
        };
        let (Some(wide), Some(narrow)) =
            (self.format(case, &layers, knobs, errors, WIDE)?, self.format(case, &layers, knobs, errors, NARROW)?)
        else {
            return Ok(Err("the numbers do not span an axis.".into()));
        };
        let legend = layers_legend(&layers, self.statistics)?;
        let mut notes = Vec::new();
        if let Some(floor) = layers.floor() {
            notes.push(floor_note(floor, errors));
        }
        Ok(Ok(Figure { wide, narrow, legend, notes, failures: layers.failures() }))
    }

    fn format(
        &self,
        case: &CaseResults,
        layers: &Layers,
        knobs: [f64; 2],
        errors: [f64; 2],
        format: Format,
    ) -> Result<Option<Markup>, DrawError> {
        let x = Axis::new(Scale::Logarithmic, knobs[0], knobs[1], Labels::Plain, format.labels[0]);
        let y = Axis::new(Scale::Logarithmic, errors[0], errors[1], Labels::Powers, format.labels[1]);
        let (Some(x), Some(y)) = (x, y) else { return Ok(None) };
        let y_label = error_label(case, self.quantity);
        let panel = Panel { x, y, x_label: self.knob_label.to_string(), y_label };
        let words = layers.words(|point| Some(number::knob(point.knob)));
        let drawing = panel.draw(format, [self.title, &words], |frame| {
            draw_floor(frame, layers.floor())?;
            self.slopes(frame, layers)?;
            draw_points(frame, layers, |point| (point.knob > 0.0).then_some((point.knob, None)))?;
            draw_failures(frame, layers, |row| row.knob.as_ref().map(|knob| knob.value))
        })?;
        Ok(Some(drawing))
    }

    /// Triangles whose slopes are the stated orders, in the emptier of the two corners they fit into.
    fn slopes(&self, frame: &Frame, layers: &Layers) -> Result<(), DrawError> {
        let orders: Vec<f64> = self.orders.iter().copied().filter(|order| order.is_finite() && *order > 0.0).collect();
        let longest = layers.all.iter().map(|layer| layer.series.points.len()).max().unwrap_or(0);
        let Some(steepest) = orders.iter().copied().max_by(f64::total_cmp) else { return Ok(()) };
        if longest < FEWEST_POINTS_FOR_SLOPE {
            return Ok(());
        }
        let (decades_x, decades_y) = (frame.panel.x.span(), frame.panel.y.span());
        let run = (0.28 * decades_x).min(0.42 * decades_y / steepest);
        let (width, height) = (run / decades_x, run / decades_y);
        let at_bottom = Corner { falling: self.knob_is_resolution, top: false };
        let at_top = Corner { falling: self.knob_is_resolution, top: true };
        let crowd = |corner: &Corner| {
            let inside = |point: &crate::series::Point| {
                corner.covers([frame.panel.x.place(point.knob), frame.panel.y.place(point.error)], [width, height * steepest])
            };
            layers.points().filter(inside).count()
        };
        let corner = if crowd(&at_top) < crowd(&at_bottom) { at_top } else { at_bottom };
        orders.iter().try_for_each(|order| corner.draw(frame, *order, [width, height * order], height * steepest))
    }
}

/// One of the two corners that a bundle of falling (or rising) lines leaves free.
struct Corner {
    falling: bool,
    top: bool,
}

impl Corner {
    /// Distance of the triangle from the frame, as a fraction.
    const INSET: f64 = 0.035;
    /// Room for the frame's distance and the label beyond the triangle, as a fraction.
    const LABEL: f64 = 0.22;

    /// Whether the corner is on the left: below falling lines and above rising ones.
    fn is_left(&self) -> bool {
        self.falling != self.top
    }

    /// The point all triangles share, next to the frame, and the directions away from the frame and along it.
    fn tip(&self, height: f64) -> ([f64; 2], f64, f64) {
        let (away, slope) = (if self.is_left() { 1.0 } else { -1.0 }, if self.top { 1.0 } else { -1.0 });
        let x = if self.is_left() { Self::INSET } else { 1.0 - Self::INSET };
        let level = if self.top { 1.0 - 2.0 * Self::INSET } else { Self::INSET };
        ([x, level - slope * height], away, slope)
    }

    fn covers(&self, [x, y]: [f64; 2], [width, height]: [f64; 2]) -> bool {
        let room = [width + Self::LABEL, height + 4.0 * Self::INSET];
        let along = if self.is_left() { x } else { 1.0 - x };
        let across = if self.top { 1.0 - y } else { y };
        along < room[0] && across < room[1]
    }

    /// One triangle; `height` is that of the steepest, so that all start from one tip.
    fn draw(&self, frame: &Frame, order: f64, [width, rise]: [f64; 2], height: f64) -> Result<(), DrawError> {
        let (tip, away, slope) = self.tip(height);
        let foot = [tip[0] + away * width, tip[1]];
        let end = [foot[0], foot[1] + slope * rise];
        let corners = [tip, foot, end, tip].map(|[x, y]| frame.place(x, y));
        frame.canvas.line(&corners, Ink::Muted, 1.2)?;
        let [x, y] = corners[2];
        let anchor = if self.is_left() { Anchor::MiddleLeft } else { Anchor::MiddleRight };
        let text = format!("order {}", number::knob(order));
        frame.canvas.text(&text, [x + 5.0 * away, y], anchor, frame.format.font * 0.92, Ink::Muted)
    }
}

/// Title of an error axis.
pub(crate) fn error_label(case: &CaseResults, quantity: &str) -> String {
    let row = case.rows.iter().find(|row| row.quantity == quantity && row.error.is_some());
    let words = words::error_of(quantity);
    match row {
        Some(row) if row.error_kind == crate::row::ErrorKind::Absolute && row.unit != "1" => {
            format!("{words}, {}", words::with_powers(&row.unit))
        }
        Some(row) if row.error_kind == crate::row::ErrorKind::Absolute => words,
        _ => format!("relative {words}"),
    }
}

/// Where the floor is, if it is not in the picture.
pub(crate) fn floor_note(floor: f64, [low, _]: [f64; 2]) -> Markup {
    let size = number::short(floor);
    html! {
        @if floor >= low {
            "Grey band: below " (size) " the reference and round-off hide the error; points inside it say nothing."
        } @else {
            "Reference and round-off allow errors down to " (size) ", below what is drawn."
        }
    }
}
