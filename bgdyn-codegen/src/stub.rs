//! Returns the module that replaces that of a refused spec.
//!
//! It has all names that a caller can use, without working code.

use std::path::Path;

use proc_macro2::TokenStream;

use crate::emit;
use crate::files::{mechanism_of, stem as stem_of};
use crate::format::is_scene;
use crate::interface::{Interface, SceneInterface};

/// Returns the module of a refused spec, or of an unreadable one (`text` is empty then): all names that a
/// caller can use, without working code. `load` returns the text of a scene's mechanism. `None` if the
/// stem cannot name a module.
pub fn stub_module(
    text: &str,
    stem: &str,
    output: &emit::OutputOptions,
    load: impl FnOnce(&str) -> Result<String, String>,
) -> Option<TokenStream> {
    if is_scene(text) {
        let path = mechanism_of(text).unwrap_or_default();
        let written = load(&path).ok();
        let of = stem_of(Path::new(&path));
        let mechanism = written.as_deref().map(|written| (written, of.as_str()));
        let scene = SceneInterface::guess(text, stem, mechanism);
        return scene.map(|scene| emit::scene_stub(&scene, output));
    }
    Interface::guess(text, stem).map(|interface| emit::stub(&interface, output))
}
