//! What is on the page, in the order of the page; how it is written down is `html`'s and `markdown`'s business.

use super::origin::Origin;
use super::section::{Ask, Exhibit, Outcome, Section, SectionOutput, Verdict};

/// Longer tables are folded on the page, and left to their file in Markdown.
pub(crate) const ROWS_IN_SIGHT: usize = 40;

/// The whole report.
pub(crate) struct Page {
    /// Machine, commit, date.
    pub(crate) origin: Origin,
    /// The sections that were asked for.
    pub(crate) chapters: Vec<Chapter>,
}

/// A section and what became of it.
pub(crate) struct Chapter {
    /// The section.
    pub(crate) section: &'static Section,
    /// Its output, or why there is none.
    pub(crate) outcome: Result<SectionOutput, String>,
    /// How long it took, s.
    pub(crate) seconds: f64,
}

/// One line of the table at the top.
pub(crate) struct Line<'a> {
    /// The section that judges.
    pub(crate) section: &'static Section,
    /// The demand.
    pub(crate) ask: &'static Ask,
    /// What was found, or why nothing was.
    pub(crate) measured: &'a str,
    /// How it ends.
    pub(crate) outcome: Outcome,
}

impl Page {
    /// Every demand of every section, judged or not: none is ever missing.
    pub(crate) fn lines(&self) -> Vec<Line<'_>> {
        self.chapters.iter().flat_map(Chapter::lines).collect()
    }

    /// How many demands were reached, missed, not judged.
    pub(crate) fn counts(&self) -> [usize; 3] {
        let lines = self.lines();
        [Outcome::Reached, Outcome::Missed, Outcome::NotJudged]
            .map(|outcome| lines.iter().filter(|line| line.outcome == outcome).count())
    }

    /// All exhibits.
    pub(crate) fn exhibits(&self) -> impl Iterator<Item = &Exhibit> {
        self.chapters
            .iter()
            .filter_map(|chapter| chapter.outcome.as_ref().ok())
            .flat_map(|output| &output.exhibits)
    }
}

impl Chapter {
    fn lines(&self) -> impl Iterator<Item = Line<'_>> {
        self.section.asks.iter().map(|ask| {
            let found = match &self.outcome {
                Ok(output) => output.verdicts.iter().find(|verdict| verdict.what == ask.what),
                Err(_) => None,
            };
            let (measured, outcome) = match (found, &self.outcome) {
                (Some(Verdict { measured, outcome, .. }), _) => (measured.as_str(), *outcome),
                (None, Err(_)) => ("the section could not be computed, see there", Outcome::NotJudged),
                (None, Ok(_)) => ("not judged by this run", Outcome::NotJudged),
            };
            Line { section: self.section, ask, measured, outcome }
        })
    }
}

impl Outcome {
    /// The word in the table.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Outcome::Reached => "reached",
            Outcome::Missed => "MISSED",
            Outcome::NotJudged => "not judged",
        }
    }
}

impl Exhibit {
    /// The files beside the page: name and text, without the figure's SVG.
    pub(crate) fn data_files(&self) -> Vec<(String, String)> {
        let table = Some((format!("{}.csv", self.name), self.table.csv()));
        let points =
            self.figure.as_ref().map(|figure| (format!("{}.points.csv", self.name), figure.points().csv()));
        let raw = self.raw.as_ref().map(|raw| (format!("{}.raw.csv", self.name), raw.csv()));
        [table, points, raw].into_iter().flatten().collect()
    }

    /// File name of the figure.
    pub(crate) fn svg_name(&self) -> Option<String> {
        self.figure.as_ref().map(|_| format!("{}.svg", self.name))
    }

    /// The caption, with a word on points that could not be drawn.
    pub(crate) fn whole_caption(&self) -> String {
        match self.figure.as_ref().map_or(0, super::figure::Figure::undrawn) {
            0 => self.caption.clone(),
            count => format!(
                "{} {count} points at or below zero, or not finite, have no place on the axes; the CSV has them.",
                self.caption
            ),
        }
    }
}
