//! The command `bgdyn`: calls the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    bgdyn_cli::run()
}
