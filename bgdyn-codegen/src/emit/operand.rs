//! Rust's spelling of operands: names, leaves, numbers, or whole operations.

use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, quote};

use super::code::{Binding, Code, atom};
use super::tokens::{ident, number};
use super::writer::Writer;
use crate::column_loop::SHARED;
use crate::expr::{Leaf, Node, NodeId, Signed};
use crate::plan::block_name;

impl Writer<'_> {
    /// Returns the code of a signed operand, in parentheses if its context binds tighter.
    pub(super) fn operand(&self, e: Signed, within: Binding) -> TokenStream {
        let Code { tokens, binding } = self.code(e.node);
        match (e.negative, binding) {
            (true, Binding::Atom) if within == Binding::Sum => quote! { -#tokens },
            (true, Binding::Atom) => quote! { (-#tokens) },
            (true, _) if within == Binding::Sum => quote! { -(#tokens) },
            (true, _) => quote! { (-(#tokens)) },
            (false, binding) if binding < within => quote! { (#tokens) },
            (false, _) => tokens,
        }
    }

    /// Returns the code of values.
    pub(super) fn values(&self, all: &[Signed]) -> Vec<TokenStream> {
        let value = |&e| self.operand(e, Binding::Sum);
        all.iter().map(value).collect()
    }

    /// Returns the code of a node: its name, or the whole operation.
    fn code(&self, id: NodeId) -> Code {
        let name = self
            .listing
            .name(id)
            .map(|name| ident(name).into_token_stream());
        match (self.listing.block.graph.node(id), name) {
            (Node::Constant(c), name) => {
                let number = || number(c.value().to_f64()).into_token_stream();
                atom(self.scalar(name.unwrap_or_else(number)))
            }
            (_, Some(name)) => atom(name),
            (Node::Leaf(leaf), None) => atom(self.leaf(*leaf)),
            (node, None) => self.operation(node),
        }
    }

    /// Returns a number as a scalar.
    pub(super) fn scalar(&self, value: TokenStream) -> TokenStream {
        match self.spelling.plain {
            true => value,
            false => quote! { k(#value) },
        }
    }

    /// Returns the code of a leaf without a variable.
    fn leaf(&self, leaf: Leaf) -> TokenStream {
        let naming = &self.spelling.naming;
        match (leaf, &self.arrays) {
            (Leaf::Parameter(p), _) => {
                let field = ident(naming.parameters[p]);
                quote! { self.#field }
            }
            (Leaf::BlockResult { block, index }, Some(arrays)) => {
                let (shared, own) = (&arrays.shared, &arrays.own);
                let index = Literal::usize_unsuffixed(index);
                match block {
                    SHARED => quote! { #shared[#index] },
                    _ => quote! { #own[#index][c] },
                }
            }
            (Leaf::BlockResult { block, index }, None) => {
                let (name, index) = (ident(&block_name(block)), Literal::usize_unsuffixed(index));
                quote! { #name[#index] }
            }
            (leaf, _) => match naming.field(leaf) {
                Some((argument, None)) => ident(argument.name()).into_token_stream(),
                Some((argument, Some(part))) => {
                    let (whole, part) = (ident(argument.name()), ident(&part));
                    quote! { #whole.#part }
                }
                None => unreachable!("an argument that is read has a variable"),
            },
        }
    }
}
