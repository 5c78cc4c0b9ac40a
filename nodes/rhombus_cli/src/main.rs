//! `rhombus`: everything useful without ROS. Results go to stdout, errors to stderr; exit code 2 means the command
//! line or an input was not accepted.

mod bag;
#[cfg(feature = "device")]
mod device;
mod evaluate;
mod explain;
mod mesh;
mod parameters;
#[cfg(feature = "report")]
mod report;
mod stability;

use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
#[cfg(feature = "replay")]
use rhombus_cli::replay;
use rhombus_cli::{assignments, calibrate, output};

/// Contact laws, scenes and bodies of the parallel rhombus-chain model, without ROS.
#[derive(Parser)]
#[command(name = "rhombus", version, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    #[command(subcommand)]
    Bag(bag::Bag),
    Calibrate(Box<calibrate::Calibrate>),
    #[cfg(feature = "device")]
    #[command(subcommand)]
    Device(device::Device),
    Evaluate(evaluate::Evaluate),
    Explain(explain::Explain),
    #[command(subcommand)]
    Mesh(mesh::Mesh),
    Parameters(parameters::Parameters),
    #[cfg(feature = "replay")]
    Replay(Box<replay::ReplayCommand>),
    #[cfg(feature = "report")]
    Report(report::Report),
    Stability(stability::Stability),
}

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return not_accepted(&error),
    };
    let done = match arguments.command {
        Command::Bag(command) => return command.run().unwrap_or_else(|error| refused(&error)),
        Command::Calibrate(command) => command.run(),
        #[cfg(feature = "device")]
        Command::Device(command) => return command.run().unwrap_or_else(|error| refused(&error)),
        Command::Evaluate(command) => command.run(),
        Command::Explain(command) => command.run(),
        Command::Mesh(command) => command.run(),
        Command::Parameters(command) => command.run(),
        #[cfg(feature = "replay")]
        Command::Replay(command) => return command.run().unwrap_or_else(|error| refused(&error)),
        Command::Stability(command) => command.run(),
        #[cfg(feature = "report")]
        Command::Report(command) => return command.run().unwrap_or_else(|error| refused(&error)),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => refused(&error),
    }
}

fn refused(error: &anyhow::Error) -> ExitCode {
    eprintln!("rhombus: {error:#}");
    ExitCode::from(2)
}

/// Help and version are no errors. Wrong usage is 2, but for the commands that say something else with 2.
fn not_accepted(error: &clap::Error) -> ExitCode {
    // Whoever closed the pipe does not want to read it.
    let _ = error.print();
    // Whatever stands before it.
    let names = Arguments::command();
    let mut arguments = std::env::args_os().skip(1);
    let command =
        arguments.find(|argument| names.get_subcommands().any(|known| *argument == *known.get_name()));
    match error.exit_code() {
        0 => ExitCode::SUCCESS,
        _ if command.is_some_and(|command| command == "bag") => ExitCode::from(bag::WRONG_USAGE),
        _ => ExitCode::from(2),
    }
}
