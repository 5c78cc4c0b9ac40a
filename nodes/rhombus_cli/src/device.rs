//! `rhombus device`: which haptic devices are there, and whether one of them is fit for a hand.

mod access;
mod backends;
mod check;
mod list;
mod report;

use std::process::ExitCode;

use clap::Subcommand;

/// Haptic devices: what is connected, and whether it is fit for a hand
#[derive(Subcommand)]
pub(crate) enum Device {
    List(list::List),
    Check(check::Check),
}

impl Device {
    pub(crate) fn run(self) -> anyhow::Result<ExitCode> {
        match self {
            Device::List(command) => command.run(),
            Device::Check(command) => command.run(),
        }
    }
}
