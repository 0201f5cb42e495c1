//! Files that are either whole or not there.

use std::fs;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::CommandError;

/// Reads a text file.
pub fn read_text(path: &Path) -> Result<String, CommandError> {
    if path.is_dir() {
        return Err(CommandError::input(format!("cannot read `{}`: it is a folder, a file is needed", path.display())));
    }
    // A device or a pipe might never end.
    if fs::metadata(path).is_ok_and(|found| !found.is_file()) {
        return Err(CommandError::input(format!("cannot read `{}`: it is not a regular file", path.display())));
    }
    let bytes = fs::read(path).map_err(|error| CommandError::file("read", path, &error))?;
    String::from_utf8(bytes).map_err(|error| {
        let place = error.utf8_error().valid_up_to();
        CommandError::input(format!("cannot read `{}`: it is not text (byte {place} is not UTF-8)", path.display()))
    })
}

/// Reads a text file that may be absent.
pub fn read_text_if_there(path: &Path) -> Result<Option<String>, CommandError> {
    match fs::symlink_metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        _ => read_text(path).map(Some),
    }
}

/// Writes a file whole: into a temporary file beside it, which then takes its name.
pub fn write_whole(path: &Path, content: &str) -> Result<(), CommandError> {
    let failed = |error: std::io::Error| CommandError::file("write", path, &error);
    let folder = folder_above(path);
    create_folder(&folder)?;
    let mut file = with_usual_permissions(0o666).tempfile_in(&folder).map_err(failed)?;
    file.write_all(content.as_bytes()).map_err(failed)?;
    file.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
}

/// Creates a folder and those above it.
pub fn create_folder(folder: &Path) -> Result<(), CommandError> {
    fs::create_dir_all(folder).map_err(|error| CommandError::file("create the folder", folder, &error))
}

/// Temporary files and folders that the user's mask applies to, as to any other.
#[cfg_attr(not(unix), expect(unused_variables, reason = "only Unix has permission bits"))]
pub fn with_usual_permissions(mode: u32) -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".touchstone-");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(mode));
    builder
}

/// Names in a folder, sorted; none if the folder is absent.
pub fn names_in(folder: &Path) -> Result<Vec<String>, CommandError> {
    let failed = |error: &std::io::Error| CommandError::file("list the folder", folder, error);
    let entries = match fs::read_dir(folder) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        other => other.map_err(|error| failed(&error))?,
    };
    let name = |entry: std::io::Result<fs::DirEntry>| entry.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let mut names = entries.map(name).collect::<Result<Vec<_>, _>>().map_err(|error| failed(&error))?;
    names.sort();
    Ok(names)
}

/// The folder that holds a path; the current one for a bare name.
pub fn folder_above(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
        _ => PathBuf::from("."),
    }
}
