//! What a calibration leaves behind: a parameter file, and beside it the regional stiffness map.
//!
//! Nothing is overwritten unless it is asked for, and nothing is left half done: both files are complete under another
//! name before they get theirs.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use rhombus_chain::ChainParameters;
use scene::StiffnessFile;
use tempfile::NamedTempFile;

use super::fitted::Fitted;

/// What a parameter file says besides the chains.
pub(super) struct Output<'a> {
    pub(super) fitted: &'a Fitted,
    /// What was fitted to, in words.
    pub(super) source: &'a str,
    /// The body the chains are for; `None` leaves it open.
    pub(super) body: Option<BodyLines>,
    /// One factor for each vertex of that body.
    pub(super) map: Option<&'a [f64]>,
    /// Files that are written before the parameter file, which names them.
    pub(super) beside: Vec<(PathBuf, Vec<u8>)>,
}

/// `body.mesh`, `body.scale` and `body.response`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BodyLines {
    pub(super) mesh: String,
    pub(super) scale: f64,
    /// File name of a calibrated body.
    pub(super) response: Option<String>,
}

/// How the names of unfinished files begin.
pub(super) const HIDDEN: &str = ".rhombus-calibrate-";

/// Where the map of a parameter file goes: beside it.
pub(super) fn map_path(path: &Path) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}_stiffness.csv"))
}

/// Refuses what would be overwritten, before anything is computed.
pub(super) fn check_free(path: &Path, with_map: bool, force: bool) -> anyhow::Result<()> {
    if path.file_name().is_none() {
        bail!("--output {}: accepted: the name of a file", path.display());
    }
    let map = with_map.then(|| map_path(path));
    check_free_all(std::iter::once(path.to_owned()).chain(map), force)
}

/// As [`check_free`], for any files.
pub(super) fn check_free_all(paths: impl IntoIterator<Item = PathBuf>, force: bool) -> anyhow::Result<()> {
    for path in paths {
        if path.symlink_metadata().is_ok() {
            if !force {
                bail!("{} exists; --force replaces it", path.display());
            }
            if path.is_dir() {
                bail!("{} is a folder; accepted: the name of a file", path.display());
            }
        }
    }
    Ok(())
}

impl Output<'_> {
    /// Writes the parameter file, and the map if there is one. Returns what was written.
    pub(super) fn write(&self, path: &Path, force: bool) -> anyhow::Result<Vec<PathBuf>> {
        check_free(path, self.map.is_some(), force)?;
        let text = self.text(path);
        let mut files: Vec<(PathBuf, Vec<u8>)> = self.beside.clone();
        check_free_all(files.iter().map(|(path, _)| path.clone()), force)?;
        if let Some(factors) = self.map {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let comment = format!(
                "Regional stiffness of {name}: factor on the force for each vertex.\n{}",
                self.source
            );
            let map = StiffnessFile { comment: &comment, factors };
            files.push((map_path(path), map.to_string().into_bytes()));
        }
        files.push((path.to_owned(), text.into_bytes()));
        let mut finished = Vec::new();
        for (path, bytes) in files {
            finished.push((unfinished(&path, &bytes)?, path));
        }
        // The parameter file comes last: it is there only when all it names is.
        finished
            .into_iter()
            .map(|(file, path)| {
                name(file, &path, force)?;
                Ok(path)
            })
            .collect()
    }

    fn text(&self, path: &Path) -> String {
        let Fitted { formulation, chains, surface, probe_radius_m, reached, notes } = self.fitted;
        let mut text = format!("# Made by rhombus calibrate {}.\n", env!("CARGO_PKG_VERSION"));
        comment(&mut text, &format!("Fitted to {}.", self.source));
        text.push_str("#\n# Error reached:\n");
        for reached in reached {
            comment(&mut text, &format!("  {:>9}  {}", percent(reached.relative), reached.what));
        }
        if !notes.is_empty() {
            text.push_str("#\n# Not told by the data:\n");
        }
        for note in notes {
            comment(&mut text, &format!("  {note}"));
        }
        let numbers = |value: fn(&ChainParameters) -> f64| {
            let all: Vec<String> = chains.iter().map(|chain| number(value(chain))).collect();
            format!("[{}]", all.join(", "))
        };
        let units: Vec<String> = chains.iter().map(|chain| chain.units.to_string()).collect();
        let mut lines = vec![(0, "/**:".to_owned()), (1, "ros__parameters:".to_owned())];
        if let Some(body) = &self.body {
            lines.push((2, "body:".to_owned()));
            lines.push((3, format!("mesh: {}", quoted(&body.mesh))));
            lines.push((3, format!("scale: {}", number(body.scale))));
            if let Some(response) = &body.response {
                lines.push((3, format!("response: {}", quoted(response))));
            }
            if self.map.is_some() {
                let map = map_path(path);
                let name = map.file_name().unwrap_or_default().to_string_lossy();
                lines.push((3, format!("stiffness_map: {}", quoted(&name))));
            }
        }
        let chains = [
            ("formulation", formulation.to_string()),
            ("rod_length", numbers(|chain| chain.rod_length_m)),
            ("angle", numbers(|chain| chain.angle_rad)),
            ("ratio", numbers(|chain| chain.ratio)),
            ("units", format!("[{}]", units.join(", "))),
            ("normal_stiffness", numbers(|chain| chain.normal_stiffness_n_per_m)),
            ("tangential_stiffness", numbers(|chain| chain.tangential_stiffness_n_per_m)),
            ("tangential_growth", numbers(|chain| chain.tangential_growth)),
            ("weight", numbers(|chain| chain.weight)),
            ("pitch", numbers(|chain| chain.pitch_m)),
        ];
        let surface = [
            ("cutoff", number(surface.cutoff)),
            ("expansion", number(surface.expansion)),
            ("spread", surface.spread.to_string()),
        ];
        let probe = [
            ("radius", number(*probe_radius_m)),
            ("contact_radius", number(self.fitted.surface.contact_radius_m)),
        ];
        for (group, values) in [("chains", &chains[..]), ("surface", &surface), ("probe", &probe)] {
            lines.push((2, format!("{group}:")));
            lines.extend(values.iter().map(|(name, value)| (3, format!("{name}: {value}"))));
        }
        for (depth, line) in lines {
            // Writing to a String does not fail.
            let _ = writeln!(text, "{}{line}", "  ".repeat(depth));
        }
        text
    }
}

/// Writes a file that is there whole or not at all.
///
/// # Errors
/// It cannot be written, or exists and is not to be replaced.
pub(super) fn put(path: &Path, bytes: &[u8], replace: bool) -> anyhow::Result<()> {
    name(unfinished(path, bytes)?, path, replace)
}

/// Gives a finished file its name.
fn name(file: NamedTempFile, path: &Path, replace: bool) -> anyhow::Result<()> {
    let put = if replace { file.persist(path) } else { file.persist_noclobber(path) };
    put.map(drop)
        .map_err(|error| error.error)
        .with_context(|| format!("{}: cannot be written", path.display()))
}

/// The bytes under a hidden name in the folder of `path`, on the disk; it goes away when it is dropped.
fn unfinished(path: &Path, bytes: &[u8]) -> anyhow::Result<NamedTempFile> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let write = || {
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644));
        let mut file = builder.prefix(HIDDEN).tempfile_in(folder)?;
        file.write_all(bytes)?;
        file.as_file().sync_all()?;
        Ok::<_, std::io::Error>(file)
    };
    write().with_context(|| format!("{}: cannot be written", path.display()))
}

/// A share as a percentage with three digits.
pub(super) fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    match percent {
        _ if percent < 1e-6 => format!("{percent:.1e} %"),
        _ if percent < 1.0 => format!("{percent:.3} %"),
        _ if percent < 10.0 => format!("{percent:.2} %"),
        _ => format!("{percent:.1} %"),
    }
}

fn comment(text: &mut String, line: &str) {
    let line: String = line.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    text.push_str("# ");
    text.push_str(line.trim_end());
    text.push('\n');
}

/// A number that reads back to the same bits, with the decimal point ROS 2 wants in every number.
fn number(value: f64) -> String {
    let text = format!("{value:?}");
    match text.split_once('e') {
        Some((mantissa, exponent)) if !mantissa.contains('.') => format!("{mantissa}.0e{exponent}"),
        _ => text,
    }
}

/// Text in double quotes, as YAML and JSON have it.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
