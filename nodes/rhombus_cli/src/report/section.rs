//! What a section of the report is: a function of a [`Context`] that returns text, exhibits and verdicts.

use std::path::Path;

use super::figure::Figure;
use super::lab::Lab;
use super::progress::Progress;
use super::table::Table;

/// How much time the report may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mode {
    /// Under two minutes on two cores.
    Quick,
    /// Everything.
    Full,
}

/// What a section is given.
pub(crate) struct Context<'a> {
    /// Quick or full.
    pub(crate) mode: Mode,
    /// The folder of reference solutions: `results/*.npz`, `tets/*.npz`.
    pub(crate) reference: &'a Path,
    /// References and calibrations, each made once for all sections.
    pub(crate) lab: &'a Lab,
    /// Where a section says what it does, so that a long run is seen to live.
    pub(crate) progress: &'a Progress,
}

/// One section of the report.
pub(crate) struct Section {
    /// What `--only` calls it; also the anchor in the page. Lower case, with underscores.
    pub(crate) name: &'static str,
    /// Its heading.
    pub(crate) title: &'static str,
    /// Every demand it judges, whether it gets that far or not.
    pub(crate) asks: &'static [Ask],
    /// Computes it. An error is shown in the report in the section's place, and fails the command.
    pub(crate) run: fn(&Context) -> anyhow::Result<SectionOutput>,
}

/// A demand, in the words of whoever asks.
pub(crate) struct Ask {
    /// What is judged: `flat punch, 1 chain`.
    pub(crate) what: &'static str,
    /// What would be enough: `at most 27 %`.
    pub(crate) asked: &'static str,
}

/// What a section found.
#[derive(Default)]
pub(crate) struct SectionOutput {
    /// Plain text, one entry for each paragraph, above the exhibits.
    pub(crate) text: Vec<String>,
    /// Figures with their tables, in the order of the page.
    pub(crate) exhibits: Vec<Exhibit>,
    /// One for each [`Ask`] that this mode can judge.
    pub(crate) verdicts: Vec<Verdict>,
}

/// A figure and its numbers. Files: `<name>.csv` (the table, every digit), with a figure `<name>.svg` and
/// `<name>.points.csv` (what is plotted), with raw numbers `<name>.raw.csv`.
pub(crate) struct Exhibit {
    /// Stem of the file names, unique in the report: lower case, with underscores.
    pub(crate) name: &'static str,
    /// Its heading.
    pub(crate) title: String,
    /// What is seen, under what conditions, in plain text.
    pub(crate) caption: String,
    /// The figure, where one helps.
    pub(crate) figure: Option<Figure>,
    /// The numbers, shown below the figure.
    pub(crate) table: Table,
    /// Numbers too many to be shown: every repeat, every site.
    pub(crate) raw: Option<Table>,
}

/// The answer to an [`Ask`].
pub(crate) struct Verdict {
    /// [`Ask::what`].
    pub(crate) what: &'static str,
    /// What was found, with unit.
    pub(crate) measured: String,
    /// Whether it is enough.
    pub(crate) outcome: Outcome,
}

/// How a verdict ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// At least as good as asked.
    Reached,
    /// Not as good as asked.
    Missed,
    /// Not judged in this run; `measured` says why.
    NotJudged,
}

impl Verdict {
    /// Reached or missed.
    pub(crate) fn new(what: &'static str, measured: String, reached: bool) -> Self {
        let outcome = if reached { Outcome::Reached } else { Outcome::Missed };
        Self { what, measured, outcome }
    }

    /// Not judged in this run, and why.
    pub(crate) fn not_judged(what: &'static str, why: impl Into<String>) -> Self {
        Self { what, measured: why.into(), outcome: Outcome::NotJudged }
    }
}

impl Mode {
    /// The name on the command line and in the report.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Mode::Quick => "quick",
            Mode::Full => "full",
        }
    }
}
