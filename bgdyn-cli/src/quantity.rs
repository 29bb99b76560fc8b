//! Parses numbers with units from the command line, by the rules of files.

use bgdyn_codegen::format::{Dimension, Number, quantity};
use bgdyn_runtime::Dd;

use crate::usage::Usage;

/// Returns the number in `text` in SI units: `30 deg`, `0.5`.
///
/// # Errors
/// The message of the parser of files, with advice.
pub(crate) fn value(text: &str, fit: &[Dimension]) -> Result<Dd, String> {
    read(text, fit).map(|number| number.value)
}

/// Returns the same with its unit.
///
/// # Errors
/// As [`value`].
pub(crate) fn read(text: &str, fit: &[Dimension]) -> Result<Number, String> {
    quantity(text, fit).map_err(|fault| match fault.help {
        Some(help) => format!("{}: {help}", fault.message),
        None => fault.message,
    })
}

/// Returns the value of a quantity with this SI unit, empty for a pure number.
///
/// # Errors
/// As [`value`].
pub(crate) fn value_in(text: &str, si: &str) -> Result<Dd, String> {
    value(text, &[Dimension::measured_in(si)])
}

/// Returns the value of an option that must be greater than 0: `--step 1 ms`.
///
/// # Errors
/// As [`value`]; also if it is not greater than 0.
pub(crate) fn positive(
    option: &str,
    text: Option<&String>,
    dimension: Dimension,
) -> Result<Option<f64>, Usage> {
    let Some(text) = text else { return Ok(None) };
    let wrong = |what: String| Usage(format!("`--{option} {text}`: {what}"));
    let number = value(text, &[dimension]).map_err(wrong)?.to_f64();
    match number > 0.0 {
        true => Ok(Some(number)),
        false => Err(wrong("write a number greater than 0".into())),
    }
}
