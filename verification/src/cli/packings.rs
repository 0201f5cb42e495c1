//! Settled packings on disk: one file each, under its key.

use std::path::PathBuf;

use super::files::{read_text_if_there, write_whole};
use crate::packing::Store;

/// A folder of packings. What cannot be read or written is made again the next time.
pub struct Packings {
    /// The folder.
    pub folder: PathBuf,
}

impl Packings {
    fn file(&self, key: &str) -> PathBuf {
        self.folder.join(format!("{key}.packing"))
    }
}

impl Store for Packings {
    fn load(&self, key: &str) -> Option<String> {
        read_text_if_there(&self.file(key)).ok().flatten()
    }

    fn save(&self, key: &str, text: &str) {
        // A full disk must not end a run that has its packing in memory.
        let _ = write_whole(&self.file(key), text);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_packing_is_found_again_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a folder");
        let packings = Packings { folder: folder.path().join("packings") };
        assert_eq!(packings.load("a"), None);
        packings.save("a", "text");
        assert_eq!((packings.load("a").as_deref(), packings.load("b")), (Some("text"), None));
        std::fs::write(packings.file("c"), [0xff, 0xfe]).expect("a file");
        assert_eq!(packings.load("c"), None);
    }
}
