//! Broken recordings, each made from a whole one by one change that is said.
//!
//! Test files take this as a module; `cargo run -p recording --example write_damaged -- DIRECTORY` writes all of them for
//! other tools. Nothing here is random: the same bytes come out each time.
#![allow(dead_code, unreachable_pub, reason = "each user takes what it needs")]
#![allow(clippy::unwrap_used, clippy::panic, reason = "makes inputs of tests; a slip in it must be seen")]

pub mod content;
pub mod directory;
pub mod hostile;
pub mod hostile_database;
pub mod mcap_file;
pub mod records;
pub mod sqlite_file;
pub mod whole;

use std::path::{Path, PathBuf};

/// What a check must say of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Expected {
    /// Exit code 0.
    Whole,
    /// Exit code 1.
    Damaged,
    /// Exit code 2.
    Unreadable,
}

/// A broken recording.
pub struct Case {
    /// Name of the file or directory.
    pub name: &'static str,
    /// How much of it can be used.
    pub expected: Expected,
    /// Words of the sentence that says what is wrong.
    pub words: &'static [&'static str],
    /// Files with their paths under `name`; the empty path: `name` is the file.
    pub files: Vec<(PathBuf, Vec<u8>)>,
    /// How many messages can be read at least.
    pub readable: u64,
}

impl Case {
    /// One file.
    pub fn file(
        name: &'static str,
        expected: Expected,
        words: &'static [&'static str],
        readable: u64,
        bytes: Vec<u8>,
    ) -> Self {
        Self { name, expected, words, readable, files: vec![(PathBuf::new(), bytes)] }
    }

    /// Writes it into a directory and returns its path.
    pub fn write(&self, directory: &Path) -> PathBuf {
        let root = directory.join(self.name);
        if self.files.is_empty() {
            std::fs::create_dir_all(&root).unwrap();
        }
        for (relative, bytes) in &self.files {
            let path = if relative.as_os_str().is_empty() { root.clone() } else { root.join(relative) };
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, bytes).unwrap();
        }
        root
    }
}

/// All of them.
pub fn all() -> Vec<Case> {
    [mcap_file::cases(), content::cases(), directory::cases(), sqlite_file::cases()]
        .into_iter()
        .flatten()
        .collect()
}
