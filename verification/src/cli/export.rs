//! `touchstone export`: a case for other codes, as files.

use std::path::Path;

use super::arguments::DEFAULT_SEED;
use super::files::{create_folder, folder_above, names_in, with_usual_permissions, write_whole};
use super::progress::Progress;
use super::{CommandError, Finish, print};
use crate::study::{self, Context};
use crate::{Case, Tier, export};

/// Writes a case for other codes into a new folder; it appears when it is whole.
///
/// # Errors
///
/// If the folder is taken or cannot be written.
pub fn export(case: &dyn Case, tier: Tier, out: &Path) -> Result<Finish, CommandError> {
    if out.exists() && !(out.is_dir() && names_in(out)?.is_empty()) {
        return Err(CommandError::input(format!("`{}` is taken; choose a folder that does not exist or is empty", out.display())));
    }
    let files =
        export::export(case, tier, &rows(case, tier)).map_err(|error| CommandError::input(format!("cannot export the case: {error}")))?;
    let above = folder_above(out);
    create_folder(&above)?;
    let failed = |error: std::io::Error| CommandError::file("write the folder", out, &error);
    let folder = with_usual_permissions(0o777).tempdir_in(&above).map_err(failed)?;
    for file in &files {
        write_whole(&folder.path().join(&file.path), &file.content)?;
    }
    std::fs::rename(folder.path(), out).map_err(failed)?;
    let _ = folder.keep();
    print::line(&format!("written to {}: {} files; README.md says how to come back", out.display(), files.len()));
    Ok(Finish::Met)
}

/// Rows of a study without times: what is expected does not depend on the machine.
fn rows(case: &dyn Case, tier: Tier) -> Vec<reports::Row> {
    let progress = Progress::new();
    let bar = progress.bar(case.description().id);
    let context = Context {
        tier,
        random_seed: DEFAULT_SEED,
        commit: String::new(),
        machine: String::new(),
        only: None,
        clock: None,
        progress: &|done, total| bar.set(done as u64, total as u64),
    };
    study::run(case, &context).rows
}
