//! `rhombus bag check`: whether a recording is whole, for people and for scripts.

use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueHint};
use recording::check::{Report, Verdict};

use super::text::verdict;
use super::{checked, code_despite};
use crate::output;

/// Read all of a recording and say whether it is whole
///
/// Exit code 0: whole. 1: damaged, and some of it can be read. 2: nothing of it can be read, or it is a directory of several
/// recordings without a metadata.yaml that says which files are one. 3: wrong usage. What is odd and harms nothing (stamps
/// that jump back, no poses) is a remark and changes no exit code.
#[derive(Args)]
pub(crate) struct Check {
    /// rosbag2 directory, or an .mcap or .db3 file
    #[arg(value_name = "PATH", value_hint = ValueHint::AnyPath)]
    path: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Check {
    pub(crate) fn run(self) -> anyhow::Result<ExitCode> {
        let report = checked(&self.path);
        let printed = match self.json {
            true => output::json(&report),
            false => output::text(&said(&report)?),
        };
        Ok(code_despite(printed, code(report.verdict)))
    }
}

/// The exit code of a verdict.
fn code(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::Whole => 0,
        Verdict::Damaged => 1,
        Verdict::Unreadable => 2,
    }
}

fn said(report: &Report) -> Result<String, std::fmt::Error> {
    let mut text = format!("{}\n", verdict(report));
    for problem in &report.problems {
        writeln!(text, "  problem: {problem}")?;
    }
    if report.more_problems > 0 {
        writeln!(text, "  and {} more problems", report.more_problems)?;
    }
    for remark in &report.remarks {
        writeln!(text, "  remark: {remark}")?;
    }
    match report.verdict {
        Verdict::Damaged if report.repairable => {
            writeln!(text, "  what to do: rhombus bag repair {}", report.path.display())?;
        }
        Verdict::Damaged => {
            text.push_str("  a repair changes nothing about it: messages are kept as they were recorded\n");
        }
        Verdict::Whole | Verdict::Unreadable => {}
    }
    Ok(text)
}
