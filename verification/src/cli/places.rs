//! Where results and pages are kept.

use std::path::{Path, PathBuf};

use super::CommandError;
use super::arguments::PlaceOptions;

/// Where results and pages are kept.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Places {
    /// Root of the enclosing checkout, if there is one.
    pub root: Option<PathBuf>,
    /// Result rows, cards and curves.
    pub results: PathBuf,
    /// Pages.
    pub site: PathBuf,
}

impl Places {
    /// The places that are asked for, or those of the checkout that encloses the current folder.
    ///
    /// # Errors
    ///
    /// If a place is not given and there is no enclosing checkout.
    pub fn find(options: &PlaceOptions) -> Result<Places, CommandError> {
        let current = std::env::current_dir().map_err(|error| CommandError::input(format!("cannot tell the current folder: {error}")))?;
        let root = checkout_of(&current);
        let place = |given: &Option<PathBuf>, name: &str| given.clone().or_else(|| Some(root.as_ref()?.join("reports").join(name)));
        let (results, site) = (place(&options.results, "results"), place(&options.site, "site"));
        let (Some(results), Some(site)) = (results, site) else {
            return Err(CommandError::input(format!(
                "`{}` is not inside a checkout (no folder above it has both `reports/` and `Cargo.toml`); go into one, or name the folders of \
                 rows and pages with `--results DIR --site DIR`",
                current.display()
            )));
        };
        Ok(Places { root, results, site })
    }

    /// Settled packings that runs share, beside the results.
    pub fn packings(&self) -> PathBuf {
        self.results.with_file_name("packings")
    }

    /// Rows of the last release, beside the results.
    pub fn baseline(&self) -> PathBuf {
        self.results.with_file_name("baseline")
    }

    /// Tables of other codes that the checkout keeps, beside the results.
    pub fn other_codes(&self) -> PathBuf {
        self.results.with_file_name("other_codes")
    }
}

fn checkout_of(folder: &Path) -> Option<PathBuf> {
    let is_root = |folder: &&Path| folder.join("reports").is_dir() && folder.join("Cargo.toml").is_file();
    folder.ancestors().find(is_root).map(Path::to_path_buf)
}
