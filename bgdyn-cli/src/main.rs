//! The command `bgdyn`.

use std::process::ExitCode;

fn main() -> ExitCode {
    bgdyn_cli::run()
}
