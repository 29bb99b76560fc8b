//! Pieces of code, and the leaves they read.

use std::collections::BTreeSet;

use proc_macro2::TokenStream;

use crate::expr::{Expr, Graph, Leaf, Node, NodeId, reachable};
use crate::method::Argument;

/// How tightly a piece of code binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    Product,
    Atom,
}

/// A piece of code for a node, without the sign it is used with.
#[derive(Clone)]
pub(super) struct Code {
    pub(super) tokens: TokenStream,
    pub(super) binding: Binding,
    pub(super) operations: usize,
}

/// Code that needs no parentheses anywhere.
pub(super) fn atom(tokens: TokenStream) -> Code {
    Code {
        tokens,
        binding: Binding::Atom,
        operations: 0,
    }
}

/// The leaf that holds component `j` of an argument.
pub(super) fn leaf_of(argument: Argument, j: usize) -> Leaf {
    match argument {
        Argument::Q => Leaf::Position(j),
        Argument::V => Leaf::Velocity(j),
        Argument::A => Leaf::Acceleration(j),
        Argument::Tau => Leaf::Input(j),
    }
}

/// The leaves that the outputs read.
pub(super) fn leaves(graph: &Graph, outputs: &[Expr]) -> BTreeSet<Leaf> {
    let needed = reachable(graph, outputs);
    let nodes = (0..needed.len())
        .filter(|&i| needed[i])
        .map(|i| graph.node(NodeId(i as u32)));
    nodes
        .filter_map(|n| {
            if let Node::Leaf(leaf) = n {
                Some(*leaf)
            } else {
                None
            }
        })
        .collect()
}
