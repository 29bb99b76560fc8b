//! What a backend is: its name, its options, and the files that it writes.

use super::given::{BackendError, BackendOption, GivenOptions};
use crate::function::Function;
use crate::generated::Generated;
use crate::model::Model;
use crate::plan::PlanLimits;
use crate::refusal::Refusal;
use crate::system::SceneEquations;

/// Writes files in a language from a mechanism or a scene.
pub trait Backend: Sync {
    /// Returns its name, for `bgdyn generate --backend`.
    fn name(&self) -> &'static str;
    /// Returns what it writes, in one sentence without a full stop.
    fn summary(&self) -> &'static str;
    /// Returns the options that it takes.
    fn options(&self) -> &'static [BackendOption];
    /// Returns what its plans keep to.
    fn limits(&self) -> PlanLimits;
    /// Returns the files with their texts.
    ///
    /// # Errors
    /// If an option has a value that is none, or if the backend cannot write something that the input has. No file is
    /// written then.
    fn files(
        &self,
        input: &BackendInput<'_>,
        given: &GivenOptions,
    ) -> Result<Vec<GeneratedFile>, BackendError>;
}

/// What is written.
pub enum BackendInput<'a> {
    /// A mechanism with its functions.
    Mechanism(&'a Model),
    /// A scene with its functions.
    Scene(&'a SceneEquations, &'a [Function]),
}

impl<'a> From<&'a Generated> for BackendInput<'a> {
    fn from(generated: &'a Generated) -> Self {
        match generated {
            Generated::Mechanism(model) => BackendInput::Mechanism(model),
            Generated::Scene(equations, functions) => BackendInput::Scene(equations, functions),
        }
    }
}

/// A file that a backend writes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GeneratedFile {
    /// Its name, without a folder.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// The reason why a backend has no files.
#[derive(Clone, Debug)]
pub enum FilesError {
    /// The spec, or an option of the generator, is refused.
    Refused(Refusal),
    /// The backend refuses one of its options, or cannot write something.
    Backend(BackendError),
}

impl From<Refusal> for FilesError {
    fn from(refusal: Refusal) -> Self {
        FilesError::Refused(refusal)
    }
}

impl From<BackendError> for FilesError {
    fn from(error: BackendError) -> Self {
        FilesError::Backend(error)
    }
}
