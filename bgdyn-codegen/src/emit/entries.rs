//! Maps nodes to entries of a result, so that an entry is stored as soon as it is computed.
//!
//! If a result is built at the end, all entries are stored then, with no computation left to overlap: this
//! costs the mass matrix of a PUMA 5 %, in lanes 9 % (`docs/order.md`). The code therefore begins with a
//! whole result and overwrites its entries. Entries that are not yet known are initialised with the first
//! known one: compilers remove those stores, but not a call that fills memory with zeros. Large results with
//! many zeros are filled with zeros nevertheless, which takes less time than to store the zeros one by one.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use crate::expr::{NodeId, QuickMap, Signed};
use crate::method::Shape;

/// Results with fewer entries are built at the end, because nothing would be gained.
const LEAST: usize = 16;

/// The name of the result while it is written.
pub(super) const NAME: &str = "entries";

/// Code of the targets of each output of a function.
pub(super) type EntryTargets = Vec<Vec<TokenStream>>;

/// A result that is written entry by entry.
pub(super) struct Entries<'a> {
    pub(super) outputs: &'a [Signed],
    /// Indices of the outputs that are equal to a node.
    pub(super) of: QuickMap<NodeId, Vec<usize>>,
    /// Targets of each output in the result.
    pub(super) places: EntryTargets,
    /// Builds the whole result from its outputs.
    pub(super) whole: &'a dyn Fn(&[TokenStream]) -> TokenStream,
    /// Whether any entry has been written.
    pub(super) begun: bool,
}

impl<'a> Entries<'a> {
    /// Returns the entries of an array.
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

    /// Returns the entries of a result with these targets; `None` if it is built at the end.
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

/// Returns the targets of a function's outputs in its matrices; `None` for other results.
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
