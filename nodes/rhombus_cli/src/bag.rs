//! `rhombus bag`: what is in a recording, whether it is whole, and what can be saved from a broken one.

mod check;
mod info;
mod repair;
mod text;

use std::path::Path;
use std::process::ExitCode;

use clap::Subcommand;
use recording::check::{Report, check};
use rhombus_cli::guard::guarded;

/// Exit code of a command line that is not accepted: 2 is taken.
pub(crate) const WRONG_USAGE: u8 = 3;

/// Recordings: what is in them, whether they are whole, what can be saved
#[derive(Subcommand)]
pub(crate) enum Bag {
    Info(info::Info),
    Check(check::Check),
    Repair(repair::Repair),
}

impl Bag {
    pub(crate) fn run(self) -> anyhow::Result<ExitCode> {
        match self {
            Bag::Info(command) => command.run(),
            Bag::Check(command) => command.run(),
            Bag::Repair(command) => command.run(),
        }
    }
}

/// The report on a recording; where reading it panics, one that nothing can be read.
fn checked(path: &Path) -> Report {
    guarded(path, || Ok(check(path))).unwrap_or_else(|panic| Report::unreadable(path, &panic.to_string()))
}

/// An exit code says how much of a recording can be used, also where what there is to say about it cannot be printed.
fn code_despite(printed: anyhow::Result<()>, code: u8) -> ExitCode {
    if let Err(error) = printed {
        eprintln!("rhombus: {error:#}");
    }
    ExitCode::from(code)
}
