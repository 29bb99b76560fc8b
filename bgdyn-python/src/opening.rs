//! Reads and checks the text of a mechanism, for a model.

use bgdyn_cli::spec_file::SpecFile;
use bgdyn_codegen::options::{Options, formulation_named, preference_named};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::{refused, spec_error};
use crate::spec::Spec;

/// Returns the mechanism in a file, and the warnings of its check; `choice` has the names of formulation and preference.
///
/// # Errors
/// `SpecError` for a refused file, a scene, or a URDF; `ValueError` for an unknown formulation or preference, or one
/// that does not serve the mechanism.
pub fn opened(
    py: Python<'_>,
    file: SpecFile,
    choice: (Option<String>, String),
) -> PyResult<(Spec, String)> {
    let named = choice.0.as_deref().map(formulation_named).transpose();
    let options = Options {
        formulation: named.map_err(PyValueError::new_err)?,
        prefer: preference_named(&choice.1).map_err(PyValueError::new_err)?,
        ..Options::default()
    };
    if let Some(fault) = file.urdf() {
        let shown = file.path.display().to_string();
        return Err(spec_error(
            py,
            &format!("{}; or load(urdf=\"{shown}\")", fault.headline(&shown)),
        ));
    }
    if file.is_scene() {
        let shown = file.path.display();
        return Err(spec_error(
            py,
            &format!("{shown} is a scene: see bgdyn.Scene"),
        ));
    }
    let (mechanism, faults) = py.detach(|| file.read());
    let Some(mechanism) = mechanism else {
        return Err(refused(py, &file, &faults));
    };
    let warnings = file.render(&faults);
    let spec = Spec::new((file.text, file.stem), mechanism, choice, options);
    spec.checked().map_err(PyValueError::new_err)?;
    Ok((spec, warnings))
}
