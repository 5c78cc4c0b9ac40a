//! `body.mesh`, `body.stiffness_map` and `body.response`: from what a person wrote to a generated body or a file that can be opened.

use std::path::{Path, PathBuf};

use crate::{BodyKind, MeshSource, Parameters, Problem, SceneError};

const SCHEME: &str = "package://";

impl MeshSource {
    /// Built-in names first; then as every file.
    pub(crate) fn resolve(p: &Parameters) -> Result<MeshSource, SceneError> {
        let text = p.text("body.mesh")?;
        if let Ok(kind) = text.parse::<BodyKind>() {
            return Ok(MeshSource::BuiltIn(kind));
        }
        if text.is_empty() {
            let accepted = format!("an OBJ file or one of the generated bodies {}", BodyKind::names());
            return Err(p.error(
                "body.mesh",
                Problem::OutOfRange { value: "\"\"".to_owned(), index: None, accepted },
            ));
        }
        resolved(p, "body.mesh", text).map(MeshSource::File)
    }
}

/// The file that `key` names; none when it is "".
pub(crate) fn file_of_body(p: &Parameters, key: &'static str) -> Result<Option<PathBuf>, SceneError> {
    let text = p.text(key)?;
    if text.is_empty() { Ok(None) } else { resolved(p, key, text).map(Some) }
}

/// `package://` first; then the path, beside the parameter file when it is relative. Whether the file exists is found
/// out by who opens it.
fn resolved(p: &Parameters, key: &str, text: &str) -> Result<PathBuf, SceneError> {
    if let Some(rest) = text.strip_prefix(SCHEME) {
        let prefixes = std::env::var("AMENT_PREFIX_PATH").unwrap_or_default();
        return in_package(rest, &prefixes).ok_or_else(|| {
            let message = format!(
                "{text:?} is in no package of AMENT_PREFIX_PATH ({prefixes}); accepted: package://PACKAGE/PATH of \
                 an installed package"
            );
            p.error(key, Problem::Model(message))
        });
    }
    let path = Path::new(text);
    if path.is_absolute() {
        return Ok(path.to_owned());
    }
    let directories = p.origin().directories();
    let candidates = || directories.iter().map(|directory| directory.join(path));
    let found = candidates().find(|candidate| candidate.exists()).or_else(|| candidates().next());
    Ok(found.unwrap_or(path.to_owned()))
}

/// `PACKAGE/PATH` is `PREFIX/share/PACKAGE/PATH` of the first prefix that has it.
fn in_package(rest: &str, prefixes: &str) -> Option<PathBuf> {
    prefixes
        .split(':')
        .filter(|prefix| !prefix.is_empty())
        .map(|prefix| Path::new(prefix).join("share").join(rest))
        .find(|candidate| candidate.is_file())
}
