//! [`render`]: from results to the files of a static site.

use std::collections::BTreeSet;

use crate::plot::DrawError;
use crate::{Results, SiteFile, SiteMeta, page, ro_crate};

/// Why no site could be made.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RenderError {
    /// A case's identifier cannot be a file name.
    #[error("case \"{case}\": an identifier consists of letters, digits, '_' and '-', and is not \"index\" or \"scene-keys\"")]
    CaseName {
        /// The identifier.
        case: String,
    },
    /// Two cases share an identifier.
    #[error("case \"{case}\" occurs twice")]
    CaseTwice {
        /// The identifier.
        case: String,
    },
    /// A row stands in the results of another case.
    #[error("case \"{case}\", line {line}: the row belongs to case \"{row_case}\"")]
    ForeignRow {
        /// The case in whose results it stands.
        case: String,
        /// Its line.
        line: usize,
        /// The case it names.
        row_case: String,
    },
    /// A data file's path leaves the results folder or that of its case.
    #[error("case \"{case}\": data file \"{path}\" must be a relative path below \"{case}/\" and occur once")]
    DataPath {
        /// The case.
        case: String,
        /// The path.
        path: String,
    },
    /// A plot could not be drawn.
    #[error("case \"{case}\": {reason}")]
    Drawing {
        /// The case.
        case: String,
        /// What plotters said.
        reason: String,
    },
}

/// Makes the site; a pure function: the same input gives the same bytes.
///
/// The files are `index.html`, `<case>.html` for each case, `scene-keys.html`, `data/<case>.jsonl`, the data files as
/// `data/<path>` and `ro-crate-metadata.json`.
///
/// # Errors
/// Names and paths that cannot be files, and rows that stand in the wrong case. Missing numbers are not errors: pages
/// say what is missing.
pub fn render(results: &Results, meta: &SiteMeta) -> Result<Vec<SiteFile>, RenderError> {
    check_names(results)?;
    let mut files = vec![SiteFile { path: "index.html".into(), content: page::index::page(results, meta) }];
    for case in &results.cases {
        let content =
            page::case::page(case, meta).map_err(|DrawError(reason)| RenderError::Drawing { case: case.card.case.clone(), reason })?;
        files.push(SiteFile { path: format!("{}.html", case.card.case), content });
    }
    files.push(SiteFile { path: "scene-keys.html".into(), content: page::scene_keys::page(&results.scene_keys, meta) });
    for case in &results.cases {
        files.extend(case.site_files());
    }
    files.push(ro_crate::metadata(&files, meta));
    Ok(files)
}

fn check_names(results: &Results) -> Result<(), RenderError> {
    let mut cases = BTreeSet::new();
    for case in &results.cases {
        let name = &case.card.case;
        if !is_file_stem(name) {
            return Err(RenderError::CaseName { case: name.clone() });
        }
        if !cases.insert(name) {
            return Err(RenderError::CaseTwice { case: name.clone() });
        }
        if let Some((line, row)) = case.numbered_rows().find(|(_, row)| row.case != *name) {
            return Err(RenderError::ForeignRow { case: name.clone(), line, row_case: row.case.clone() });
        }
        let mut paths = BTreeSet::new();
        if let Some(file) = case.data.iter().find(|file| !is_below(&file.path, name) || !paths.insert(&file.path)) {
            return Err(RenderError::DataPath { case: name.clone(), path: file.path.clone() });
        }
    }
    Ok(())
}

fn is_file_stem(name: &str) -> bool {
    let allowed = |character: char| character.is_ascii_alphanumeric() || "_-".contains(character);
    !name.is_empty() && name.chars().all(allowed) && name != "index" && name != "scene-keys"
}

/// Whether a path is made of plain parts and starts with the folder of its case.
fn is_below(path: &str, case: &str) -> bool {
    let allowed = |character: char| character.is_ascii_alphanumeric() || "_-.+=".contains(character);
    let plain = |part: &str| !part.is_empty() && part != "." && part != ".." && part.chars().all(allowed);
    path.split('/').all(plain) && path.strip_prefix(case).is_some_and(|rest| rest.starts_with('/'))
}
