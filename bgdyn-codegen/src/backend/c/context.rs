//! What all functions of a pair of files have in common.

use std::ops::Deref;

use super::style::Style;
use crate::interface::SceneInterface;
use crate::model::Model;
use crate::plan::Naming;

/// What the code of all functions of a pair of files has in common.
pub(super) struct FunctionContext<'a> {
    pub(super) style: &'a Style,
    pub(super) naming: &'a Naming<'a>,
    /// Number of velocities.
    pub(super) nv: usize,
    /// Number of velocities of the open tree; without loops and contacts that of all.
    pub(super) nt: usize,
    /// The scene whose functions they are; `None` for those of a mechanism.
    pub(super) scene: Option<&'a SceneInterface>,
}

impl<'a> FunctionContext<'a> {
    /// Returns what the functions of a scene have in common.
    pub(super) fn of_scene(
        scene: &'a SceneInterface,
        style: &'a Style,
        naming: &'a Naming<'a>,
    ) -> Self {
        let nv = scene.layout.nv();
        FunctionContext {
            style,
            naming,
            nv,
            nt: nv,
            scene: Some(scene),
        }
    }
}

/// A mechanism, with what its functions have in common. It dereferences to the latter.
pub(super) struct ModelContext<'a> {
    pub(super) model: &'a Model,
    functions: FunctionContext<'a>,
}

impl<'a> ModelContext<'a> {
    pub(super) fn new(model: &'a Model, style: &'a Style, naming: &'a Naming<'a>) -> Self {
        let (nv, closed) = (model.mechanism.nv(), model.bond_graph.closed.as_deref());
        let functions = FunctionContext {
            style,
            naming,
            nv,
            nt: closed.map_or(nv, |closed| closed.tree.coordinates.len()),
            scene: None,
        };
        ModelContext { model, functions }
    }
}

impl<'a> Deref for ModelContext<'a> {
    type Target = FunctionContext<'a>;

    fn deref(&self) -> &FunctionContext<'a> {
        &self.functions
    }
}
