//! The command line of `rhombus replay`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use anyhow::{Context, ensure};
use clap::{Args, ValueHint};
use recording::{Comparison, Digest, Outcome, Recording, Tolerances, Verdict};
use scene::topic;
use serde::Serialize;
use signal_hook::consts::{SIGINT, SIGTERM};

use super::model::{Counts, Replay};
use super::record::Record;
use super::text::plural;
use super::{json, junit, markdown, plot, text};
use crate::assignments::Assignments;
use crate::guard::guarded;
use crate::output;

/// Put the poses of a recording through the model again and compare what it answers, message by message
///
/// No ROS is needed: the model is the one of the deformation node, time is in the stamps, and equal inputs give equal bits. Frames are
/// those of the parameters and of recorded /tf and /tf_static. Exit code: 0 the same (or nothing to compare), 1 different, 2 it could not be
/// compared, as when a
/// place in RECORDING or GOLDEN cannot be read. The reports say that too, and reports of an earlier run never stay.
#[derive(Args)]
pub struct ReplayCommand {
    /// Recording with the poses: a rosbag2 directory, or an .mcap or .db3 file
    #[arg(value_name = "RECORDING", value_hint = ValueHint::AnyPath)]
    recording: PathBuf,
    /// ROS 2 parameter file of the scene
    #[arg(long, value_name = "PARAMS.yaml", value_hint = ValueHint::FilePath)]
    params: PathBuf,
    #[command(flatten)]
    assignments: Assignments,
    /// Namespace of the session in the recording; found when only one fits
    #[arg(long, value_name = "NAMESPACE")]
    namespace: Option<String>,
    /// A recorded topic under another name that no other topic has, such as /PSM1/measured_cp:=/measured_cp; may be repeated
    #[arg(long, value_name = "FROM:=TO", value_parser = remapping)]
    remap: Vec<(String, String)>,
    /// Write forces, laws, contacts, surfaces and the mesh to a new recording; a replay that fails leaves none
    #[arg(long, value_name = "NEW", value_hint = ValueHint::AnyPath)]
    record: Option<PathBuf>,
    /// Compare with this recording; it may be RECORDING itself
    #[arg(long, value_name = "GOLDEN", value_hint = ValueHint::AnyPath)]
    expect: Option<PathBuf>,
    /// Accept |computed - golden| <= ABS + REL |golden| on a topic or one field of it; every bit counts otherwise
    #[arg(long, value_name = "TOPIC[.FIELD]=ABS,REL", requires = "expect")]
    tolerance: Vec<String>,
    /// Plot golden and computed signals and their difference
    #[arg(long, value_name = "FILE.svg", requires = "expect", value_hint = ValueHint::FilePath)]
    plot: Option<PathBuf>,
    /// JUnit XML, a test case for each topic
    #[arg(long, value_name = "FILE.xml", requires = "expect", value_hint = ValueHint::FilePath)]
    junit: Option<PathBuf>,
    /// Markdown for the summary of a CI job
    #[arg(long, value_name = "FILE.md", requires = "expect", value_hint = ValueHint::FilePath)]
    markdown: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// What is printed as JSON.
#[derive(Serialize)]
struct Report<'a> {
    recording: &'a Path,
    #[serde(flatten)]
    counts: &'a Counts,
    /// Recorded time that was replayed, s, and what the replay took.
    recorded_s: f64,
    elapsed_s: f64,
    sha256: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    comparison: Option<json::Json>,
}

fn remapping(text: &str) -> Result<(String, String), String> {
    match text.split_once(":=") {
        Some((from, to)) if from.starts_with('/') && to.starts_with('/') => {
            Ok((from.to_owned(), to.to_owned()))
        }
        _ => Err("accepted: FROM:=TO, both absolute, such as /PSM1/measured_cp:=/measured_cp".to_owned()),
    }
}

impl ReplayCommand {
    /// Runs it; the exit code says whether the recording is still the same.
    ///
    /// # Errors
    /// Something could not be read, replayed or written.
    pub fn run(&self) -> anyhow::Result<ExitCode> {
        // Whatever ends this program: no report of an earlier run must pass for one of this.
        self.write_reports(&self.not_compared("the replay did not come to its end"), Path::is_file)?;
        let judged = guarded(&self.recording, || self.judged());
        if let Err(error) = &judged {
            // The error is told in any case, and no older report is left.
            let _ = self.write_reports(&self.not_compared(&format!("{error:#}")), |_| true);
        }
        judged
    }

    /// The outcome where there is no comparison.
    fn not_compared(&self, reason: &str) -> Outcome {
        let golden = self.expect.clone().unwrap_or_default();
        Outcome { golden, topics: Vec::new(), verdict: Verdict::NotCompared(reason.to_owned()) }
    }

    fn judged(&self) -> anyhow::Result<ExitCode> {
        let scene = self.assignments.scene(&self.params)?;
        let recording = Recording::open(&self.recording)?;
        let golden = self.expect.as_ref().map(Recording::open).transpose()?;
        let replay = Replay::new(&recording, &scene, self.namespace.as_deref(), &self.remap)?;
        let topics = replay.topics().to_vec();
        let judged: Vec<String> = topics
            .iter()
            .filter(|output| !output.name.ends_with(topic::BODY_MESH))
            .filter(|output| {
                !output.name.ends_with(topic::SURFACE_DISPLACEMENT) || scene.surface.rate_hz > 0.0
            })
            .map(|output| output.name.clone())
            .collect();
        let mut comparison = match &golden {
            Some(golden) => Some(Comparison::new(golden, Tolerances::parse(&self.tolerance)?, &judged)?),
            None => None,
        };
        let mut record = match &self.record {
            Some(directory) => Some(Record::create(directory, &topics, &recording)?),
            None => None,
        };
        let stopped = Arc::new(AtomicBool::new(false));
        if record.is_some() {
            for signal in [SIGINT, SIGTERM] {
                signal_hook::flag::register(signal, Arc::clone(&stopped))?;
            }
        }
        let mut digest = Digest::new();
        let began = Instant::now();
        let counts = replay.run(|output| {
            ensure!(!stopped.load(Ordering::Relaxed), "interrupted; nothing is left behind");
            let name = &topics[output.topic].name;
            digest.take(name, output.data)?;
            if let Some(comparison) = &mut comparison {
                comparison.take(name, output.data);
            }
            if let Some(record) = &mut record {
                record.take(&output)?;
            }
            Ok(())
        })?;
        let mut outcome = comparison.map(Comparison::finish);
        let elapsed_s = began.elapsed().as_secs_f64();
        ensure!(counts.poses > 0, "{}: no pose could be read from it", self.recording.display());
        if let Some(Outcome { verdict, .. }) = &mut outcome
            && !matches!(verdict, Verdict::NotCompared(_))
            && let Some(reason) = self.unread(&counts)
        {
            // What is the same, or differs, may be so because of what could not be read.
            *verdict = Verdict::NotCompared(reason);
        }
        let report = Report {
            recording: &self.recording,
            counts: &counts,
            recorded_s: counts.stamps_ns.map_or(0.0, |(first, last)| last.abs_diff(first) as f64 * 1e-9),
            elapsed_s,
            sha256: digest.finish().to_string(),
            comparison: outcome.as_ref().map(json::json),
        };
        if let Some(outcome) = &outcome {
            self.write_reports(outcome, |_| true)?;
        }
        if let Some(record) = record {
            record.close()?;
        }
        match self.json {
            true => output::json(&report)?,
            false => output::text(&in_words(&report, outcome.as_ref()))?,
        }
        Ok(ExitCode::from(outcome.map_or(0, |outcome| outcome.verdict.exit_code())))
    }

    /// Why not all of the recording was replayed.
    fn unread(&self, counts: &Counts) -> Option<String> {
        (counts.unreadable_places > 0).then(|| {
            let places = plural(counts.unreadable_places, "place");
            let path = self.recording.display();
            format!("{places} of {path} could not be read; `rhombus bag check` says which, `rhombus bag repair` saves the rest")
        })
    }

    /// Writes the reports that are asked for, at paths that are `wanted`.
    fn write_reports(&self, outcome: &Outcome, wanted: fn(&Path) -> bool) -> anyhow::Result<()> {
        let write = |path: &Path, content: String| {
            std::fs::write(path, content).with_context(|| format!("{}: cannot write", path.display()))
        };
        let wanted = |path: &Option<PathBuf>| path.clone().filter(|path| wanted(path));
        let plot = self.plot.as_deref().filter(|_| !outcome.topics.is_empty()).and_then(Path::file_name);
        let plot = plot.map(|name| name.to_string_lossy());
        let in_markdown = || markdown::markdown(outcome, plot.as_deref());
        // One that cannot be written keeps none of the others from being written.
        let written = [
            wanted(&self.plot).map(|path| plot::svg(outcome).and_then(|svg| write(&path, svg))),
            wanted(&self.junit).map(|path| write(&path, junit::junit(outcome))),
            wanted(&self.markdown).map(|path| write(&path, in_markdown())),
        ];
        written.into_iter().flatten().collect()
    }
}

fn in_words(report: &Report<'_>, outcome: Option<&Outcome>) -> String {
    let counts = report.counts;
    let mut words = format!(
        "{}: {} over {:.1} s replayed in {:.2} s ({:.0} x real time), {}\n",
        report.recording.display(),
        plural(counts.poses, "pose"),
        report.recorded_s,
        report.elapsed_s,
        report.recorded_s / report.elapsed_s.max(1e-9),
        plural(counts.surfaces, "surface"),
    );
    let causes = counts.rejected.iter().zip(rhombus_chain::Rejection::CAUSES);
    for (count, cause) in causes.filter(|(count, _)| **count > 0) {
        words.push_str(&format!("{} rejected: {cause}\n", plural(*count, "pose")));
    }
    if counts.unusable > 0 {
        let messages = plural(counts.unusable, "message");
        words.push_str(&format!("{messages} of the model's inputs could not be used\n"));
    }
    if counts.unreadable_places > 0 {
        words.push_str(&format!(
            "{} of the recording could not be read; `rhombus bag check` says which\n",
            plural(counts.unreadable_places, "place")
        ));
    }
    words.push_str(&format!("SHA-256 of all forces and displacements: {}\n", report.sha256));
    if let Some(outcome) = outcome {
        words.push_str(&text::text(outcome));
    }
    words
}
