//! Generates the files of a backend from a file that contains a mechanism or a scene.

use super::{mechanism, scene};
use crate::backend::{Backend, BackendError, BackendInput, GeneratedFile, GivenOptions};
use crate::fault::Faults;
use crate::format::is_scene;
use crate::options::Options;
use crate::refusal::Refusal;

/// The reason why a backend has no files.
#[derive(Clone, Debug)]
pub enum FilesError {
    /// The spec, or an option of the generator, is refused.
    Refused(Refusal),
    /// The backend refuses one of its options, or cannot write something.
    Backend(BackendError),
}

/// Converts a spec's text to the files of a backend, with its warnings. `stem` is the file's stem; `load` reads a
/// scene's mechanism, from the path in the scene.
///
/// # Errors
/// As [`super::generate_file`], and those of the backend.
pub fn generate_files(
    text: &str,
    stem: &str,
    backend: &dyn Backend,
    given: &GivenOptions,
    options: &Options,
    load: impl FnOnce(&str) -> Result<String, String>,
) -> Result<(Vec<GeneratedFile>, Faults), FilesError> {
    let (files, findings) = match is_scene(text) {
        true => {
            let found = scene::checked_scene(text, stem, options, load);
            let (system, functions, findings) = found.map_err(FilesError::Refused)?;
            let input = BackendInput::Scene(&system, &functions);
            (backend.files(&input, given), findings)
        }
        false => {
            let found = mechanism::checked_model(text, stem, options);
            let (model, findings) = found.map_err(FilesError::Refused)?;
            let input = BackendInput::Mechanism(&model);
            (backend.files(&input, given), findings)
        }
    };
    Ok((files.map_err(FilesError::Backend)?, findings))
}
