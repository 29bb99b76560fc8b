//! Emits stores of the entries of a result as soon as they are computed.

use bgdyn_runtime::Dd;
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::code::{Binding, atom};
use super::entries::{Entries, NAME};
use super::tokens::COMMENT;
use super::writer::Writer;
use crate::expr::{Node, NodeId, Signed};

/// Number of entries from which a result with many zeros is first filled with them.
const LARGE: usize = 256;

impl Writer<'_> {
    /// Returns the result if it is written entry by entry; if no entry was written, all are constants.
    pub(super) fn stored_matrix(&self) -> Option<Ident> {
        let begun = self.entries.as_ref().is_some_and(|entries| entries.begun);
        begun.then(|| format_ident!("{NAME}"))
    }

    /// Stores a computed node in its entries.
    pub(super) fn store(&mut self, id: NodeId) {
        let Some(mut entries) = self.entries.take() else {
            return;
        };
        if let Some(found) = entries.of.get(&id)
            && self.constant(id).is_none()
        {
            if !entries.begun {
                self.begin(id, &entries);
            }
            entries.begun = true;
            for &k in found {
                let value = self.operand(entries.outputs[k], Binding::Sum);
                for place in &entries.places[k] {
                    self.push_untitled(quote! { #place = #value; });
                }
            }
        }
        self.entries = Some(entries);
    }

    /// Initialises the whole result: constants in their entries, the first node elsewhere.
    fn begin(&mut self, first: NodeId, entries: &Entries<'_>) {
        if let Some(code) = &self.code[first.0 as usize]
            && code.binding != Binding::Atom
        {
            let (variable, tokens) = (self.names.numbered(), code.tokens.clone());
            self.push(first, quote! { let #variable = #tokens; });
            self.code[first.0 as usize] = Some(atom(quote! { #variable }));
        }
        let other = match self.mostly_zero(entries) {
            true => self.scalar(quote! { 0.0 }).tokens,
            false => self.operand(Signed::plus(first), Binding::Sum),
        };
        let value = |e: &Signed| match self.constant(e.node) {
            Some(value) if e.negative => quote! { -#value },
            Some(value) => value,
            None => other.clone(),
        };
        let values: Vec<TokenStream> = entries.outputs.iter().map(value).collect();
        let (name, whole) = (format_ident!("{NAME}"), (entries.whole)(&values));
        let title =
            format!("{COMMENT} placeholders but for constants: every other entry is stored below");
        self.push_untitled(quote! { #[doc = #title] let mut #name = #whole; });
    }

    /// Returns whether zeros are so many that filling the result with them takes the least time.
    fn mostly_zero(&self, entries: &Entries<'_>) -> bool {
        let sizes = entries.outputs.iter().zip(&entries.places);
        let zero = |id| matches!(self.graph.node(id), Node::Constant(c) if c.value() == Dd::ZERO);
        let zeros = sizes.filter(|(e, _)| zero(e.node));
        let zeros: usize = zeros.map(|(_, places)| places.len()).sum();
        let all: usize = entries.places.iter().map(Vec::len).sum();
        all >= LARGE && 4 * zeros >= all
    }

    /// Returns the code of a constant.
    fn constant(&mut self, id: NodeId) -> Option<TokenStream> {
        match self.graph.node(id) {
            Node::Constant(c) => {
                let value = self.number_of(c.value());
                Some(self.scalar(value).tokens)
            }
            _ => None,
        }
    }
}
