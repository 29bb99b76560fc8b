//! Writes to standard output with error handling, and to standard error without.
//!
//! A reader that closes the pipe causes neither a panic nor a failure.

use std::io::{ErrorKind, Write};

use anyhow::{Context, Result};

use crate::colour::painted;

/// Writes to stdout, whose reader may stop early (`| head -1`).
pub(crate) fn print(text: &str) -> Result<()> {
    let mut stdout = std::io::stdout().lock();
    let written = stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush());
    match written {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        other => other.context("stdout cannot be written"),
    }
}

/// Writes to stderr; a failure cannot be reported.
pub(crate) fn tell(text: &str) {
    let _ = std::io::stderr().lock().write_all(painted(text).as_bytes());
}
