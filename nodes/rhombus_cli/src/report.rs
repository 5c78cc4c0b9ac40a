//! `rhombus report`: what the model is worth, measured here and now, beside its peers.

mod beyond;
mod bodies;
mod calibrated;
mod clockwork;
mod closed_loop;
mod depth;
mod elapsed;
mod figure;
mod half_space;
mod html;
mod lab;
mod liver;
mod markdown;
mod origin;
mod page;
mod plot;
mod profiles;
mod progress;
mod run_time;
mod section;
mod stability_map;
mod staging;
mod subject;
mod table;
mod truth;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use clap::{Args, ValueHint};

use lab::Lab;
use origin::Origin;
use page::{Chapter, Page};
use progress::Progress;
use section::{Context, Mode, Section};
use staging::Staging;

use rhombus_cli::output;

/// Every section, in the order of the page.
const SECTIONS: &[Section] = &[
    half_space::SECTION,
    liver::SECTION,
    calibrated::SECTION,
    run_time::SECTION,
    depth::SECTION,
    profiles::SECTION,
    beyond::SECTION,
    elapsed::SECTION,
    stability_map::SECTION,
    closed_loop::SECTION,
];

/// Measure error, run time and stability here, beside other models: HTML, Markdown, SVG and CSV
///
/// Writes DIR whole or not at all. Exit code 1 when a section could not be computed (the report says why in its place),
/// 2 when the command line is not accepted. Measure with a release build on a quiet machine.
#[derive(Args)]
pub(crate) struct Report {
    /// Folder to make
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    out: PathBuf,
    /// Under two minutes (default)
    #[arg(long, conflicts_with = "full")]
    quick: bool,
    /// Everything; the largest peers take their time
    #[arg(long)]
    full: bool,
    /// Folder of reference solutions
    #[arg(long, value_name = "DIR", default_value = "tests/reference", value_hint = ValueHint::DirPath)]
    reference: PathBuf,
    /// Replace DIR, once the new report is whole, if it is a report
    #[arg(long)]
    force: bool,
    /// Sections to compute; all by default
    #[arg(long, value_name = "SECTION", num_args = 1.., value_delimiter = ',', value_parser = known_section)]
    only: Vec<&'static Section>,
}

fn known_section(name: &str) -> Result<&'static Section, String> {
    SECTIONS.iter().find(|section| section.name == name).ok_or_else(|| {
        let names: Vec<&str> = SECTIONS.iter().map(|section| section.name).collect();
        format!("accepted: {}", names.join(", "))
    })
}

impl Report {
    pub(crate) fn run(self) -> anyhow::Result<ExitCode> {
        // --quick says what holds anyway: it is there so that a script can say so.
        let mode = if self.full { Mode::Full } else { Mode::Quick };
        let staging = Staging::new(&self.out, self.force)?;
        let asked =
            |section: &&Section| self.only.is_empty() || self.only.iter().any(|own| own.name == section.name);
        let sections: Vec<&'static Section> = SECTIONS.iter().filter(asked).collect();
        let progress = Progress::new(sections.len());
        let lab = Lab::new(self.reference.clone());
        let context = Context { mode, reference: &self.reference, lab: &lab, progress: &progress };
        let origin = Origin::new(mode);
        let chapters = sections.into_iter().map(|section| compute(section, &context)).collect();
        let page = Page { origin, chapters };
        write(&page, &staging)?;
        progress.finish();
        staging.publish()?;
        let [reached, missed, open] = page.counts();
        let place = self.out.display();
        output::text(&format!(
            "{place}/index.html: of the demands {reached} reached, {missed} missed, {open} not judged\n"
        ))?;
        let failed: Vec<&str> = page
            .chapters
            .iter()
            .filter(|chapter| chapter.outcome.is_err())
            .map(|chapter| chapter.section.name)
            .collect();
        if !failed.is_empty() {
            eprintln!("rhombus: {place} is written, without: {}", failed.join(", "));
            return Ok(ExitCode::FAILURE);
        }
        Ok(ExitCode::SUCCESS)
    }
}

fn compute(section: &'static Section, context: &Context) -> Chapter {
    context.progress.section(section.name);
    let start = Instant::now();
    let outcome = (section.run)(context).map_err(|error| format!("{error:#}"));
    if let Err(problem) = &outcome {
        context.progress.say(&format!("{}: not computed: {problem}", section.name));
    }
    context.progress.done();
    Chapter { section, outcome, seconds: start.elapsed().as_secs_f64() }
}

fn write(page: &Page, staging: &Staging) -> anyhow::Result<()> {
    let mut figures = BTreeMap::new();
    for exhibit in page.exhibits() {
        for (name, text) in exhibit.data_files() {
            staging.write(&name, &text)?;
        }
        if let (Some(figure), Some(name)) = (&exhibit.figure, exhibit.svg_name()) {
            let svg = plot::svg(figure)?;
            staging.write(&name, &svg)?;
            figures.insert(exhibit.name, svg);
        }
    }
    staging.write("index.html", &html::page(page, &figures))?;
    staging.write("report.md", &markdown::page(page))?;
    staging.write(staging::MARK, &serde_json::to_string_pretty(&page.origin)?)
}
