//! What all functions of a pair of files have in common.

use super::style::Style;
use crate::model::Model;
use crate::plan::Naming;

/// What all functions of a pair of files have in common.
pub(super) struct FunctionContext<'a> {
    pub(super) model: &'a Model,
    pub(super) style: &'a Style,
    pub(super) naming: &'a Naming<'a>,
    /// Number of velocities.
    pub(super) nv: usize,
    /// Number of velocities of the open tree; without loops and contacts that of all.
    pub(super) nt: usize,
}

impl<'a> FunctionContext<'a> {
    pub(super) fn new(model: &'a Model, style: &'a Style, naming: &'a Naming<'a>) -> Self {
        let (nv, closed) = (model.mechanism.nv(), model.bond_graph.closed.as_deref());
        FunctionContext {
            model,
            style,
            naming,
            nv,
            nt: closed.map_or(nv, |closed| closed.tree.coordinates.len()),
        }
    }
}
