//! The still picture of a case: plain geometry as inline SVG.

use maud::{Markup, html};

use crate::card::{Picture, PictureItem};

/// Width and greatest height of a picture in its own pixels.
const WIDTH: f64 = 400.0;
const GREATEST_HEIGHT: f64 = 300.0;
/// Room for labels round the geometry.
const MARGIN: f64 = 30.0;
/// Distance between the strokes of a hatched wall, and their length.
const HATCH: f64 = 9.0;
/// Size of text.
const FONT: f64 = 14.0;

/// From the picture's own lengths to pixels, y turned downwards.
struct Fit {
    scale: f64,
    low: [f64; 2],
    height: f64,
    shift: f64,
}

impl Fit {
    /// Fits all points into the picture; absent if there is nothing with a finite place.
    fn new(items: &[PictureItem]) -> Option<Fit> {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for [x, y] in items.iter().flat_map(extent).filter(|point| point.iter().all(|place| place.is_finite())) {
            low = [low[0].min(x), low[1].min(y)];
            high = [high[0].max(x), high[1].max(y)];
        }
        let size = [high[0] - low[0], high[1] - low[1]];
        if !size.iter().all(|length| length.is_finite()) {
            return None;
        }
        let room = [WIDTH - 2.0 * MARGIN, GREATEST_HEIGHT - 2.0 * MARGIN];
        let scale = (room[0] / size[0].max(1e-300)).min(room[1] / size[1].max(1e-300)).min(1e290);
        let height = size[1] * scale + 2.0 * MARGIN;
        Some(Fit { scale, low, height, shift: (WIDTH - size[0] * scale) / 2.0 })
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let right = self.shift + (x - self.low[0]) * self.scale;
        [tenth(right), tenth(self.height - MARGIN - (y - self.low[1]) * self.scale)]
    }
}

/// Tenths of a pixel are as fine as a screen shows, and keep the page small.
fn tenth(pixels: f64) -> f64 {
    (pixels * 10.0).round() / 10.0
}

/// Points that must lie inside the picture.
fn extent(item: &PictureItem) -> Vec<[f64; 2]> {
    match item {
        PictureItem::Disc { center: [x, y], radius, .. } => {
            vec![[x - radius, y - radius], [x + radius, y + radius]]
        }
        PictureItem::Polygon { points, .. } => points.clone(),
        PictureItem::Wall { from, to, .. } | PictureItem::Arrow { from, to, .. } | PictureItem::Dashed { from, to } => vec![*from, *to],
        PictureItem::Label { at, .. } => vec![*at],
    }
}

/// Draws the picture; an empty one is said to be missing.
pub(crate) fn draw(picture: &Picture) -> Markup {
    let Some(fit) = Fit::new(&picture.items) else {
        return html! { p.missing { "This case has no picture." } };
    };
    html! {
        svg.picture viewBox=(format!("0 0 {WIDTH} {}", tenth(fit.height))) role="img" {
            title { (picture.caption) }
            @for item in &picture.items { (draw_item(&fit, item)) }
        }
    }
}

fn draw_item(fit: &Fit, item: &PictureItem) -> Markup {
    match item {
        PictureItem::Disc { center, radius, ghost } => {
            let [x, y] = fit.at(*center);
            html! { circle .solid[!ghost] .ghost[*ghost] cx=(x) cy=(y) r=(tenth(radius * fit.scale)) {} }
        }
        PictureItem::Polygon { points, ghost } => {
            let corners: Vec<String> = points.iter().map(|point| fit.at(*point)).map(|[x, y]| format!("{x},{y}")).collect();
            html! { polygon .solid[!ghost] .ghost[*ghost] points=(corners.join(" ")) {} }
        }
        PictureItem::Wall { from, to, solid_side } => wall(fit.at(*from), fit.at(*to), *solid_side),
        PictureItem::Arrow { from, to, label } => arrow(fit.at(*from), fit.at(*to), label),
        PictureItem::Dashed { from, to } => html! { (segment(fit.at(*from), fit.at(*to), "dashed")) },
        PictureItem::Label { at, text } => {
            let [x, y] = fit.at(*at);
            html! { text x=(x) y=(y) dy="0.35em" text-anchor="middle" { (text) } }
        }
    }
}

fn segment([x1, y1]: [f64; 2], [x2, y2]: [f64; 2], class: &str) -> Markup {
    html! { line class=(class) x1=(tenth(x1)) y1=(tenth(y1)) x2=(tenth(x2)) y2=(tenth(y2)) {} }
}

/// A thick surface with short slanted strokes on its solid side.
fn wall(from: [f64; 2], to: [f64; 2], solid_side: [f64; 2]) -> Markup {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = along[0].hypot(along[1]);
    let into = [solid_side[0], -solid_side[1]];
    // At most as many strokes as fit a picture's diagonal: a wall far larger than its picture cannot flood the page.
    let strokes = ((length / HATCH).floor() as usize).min(80);
    let stroke = |index: usize| {
        let fraction = (index as f64 + 0.5) / strokes as f64;
        let start = [from[0] + along[0] * fraction, from[1] + along[1] * fraction];
        let lean = [along[0] / length * HATCH * 0.7, along[1] / length * HATCH * 0.7];
        let end = [start[0] + into[0] * HATCH - lean[0], start[1] + into[1] * HATCH - lean[1]];
        segment(start, end, "hatch")
    };
    html! {
        (segment(from, to, "wall"))
        @for index in 0..strokes { (stroke(index)) }
    }
}

/// A shaft with a head, and its label beyond the tip or beside it, inside the picture.
fn arrow(from: [f64; 2], to: [f64; 2], label: &str) -> Markup {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = along[0].hypot(along[1]);
    if length < 0.1 {
        return html! { text x=(to[0]) y=(to[1]) text-anchor="middle" { (label) } };
    }
    let unit = [along[0] / length, along[1] / length];
    let head = 9.0_f64.min(length);
    let neck = [to[0] - unit[0] * head, to[1] - unit[1] * head];
    let wing = |side: f64| format!("{},{}", tenth(neck[0] - unit[1] * 4.5 * side), tenth(neck[1] + unit[0] * 4.5 * side));
    let (x, y, anchor) = arrow_label(to, unit, label);
    html! {
        (segment(from, neck, "arrow"))
        polygon.arrowhead points=(format!("{},{} {} {}", to[0], to[1], wing(1.0), wing(-1.0))) {}
        @if !label.is_empty() { text x=(tenth(x)) y=(tenth(y)) dy="0.35em" text-anchor=(anchor) { (label) } }
    }
}

fn arrow_label(tip: [f64; 2], unit: [f64; 2], label: &str) -> (f64, f64, &'static str) {
    let width = label.chars().count() as f64 * FONT * 0.55;
    let beyond = [tip[0] + unit[0] * 7.0, tip[1] + unit[1] * (FONT * 0.8)];
    if unit[0] > 0.5 && beyond[0] + width <= WIDTH {
        (beyond[0], beyond[1], "start")
    } else if unit[0] < -0.5 && beyond[0] - width >= 0.0 {
        (beyond[0], beyond[1], "end")
    } else if unit[0].abs() > 0.5 {
        // No room beyond the tip: above it.
        ((tip[0]).clamp(width / 2.0, (WIDTH - width / 2.0).max(width / 2.0)), tip[1] - FONT, "middle")
    } else if tip[0] + 8.0 + width <= WIDTH {
        (tip[0] + 8.0, tip[1] - unit[1] * 6.0, "start")
    } else {
        (tip[0] - 8.0, tip[1] - unit[1] * 6.0, "end")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn y_points_upwards_and_everything_fits() {
        let items = vec![
            PictureItem::Disc { center: [0.0, 2.0], radius: 1.0, ghost: false },
            PictureItem::Wall { from: [-2.0, 0.0], to: [2.0, 0.0], solid_side: [0.0, -1.0] },
        ];
        let fit = Fit::new(&items).expect("finite geometry");
        assert!(fit.at([0.0, 2.0])[1] < fit.at([0.0, 0.0])[1]);
        for [x, y] in items.iter().flat_map(extent).map(|point| fit.at(point)) {
            assert!((0.0..=WIDTH).contains(&x) && (0.0..=fit.height).contains(&y));
        }
    }

    #[test]
    fn an_empty_or_broken_picture_is_said_to_be_missing() {
        let broken = PictureItem::Label { at: [f64::NAN, 0.0], text: "x".into() };
        for items in [Vec::new(), vec![broken]] {
            assert!(draw(&Picture { caption: String::new(), items }).into_string().contains("no picture"));
        }
    }
}
