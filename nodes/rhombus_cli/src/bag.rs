//! `rhombus bag`: what is in a recording, whether it is whole, and what can be saved from a broken one.

mod check;
mod guard;
mod info;
mod repair;
mod text;

use std::process::ExitCode;

use clap::Subcommand;

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
