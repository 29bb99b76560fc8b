//! Which entries of a result each node is, so that an entry is stored as soon as it is known.
//!
//! A result that is put together at the end is stored there as well, entry after entry, with nothing left to
//! compute meanwhile: that costs the mass matrix of a PUMA 5 %, in lanes 9 % (`docs/order.md`). The code
//! therefore begins with a whole result and overwrites its entries. Entries that are not yet known are
//! initialised with the first known one: compilers remove those stores, but not a call that fills memory
//! with zeros.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use crate::expr::{NodeId, QuickMap, Signed};
use crate::method::Shape;

/// Results with fewer entries are put together at the end: there is nothing to be gained.
const LEAST: usize = 16;

/// What the result is called while it is written.
pub(super) const NAME: &str = "entries";

/// Code of the places where each output of a function stands.
pub(super) type EntryTargets = Vec<Vec<TokenStream>>;

/// A result that is written entry by entry.
pub(super) struct Entries<'a> {
    pub(super) outputs: &'a [Signed],
    /// Which outputs a node is.
    pub(super) of: QuickMap<NodeId, Vec<usize>>,
    /// Where each output stands in the result.
    pub(super) places: EntryTargets,
    /// The whole result from its outputs.
    pub(super) whole: &'a dyn Fn(&[TokenStream]) -> TokenStream,
    /// Whether any entry has been written.
    pub(super) begun: bool,
}

impl<'a> Entries<'a> {
    /// For an array.
    pub(super) fn of_array(
        outputs: &'a [Signed],
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
        outputs: &'a [Signed],
        places: EntryTargets,
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
pub(super) fn places(shape: Shape, nv: usize) -> Option<EntryTargets> {
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
