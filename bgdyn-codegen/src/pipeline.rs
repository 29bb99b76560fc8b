//! Runs the steps in order, from the text of a mechanism or of a scene to a Rust module or to the files of a backend.

use proc_macro2::TokenStream;

#[cfg(feature = "source")]
use crate::backend::{Backend, FilesError, GeneratedFile, GivenOptions};
use crate::emit::OutputOptions;
use crate::fault::Faults;
use crate::generated::Generated;
use crate::options::Options;
use crate::read::{SpecText, read_text};
use crate::refusal::Refusal;

/// Generates the functions of a file, and compares them with equation (6); returns the warnings beside them.
///
/// # Errors
/// All faults of the file; or all names and options that do not fit it; or all differences from equation (6).
pub fn generate_functions(
    spec: &SpecText<'_>,
    options: &Options,
) -> Result<(Generated, Faults), Refusal> {
    let (read, warnings) = read_text(spec)?;
    let generated = Generated::new(read, options)?;
    if options.verify {
        Refusal::unless_equal(generated.differences())?;
    }
    Ok((generated, warnings))
}

/// Generates the tokens of a file's module, with the warnings.
///
/// # Errors
/// As [`generate_functions`].
pub fn generate_module(
    spec: &SpecText<'_>,
    options: &Options,
    output: &OutputOptions,
) -> Result<(TokenStream, Faults), Refusal> {
    let (generated, warnings) = generate_functions(spec, options)?;
    Ok((generated.tokens(output), warnings))
}

/// Generates the files of a backend, with the warnings.
///
/// # Errors
/// As [`generate_functions`], and those of the backend.
#[cfg(feature = "source")]
pub fn generate_files(
    spec: &SpecText<'_>,
    options: &Options,
    backend: &dyn Backend,
    given: &GivenOptions,
) -> Result<(Vec<GeneratedFile>, Faults), FilesError> {
    let (generated, warnings) = generate_functions(spec, options)?;
    Ok((backend.files(&(&generated).into(), given)?, warnings))
}
