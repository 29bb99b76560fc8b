//! Results of many entries, each written as soon as it is known.
//!
//! A result that is put together at the end is stored there as well, one entry after the other with
//! nothing left to compute meanwhile: so the mass matrix of a PUMA takes 5 % longer, in lanes 9 %
//! (`docs/order.md`). The code begins with a whole result and writes over its entries as it gets to know them. What stands in
//! them until then is the first entry: a value that is there, for compilers to drop as never read. (Of
//! zeros they make a call that fills memory, and do not drop that.)

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::code::{Binding, atom};
use super::number;
use super::writer::Writer;
use crate::expr::{Expr, Node, NodeId, QuickMap};
use crate::method::Shape;

/// Results with fewer entries are put together at the end: there is nothing to be gained.
const LEAST: usize = 16;

/// What the result is called while it is written.
pub(super) const NAME: &str = "entries";

/// Code of the places where each output of a function stands.
pub(super) type Places = Vec<Vec<TokenStream>>;

/// A result that is written entry by entry.
pub(super) struct Entries<'a> {
    outputs: &'a [Expr],
    /// Which outputs a node is.
    of: QuickMap<NodeId, Vec<usize>>,
    /// Where each output stands in the result.
    places: Places,
    /// The whole result from its outputs.
    whole: &'a dyn Fn(&[TokenStream]) -> TokenStream,
    /// Whether any entry has been written.
    begun: bool,
}

impl<'a> Entries<'a> {
    /// For an array.
    pub(super) fn of_array(
        outputs: &'a [Expr],
        whole: &'a dyn Fn(&[TokenStream]) -> TokenStream,
    ) -> Option<Self> {
        let name = format_ident!("{NAME}");
        let place = |k| {
            let k = index(k);
            vec![quote! { #name[#k] }]
        };
        Self::new(outputs, (0..outputs.len()).map(place).collect(), whole)
    }

    /// For a result whose outputs stand in these places; nothing where it is put together at the end.
    pub(super) fn new(
        outputs: &'a [Expr],
        places: Places,
        whole: &'a dyn Fn(&[TokenStream]) -> TokenStream,
    ) -> Option<Self> {
        let count: usize = places.iter().map(Vec::len).sum();
        if count < LEAST {
            return None;
        }
        let mut of: QuickMap<NodeId, Vec<usize>> = QuickMap::default();
        for (k, output) in outputs.iter().enumerate() {
            of.entry(output.node).or_default().push(k);
        }
        Some(Entries {
            outputs,
            of,
            places,
            whole,
            begun: false,
        })
    }
}

/// Where the outputs of a function stand in its matrices; nothing for other results.
pub(super) fn places(shape: Shape, nv: usize) -> Option<Places> {
    let name = format_ident!("{NAME}");
    let place = |matrix: Option<usize>, i: usize, j: usize| {
        let matrix = matrix.map(index).map(|k| quote! { [#k] });
        let (i, j) = (index(i), index(j));
        quote! { #name #matrix.data.0[#j][#i] }
    };
    let full = |matrix, rows: usize| {
        let entries = (0..rows).flat_map(move |i| (0..nv).map(move |j| (i, j)));
        entries.map(move |(i, j)| vec![place(matrix, i, j)])
    };
    Some(match shape {
        Shape::Symmetric => {
            let triangle = (0..nv).flat_map(|i| (0..=i).map(move |j| (i, j)));
            let both = |(i, j)| match i == j {
                true => vec![place(None, i, j)],
                false => vec![place(None, i, j), place(None, j, i)],
            };
            triangle.map(both).collect()
        }
        Shape::Square => full(None, nv).collect(),
        Shape::Jacobian => full(None, 6).collect(),
        Shape::SquarePair => full(Some(0), nv).chain(full(Some(1), nv)).collect(),
        _ => return None,
    })
}

fn index(k: usize) -> Literal {
    Literal::usize_unsuffixed(k)
}

impl Writer<'_> {
    /// The result, if it was written entry by entry; if not although it was to be, all are constants.
    pub(super) fn written(&self) -> Option<Ident> {
        let begun = self.entries.as_ref().is_some_and(|entries| entries.begun);
        begun.then(|| format_ident!("{NAME}"))
    }

    /// Writes a node that is known into the entries that it is.
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

    /// The whole result: constants where they belong, elsewhere the first entry.
    fn begin(&mut self, first: NodeId, entries: &Entries<'_>) {
        if let Some(code) = &self.code[first.0 as usize]
            && code.binding != Binding::Atom
        {
            let (variable, tokens) = (self.names.numbered(), code.tokens.clone());
            self.push(first, quote! { let #variable = #tokens; });
            self.code[first.0 as usize] = Some(atom(quote! { #variable }));
        }
        let first_value = self.operand(Expr::plus(first), Binding::Sum);
        let value = |e: &Expr| match self.constant(e.node) {
            Some(value) if e.negative => quote! { -#value },
            Some(value) => value,
            None => first_value.clone(),
        };
        let values: Vec<TokenStream> = entries.outputs.iter().map(value).collect();
        let (name, whole) = (format_ident!("{NAME}"), (entries.whole)(&values));
        if entries
            .outputs
            .iter()
            .any(|e| self.constant(e.node).is_some())
        {
            self.use_constants();
        }
        self.push_untitled(quote! { let mut #name = #whole; });
    }

    /// The code of a constant.
    fn constant(&self, id: NodeId) -> Option<TokenStream> {
        match self.graph.node(id) {
            Node::Constant(c) => {
                let value = number(c.value().to_f64());
                Some(quote! { k(#value) })
            }
            _ => None,
        }
    }
}
