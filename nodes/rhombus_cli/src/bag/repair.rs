//! `rhombus bag repair`: what can be read of a broken recording, as a new one.

use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::{Args, ValueHint};
use recording::repair::{Repaired, default_output, repair};
use rhombus_cli::guard::guarded;
use signal_hook::consts::{SIGINT, SIGTERM};

use super::code_despite;
use super::text::counted;
use crate::output;

/// Write what can be read of a recording to a new one of which everything can be read
///
/// Topics, QoS, definitions, times and messages stay as they were. PATH is not touched and nothing is overwritten; a full
/// disk or Ctrl-C leaves nothing behind. Exit code 0: every message that was recorded is in the new recording, which is whole.
/// 1: some are lost, or it is not known, or some are not what their type says, and are kept as recorded. 2: nothing can be read, or the new recording cannot be written. 3: wrong usage.
#[derive(Args)]
pub(crate) struct Repair {
    /// rosbag2 directory, or an .mcap or .db3 file
    #[arg(value_name = "PATH", value_hint = ValueHint::AnyPath)]
    path: PathBuf,
    /// Directory to write; by default PATH_repaired
    #[arg(short, long, value_name = "NEW", value_hint = ValueHint::DirPath)]
    output: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Repair {
    pub(crate) fn run(self) -> anyhow::Result<ExitCode> {
        let output = self.output.unwrap_or_else(|| default_output(&self.path));
        let stopped = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM] {
            signal_hook::flag::register(signal, Arc::clone(&stopped))?;
        }
        let go_on = || !stopped.load(Ordering::Relaxed);
        // What was written until a panic goes with it.
        let repaired = guarded(&self.path, || Ok(repair(&self.path, &output, &go_on)?))?;
        let printed = match self.json {
            true => output::json(&repaired),
            false => output::text(&said(&repaired)?),
        };
        let is_whole = repaired.all_saved && repaired.remaining.is_empty();
        Ok(code_despite(printed, u8::from(!is_whole)))
    }
}

fn said(repaired: &Repaired) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    for problem in &repaired.problems {
        writeln!(text, "problem: {problem}")?;
    }
    if repaired.more_problems > 0 {
        writeln!(text, "and {} more problems", repaired.more_problems)?;
    }
    for topic in &repaired.topics {
        let lost = match topic.lost {
            Some(lost) => format!("{lost} lost"),
            None => "how many are lost is not known".to_owned(),
        };
        writeln!(text, "{}: {} saved, {lost}", topic.name, topic.saved)?;
    }
    for problem in &repaired.remaining {
        writeln!(text, "remains: {problem}")?;
    }
    if repaired.more_remaining > 0 {
        writeln!(text, "and {} more remain", repaired.more_remaining)?;
    }
    let (saved, output) = (counted(repaired.saved, "message"), repaired.output.display());
    let lost = match (repaired.all_saved, repaired.lost) {
        (true, _) => "nothing lost".to_owned(),
        (false, 0) => "how many are lost, or are not as they were recorded, is not known".to_owned(),
        (false, lost) if repaired.topics.iter().any(|topic| topic.lost.is_none()) => {
            format!("at least {lost} lost")
        }
        (false, lost) => format!("{lost} lost"),
    };
    if repaired.remaining.is_empty() {
        writeln!(text, "{output}: whole: {saved} saved, {lost}")?;
    } else {
        let remains = match repaired.unlike_their_type {
            0 => "topics have messages of several kinds".to_owned(),
            1 => "1 message is not what its type says".to_owned(),
            count => format!("{count} messages are not what their type says"),
        };
        writeln!(text, "{output}: readable: {saved} saved, {lost}; {remains}; kept as recorded")?;
    }
    Ok(text)
}
