//! [`Panel`]: two axes with grid, ticks and labels, and a frame that maps values to pixels.

use maud::Markup;

use super::axis::Axis;
use super::canvas::{self, Anchor, Canvas, Caption, DrawError, Ink, Pixel};

/// A drawing's size and how large its text is. Pages hold two and show the one that fits the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Format {
    pub(crate) class: &'static str,
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) font: f64,
    /// Labels an axis has room for, across and up.
    pub(crate) labels: [usize; 2],
}

/// For screens with room.
pub(crate) const WIDE: Format = Format { class: "plot wide", width: 760.0, height: 430.0, font: 14.0, labels: [9, 7] };
/// For a phone: drawn at its real size, so that text stays readable.
pub(crate) const NARROW: Format = Format { class: "plot narrow", width: 350.0, height: 330.0, font: 12.5, labels: [4, 6] };
/// For the head of a page.
pub(crate) const THUMBNAIL: Format = Format { class: "plot thumbnail", width: 400.0, height: 262.0, font: 12.5, labels: [5, 5] };

/// The axes of a plot with their titles.
pub(crate) struct Panel {
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) x_label: String,
    pub(crate) y_label: String,
}

/// The inside of a drawn panel.
pub(crate) struct Frame<'a, 'b> {
    pub(crate) canvas: &'a Canvas<'b>,
    pub(crate) panel: &'a Panel,
    pub(crate) format: Format,
    /// Corners of the plotted area in pixels: left, right, top, bottom.
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) top: f64,
    pub(crate) bottom: f64,
}

impl Panel {
    /// Draws grid, content and labels.
    pub(crate) fn draw(
        &self,
        format: Format,
        [title, description]: [&str; 2],
        content: impl FnOnce(&Frame) -> Result<(), DrawError>,
    ) -> Result<Markup, DrawError> {
        let caption = Caption { class: format.class, title, description };
        canvas::draw([format.width, format.height], &caption, |canvas| {
            let frame = Frame {
                canvas,
                panel: self,
                format,
                left: self.left_margin(format),
                right: format.width - 14.0,
                top: format.font * 2.4,
                bottom: format.height - format.font * 3.6,
            };
            frame.grid()?;
            content(&frame)?;
            frame.labels()
        })
    }

    /// Room for the longest tick label of the ordinate; a character is about half as wide as it is high.
    fn left_margin(&self, format: Format) -> f64 {
        let longest = self
            .y
            .ticks
            .iter()
            .filter_map(|tick| tick.label.as_ref())
            .map(|label| label.chars().filter(|character| !"^{}".contains(*character)).count())
            .max()
            .unwrap_or(0);
        12.0 + longest as f64 * format.font * 0.58
    }
}

impl Frame<'_, '_> {
    /// Pixel of a pair of values.
    pub(crate) fn at(&self, x: f64, y: f64) -> Pixel {
        self.place(self.panel.x.place(x), self.panel.y.place(y))
    }

    /// Pixel of two fractions of the axes.
    pub(crate) fn place(&self, x: f64, y: f64) -> Pixel {
        [self.left + x * (self.right - self.left), self.bottom - y * (self.bottom - self.top)]
    }

    fn grid(&self) -> Result<(), DrawError> {
        for tick in &self.panel.x.ticks {
            let [x, _] = self.place(self.panel.x.place(tick.at), 0.0);
            match tick.label {
                Some(_) => self.canvas.line(&[[x, self.top], [x, self.bottom + 5.0]], Ink::Grid, 1.0)?,
                None => self.canvas.line(&[[x, self.bottom], [x, self.bottom + 3.0]], Ink::Muted, 0.8)?,
            }
        }
        for tick in &self.panel.y.ticks {
            let [_, y] = self.place(0.0, self.panel.y.place(tick.at));
            match tick.label {
                Some(_) => self.canvas.line(&[[self.left - 5.0, y], [self.right, y]], Ink::Grid, 1.0)?,
                None => self.canvas.line(&[[self.left - 3.0, y], [self.left, y]], Ink::Muted, 0.8)?,
            }
        }
        Ok(())
    }

    fn labels(&self) -> Result<(), DrawError> {
        let font = self.format.font;
        let corners = [[self.left, self.top], [self.left, self.bottom], [self.right, self.bottom]];
        self.canvas.line(&corners, Ink::Muted, 1.2)?;
        let mut free_from = 0.0;
        for tick in &self.panel.x.ticks {
            let Some(label) = &tick.label else { continue };
            let [x, _] = self.place(self.panel.x.place(tick.at), 0.0);
            let half = 0.29 * font * label.chars().count() as f64;
            // A label that would touch its neighbour or leave the drawing is left out; its grid line stays.
            if x - half >= free_from && x + half <= self.format.width {
                self.canvas.text(label, [x, self.bottom + 8.0], Anchor::MiddleTop, font, Ink::Muted)?;
                free_from = x + half + 0.6 * font;
            }
        }
        for tick in &self.panel.y.ticks {
            let Some(label) = &tick.label else { continue };
            let [_, y] = self.place(0.0, self.panel.y.place(tick.at));
            self.canvas.text(label, [self.left - 8.0, y], Anchor::MiddleRight, font, Ink::Muted)?;
        }
        let y_label = with_multiplier(&self.panel.y_label, &self.panel.y);
        let x_label = with_multiplier(&self.panel.x_label, &self.panel.x);
        self.canvas.text(&y_label, [4.0, 4.0], Anchor::LeftTop, font, Ink::Text)?;
        self.canvas.text(&x_label, [self.right, self.format.height - 4.0], Anchor::RightBottom, font, Ink::Text)
    }
}

fn with_multiplier(label: &str, axis: &Axis) -> String {
    match axis.multiplier {
        Some(power) => format!("{label}, × 10^{{{}}}", crate::number::superscript(power)),
        None => label.to_string(),
    }
}
