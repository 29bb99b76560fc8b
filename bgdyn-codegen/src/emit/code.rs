//! Pieces of Rust with their operator precedence, and how leaves and formulas are written.

use proc_macro2::TokenStream;

use crate::interface::SceneInterface;
use crate::model::Model;
use crate::plan::Naming;

/// The name of a result while it is written entry by entry.
pub(super) const RESULT: &str = "entries";

/// Operator precedence of a piece of code.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    Product,
    Atom,
}

/// A piece of code for a node, without the sign that its user applies.
pub(super) struct Code {
    pub(super) tokens: TokenStream,
    pub(super) binding: Binding,
}

/// Code that never needs parentheses.
pub(super) fn atom(tokens: TokenStream) -> Code {
    Code {
        tokens,
        binding: Binding::Atom,
    }
}

/// How leaves and formulas are written.
pub(super) struct Spelling<'a> {
    /// The names of leaves.
    pub(super) naming: Naming<'a>,
    /// Whether formulas use infix operators.
    pub(super) plain: bool,
}

impl<'a> Spelling<'a> {
    /// Spelling of a mechanism's functions.
    pub(super) fn of_model(model: &'a Model, plain: bool) -> Self {
        let naming = Naming::of_model(model);
        Spelling { naming, plain }
    }

    /// Spelling of a scene's functions.
    pub(super) fn of_scene(scene: &'a SceneInterface, plain: bool) -> Self {
        let naming = Naming::of_scene(scene);
        Spelling { naming, plain }
    }

    /// Returns the names that generated code uses beside those of values.
    pub(super) fn reserved(&self) -> Vec<&'static str> {
        let mut names = vec!["q", "v", "a", "tau", "k", "refused", RESULT];
        if self.naming.layout.is_some() {
            names.extend(["state", "input", "acceleration", "t"]);
        }
        names
    }
}
