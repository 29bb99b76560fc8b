//! Converts a scene's text to functions and tokens.

use proc_macro2::TokenStream;

use crate::emit;
use crate::fault::Faults;
use crate::function::Function;
use crate::options::Options;
use crate::read::read_scene;
use crate::refusal::Refusal;
use crate::system::SceneEquations;
use crate::verify::check_scene;

/// Converts a scene's text to the tokens of its module; see [`super::generate_file`].
pub(super) fn generate_scene(
    text: &str,
    stem: &str,
    output: &emit::OutputOptions,
    options: &Options,
    load: impl FnOnce(&str) -> Result<String, String>,
) -> Result<(TokenStream, Faults), Refusal> {
    let (system, functions, findings) = checked_scene(text, stem, options, load)?;
    Ok((emit::scene_module(&system, &functions, output), findings))
}

/// Converts a scene's text to its equations and functions, compared with equation (6), with its warnings.
pub(super) fn checked_scene(
    text: &str,
    stem: &str,
    options: &Options,
    load: impl FnOnce(&str) -> Result<String, String>,
) -> Result<(SceneEquations, Vec<Function>, Faults), Refusal> {
    let (system, findings) = read_scene(text, stem, load)?;
    let misplaced = options.misplaced_mechanism_options();
    if !misplaced.is_empty() {
        return Err(Refusal::Options(misplaced));
    }
    options
        .check_canonical(&system.graph)
        .map_err(Refusal::Options)?;
    let functions = scene_functions(&system, options);
    if options.verify {
        Refusal::unless_equal(check_scene(&system, &functions))?;
    }
    Ok((system, functions, findings))
}

/// Returns the functions of a scene: the default ones, those that its integrator needs, and those that the
/// options select.
pub fn scene_functions(system: &SceneEquations, options: &Options) -> Vec<Function> {
    let roles = system.roles_with(options.jacobian, options.canonical);
    let roles = roles.into_iter();
    roles.map(|role| system.function(role)).collect()
}
