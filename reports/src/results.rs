//! What goes into the site ([`Results`], [`SiteMeta`]) and what comes out ([`SiteFile`]).

use crate::row_lines::write_rows;
use crate::{Card, Row};

/// Everything a site is made from.
#[derive(Debug, Clone, Default)]
pub struct Results {
    /// The cases, in registry order.
    pub cases: Vec<CaseResults>,
    /// The tables of a scene file with all their keys, for the reference page.
    pub scene_keys: Vec<KeyTable>,
}

/// One case: what it says about itself and what was measured.
#[derive(Debug, Clone)]
pub struct CaseResults {
    /// The case's own words, picture and list of plots.
    pub card: Card,
    /// The measured rows, in file order; rows of other codes carry another [`Row::code`].
    pub rows: Vec<Row>,
    /// The rows of the last release; empty if there is none.
    pub baseline: Vec<Row>,
    /// The files the rows and plots refer to.
    pub data: Vec<DataFile>,
}

/// A file behind the numbers: a curve, a history, samples.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DataFile {
    /// Path relative to the results folder, with forward slashes.
    pub path: String,
    /// The whole text.
    pub content: String,
}

/// One table of a scene file (`[scene]`, `[[body]]`) and its keys.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeyTable {
    /// Name as it is written in the file, without brackets.
    pub table: String,
    /// What the table is for.
    pub doc: String,
    /// Its keys, in order.
    pub keys: Vec<KeyDoc>,
}

/// One key of a scene file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeyDoc {
    /// Name of the key.
    pub name: String,
    /// Its type in words ("number", "list of 3 numbers").
    pub type_name: String,
    /// Whether a scene is refused without it.
    pub required: bool,
    /// What holds if it is absent; empty if nothing does.
    pub default: String,
    /// Meaning, unit and allowed values.
    pub doc: String,
}

/// What the rows do not know about the site; given by the caller so that the same input makes the same bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SiteMeta {
    /// Commit the site was made from.
    pub commit: String,
    /// Date of that commit or of the newest rows, as text.
    pub date: String,
    /// Machine the rows were measured on.
    pub machine: String,
    /// Version of Touchstone.
    pub version: String,
}

/// One file of the finished site.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SiteFile {
    /// Path relative to the site's root, with forward slashes.
    pub path: String,
    /// The whole text.
    pub content: String,
}

impl CaseResults {
    /// The rows and data files, where the site keeps them.
    pub(crate) fn site_files(&self) -> Vec<SiteFile> {
        let rows = SiteFile { path: format!("data/{}.jsonl", self.card.case), content: write_rows(&self.rows) };
        let copies = self.data.iter().map(|file| SiteFile { path: format!("data/{}", file.path), content: file.content.clone() });
        std::iter::once(rows).chain(copies).collect()
    }

    /// The rows this project measured itself; only these decide the verdict of a case.
    ///
    /// The first number is the row's line in the case's result file, counted from 1.
    pub fn own_rows(&self) -> impl Iterator<Item = (usize, &Row)> {
        self.numbered_rows().filter(|(_, row)| row.is_own())
    }

    /// The rows that `touchstone compare` brought in, with their line numbers.
    pub fn foreign_rows(&self) -> impl Iterator<Item = (usize, &Row)> {
        self.numbered_rows().filter(|(_, row)| !row.is_own())
    }

    /// All rows with their line numbers.
    pub fn numbered_rows(&self) -> impl Iterator<Item = (usize, &Row)> {
        self.rows.iter().enumerate().map(|(index, row)| (index + 1, row))
    }

    /// The content of a data file, by its path relative to the results folder.
    pub fn file(&self, path: &str) -> Option<&str> {
        self.data.iter().find(|file| file.path == path).map(|file| file.content.as_str())
    }
}
