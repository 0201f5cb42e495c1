//! Why a command could not do its work.

use std::io;
use std::path::Path;

/// Why a command could not do its work; the message names file, key or value and what is allowed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CommandError {
    /// The input is wrong, or a place cannot be read or written.
    #[error("{0}")]
    Input(String),
    /// A guard stopped the run of a scene.
    #[error("{0}")]
    Stopped(String),
}

impl CommandError {
    /// An error of the input.
    pub fn input(message: impl Into<String>) -> CommandError {
        CommandError::Input(message.into())
    }

    /// An error of the file system: what could not be done, where, and why.
    pub fn file(action: &str, path: &Path, error: &io::Error) -> CommandError {
        CommandError::Input(format!("cannot {action} `{}`: {error}", path.display()))
    }

    /// The exit code.
    pub fn exit_code(&self) -> u8 {
        match self {
            CommandError::Input(_) => 2,
            CommandError::Stopped(_) => 3,
        }
    }
}
