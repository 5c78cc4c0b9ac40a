//! Runs the Python programs: whether Python has what they need, how far they are, and their end when ours is asked for.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::time::Duration;

use anyhow::{Context, bail};
use serde::Deserialize;
use signal_hook::consts::{SIGINT, SIGTERM};

use super::progress::Progress;
use super::work::Work;

/// What the programs import beyond Python's own library.
const IMPORTS: &str = "import numpy, scipy, skfem, tetgen, pypardiso";
/// The two commands that make the environment.
const ENVIRONMENT: &str = "python3 -m venv venv && venv/bin/pip install -r tests/reference/requirements.txt, then \
                           --python venv/bin/python (Python 3.11 or newer)";
/// How long an answer is waited for before signals are looked at again.
const LOOK: Duration = Duration::from_millis(50);

/// A Python that has what the programs need.
pub(super) struct Python {
    program: PathBuf,
    /// Set when this run is asked to end.
    stopped: Arc<AtomicBool>,
}

/// A line that a program prints.
#[derive(Deserialize)]
#[serde(untagged)]
enum Line {
    Error { error: String },
    Done { done: usize, of: usize },
}

impl Python {
    /// Tries `program`.
    ///
    /// # Errors
    /// It does not start, or a package is missing; says how to get both.
    pub(super) fn find(program: &Path) -> anyhow::Result<Self> {
        let name = program.display();
        let tried = Command::new(program).args(["-c", IMPORTS]).stdin(Stdio::null()).output();
        let tried = tried.map_err(|error| {
            anyhow::anyhow!("--python {name}: cannot be started: {error}; accepted: {ENVIRONMENT}")
        })?;
        if !tried.status.success() {
            let said = String::from_utf8_lossy(&tried.stderr);
            let last =
                said.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or("it fails without a word");
            bail!("--python {name}: {last}; accepted: a Python with the packages of {ENVIRONMENT}");
        }
        let stopped = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM] {
            signal_hook::flag::register(signal, Arc::clone(&stopped)).context("cannot listen for signals")?;
        }
        Ok(Self { program: program.to_owned(), stopped })
    }

    /// An error when this run was asked to end.
    pub(super) fn check_stopped(&self, work: &Work) -> anyhow::Result<()> {
        if self.stopped.load(Ordering::Relaxed) {
            bail!("interrupted; the same command goes on where it was ({})", work.folder.display());
        }
        Ok(())
    }

    /// Runs one of the programs on a folder to its end.
    ///
    /// # Errors
    /// What it says; its end without a word; this run was asked to end, and so was it.
    pub(super) fn run(&self, program: &str, work: &Work, progress: &mut Progress) -> anyhow::Result<()> {
        let log = work.folder.join(program).with_extension("log");
        let said = File::create(&log).with_context(|| format!("{}: cannot be written", log.display()))?;
        let path = work.folder.join("python").join(program);
        let mut child = Command::new(&self.program)
            .arg(&path)
            .arg(&work.folder)
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(said)
            .spawn()
            .with_context(|| format!("--python {}: cannot be started", self.program.display()))?;
        let ended = self.follow(&mut child, work, progress);
        if ended.is_err() {
            // It may have ended by itself.
            let _ = child.kill();
        }
        let status = child.wait().with_context(|| format!("{program}: cannot be waited for"))?;
        ended?;
        if !status.success() {
            bail!("{program}: {}; what it said is in {}", how_it_ended(status), log.display());
        }
        Ok(())
    }

    /// Reads what a program prints until it closes its output.
    fn follow(&self, child: &mut Child, work: &Work, progress: &mut Progress) -> anyhow::Result<()> {
        let Some(output) = child.stdout.take() else { return Ok(()) };
        let lines = lines(output)?;
        loop {
            self.check_stopped(work)?;
            match lines.recv_timeout(LOOK) {
                Ok(line) => match serde_json::from_str(&line) {
                    Ok(Line::Error { error }) => bail!("{error}"),
                    Ok(Line::Done { done, of }) => progress.reached(done, of),
                    // A library's own words.
                    Err(_) => {}
                },
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Ok(()),
            }
        }
    }
}

/// Lines as they come, from a thread of their own: reading cannot be interrupted.
fn lines(output: impl std::io::Read + Send + 'static) -> anyhow::Result<Receiver<String>> {
    let (sender, receiver) = sync_channel(64);
    std::thread::Builder::new()
        .name("python output".to_owned())
        .spawn(move || {
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        })
        .context("no thread can be started")?;
    Ok(receiver)
}

fn how_it_ended(status: ExitStatus) -> String {
    #[cfg(unix)]
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        let killed = if signal == 9 { " (the system may have run out of memory)" } else { "" };
        return format!("ended by signal {signal}{killed}");
    }
    status.to_string()
}
