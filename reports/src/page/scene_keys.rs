//! The reference page of all keys of a scene file.

use maud::{Markup, html};

use super::layout::{document, scrolling};
use super::text::linked;
use crate::{KeyTable, SiteMeta};

/// The whole page.
pub(crate) fn page(tables: &[KeyTable], meta: &SiteMeta) -> String {
    let content = html! {
        header.site {
            h1 { "Scene file keys" }
            p.question { "A scene file is TOML: SI units, angles in radians. A table that is absent is physics that is absent. Unknown keys are refused." }
        }
        @if tables.is_empty() { p.missing { "No keys were given to this page." } }
        nav.keys aria-label="tables" {
            @for (index, table) in tables.iter().enumerate() {
                a href=(anchor(index, table)) { code { "[" (table.table) "]" } } " "
            }
        }
        @for (index, table) in tables.iter().enumerate() { (key_table(index, table)) }
    };
    document("Scene file keys", "All tables and keys of a scene file", false, meta, &content)
}

/// Anchors are numbered, because the names of two tables may differ in signs only.
fn anchor(index: usize, table: &KeyTable) -> String {
    format!("#{}", id(index, table))
}

fn id(index: usize, table: &KeyTable) -> String {
    let name: String = table.table.chars().map(|sign| if sign.is_ascii_alphanumeric() { sign } else { '-' }).collect();
    format!("table-{}-{name}", index + 1)
}

fn key_table(index: usize, table: &KeyTable) -> Markup {
    let content = html! {
        table.keys {
            thead { tr { th scope="col" { "Key" } th scope="col" { "Type" } th scope="col" { "If absent" } th scope="col" { "Meaning" } } }
            tbody {
                @for (number, key) in table.keys.iter().enumerate() {
                    tr id=(format!("{}-key-{}", id(index, table), number + 1)) {
                        th scope="row" { code { (key.name) } }
                        td { (key.type_name) }
                        td {
                            @if key.required { strong { "required" } }
                            @else if key.default.is_empty() { "–" }
                            @else { code { (key.default) } }
                        }
                        td.why { (linked(&key.doc)) }
                    }
                }
            }
        }
    };
    html! {
        section id=(id(index, table)) {
            h2 { code { "[" (table.table) "]" } }
            p { (linked(&table.doc)) }
            @if table.keys.is_empty() { p { "It has no keys of its own." } }
            @else { (scrolling(&format!("keys of {}", table.table), &content)) }
        }
    }
}
