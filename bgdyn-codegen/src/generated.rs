//! A mechanism or a scene with the functions that the options select.

use proc_macro2::TokenStream;

use crate::emit::{self, OutputOptions};
use crate::function::Function;
use crate::model::Model;
use crate::options::Options;
use crate::read::Checked;
use crate::refusal::Refusal;
use crate::selection;
use crate::system::SceneEquations;
use crate::verify::{Difference, check_model, check_scene};

/// A mechanism or a scene, with the functions that the options select.
pub enum Generated {
    /// A mechanism.
    Mechanism(Box<Model>),
    /// A scene: its equations and functions.
    Scene(Box<SceneEquations>, Vec<Function>),
}

impl Generated {
    /// Generates the functions that the options select.
    ///
    /// # Errors
    /// All names that the mechanism does not have; or all options that do not fit the scene.
    pub fn new(checked: Checked, options: &Options) -> Result<Self, Refusal> {
        match checked {
            Checked::Mechanism(mechanism) => {
                let model = selection::model(*mechanism, options).map_err(Refusal::Options)?;
                Ok(Generated::Mechanism(Box::new(model)))
            }
            Checked::Scene(equations) => {
                let fit = options.check_scene(&equations.graph);
                fit.map_err(Refusal::Options)?;
                let functions = selection::scene_functions(&equations, options);
                Ok(Generated::Scene(equations, functions))
            }
        }
    }

    /// Compares the functions with equation (6); returns all differences.
    pub fn differences(&self) -> Vec<Difference> {
        match self {
            Generated::Mechanism(model) => check_model(model),
            Generated::Scene(equations, functions) => check_scene(equations, functions),
        }
    }

    /// Returns the tokens of the module.
    pub fn tokens(&self, output: &OutputOptions) -> TokenStream {
        match self {
            Generated::Mechanism(model) => emit::module(model, output),
            Generated::Scene(equations, functions) => {
                emit::scene_module(equations, functions, output)
            }
        }
    }
}
