//! Ratios as bars that begin at one, each with its interval and its name above it.

use maud::html;

use super::axis::{Axis, Labels, Scale};
use super::canvas::{Anchor, DrawError, Ink};
use super::figure::{Drawn, Figure};
use super::panel::{Format, Frame, NARROW, Panel, WIDE};
use crate::bar_file::{Bar, read_bars};
use crate::{CaseResults, number};

/// What the plot shows; fields of [`crate::card::Plot::Bars`].
pub(crate) struct Bars<'a> {
    pub(crate) title: &'a str,
    pub(crate) file: &'a str,
    pub(crate) x_label: &'a str,
    pub(crate) caption: &'a str,
}

/// Height of one bar with its name, over the height of the text.
const ROW: f64 = 2.7;
/// Thickness of a bar, over the height of the text.
const THICKNESS: f64 = 0.8;
/// Height of axis and labels, over the height of the text.
const MARGINS: f64 = 6.0;

impl Bars<'_> {
    /// Draws the plot in both formats.
    pub(crate) fn draw(&self, case: &CaseResults) -> Result<Drawn, DrawError> {
        let Some(text) = case.file(self.file) else {
            return Ok(Err(format!("the file {} is missing.", self.file)));
        };
        let bars = match read_bars(text) {
            Ok(file) => file.bars,
            Err(reason) => return Ok(Err(format!("{}: {reason}.", self.file))),
        };
        let ends = || bars.iter().flat_map(|bar| [bar.ratio, bar.interval[0], bar.interval[1]]).chain([1.0]);
        let (low, high) = (ends().fold(f64::INFINITY, f64::min), ends().fold(0.0, f64::max));
        let draw = |format: Format| {
            let Some(x) = Axis::new(Scale::Logarithmic, low, high, Labels::Plain, format.labels[0]) else { return Ok(html! {}) };
            self.format(&bars, x, format)
        };
        Ok(Ok(Figure {
            wide: draw(WIDE)?,
            narrow: draw(NARROW)?,
            legend: html! {},
            notes: vec![html! { (self.caption) }],
            failures: Vec::new(),
        }))
    }

    fn format(&self, bars: &[Bar], x: Axis, format: Format) -> Result<maud::Markup, DrawError> {
        let format = Format { height: format.font * (MARGINS + ROW * bars.len() as f64), ..format };
        let panel = Panel { x, y: Axis::without_ticks(0.0, bars.len() as f64), x_label: self.x_label.to_string(), y_label: String::new() };
        let words = bars.iter().map(|bar| format!("{}: {}.", bar.name, number::terminal(bar.ratio))).collect::<Vec<_>>().join(" ");
        panel.draw(format, [self.title, &words], |frame| {
            bars.iter().enumerate().try_for_each(|(index, bar)| draw_bar(frame, (bars.len() - index) as f64 - 0.7, bar))
        })
    }
}

fn draw_bar(frame: &Frame, middle: f64, bar: &Bar) -> Result<(), DrawError> {
    let (canvas, font) = (frame.canvas, frame.format.font);
    let half = 0.5 * THICKNESS * font;
    let ([from, y], [to, _]) = (frame.at(1.0, middle), frame.at(bar.ratio, middle));
    canvas.text(&bar.name, [frame.left + 4.0, y - half - 0.55 * font], Anchor::MiddleLeft, font, Ink::Text)?;
    canvas.rectangle([from.min(to), y - half], [from.max(to).max(from.min(to) + 1.0), y + half], Ink::Series(0))?;
    let [low, high] = bar.interval.map(|end| frame.at(end, middle)[0]);
    canvas.line(&[[low, y], [high, y]], Ink::Text, 1.4)?;
    [low, high].into_iter().try_for_each(|end| canvas.line(&[[end, y - 0.6 * half], [end, y + 0.6 * half]], Ink::Text, 1.4))
}
