//! A file that holds a mechanism or a scene: its text to tokens.

use proc_macro2::TokenStream;

use super::{mechanism, scene};
use crate::emit::OutputOptions;
use crate::fault::Faults;
use crate::format::is_scene;
use crate::options::Options;
use crate::refusal::Refusal;

/// From a spec's text to the tokens of its module, with warnings if there are any. `stem` is the
/// file's stem, `output` says where and from what the code is generated. A scene's mechanism is read by
/// `load`, from the path that the scene writes.
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
