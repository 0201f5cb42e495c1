//! [`Figure`]: a finished plot with its legend and notes, as the page sets it.

use maud::{Markup, html};

use super::canvas::{Caption, DrawError, Ink, draw};
use super::layer::{Layer, Layers};
use super::marker::Look;

/// A plot ready for a page.
pub(crate) struct Figure {
    /// The same plot for screens with room and for phones.
    pub(crate) wide: Markup,
    pub(crate) narrow: Markup,
    pub(crate) legend: Markup,
    /// Sentences under the plot.
    pub(crate) notes: Vec<Markup>,
    /// Runs that failed: line of the row and reason.
    pub(crate) failures: Vec<(usize, String)>,
}

/// A plot, or the reason why there is none.
pub(crate) type Drawn = Result<Figure, String>;

/// One line of a legend.
pub(crate) struct Entry {
    pub(crate) look: Look,
    pub(crate) joined: bool,
    pub(crate) marked: bool,
    pub(crate) name: String,
}

/// The legend of an error plot; statistics and failures are explained once, not per setup.
pub(crate) fn layers_legend(layers: &Layers, statistics: &[String]) -> Result<Markup, DrawError> {
    let list = legend(&layer_entries(layers))?;
    let others = statistics.get(1..).unwrap_or_default().join(", ");
    Ok(html! {
        (list)
        @if !layers.shared.is_empty() { p.note { "The same in all: " (layers.shared) "." } }
        @if !others.is_empty() {
            p.note { "Filled markers with a line: " (statistics[0]) ". Hollow markers: " (others) "." }
        }
    })
}

/// One line for each setup and each series of another code.
pub(crate) fn layer_entries(layers: &Layers) -> Vec<Entry> {
    layers
        .all
        .iter()
        .filter(|layer| layer.joined || layer.series.code.is_some())
        .map(|layer| Entry { look: layer.look, joined: layer.joined, marked: true, name: legend_name(layer) })
        .collect()
}

/// A setup of which nothing is drawn stays in the legend, so that nobody has to wonder where it is.
fn legend_name(layer: &Layer) -> String {
    match layer.series.points.len() {
        0 => format!("{} (no result)", layer.name),
        _ => layer.name.clone(),
    }
}

/// A legend outside the plot, where it hides no data.
pub(crate) fn legend(entries: &[Entry]) -> Result<Markup, DrawError> {
    let swatches = entries.iter().map(swatch).collect::<Result<Vec<Markup>, DrawError>>()?;
    Ok(html! {
        ul.legend {
            @for (entry, swatch) in entries.iter().zip(swatches) { li { (swatch) span { (entry.name) } } }
        }
    })
}

fn swatch(entry: &Entry) -> Result<Markup, DrawError> {
    let caption = Caption { class: "swatch", title: &entry.name, description: "" };
    draw([30.0, 16.0], &caption, |canvas| {
        if entry.joined {
            canvas.line(&[[1.0, 8.0], [29.0, 8.0]], entry.look.ink, 1.8)?;
        }
        if entry.marked { entry.look.draw(canvas, [15.0, 8.0]) } else { Ok(()) }
    })
}

/// The swatch of the Pareto front.
pub(crate) fn front_entry() -> Result<Markup, DrawError> {
    let caption = Caption { class: "swatch", title: "best of all", description: "" };
    let swatch = draw([30.0, 16.0], &caption, |canvas| canvas.line(&[[1.0, 8.0], [29.0, 8.0]], Ink::Front, 6.0))?;
    Ok(html! { ul.legend { li { (swatch) span { "no other run is both cheaper and more accurate (Pareto front)" } } } })
}
