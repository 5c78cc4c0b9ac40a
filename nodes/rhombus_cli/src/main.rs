//! `rhombus`: everything useful without ROS. Results go to stdout, errors to stderr; exit code 2 means the command
//! line or an input was not accepted.

mod assignments;
mod evaluate;
mod explain;
mod mesh;
mod output;
mod parameters;
mod stability;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Contact laws, scenes and bodies of the parallel rhombus-chain model, without ROS.
#[derive(Parser)]
#[command(name = "rhombus", version, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Evaluate(evaluate::Evaluate),
    Explain(explain::Explain),
    #[command(subcommand)]
    Mesh(mesh::Mesh),
    Parameters(parameters::Parameters),
    Stability(stability::Stability),
}

fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Evaluate(command) => command.run(),
        Command::Explain(command) => command.run(),
        Command::Mesh(command) => command.run(),
        Command::Parameters(command) => command.run(),
        Command::Stability(command) => command.run(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("rhombus: {error:#}");
            ExitCode::from(2)
        }
    }
}
