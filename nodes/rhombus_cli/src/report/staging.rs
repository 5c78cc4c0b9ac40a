//! The report's folder: nothing of it is seen before it is whole, and an interrupted run leaves nothing.
//!
//! Everything is written into a hidden sibling of the target, which is renamed at the end. SIGINT, SIGTERM and SIGHUP
//! remove the sibling and end the process with the usual 128 + signal number.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use anyhow::{Context, Result, bail, ensure};
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;

/// Only a folder that has this file is ever replaced.
pub(crate) const MARK: &str = "rhombus-report.json";

/// A report in the making. Dropped before [`publish`](Self::publish), it leaves nothing.
pub(crate) struct Staging {
    target: PathBuf,
    replaces: bool,
    /// The hidden sibling; `None` once it is published. Whoever holds the lock may remove or rename it.
    folder: Arc<Mutex<Option<tempfile::TempDir>>>,
    path: PathBuf,
}

impl Staging {
    /// Makes the hidden sibling of `target` and watches for signals from now on.
    ///
    /// # Errors
    /// `target` exists and `replaces` is false, or it is no report; its parent is not there or cannot be written.
    pub(crate) fn new(target: &Path, replaces: bool) -> Result<Self> {
        let shown = target.display();
        if target.symlink_metadata().is_ok() {
            ensure!(replaces, "{shown} exists; --force replaces it once the new report is whole");
            ensure!(
                target.join(MARK).is_file(),
                "{shown} exists and is not a report (it has no {MARK}); it is not replaced, not even with --force"
            );
        }
        let Some(name) = target.file_name().map(|name| name.to_string_lossy().into_owned()) else {
            bail!("{shown} has no name of its own; accepted: a folder to be made, such as report");
        };
        let parent = parent_of(target);
        // Watched first: from its first moment on, the folder goes with the process.
        let folder = Arc::new(Mutex::new(None));
        watch_signals(Arc::clone(&folder))?;
        let mut slot = lock(&folder);
        let made = tempfile::Builder::new()
            .prefix(&format!(".{name}.unfinished-"))
            .tempdir_in(parent)
            .with_context(|| format!("no folder can be made in {}", parent.display()))?;
        let path = made.path().to_owned();
        *slot = Some(made);
        drop(slot);
        Ok(Self { target: target.to_owned(), replaces, folder, path })
    }

    /// Writes one file of the report.
    pub(crate) fn write(&self, name: &str, text: &str) -> Result<()> {
        let path = self.path.join(name);
        std::fs::write(&path, text).with_context(|| format!("{} cannot be written", path.display()))
    }

    /// Puts the whole report in place.
    ///
    /// # Errors
    /// The target has come into being meanwhile, or cannot be renamed; the old report is then where it was.
    pub(crate) fn publish(self) -> Result<()> {
        let mut folder = lock(&self.folder);
        readable_by_others(&self.path)?;
        let target = self.target.display();
        let aside = tempfile::Builder::new().prefix(".replaced-").tempdir_in(parent_of(&self.target))?;
        let old = aside.path().join("report");
        if self.target.symlink_metadata().is_ok() {
            ensure!(
                self.replaces,
                "{target} has come into being meanwhile; it is not replaced without --force"
            );
            std::fs::rename(&self.target, &old).with_context(|| format!("{target} cannot be put aside"))?;
        }
        if let Err(error) = std::fs::rename(&self.path, &self.target) {
            if old.exists() {
                std::fs::rename(&old, &self.target)
                    .with_context(|| format!("the old report is now {}", old.display()))?;
            }
            return Err(error).with_context(|| format!("{target} cannot be made"));
        }
        // What it guarded is published: nothing is left to remove.
        if let Some(folder) = folder.take() {
            let _ = folder.keep();
        }
        Ok(())
    }
}

fn parent_of(target: &Path) -> &Path {
    match target.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

/// Temporary folders are private; a report is as readable as any other folder its maker makes.
fn readable_by_others(path: &Path) -> Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let probe = path.join(".mode");
        std::fs::create_dir(&probe)?;
        let mode = std::fs::metadata(&probe)?.permissions().mode();
        std::fs::remove_dir(&probe)?;
        std::fs::set_permissions(path, std::fs::Permissions::from_mode(mode))?;
    }
    Ok(())
}

fn watch_signals(folder: Arc<Mutex<Option<tempfile::TempDir>>>) -> Result<()> {
    let mut signals = Signals::new([SIGINT, SIGTERM, SIGHUP])?;
    std::thread::Builder::new().name("signals".to_owned()).spawn(move || {
        if let Some(signal) = signals.forever().next() {
            // Held until the end of the process: publishing does not begin while the folder is removed.
            let mut folder = lock(&folder);
            if let Some(unfinished) = folder.take() {
                drop(unfinished);
                eprintln!("\nrhombus report: interrupted; nothing is left behind");
            }
            std::process::exit(128 + signal);
        }
    })?;
    Ok(())
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
