//! `body.mesh`: from what a person wrote to a generated body or a file that can be opened.

use std::path::{Path, PathBuf};

use crate::{BodyKind, MeshSource, Parameters, Problem, SceneError};

const SCHEME: &str = "package://";

impl MeshSource {
    /// Built-in names first; then `package://`; then the path, beside the parameter file when it is relative. Whether
    /// the file exists is found out by who opens it.
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
        if let Some(rest) = text.strip_prefix(SCHEME) {
            let prefixes = std::env::var("AMENT_PREFIX_PATH").unwrap_or_default();
            return in_package(rest, &prefixes).map(MeshSource::File).ok_or_else(|| {
                let message = format!(
                    "{text:?} is in no package of AMENT_PREFIX_PATH ({prefixes}); accepted: package://PACKAGE/PATH of \
                     an installed package"
                );
                p.error("body.mesh", Problem::Model(message))
            });
        }
        let path = Path::new(text);
        let directories = p.origin().directories();
        let candidates = || directories.iter().map(|directory| directory.join(path));
        let found = candidates().find(|candidate| candidate.exists()).or_else(|| candidates().next());
        Ok(MeshSource::File(if path.is_absolute() {
            path.to_owned()
        } else {
            found.unwrap_or(path.to_owned())
        }))
    }
}

/// `PACKAGE/PATH` is `PREFIX/share/PACKAGE/PATH` of the first prefix that has it.
fn in_package(rest: &str, prefixes: &str) -> Option<PathBuf> {
    prefixes
        .split(':')
        .filter(|prefix| !prefix.is_empty())
        .map(|prefix| Path::new(prefix).join("share").join(rest))
        .find(|candidate| candidate.is_file())
}
