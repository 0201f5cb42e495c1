//! A plot in its place on a page: title, legend, both formats, notes, failures and where the numbers are.

use maud::{Markup, html};

use super::text::row_link;
use crate::plot::figure::Drawn;

/// Sets a plot, or says why there is none. `data` is the file behind it, relative to the site.
pub(crate) fn figure(title: &str, drawn: &Drawn, data: &str, command: &str) -> Markup {
    html! {
        figure.plot {
            h3 { (title) }
            @match drawn {
                Ok(figure) => {
                    (figure.legend)
                    (figure.wide) (figure.narrow)
                    @if !figure.failures.is_empty() {
                        ul.failures {
                            @for (line, words) in &figure.failures {
                                li { span.bad { "✕" } " failed: " (row_link(*line, &html! { (words) })) }
                            }
                        }
                    }
                    figcaption {
                        @for note in &figure.notes { span { (note) } " " }
                        span.links { a href=(data) { "data" } " · remake: " code { (command) } }
                    }
                },
                Err(reason) => p.missing { "Not drawn: " (reason) },
            }
        }
    }
}
