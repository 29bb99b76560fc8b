//! Runs the steps in order, from the text of a mechanism or of a scene to a Rust module or to the files of a backend.
//!
//! `stem` is the stem of the file's name; `load` returns the text of a scene's mechanism, given its path in the scene.

use proc_macro2::TokenStream;

#[cfg(feature = "source")]
use crate::backend;
use crate::emit;
use crate::fault::Faults;
use crate::format::is_scene;
use crate::function::Function;
use crate::model::Model;
use crate::options::Options;
use crate::read::{read, read_scene};
use crate::refusal::Refusal;
use crate::selection::{model, scene_functions};
use crate::system::SceneEquations;
use crate::verify::{check_functions, check_scene};

/// A mechanism or a scene, with the functions that the options select.
pub enum Generated {
    /// A mechanism.
    Mechanism(Box<Model>),
    /// A scene: its equations and functions.
    Scene(Box<SceneEquations>, Vec<Function>),
}

/// Generates the functions of a file, and compares them with equation (6); returns the warnings beside them.
///
/// # Errors
/// All faults of the file; or all names and options that do not fit it; or all differences from equation (6).
pub fn generate_functions(
    text: &str,
    stem: &str,
    options: &Options,
    load: impl FnOnce(&str) -> Result<String, String>,
) -> Result<(Generated, Faults), Refusal> {
    if is_scene(text) {
        let (equations, warnings) = read_scene(text, stem, load)?;
        let fit = options.check_scene(&equations.graph);
        fit.map_err(Refusal::Options)?;
        let functions = scene_functions(&equations, options);
        if options.verify {
            Refusal::unless_equal(check_scene(&equations, &functions))?;
        }
        return Ok((Generated::Scene(Box::new(equations), functions), warnings));
    }
    let (mechanism, findings) = read(text, Some(stem));
    let Some(mechanism) = mechanism else {
        return Err(Refusal::Spec(findings));
    };
    let model = model(mechanism, options).map_err(Refusal::Options)?;
    verify(&model, options)?;
    Ok((Generated::Mechanism(Box::new(model)), findings))
}

/// Compares the model's functions with equation (6), unless the options leave that out.
///
/// # Errors
/// [`Refusal::Unequal`] with every difference.
pub fn verify(model: &Model, options: &Options) -> Result<(), Refusal> {
    if !options.verify {
        return Ok(());
    }
    let name = model.mechanism.name();
    Refusal::unless_equal(check_functions(name, &model.bond_graph, &model.functions))
}

/// Generates the tokens of a file's module, with the warnings.
///
/// # Errors
/// As [`generate_functions`].
pub fn generate_module(
    text: &str,
    stem: &str,
    output: &emit::OutputOptions,
    options: &Options,
    load: impl FnOnce(&str) -> Result<String, String>,
) -> Result<(TokenStream, Faults), Refusal> {
    let (generated, warnings) = generate_functions(text, stem, options, load)?;
    let tokens = match &generated {
        Generated::Mechanism(model) => emit::module(model, output),
        Generated::Scene(equations, functions) => emit::scene_module(equations, functions, output),
    };
    Ok((tokens, warnings))
}

/// Generates the files of a backend, with the warnings.
///
/// # Errors
/// As [`generate_functions`], and those of the backend.
#[cfg(feature = "source")]
pub fn generate_files(
    text: &str,
    stem: &str,
    backend: &dyn backend::Backend,
    given: &backend::GivenOptions,
    options: &Options,
    load: impl FnOnce(&str) -> Result<String, String>,
) -> Result<(Vec<backend::GeneratedFile>, Faults), backend::FilesError> {
    let (generated, warnings) = generate_functions(text, stem, options, load)?;
    let input = match &generated {
        Generated::Mechanism(model) => backend::BackendInput::Mechanism(model),
        Generated::Scene(equations, functions) => {
            backend::BackendInput::Scene(equations, functions)
        }
    };
    Ok((backend.files(&input, given)?, warnings))
}
