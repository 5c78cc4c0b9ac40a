//! `rhombus bag info`: what is in a recording.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueHint};
use recording::check::Verdict;

use super::text;
use super::{checked, code_despite};
use crate::output;

/// What a recording holds: topics, rates, gaps, stamps, QoS, types
///
/// Exit code 0 when something of it can be read, 2 when nothing can, 3 for wrong usage.
#[derive(Args)]
pub(crate) struct Info {
    /// rosbag2 directory, or an .mcap or .db3 file
    #[arg(value_name = "PATH", value_hint = ValueHint::AnyPath)]
    path: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Info {
    pub(crate) fn run(self) -> anyhow::Result<ExitCode> {
        let report = checked(&self.path);
        let printed = match self.json {
            true => output::json(&report),
            false => output::text(&text::overview(&report)?),
        };
        let code = match report.verdict {
            Verdict::Unreadable => 2,
            Verdict::Whole | Verdict::Damaged => 0,
        };
        Ok(code_despite(printed, code))
    }
}
