//! Emits sines and cosines: a pair for each angle, several angles in one call.

use proc_macro2::TokenStream;
use quote::quote;

use super::code::{Binding, SinePair};
use super::tokens::number;
use super::writer::Writer;
use crate::expr::{Leaf, Node, NodeId, Signed};

/// Largest number of angles in one call: the lanes of the widest register.
const AT_ONCE: usize = 8;

impl Writer<'_> {
    /// Returns sine and cosine of an angle, computed once as a pair. An angle that depends only on
    /// arguments is computed together with the next such angles.
    pub(super) fn sine_cosine(&mut self, angle: NodeId) -> SinePair {
        if let Some(pair) = self.sines.get(&angle) {
            return pair.clone();
        }
        let together = match self.is_argument(angle) {
            true => self.next_arguments(angle),
            false => vec![angle],
        };
        let pairs: Vec<SinePair> = together.iter().map(|&a| self.pair(a)).collect();
        let parts: Vec<TokenStream> = (together.iter().zip(&pairs))
            .map(|(&a, pair)| self.used(a, pair))
            .collect();
        // The code of an argument may come later in the graph, where it is first used.
        for &angle in &together {
            self.bind_angle(angle);
        }
        let terms: Vec<_> = together.iter().map(|&a| self.terms(a)).collect();
        let statement = match (terms.as_slice(), parts.as_slice()) {
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
        };
        self.push(angle, statement);
        self.sines
            .extend(together.into_iter().zip(pairs.iter().cloned()));
        pairs[0].clone()
    }

    /// Returns whether an angle is an argument, or a sum of arguments.
    fn is_argument(&self, angle: NodeId) -> bool {
        let is_leaf = |id: NodeId| matches!(self.graph.node(id), Node::Leaf(_));
        match self.graph.node(angle) {
            Node::Angle(terms, ..) => terms.iter().all(|t| is_leaf(t.node)),
            _ => is_leaf(angle),
        }
    }

    /// Returns this angle and the next ones that depend only on arguments and are not computed yet, in the
    /// order of use.
    fn next_arguments(&self, angle: NodeId) -> Vec<NodeId> {
        let mut found = vec![angle];
        for i in (0..self.needed.len()).filter(|&i| self.needed[i]) {
            if let Node::Sin(a) | Node::Cos(a) = self.graph.node(NodeId(i as u32))
                && !found.contains(a)
                && !self.sines.contains_key(a)
                && self.is_argument(*a)
            {
                found.push(*a);
                if found.len() == AT_ONCE {
                    break;
                }
            }
        }
        found
    }

    /// Ensures that the arguments in an angle have code.
    fn bind_angle(&mut self, angle: NodeId) {
        let mut read = vec![angle];
        self.graph.node(angle).for_each_operand(|a| read.push(a));
        read.into_iter().for_each(|id| self.bind_leaf(id));
    }

    /// Returns variables for sine and cosine of an angle.
    fn pair(&mut self, angle: NodeId) -> SinePair {
        let name = self.angle_name(angle);
        SinePair {
            sine: self.names.named(&format!("sin_{name}")),
            cosine: self.names.named(&format!("cos_{name}")),
        }
    }

    /// Returns the pattern that binds the used parts of a pair.
    fn used(&self, angle: NodeId, SinePair { sine, cosine }: &SinePair) -> TokenStream {
        let used = |node: &Node| {
            let id = self.graph.find(node);
            id.is_some_and(|id| self.uses[id.0 as usize] > 0)
        };
        match (used(&Node::Sin(angle)), used(&Node::Cos(angle))) {
            (true, true) => quote! { (#sine, #cosine) },
            (true, false) => quote! { (#sine, _) },
            (false, true) => quote! { (_, #cosine) },
            (false, false) => quote! { _ },
        }
    }

    /// Returns the terms of an angle, and its offset if it is a sum.
    fn terms(&mut self, angle: NodeId) -> (Vec<TokenStream>, Option<TokenStream>) {
        let Node::Angle(terms, offset, negative) = self.graph.node(angle).clone() else {
            return (vec![self.operand(Signed::plus(angle), Binding::Sum)], None);
        };
        let terms = terms.iter();
        let terms = terms.map(|&t| self.operand(t, Binding::Sum)).collect();
        let offset = if negative {
            -offset.value()
        } else {
            offset.value()
        };
        let (hi, lo) = (number(offset.hi()), number(offset.lo()));
        (terms, Some(quote! { (#hi, #lo) }))
    }

    /// Returns the names of the joints whose angles are summed: `shoulder_elbow`.
    fn angle_name(&self, angle: NodeId) -> String {
        let joint = |id: NodeId| match self.graph.node(id) {
            Node::Leaf(Leaf::Position(j)) => self.naming.positions[*j].to_string(),
            Node::Leaf(Leaf::Parameter(p)) => self.naming.parameters[*p].to_string(),
            _ => "angle".to_string(),
        };
        match self.graph.node(angle) {
            Node::Angle(terms, ..) => terms
                .iter()
                .map(|t| joint(t.node))
                .collect::<Vec<_>>()
                .join("_"),
            _ => joint(angle),
        }
    }
}
