//! The folder of a scene's outputs. A new one is written beside its place under a temporary name and appears there when it can first be
//! resumed, at the first checkpoint; a run that fails before leaves nothing.

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::cli::CommandError;
use crate::cli::files::{create_folder, folder_above, names_in, with_usual_permissions};

/// State of a run, to go on from.
pub const CHECKPOINT: &str = "checkpoint.json";
/// What probes observed.
pub const PROBES: &str = "probes.csv";
/// State of every body at the end.
pub const BODIES: &str = "bodies.csv";
/// Bodies that have left, of scenes with outlets.
pub const DEPARTURES: &str = "departures.csv";
/// Stages used and left out.
pub const LEDGER: &str = "ledger.json";
/// Folder of VTK snapshots.
pub const SNAPSHOTS: &str = "vtk";
/// List of VTK snapshots over time.
pub const SERIES: &str = "bodies.pvd";
/// List of VTK snapshots of the fluid over time, of scenes with one.
pub const FLOW_SERIES: &str = "flow.pvd";

/// All names a run may write.
const NAMES: [&str; 8] = [CHECKPOINT, PROBES, BODIES, DEPARTURES, LEDGER, SNAPSHOTS, SERIES, FLOW_SERIES];

/// The folder of a scene's outputs.
pub struct OutputFolder {
    place: PathBuf,
    /// The folder that is written until the outputs appear in their place.
    temporary: Option<TempDir>,
}

impl OutputFolder {
    /// A folder for a new run.
    ///
    /// # Errors
    ///
    /// If the place is taken or cannot be written.
    pub fn new(place: &Path, overwrite: bool) -> Result<OutputFolder, CommandError> {
        if place.exists() && !place.is_dir() {
            return Err(CommandError::input(format!("`{}` is a file; the output folder needs another name", place.display())));
        }
        let names = names_in(place)?;
        if !names.is_empty() {
            check_that_it_may_be_replaced(place, &names, overwrite)?;
        }
        let above = folder_above(place);
        create_folder(&above)?;
        let temporary = with_usual_permissions(0o777).tempdir_in(&above);
        let temporary = temporary.map_err(|error| CommandError::file("write into the folder", &above, &error))?;
        Ok(OutputFolder { place: place.to_path_buf(), temporary: Some(temporary) })
    }

    /// The folder of a former run, to be gone on with.
    ///
    /// # Errors
    ///
    /// If it holds no checkpoint.
    pub fn of_former_run(place: &Path) -> Result<OutputFolder, CommandError> {
        if !place.join(CHECKPOINT).is_file() {
            let message = format!("there is nothing to resume: `{}` does not exist", place.join(CHECKPOINT).display());
            return Err(CommandError::input(message));
        }
        Ok(OutputFolder { place: place.to_path_buf(), temporary: None })
    }

    /// Where outputs are now.
    pub fn path(&self) -> &Path {
        self.temporary.as_ref().map_or(&self.place, |temporary| temporary.path())
    }

    /// Lets the outputs appear in their place; a former output there goes.
    ///
    /// # Errors
    ///
    /// If the folder cannot be renamed.
    pub fn publish(&mut self) -> Result<(), CommandError> {
        let Some(temporary) = self.temporary.take() else { return Ok(()) };
        let failed = |error: std::io::Error| CommandError::file("write the folder", &self.place, &error);
        let former = if names_in(&self.place)?.is_empty() {
            None
        } else {
            let aside = with_usual_permissions(0o777).tempdir_in(folder_above(&self.place)).map_err(failed)?;
            fs::rename(&self.place, aside.path().join("former")).map_err(failed)?;
            Some(aside)
        };
        if let Err(error) = fs::rename(temporary.path(), &self.place) {
            if let Some(aside) = former {
                fs::rename(aside.path().join("former"), &self.place).map_err(failed)?;
            }
            return Err(failed(error));
        }
        // It has moved: there is nothing left to delete under the temporary name.
        let _ = temporary.keep();
        Ok(())
    }
}

fn check_that_it_may_be_replaced(place: &Path, names: &[String], overwrite: bool) -> Result<(), CommandError> {
    let is_of_a_run = names.iter().any(|name| name == LEDGER || name == CHECKPOINT);
    let is_only_of_a_run = names.iter().all(|name| NAMES.contains(&name.as_str()));
    let place = place.display();
    if !(is_of_a_run && is_only_of_a_run) {
        return Err(CommandError::input(format!("`{place}` is not empty and holds more than the outputs of a run; choose another folder")));
    }
    if !overwrite {
        return Err(CommandError::input(format!(
            "`{place}` holds the outputs of a former run; `--resume` goes on with it, `--overwrite` replaces it"
        )));
    }
    Ok(())
}
