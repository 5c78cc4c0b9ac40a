//! Where a repair writes to.

use std::path::{Path, PathBuf};

use super::RepairError;
use crate::error::Error;
use crate::place::{Place, parent_of};

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

/// The place of a new recording `output` that is made from the one at `source`.
pub(super) fn place(output: &Path, source: &Path) -> Result<Place, RepairError> {
    let place = Place::beside(output)?;
    let parent = parent_of(output);
    let resolved = parent.canonicalize().map_err(Error::io(parent, "find"))?;
    if source.is_dir() && source.canonicalize().is_ok_and(|source| resolved.starts_with(source)) {
        return Err(RepairError::Inside { output: output.to_owned(), path: source.to_owned() });
    }
    Ok(place)
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
