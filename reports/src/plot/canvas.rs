//! [`Canvas`]: plotters' SVG backend with this project's inks; its text becomes SVG that the page's style sheet colours.

use maud::{Markup, PreEscaped, html};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Plotters places everything on whole pixels, so each pixel of a page is ten of its pixels: lines land where they should.
const SUBPIXELS: f64 = 10.0;

/// Plotters writes font sizes divided by this factor.
const PLOTTERS_FONT_FACTOR: f64 = 1.24;

/// A colour by its part in a plot; the page decides what it looks like in light, dark and print.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ink {
    /// One of [`SERIES_INKS`] colours, taken round.
    Series(usize),
    Text,
    Muted,
    Grid,
    Band,
    Front,
    Surface,
    Bad,
}

/// Colours that tell series apart.
pub(crate) const SERIES_INKS: usize = 8;

const ROLES: [(Ink, &str); 7] = [
    (Ink::Text, "var(--text)"),
    (Ink::Muted, "var(--muted)"),
    (Ink::Grid, "var(--grid)"),
    (Ink::Band, "var(--band)"),
    (Ink::Front, "var(--front)"),
    (Ink::Surface, "var(--surface)"),
    (Ink::Bad, "var(--bad)"),
];

impl Ink {
    /// A colour no drawing uses otherwise, by which the ink is found again in the finished SVG.
    fn stand_in(self) -> RGBColor {
        match self {
            Ink::Series(index) => RGBColor((index % SERIES_INKS) as u8, 0xC0, 0xDE),
            role => RGBColor(ROLES.iter().position(|(other, _)| *other == role).unwrap_or(0) as u8, 0xC1, 0xDE),
        }
    }

    fn style_names() -> impl Iterator<Item = (Ink, String)> {
        let series = (0..SERIES_INKS).map(|index| (Ink::Series(index), format!("var(--series-{index})")));
        series.chain(ROLES.iter().map(|(ink, name)| (*ink, (*name).to_string())))
    }
}

/// What plotters could not draw. Writing into memory does not fail, so this is not expected to happen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct DrawError(pub(crate) String);

impl<E: std::error::Error + Send + Sync> From<DrawingAreaErrorKind<E>> for DrawError {
    fn from(error: DrawingAreaErrorKind<E>) -> Self {
        DrawError(error.to_string())
    }
}

/// A point in pixels from the upper left corner.
pub(crate) type Pixel = [f64; 2];

/// Something to draw on.
pub(crate) struct Canvas<'a> {
    area: DrawingArea<SVGBackend<'a>, Shift>,
}

/// What a screen reader says, and the class by which the style sheet knows the drawing.
pub(crate) struct Caption<'a> {
    pub(crate) class: &'a str,
    pub(crate) title: &'a str,
    pub(crate) description: &'a str,
}

/// Draws a picture of `width` x `height` pixels and returns it as inline SVG.
pub(crate) fn draw(
    [width, height]: [f64; 2],
    caption: &Caption,
    content: impl FnOnce(&Canvas) -> Result<(), DrawError>,
) -> Result<Markup, DrawError> {
    let size = ((width * SUBPIXELS) as u32, (height * SUBPIXELS) as u32);
    let mut svg = String::new();
    {
        let canvas = Canvas { area: SVGBackend::with_string(&mut svg, size).into_drawing_area() };
        content(&canvas)?;
        canvas.area.present()?;
    }
    Ok(html! {
        svg class=(caption.class) viewBox=(format!("0 0 {} {}", size.0, size.1)) role="img" {
            title { (caption.title) }
            desc { (caption.description) }
            (PreEscaped(page_svg(&svg)))
        }
    })
}

impl Canvas<'_> {
    /// A line through points.
    pub(crate) fn line(&self, points: &[Pixel], ink: Ink, width: f64) -> Result<(), DrawError> {
        let points: Vec<(i32, i32)> = points.iter().map(|point| subpixel(*point)).collect();
        Ok(self.area.draw(&PathElement::new(points, ink.stand_in().stroke_width(stroke(width))))?)
    }

    /// A filled polygon.
    pub(crate) fn polygon(&self, corners: &[Pixel], ink: Ink) -> Result<(), DrawError> {
        let corners: Vec<(i32, i32)> = corners.iter().map(|point| subpixel(*point)).collect();
        Ok(self.area.draw(&Polygon::new(corners, ink.stand_in().filled()))?)
    }

    /// A filled rectangle between two opposite corners.
    pub(crate) fn rectangle(&self, a: Pixel, b: Pixel, ink: Ink) -> Result<(), DrawError> {
        Ok(self.area.draw(&Rectangle::new([subpixel(a), subpixel(b)], ink.stand_in().filled()))?)
    }

    /// A filled disc.
    pub(crate) fn disc(&self, center: Pixel, radius: f64, ink: Ink) -> Result<(), DrawError> {
        let radius = (radius * SUBPIXELS).round() as i32;
        Ok(self.area.draw(&Circle::new(subpixel(center), radius, ink.stand_in().filled()))?)
    }

    /// Text; `^{...}` in it becomes a superscript.
    pub(crate) fn text(&self, text: &str, at: Pixel, anchor: Anchor, size: f64, ink: Ink) -> Result<(), DrawError> {
        let color = ink.stand_in();
        let style =
            ("sans-serif", size * SUBPIXELS * PLOTTERS_FONT_FACTOR).into_text_style(&self.area).color(&color).pos(anchor.position());
        Ok(self.area.draw_text(text, &style, subpixel(at))?)
    }
}

/// Which point of a text is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    MiddleTop,
    MiddleLeft,
    MiddleRight,
    RightBottom,
    LeftTop,
}

impl Anchor {
    fn position(self) -> Pos {
        let (horizontal, vertical) = match self {
            Anchor::MiddleTop => (HPos::Center, VPos::Top),
            Anchor::MiddleLeft => (HPos::Left, VPos::Center),
            Anchor::MiddleRight => (HPos::Right, VPos::Center),
            Anchor::RightBottom => (HPos::Right, VPos::Bottom),
            Anchor::LeftTop => (HPos::Left, VPos::Top),
        };
        Pos::new(horizontal, vertical)
    }
}

fn subpixel([x, y]: Pixel) -> (i32, i32) {
    ((x * SUBPIXELS).round() as i32, (y * SUBPIXELS).round() as i32)
}

fn stroke(width: f64) -> u32 {
    (width * SUBPIXELS).round() as u32
}

/// Turns plotters' text into what stands inside a page's `<svg>`: inks for stand-ins, the page's font, superscripts.
fn page_svg(svg: &str) -> String {
    // The first line opens plotters' own <svg>, the last closes it; one element or one text stands on each line between.
    let mut lines: Vec<&str> = svg.lines().skip(1).collect();
    lines.pop();
    let mut page = String::with_capacity(svg.len());
    for line in lines {
        if line.starts_with('<') {
            page.push_str(&line.replace(" opacity=\"1\"", "").replace(" font-family=\"sans-serif\"", ""));
            page.push('\n');
        } else {
            page.push_str(&superscripts(line));
        }
    }
    for (ink, name) in Ink::style_names() {
        let RGBColor(r, g, b) = ink.stand_in();
        page = page.replace(&format!("#{r:02X}{g:02X}{b:02X}"), &name);
    }
    page
}

fn superscripts(text: &str) -> String {
    let mut page = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("^{") {
        let Some((raised, behind)) = after.split_once('}') else { break };
        page.push_str(before);
        page.push_str("<tspan dy=\"-0.42em\" font-size=\"76%\">");
        page.push_str(raised);
        page.push_str("</tspan>");
        // What follows goes back to the line.
        if !behind.is_empty() {
            page.push_str("<tspan dy=\"0.32em\">\u{200b}</tspan>");
        }
        rest = behind;
    }
    page.push_str(rest);
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inks_are_variables_and_superscripts_are_raised() {
        let caption = Caption { class: "plot", title: "a <title>", description: "numbers" };
        let svg = draw([100.0, 50.0], &caption, |canvas| {
            canvas.line(&[[0.0, 0.0], [1.05, 2.0]], Ink::Series(9), 1.5)?;
            canvas.text("10^{−5} & more", [3.0, 4.0], Anchor::MiddleTop, 12.0, Ink::Muted)
        });
        let svg = svg.map(PreEscaped::into_string).unwrap_or_default();
        assert!(svg.contains("stroke=\"var(--series-1)\" stroke-width=\"15\" points=\"0,0 11,20 \""), "{svg}");
        assert!(svg.contains("10<tspan dy=\"-0.42em\" font-size=\"76%\">−5</tspan>"), "{svg}");
        assert!(svg.contains("&amp; more") && svg.contains("a &lt;title&gt;"), "{svg}");
        assert!(!svg.contains('#') && !svg.contains("http"), "{svg}");
    }
}
