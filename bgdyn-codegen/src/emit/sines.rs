//! Emits sines and cosines: a pair for each angle, several angles in one call.

use proc_macro2::TokenStream;
use quote::quote;

use super::code::Binding;
use super::tokens::{ident, number};
use super::writer::Writer;
use crate::expr::{Node, NodeId, Signed};
use crate::plan::AnglePair;

impl Writer<'_> {
    /// Emits the call that computes sines and cosines of these angles.
    pub(super) fn sines(&self, angles: &[AnglePair]) -> TokenStream {
        let parts: Vec<TokenStream> = angles.iter().map(|pair| self.used(pair)).collect();
        let terms: Vec<_> = angles.iter().map(|pair| self.terms(pair.angle)).collect();
        match (terms.as_slice(), parts.as_slice()) {
            ([(angle, None)], [part]) => quote! { let #part = T::sin_cos(#(#angle)*); },
            ([(angles, Some(offset))], [part]) => {
                quote! { let #part = T::sin_cos_sum(&[#(#angles),*], #offset); }
            }
            _ => {
                let none = quote! { (0.0, 0.0) };
                let angles = terms.iter().map(|(angles, _)| quote! { &[#(#angles),*] });
                let offsets = terms
                    .iter()
                    .map(|(_, offset)| offset.as_ref().unwrap_or(&none));
                quote! { let [#(#parts),*] = T::sin_cos_all([#(#angles),*], [#(#offsets),*]); }
            }
        }
    }

    /// Returns the pattern that binds the read parts of a pair.
    fn used(&self, pair: &AnglePair) -> TokenStream {
        let name = |id: Option<NodeId>| id.and_then(|id| self.listing.name(id)).map(ident);
        match (name(pair.sine), name(pair.cosine)) {
            (Some(sine), Some(cosine)) => quote! { (#sine, #cosine) },
            (Some(sine), None) => quote! { (#sine, _) },
            (None, Some(cosine)) => quote! { (_, #cosine) },
            (None, None) => quote! { _ },
        }
    }

    /// Returns the terms of an angle, and its offset if it is a sum.
    fn terms(&self, angle: NodeId) -> (Vec<TokenStream>, Option<TokenStream>) {
        let Node::Angle(terms, offset, negative) = self.listing.block.graph.node(angle) else {
            return (vec![self.operand(Signed::plus(angle), Binding::Sum)], None);
        };
        let offset = match negative {
            true => -offset.value(),
            false => offset.value(),
        };
        let (hi, lo) = (number(offset.hi()), number(offset.lo()));
        (self.values(terms), Some(quote! { (#hi, #lo) }))
    }
}
