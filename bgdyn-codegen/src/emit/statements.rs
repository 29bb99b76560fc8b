//! The statements of one block: a `let` for each value that is used more than once.

use proc_macro2::TokenStream;
use quote::quote;

use super::code::{Binding, atom, leaves};
use super::tokens::number;
use super::writer::Writer;
use crate::expr::{Expr, Node, NodeId};
use crate::function::Function;

/// Operations in one statement at the most: what a reader takes in at a glance.
const STATEMENT: usize = 6;

impl Writer<'_> {
    /// Statements that compute a block.
    pub(super) fn block(&mut self, outputs: &[Expr], function: &Function) -> TokenStream {
        let arguments = self.arguments(function, &leaves(self.graph, outputs));
        for i in 0..self.needed.len() {
            if !self.needed[i] {
                continue;
            }
            let id = NodeId(i as u32);
            if self.code[i].is_none() {
                self.node(id);
            }
            self.store(id);
        }
        let constants = self
            .constants
            .then(|| quote! { let k = <T as __Scalar>::from_f64; });
        let statements = std::mem::take(&mut self.statements);
        quote! { #arguments #constants #(#statements)* }
    }

    /// Code of the block's results.
    pub(super) fn results(&mut self, outputs: &[Expr]) -> Vec<TokenStream> {
        outputs
            .iter()
            .map(|&e| self.operand(e, Binding::Sum))
            .collect()
    }

    /// Writes a node: the code where it is used, after a statement of its own if it needs one.
    fn node(&mut self, id: NodeId) {
        let i = id.0 as usize;
        let code = match self.graph.node(id) {
            Node::Leaf(leaf) => match self.leaf(*leaf) {
                Some(code) => code,
                None => return,
            },
            Node::Constant(c) => {
                self.use_constants();
                let value = number(c.value().to_f64());
                atom(quote! { k(#value) })
            }
            Node::Less(a, b) => {
                let (a, b) = (
                    self.operand(*a, Binding::Sum),
                    self.operand(*b, Binding::Sum),
                );
                let mask = self.names.numbered();
                self.push(id, quote! { let #mask = T::less(#a, #b); });
                atom(quote! { #mask })
            }
            // Written with the sine.
            Node::Angle(..) => return,
            Node::Sin(a) => {
                let sine = self.sine_cosine(*a).sine;
                atom(quote! { #sine })
            }
            Node::Cos(a) => {
                let cosine = self.sine_cosine(*a).cosine;
                atom(quote! { #cosine })
            }
            node => self.operation(&node.clone()),
        };
        let is_operation = !matches!(
            self.graph.node(id),
            Node::Leaf(_) | Node::Constant(_) | Node::Less(..) | Node::Sin(_) | Node::Cos(_)
        );
        let inline = self.uses[i] <= 1
            && code.binding != Binding::Atom
            && code.operations < STATEMENT
            && self.graph.name(id).is_none();
        self.code[i] = Some(if is_operation && !inline {
            self.bind(id, code)
        } else {
            code
        });
    }
}
