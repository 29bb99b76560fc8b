//! The generated source of a model: what Python asks for, and the files that a backend writes.

use bgdyn_cli::spec_file::SpecFile;
use bgdyn_codegen::SpecText;
use bgdyn_codegen::backend::{Backend, FilesError, GeneratedFile, GivenOptions, backend_named};
use bgdyn_codegen::options::{BundleOption, Options};
use bgdyn_codegen::pipeline::generate_files;
use bgdyn_codegen::refusal::Refusal;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyMapping, PyString};

use crate::spec::Spec;

/// What is generated.
pub struct SourceRequest {
    /// The names of the methods; without them those that `bgdyn generate` chooses.
    methods: Option<Vec<String>>,
    bundles: Vec<BundleOption>,
    backend: &'static dyn Backend,
    /// Names and values of the backend's options.
    options: Vec<(String, String)>,
}

impl SourceRequest {
    /// Reads the arguments of `Model.source`: a name or a list of names, a dictionary of such, the name of a backend, and
    /// a dictionary of texts.
    ///
    /// # Errors
    /// `TypeError` for arguments of another kind, `ValueError` for an unknown backend.
    pub fn new(
        method: Option<&Bound<'_, PyAny>>,
        bundles: Option<&Bound<'_, PyAny>>,
        backend: &str,
        options: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let methods = method.map(|given| names("method", given)).transpose()?;
        let mut all = Vec::new();
        for (name, methods) in entries("bundles", "{name: [method, …]}", bundles)? {
            let methods = names(&format!("bundles[\"{name}\"]"), &methods)?;
            all.push(BundleOption { name, methods });
        }
        let mut given = Vec::new();
        for (name, value) in entries("options", "{name: text}", options)? {
            let Ok(text) = value.extract() else {
                let message = format!("`options[\"{name}\"]` is a text, not {}", value.repr()?);
                return Err(PyTypeError::new_err(message));
            };
            given.push((name, text));
        }
        Ok(SourceRequest {
            methods,
            bundles: all,
            backend: backend_named(backend).map_err(PyValueError::new_err)?,
            options: given,
        })
    }

    /// Returns the files with the functions of a mechanism, which are compared with equation (6) first.
    ///
    /// # Errors
    /// The text of `bgdyn generate` for unknown names and options, and for functions that differ from equation (6).
    pub fn files(self, spec: &Spec) -> Result<Vec<GeneratedFile>, String> {
        let options = Options {
            methods: self.methods,
            bundles: self.bundles,
            ..spec.options.clone()
        };
        let (file, backend) = (format!("{}.yaml", spec.name), self.backend);
        let (name, known) = (backend.name(), backend.options());
        let given = GivenOptions::new(file.clone(), name, known, self.options);
        let given = given.map_err(|error| error.to_string())?;
        let text = SpecText::mechanism(&spec.text, &spec.name);
        match generate_files(&text, &options, backend, &given) {
            Ok((files, _)) => Ok(files),
            Err(FilesError::Backend(error)) => Err(error.to_string()),
            Err(FilesError::Refused(refusal)) => Err(refused(spec, file, refusal)),
        }
    }
}

/// Returns the text of a refusal: a line for each unknown name.
fn refused(spec: &Spec, file: String, refusal: Refusal) -> String {
    if let Refusal::Options(unknown) = refusal {
        let lines = unknown.into_iter().map(|one| one.message);
        return lines.collect::<Vec<_>>().join("\n");
    }
    let file = SpecFile {
        path: file.into(),
        text: spec.text.clone(),
        stem: spec.name.clone(),
        mechanism: None,
    };
    let (findings, why) = file.refusal(refusal);
    findings + &why
}

/// Returns names that are given as one text or as a list of texts.
fn names(of: &str, given: &Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    if given.is_instance_of::<PyString>() {
        return Ok(vec![given.extract()?]);
    }
    let list = given.extract();
    list.or_else(|_| {
        let message = format!("`{of}` is a name or a list of names, not {}", given.repr()?);
        Err(PyTypeError::new_err(message))
    })
}

/// Returns names and values of a dictionary in its order; none for None.
fn entries<'py>(
    of: &str,
    kind: &str,
    given: Option<&Bound<'py, PyAny>>,
) -> PyResult<Vec<(String, Bound<'py, PyAny>)>> {
    let Some(given) = given else {
        return Ok(Vec::new());
    };
    let items = given.cast::<PyMapping>().ok().map(|all| all.items());
    let items = items.transpose()?.and_then(|all| all.extract().ok());
    match items {
        Some(items) => Ok(items),
        None => Err(PyTypeError::new_err(format!(
            "`{of}` is a dictionary, {kind}, not {}",
            given.repr()?
        ))),
    }
}
