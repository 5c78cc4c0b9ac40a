//! Where a new recording grows until it is whole.

use std::fs::File;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::error::Error;

/// A directory beside the place of a new recording, removed with everything in it unless it is finished: a failure leaves
/// nothing that looks like a recording and nothing that is in the way of the next one.
#[derive(Debug)]
pub struct Place {
    output: PathBuf,
    unfinished: PathBuf,
    directory: TempDir,
}

impl Place {
    /// For a recording `output`, which must not exist; the directory above it must.
    ///
    /// # Errors
    /// When there is something of that name, or nothing can be written beside it.
    pub fn beside(output: &Path) -> Result<Self, Error> {
        refuse_existing(output)?;
        let name = output.file_name().ok_or_else(|| Error::NotARecording {
            path: output.to_owned(),
            reason: "the path has no name at its end".to_owned(),
        })?;
        let parent = parent_of(output);
        let directory = tempfile::Builder::new()
            .prefix(".rhombus_unfinished_")
            .tempdir_in(parent)
            .map_err(Error::io(parent, "write into"))?;
        let unfinished = directory.path().join(name);
        Ok(Self { output: output.to_owned(), unfinished, directory })
    }

    /// Where the recording is until it is finished.
    pub fn unfinished(&self) -> &Path {
        &self.unfinished
    }

    /// Gives the recording its name.
    ///
    /// # Errors
    /// When it cannot be written to the disk, or something has got its name meanwhile.
    pub fn finish(self) -> Result<(), Error> {
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

/// The directory above a path.
pub(crate) fn parent_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
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
