//! The command `bgdyn`, as a library: one module per subcommand.
//!
//! Errors go to stderr; exit 1 for a bad input, 2 for bad usage.
#![forbid(unsafe_code)]

mod accuracy;
mod cargo_project;
mod colour;
pub mod commands;
mod engine;
mod excite;
pub mod fuzz_invariants;
pub mod graph;
mod identify;
pub mod import;
mod output;
mod quantity;
pub mod schema;
pub mod simulate;
pub mod spec_file;
mod table;
mod template;
mod timing;
mod usage;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use usage::Usage;

#[derive(Parser)]
#[command(
    name = "bgdyn",
    version,
    about = "Rigid-body dynamics as generated Rust",
    after_help = "Example:\n  bgdyn check specs/scara.yaml"
)]
struct Arguments {
    /// Colours on stderr; `auto`: on a terminal, unless NO_COLOR is set
    #[arg(long, global = true, value_enum, value_name = "WHEN", default_value_t)]
    color: colour::Colour,
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Check(commands::check::Check),
    Ops(commands::ops::Ops),
    Eval(commands::eval::Eval),
    Equations(commands::equations::Equations),
    Generate(commands::generate::Generate),
    Graph(commands::graph::Graph),
    Simulate(commands::simulate::Simulate),
    Identify(commands::identify::Identify),
    Excite(commands::excite::Excite),
    Accuracy(commands::accuracy::Accuracy),
    Import(import::ImportArgs),
    Schema(commands::schema::Schema),
}

/// Runs the command line.
pub fn run() -> ExitCode {
    let arguments = Arguments::parse();
    arguments.color.choose();
    let done = match arguments.command {
        Command::Check(command) => command.run(),
        Command::Ops(command) => command.run(),
        Command::Eval(command) => command.run(),
        Command::Equations(command) => command.run(),
        Command::Generate(command) => command.run(),
        Command::Graph(command) => command.run(),
        Command::Simulate(command) => command.run(),
        Command::Identify(command) => command.run(),
        Command::Excite(command) => command.run(),
        Command::Accuracy(command) => command.run(),
        Command::Import(arguments) => import::run(arguments),
        Command::Schema(command) => command.run(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let text = format!("{error:#}");
            // An empty error is a refusal that was reported already.
            if !text.is_empty() {
                output::tell(&format!("bgdyn: {text}\n"));
            }
            ExitCode::from(if error.is::<Usage>() { 2 } else { 1 })
        }
    }
}
