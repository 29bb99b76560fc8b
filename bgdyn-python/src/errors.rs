//! Raises the exceptions that `python/bgdyn/_errors.py` defines.

use bgdyn_cli::spec_file::SpecFile;
use bgdyn_codegen::fault::Faults;
use bgdyn_codegen::refusal::Refusal;
use pyo3::exceptions::{PyImportError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arrays::shown;

/// What happens at singular states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnSingular {
    /// An exception.
    Raise,
    /// NaN, and a mask.
    Nan,
}

impl OnSingular {
    /// Returns the one with this name.
    ///
    /// # Errors
    /// `ValueError` for another name.
    pub fn named(name: &str) -> PyResult<Self> {
        match name {
            "raise" => Ok(OnSingular::Raise),
            "nan" => Ok(OnSingular::Nan),
            _ => Err(PyValueError::new_err(format!(
                "on_singular=\"{name}\": it is \"raise\" or \"nan\""
            ))),
        }
    }
}

/// Where a batch has no result.
#[derive(Debug)]
pub struct Singular {
    /// What is wrong, and where.
    pub message: String,
    /// The index of the state; empty for a single state.
    pub index: Vec<usize>,
    /// The joint, if it is one.
    pub joint: Option<String>,
    /// The loop, if it is one.
    pub closes: Option<String>,
}

impl Singular {
    /// Returns the error of the state with this index, without a cause.
    pub fn new(index: Vec<usize>, what: &str) -> Self {
        let message = match index[..] {
            [] => what.to_owned(),
            _ => format!("state {}: {what}", shown(&index)),
        };
        Singular {
            message,
            index,
            joint: None,
            closes: None,
        }
    }

    /// Converts it to `bgdyn.SingularError`.
    pub fn raised(&self, py: Python<'_>) -> PyErr {
        let arguments = PyTuple::new(py, &self.index)
            .and_then(|index| (&self.message, index, &self.joint, &self.closes).into_pyobject(py));
        match arguments {
            Ok(arguments) => raised(py, "SingularError", arguments),
            Err(error) => error,
        }
    }
}

/// Returns a `bgdyn.SpecError` with this text.
pub fn spec_error(py: Python<'_>, text: &str) -> PyErr {
    match (text.trim_end(),).into_pyobject(py) {
        Ok(arguments) => raised(py, "SpecError", arguments),
        Err(error) => error,
    }
}

/// Returns a `bgdyn.SpecError` with the text of `bgdyn check` for a refused mechanism.
pub fn refused(py: Python<'_>, file: &SpecFile, faults: &Faults) -> PyErr {
    spec_error(py, &(file.render(faults) + &faults.tally()))
}

/// Returns the same for a refused scene.
pub fn scene_refused(py: Python<'_>, file: &SpecFile, refusal: Refusal) -> PyErr {
    let (findings, tally) = file.refusal(refusal);
    spec_error(py, &(findings + &tally))
}

fn raised(py: Python<'_>, class: &str, arguments: Bound<'_, PyTuple>) -> PyErr {
    let error = py
        .import("bgdyn._errors")
        .and_then(|errors| errors.getattr(class))
        .and_then(|class| class.call1(arguments));
    match error {
        Ok(error) => PyErr::from_value(error),
        Err(error) => PyImportError::new_err(error.to_string()),
    }
}
