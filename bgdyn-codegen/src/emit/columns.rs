//! Emits similar columns as a loop, with the values of each column in arrays, row by row.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::code::{Naming, atom};
use super::names::LoopArrays;
use super::tokens::COMMENT;
use super::writer::Writer;
use crate::column_loop::{ColumnLoop, LoopedResult, OWN, ResultSource, SHARED};
use crate::expr::{Leaf, Node, NodeId};
use crate::function::Function;

/// Returns the loops, and the function's results including those of the loops; `stage` is the code of the
/// results of the blocks.
pub(super) fn columns(
    function: &Function,
    loops: &LoopedResult,
    naming: &Naming<'_>,
    stage: &[TokenStream],
) -> (TokenStream, Vec<TokenStream>) {
    let groups = loops.groups.iter().enumerate();
    let code =
        groups.map(|(k, group)| column_group(function, group, &LoopArrays::of(k), naming, stage));
    let code = code.collect();
    let value = |part: &ResultSource| match *part {
        ResultSource::Stage(k) => stage[k].clone(),
        ResultSource::Column { group, column, row } => {
            let LoopArrays { found, .. } = LoopArrays::of(group);
            let (row, column) = (place(row), place(column));
            quote! { #found[#row][#column] }
        }
    };
    (code, loops.parts.iter().map(value).collect())
}

fn column_group(
    function: &Function,
    group: &ColumnLoop,
    arrays: &LoopArrays,
    naming: &Naming<'_>,
    stage: &[TokenStream],
) -> TokenStream {
    let LoopArrays { shared, own, found } = arrays;
    let column = function.of_column(group);
    let mut writer = Writer::new(&column, naming, &group.outputs);
    for i in 0..group.graph.len() {
        writer.code[i] = match *group.graph.node(NodeId::at(i)) {
            Node::Leaf(Leaf::BlockResult { block, index }) => {
                let index = place(index);
                Some(atom(match block {
                    SHARED => quote! { #shared[#index] },
                    OWN => quote! { #own[#index][c] },
                    _ => unreachable!("a column reads two kinds of values"),
                }))
            }
            _ => None,
        };
    }
    let statements = writer.block(&group.outputs, &column);
    let results = writer.results(&group.outputs);
    let rows = (0..results.len()).map(place);
    let values = group.shared.iter().map(|&k| &stage[k]);
    let own_rows = (0..group.own.first().map_or(0, Vec::len)).map(|row| {
        let values = group.own.iter().map(|places| &stage[places[row]]);
        quote! { [#(#values),*] }
    });
    let (count, height) = (place(group.own.len()), place(results.len()));
    let title =
        format!("{COMMENT} the same for each column: row by row what it reads, and its results");
    quote! {
        #[doc = #title]
        let #shared = [#(#values),*];
        let #own = [#(#own_rows),*];
        let mut #found = [[T::from_f64(0.0); #count]; #height];
        for c in 0..#count {
            #statements
            #(#found[#rows][c] = #results;)*
        }
    }
}

fn place(index: usize) -> Literal {
    Literal::usize_unsuffixed(index)
}
