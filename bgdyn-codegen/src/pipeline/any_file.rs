//! Generates the tokens of a file that contains a mechanism or a scene.

use proc_macro2::TokenStream;

use super::{mechanism, scene};
use crate::emit::OutputOptions;
use crate::fault::Faults;
use crate::format::is_scene;
use crate::options::Options;
use crate::refusal::Refusal;

/// Converts a spec's text to the tokens of its module, with its warnings. `stem` is the file's stem,
/// `output` has the options of the module. `load` reads a scene's mechanism, from the path in the scene.
///
/// # Errors
/// As [`super::generate`], and as [`crate::read_scene`].
pub fn generate_file(
    text: &str,
    stem: &str,
    output: &OutputOptions,
    options: &Options,
    load: impl FnOnce(&str) -> Result<String, String>,
) -> Result<(TokenStream, Faults), Refusal> {
    match is_scene(text) {
        true => scene::generate_scene(text, stem, output, options, load),
        false => mechanism::generate(text, stem, output, options),
    }
}
