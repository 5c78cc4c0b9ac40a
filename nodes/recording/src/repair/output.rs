//! Where a new recording grows until it is whole.

use std::fs::File;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::RepairError;
use crate::error::Error;

/// `PATH_repaired`, without the ending of a file.
pub fn default_output(path: &Path) -> PathBuf {
    // "." and ".." have no name of their own.
    let resolved = path.file_name().is_none().then(|| path.canonicalize().ok()).flatten();
    let path = resolved.as_deref().unwrap_or(path);
    let name = path.file_name().unwrap_or_default();
    let mut stem = Path::new(name).to_owned();
    for ending in ["zstd", "mcap", "db3"] {
        if !path.is_dir() && stem.extension().is_some_and(|extension| extension == ending) {
            stem.set_extension("");
        }
    }
    let mut repaired = stem.into_os_string();
    repaired.push("_repaired");
    path.with_file_name(repaired)
}

/// A directory beside the place of the new recording, removed with everything in it unless it is finished.
pub(super) struct Place {
    output: PathBuf,
    unfinished: PathBuf,
    directory: TempDir,
}

impl Place {
    /// For a recording `output` that is made from the one at `source`.
    pub(super) fn beside(output: &Path, source: &Path) -> Result<Self, RepairError> {
        refuse_existing(output)?;
        let name = output.file_name().ok_or_else(|| Error::NotARecording {
            path: output.to_owned(),
            reason: "the path has no name at its end".to_owned(),
        })?;
        let parent = match output.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let resolved = parent.canonicalize().map_err(Error::io(parent, "find"))?;
        if source.is_dir() && source.canonicalize().is_ok_and(|source| resolved.starts_with(source)) {
            return Err(RepairError::Inside { output: output.to_owned(), path: source.to_owned() });
        }
        let directory = tempfile::Builder::new()
            .prefix(".rhombus_repair_")
            .tempdir_in(parent)
            .map_err(Error::io(parent, "write into"))?;
        let unfinished = directory.path().join(name);
        Ok(Self { output: output.to_owned(), unfinished, directory })
    }

    /// Where the recording is until it is finished.
    pub(super) fn unfinished(&self) -> &Path {
        &self.unfinished
    }

    /// Gives the recording its name.
    pub(super) fn finish(self) -> Result<(), RepairError> {
        // The name must not be on the disk before the content is.
        let entries = std::fs::read_dir(&self.unfinished).map_err(Error::io(&self.unfinished, "read"))?;
        for entry in entries {
            let file = entry.map_err(Error::io(&self.unfinished, "read"))?.path();
            let synced = File::open(&file).and_then(|opened| opened.sync_all());
            synced.map_err(Error::io(&file, "write"))?;
        }
        refuse_existing(&self.output)?;
        std::fs::rename(&self.unfinished, &self.output).map_err(Error::io(&self.output, "make"))?;
        // Empty now; if it cannot be removed nothing is lost.
        let _ = self.directory.close();
        Ok(())
    }
}

/// A link that leads nowhere is in the way as well.
fn refuse_existing(output: &Path) -> Result<(), Error> {
    match std::fs::symlink_metadata(output) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(()),
        Err(error) => Err(Error::io(output, "find")(error)),
        Ok(_) => Err(Error::Exists { path: output.to_owned() }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_name_stands_beside_the_old_one_without_its_ending() {
        for (path, output) in [
            ("bags/session", "bags/session_repaired"),
            ("bags/session/", "bags/session_repaired"),
            ("session_0.mcap", "session_0_repaired"),
            ("a/session_0.db3.zstd", "a/session_0_repaired"),
            ("a/left.right", "a/left.right_repaired"),
        ] {
            assert_eq!(default_output(Path::new(path)), Path::new(output), "{path}");
        }
    }
}
