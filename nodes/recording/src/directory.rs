//! The files of a recording, from its `metadata.yaml` and from what lies in its directory.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::metadata::Metadata;
use crate::parts::{Series, holes, part, plain, several};
use crate::storage::{COMPRESSED, MCAP, SQLITE};

/// What is to be opened.
#[derive(Debug, Default)]
pub(crate) struct Directory {
    /// In the order of the recording, missing ones included.
    pub(crate) files: Vec<PathBuf>,
    pub(crate) metadata: Option<Metadata>,
    /// What `metadata.yaml` says other than the directory, and parts that nothing names and that must have been there.
    pub(crate) disagreements: Vec<String>,
    /// `metadata.yaml` is older than the last parts, whose messages it does not count.
    pub(crate) has_unlisted_parts: bool,
    /// The numbers of the parts have holes, and nothing says what was in the missing ones.
    pub(crate) has_missing_parts: bool,
}

impl Directory {
    /// A directory, or one file of a recording. Without metadata that names its files a directory is one recording only if
    /// they are the parts of one: otherwise the messages of several would be taken as those of one session.
    pub(crate) fn of(path: &Path) -> Result<Self, Error> {
        if !path.is_dir() {
            return Ok(Self { files: vec![path.to_owned()], ..Self::default() });
        }
        let mut directory = Self::default();
        match Metadata::load(path) {
            Ok(metadata) => directory.metadata = metadata,
            Err(error) => directory.disagreements.push(format!("{error}; reading the files without it")),
        }
        let present = recorded_files_in(path)?;
        let mut unlisted: BTreeSet<_> = present.iter().cloned().collect();
        let mut taken = BTreeSet::new();
        for listed in directory.metadata.iter().flat_map(|metadata| &metadata.relative_file_paths) {
            // Old versions wrote the directory in front of the name; and a recording has no business outside of it.
            let Some(name) = Path::new(listed).file_name() else { continue };
            let file = path.join(name);
            let other = other_form(&file);
            let found = [&file, &other].into_iter().find(|candidate| unlisted.remove(*candidate));
            if found.is_none() && !taken.contains(&file) {
                directory.disagreements.push(format!("metadata.yaml names {listed}, which is not there"));
            }
            let file = found.unwrap_or(&file).clone();
            if taken.insert(file.clone()) {
                directory.files.push(file);
            }
        }
        // Names of which none is there say nothing of the files that are.
        let is_listed = unlisted.len() < present.len();
        let named = directory.files.len();
        let listed: BTreeSet<Series> = directory.files.iter().map(|file| part(file).0).collect();
        // A recorder that is killed has not named its last files yet.
        for file in present.into_iter().filter(|file| unlisted.contains(file)) {
            // Of a file that lies there compressed and not, one is enough; and a converted copy is no part.
            let is_part = !is_listed || listed.contains(&part(&file).0);
            if taken.contains(&other_form(&file)) || !is_part {
                continue;
            }
            if is_listed {
                directory.has_unlisted_parts = true;
                let name = file.file_name().unwrap_or_default().display();
                directory
                    .disagreements
                    .push(format!("metadata.yaml does not name {name}, which is read too"));
            }
            taken.insert(file.clone());
            directory.files.push(file);
        }
        let there = directory.files.get(named..).unwrap_or_default();
        if !is_listed && let Some(found) = several(there) {
            return Err(Error::SeveralRecordings { path: path.to_owned(), found });
        }
        if !is_listed || directory.has_unlisted_parts {
            // A recorder that keeps the newest parts deletes the first ones, and its metadata does not name them.
            let files = if is_listed { &directory.files } else { there };
            let holes = holes(files, (!is_listed).then_some(0));
            directory.has_missing_parts = !holes.is_empty();
            directory.disagreements.extend(holes);
        }
        if directory.files.is_empty() {
            let reason = "the directory has neither .mcap nor .db3 files".to_owned();
            return Err(Error::NotARecording { path: path.to_owned(), reason });
        }
        Ok(directory)
    }
}

/// A compressed file without its ending, or any other with it.
fn other_form(file: &Path) -> PathBuf {
    if file.extension().is_some_and(|extension| extension == COMPRESSED) {
        return file.with_extension("");
    }
    let mut name = OsString::from(file);
    name.push(".");
    name.push(COMPRESSED);
    name.into()
}

/// The files of a directory that may be parts of a recording, in the order of their numbers.
fn recorded_files_in(directory: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(directory).map_err(Error::io(directory, "read"))? {
        let file = entry.map_err(Error::io(directory, "read"))?.path();
        if plain(&file).extension().is_some_and(|extension| extension == MCAP || extension == SQLITE) {
            files.push(file);
        }
    }
    // NAME_10 comes behind NAME_9, compressed or not: shorter names first.
    files.sort_by_cached_key(|file| {
        let plain = plain(file);
        (plain.as_os_str().len(), plain, file.clone())
    });
    Ok(files)
}
