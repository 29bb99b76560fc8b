//! Common code of the benchmarks: a mechanism as a list of moving bodies, random states, and the
//! recursions of a textbook for comparison.
#![forbid(unsafe_code)]

pub mod clock;
pub mod inputs;
pub mod joints;
pub mod methods;
pub mod outcome;
pub mod plain;
pub mod states;

pub use textbook::mechanism as body;

use std::path::Path;

use bgdyn_codegen::mechanism::Mechanism;

/// Reads the mechanism of a spec.
///
/// # Errors
/// The file cannot be read, or every fault of the spec, as the command prints them.
pub fn read(path: &Path) -> Result<Mechanism, String> {
    let shown = path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|e| format!("{shown}: {e}"))?;
    let stem = bgdyn_codegen::files::stem(path);
    let (mechanism, faults) = bgdyn_codegen::read(&text, Some(&stem));
    mechanism.ok_or_else(|| faults.render(&shown, &text))
}
