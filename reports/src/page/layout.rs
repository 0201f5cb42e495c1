//! What all pages share: the document round their content, with style and script inside, so that a page is one file.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::SiteMeta;

const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// A whole page. `is_index` leaves out the link back.
pub(crate) fn document(title: &str, description: &str, is_index: bool, meta: &SiteMeta, content: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="description" content=(description);
                title { (title) " · Touchstone" }
                // An empty icon keeps browsers from asking for one.
                link rel="icon" href="data:,";
                style { (PreEscaped(STYLE)) }
            }
            body {
                nav.top {
                    @if is_index { strong { "Touchstone" } } @else { a href="index.html" { "← All cases" } }
                    a href="scene-keys.html" { "Scene file keys" }
                }
                main { (content) }
                footer {
                    "Touchstone " (meta.version) ", commit " code { (meta.commit) } ", " (meta.date) ". Measured on "
                    (meta.machine) ". Made from measured rows only; "
                    a href="ro-crate-metadata.json" { "list of all files with checksums" } "."
                }
                script { (PreEscaped(SCRIPT)) }
            }
        }
    };
    page.into_string()
}

/// A table in a box of its own, so that a wide one scrolls there and never the page.
pub(crate) fn scrolling(label: &str, table: &Markup) -> Markup {
    html! { div.scroll role="region" aria-label=(label) tabindex="0" { (table) } }
}

/// The same with a caption above, which stays in view when the table scrolls.
pub(crate) fn captioned(label: &str, caption: &Markup, table: &Markup) -> Markup {
    html! { p.caption { (caption) } (scrolling(label, table)) }
}

/// A command with a button that copies it.
pub(crate) fn command(text: &str) -> Markup {
    html! {
        span.command { code { (text) } button type="button" data-copy=(text) { "Copy" } }
    }
}
