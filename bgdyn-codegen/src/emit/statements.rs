//! Emits the statements of one block: a `let` for each value that is used more than once.

use bgdyn_runtime::Dd;
use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use super::code::{Binding, Code, atom, leaves};
use super::named_constants::unit_of_length;
use super::order::{STATEMENT, order};
use super::tokens::{COMMENT, number};
use super::writer::Writer;
use crate::expr::{Node, NodeId, Signed};
use crate::function::Function;
use crate::legend::LegendQuantity;

impl Writer<'_> {
    /// Emits the statements of a block.
    pub(super) fn block(&mut self, outputs: &[Signed], function: &Function) -> TokenStream {
        let arguments = self.arguments(function, &leaves(self.graph, outputs));
        let unit = self.first_unit();
        for id in self.order(outputs) {
            if self.code[id.place()].is_none() {
                self.node(id);
            }
            self.store(id);
        }
        let constants = self
            .constants
            .then(|| quote! { let k = <T as __Scalar>::from_f64; });
        let statements = std::mem::take(&mut self.statements);
        let named = self.named_constants.items(self.unit);
        let whole = quote! { #named #arguments #constants #(#statements)* };
        match unit.filter(|_| !whole.is_empty()) {
            Some(unit) => quote! { #[doc = #unit] #whole },
            None => whole,
        }
    }

    /// Returns the needed nodes in the order in which they are written.
    fn order(&mut self, outputs: &[Signed]) -> Vec<NodeId> {
        let stored = self.entries.is_some();
        if let Some(order) = order(self.graph, &self.needed, outputs, stored) {
            let title = format!(
                "{COMMENT} in an order that keeps few values at a time: the steps are mixed"
            );
            self.push_untitled(quote! { #[doc = #title] });
            self.mixed = true;
            return order;
        }
        let needed = (0..self.needed.len()).filter(|&i| self.needed[i]);
        needed.map(NodeId::at).collect()
    }

    /// Returns a comment on the unit of length at the beginning of the block, if it is not the metre.
    fn first_unit(&mut self) -> Option<String> {
        let needed = (0..self.needed.len()).filter(|&i| self.needed[i]);
        let nodes = needed.map(NodeId::at);
        let nodes =
            nodes.filter(|&id| !matches!(self.graph.node(id), Node::Leaf(_) | Node::Constant(_)));
        let unit = nodes.clone().find_map(|id| self.graph.unit_of_length(id))?;
        self.unit = Some(unit);
        if unit == Dd::ONE {
            return None;
        }
        let names = nodes.filter_map(|id| self.graph.name(id));
        let quantities = names.filter_map(|name| LegendQuantity::of_name(&name.text));
        let patterns = quantities.map(|(quantity, _)| quantity.pattern()).collect();
        Some(unit_of_length(unit, &patterns))
    }

    /// Returns the code of the block's results.
    pub(super) fn results(&mut self, outputs: &[Signed]) -> Vec<TokenStream> {
        outputs
            .iter()
            .map(|&e| self.operand(e, Binding::Sum))
            .collect()
    }

    /// Returns a number as a scalar.
    pub(super) fn scalar(&mut self, value: TokenStream) -> Code {
        if self.naming.plain {
            return atom(value);
        }
        self.use_constants();
        atom(quote! { k(#value) })
    }

    /// Returns a number's name, or its digits if it has none.
    pub(super) fn number_of(&mut self, value: Dd) -> TokenStream {
        match self.graph.constant_name(value) {
            Some(name) => self.named_constants.add(&mut self.names, name, value),
            None => number(value.to_f64()).into_token_stream(),
        }
    }

    /// Emits a node: its code for the users, after a statement of its own if it needs one.
    fn node(&mut self, id: NodeId) {
        let i = id.0 as usize;
        let code = match self.graph.node(id) {
            Node::Leaf(leaf) => match self.leaf(*leaf) {
                Some(code) => code,
                None => return,
            },
            Node::Constant(c) => {
                let value = self.number_of(c.value());
                self.scalar(value)
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
            // Emitted with the sine.
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
            && !matches!(self.graph.node(id), Node::MulAdd(..))
            && self.graph.name(id).is_none();
        self.code[i] = Some(if is_operation && !inline {
            self.bind(id, code)
        } else {
            code
        });
    }
}
