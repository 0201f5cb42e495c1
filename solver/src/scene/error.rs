//! What can be wrong with a scene, said so that the author can mend it.

/// Why a scene is refused: the key, the line of the file if it came from one, what is wrong and what is allowed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub struct SceneError {
    /// The kind of fault, for programs and tests.
    pub kind: SceneErrorKind,
    /// Path of the key, as `body[3].mass`.
    pub key: String,
    /// Line in the file, from 1.
    pub line: Option<usize>,
    /// Name of the file.
    pub file: Option<String>,
    /// What is wrong and what is allowed.
    pub message: String,
}

/// Kinds of faults in a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SceneErrorKind {
    /// The text is not TOML, or a key is unknown, missing or of the wrong type.
    Format,
    /// A number is not finite or outside its range.
    Value,
    /// A name or id that is not defined, or defined twice.
    Reference,
    /// Keys that are each right do not go together.
    Combination,
    /// The time step is above what the stiffest contact allows.
    StepTooLarge,
    /// Bodies overlap at the start.
    Overlap,
    /// The scene has nothing to simulate.
    Empty,
    /// A model that does not exist in this version.
    Unsupported,
}

impl SceneError {
    /// An error at a key; file and line are added by the loader.
    pub fn new(kind: SceneErrorKind, key: impl Into<String>, message: impl Into<String>) -> SceneError {
        SceneError { kind, key: key.into(), line: None, file: None, message: message.into() }
    }
}

impl std::fmt::Display for SceneError {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let Some(file) = &self.file {
            write!(formatter, "{file}")?;
            if let Some(line) = self.line {
                write!(formatter, ":{line}")?;
            }
            write!(formatter, ": ")?;
        } else if let Some(line) = self.line {
            write!(formatter, "line {line}: ")?;
        }
        if !self.key.is_empty() {
            write!(formatter, "`{}`: ", self.key)?;
        }
        write!(formatter, "{}", self.message)
    }
}
