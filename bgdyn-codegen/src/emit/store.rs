//! Emits stores of the entries of a result as soon as they are computed.
//!
//! If a result is built at the end, all entries are stored then, with no computation left to overlap: this
//! costs the mass matrix of a PUMA 5 %, in lanes 9 % (`docs/order.md`). The code therefore begins with a
//! whole result and overwrites its entries. Entries that are not yet known are initialised with the first
//! known one: compilers remove those stores, but not a call that fills memory with zeros. Large results with
//! many zeros are filled with zeros nevertheless, which takes less time than to store the zeros one by one.

use bgdyn_runtime::Dd;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::code::{Binding, RESULT};
use super::tokens::comment;
use super::writer::{Matrices, Writer};
use crate::expr::{Node, NodeId, Signed};
use crate::plan::Destination;

/// Number of entries from which a result with many zeros is first filled with them.
const LARGE: usize = 256;

impl Writer<'_> {
    /// Initialises the whole result: constants in their entries, the first known node elsewhere.
    pub(super) fn begin(&self, first: NodeId) -> TokenStream {
        let Some(target) = &self.target else {
            return TokenStream::new();
        };
        let other = match self.mostly_zero() {
            true => self.scalar(quote! { 0.0 }),
            false => self.operand(Signed::plus(first), Binding::Sum),
        };
        let block = self.listing.block;
        let value = |e: &Signed| match block.graph.node(e.node) {
            Node::Constant(_) => self.operand(*e, Binding::Sum),
            _ => other.clone(),
        };
        let values: Vec<TokenStream> = block.outputs.iter().map(value).collect();
        let (name, whole) = (format_ident!("{RESULT}"), (target.whole)(&values));
        let title = comment("placeholders but for constants: every other entry is stored below");
        quote! { #title let mut #name = #whole; }
    }

    /// Stores an output at its destinations.
    pub(super) fn store(&self, output: usize) -> TokenStream {
        let block = self.listing.block;
        let value = self.operand(block.outputs[output], Binding::Sum);
        let destinations = block
            .destinations
            .iter()
            .flat_map(|destinations| &destinations[output]);
        let destinations = destinations.map(|destination| self.destination(destination));
        quote! { #(#destinations = #value;)* }
    }

    fn destination(&self, destination: &Destination) -> TokenStream {
        let name = format_ident!("{RESULT}");
        match *destination {
            Destination::Element(k) => {
                let k = index(k);
                quote! { #name[#k] }
            }
            Destination::Entry {
                list,
                matrix,
                row,
                column,
            } => {
                let matrices = self.target.as_ref().map(|target| target.matrices);
                let (list, matrix) = (index(list), index(matrix));
                let matrix = match matrices.unwrap_or(Matrices::One) {
                    Matrices::One => quote! {},
                    Matrices::List => quote! { [#matrix] },
                    Matrices::Lists => quote! { [#list][#matrix] },
                };
                let (row, column) = (index(row), index(column));
                quote! { #name #matrix.data.0[#column][#row] }
            }
        }
    }

    /// Returns whether zeros are so many that filling the result with them takes the least time.
    fn mostly_zero(&self) -> bool {
        let block = self.listing.block;
        let destinations = || block.destinations.iter().flatten();
        let zero = |e: &Signed| matches!(block.graph.node(e.node), Node::Constant(c) if c.value() == Dd::ZERO);
        let zeros = block
            .outputs
            .iter()
            .zip(destinations())
            .filter(|(e, _)| zero(e));
        let zeros: usize = zeros.map(|(_, destinations)| destinations.len()).sum();
        let all: usize = destinations().map(Vec::len).sum();
        all >= LARGE && 4 * zeros >= all
    }
}

fn index(k: usize) -> Literal {
    Literal::usize_unsuffixed(k)
}
