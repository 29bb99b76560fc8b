//! Emits similar columns as a loop, with the values of each column in arrays, row by row.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::code::Spelling;
use super::tokens::{comment, ident};
use super::writer::{ColumnArrays, Writer};
use crate::column_loop::ResultSource;
use crate::function::Function;
use crate::plan::{ColumnPlan, Listing, LoopArrays};

/// Returns the loops, and the function's results including those of the loops; `stage` is the code of the
/// results of the blocks.
pub(super) fn columns(
    function: &Function,
    loops: &[ColumnPlan<'_>],
    spelling: &Spelling<'_>,
    stage: &[TokenStream],
) -> (TokenStream, Vec<TokenStream>) {
    let groups = loops.iter().enumerate();
    let code = groups.map(|(k, plan)| column_group(function, plan, k, spelling, stage));
    let value = |part: &ResultSource| match *part {
        ResultSource::Stage(k) => stage[k].clone(),
        ResultSource::Column { group, column, row } => {
            let found = ident(&LoopArrays::of(group).found);
            let (row, column) = (literal_index(row), literal_index(column));
            quote! { #found[#row][#column] }
        }
    };
    let parts = function.loops.iter().flat_map(|loops| &loops.parts);
    (code.collect(), parts.map(value).collect())
}

fn column_group(
    function: &Function,
    plan: &ColumnPlan<'_>,
    group: usize,
    spelling: &Spelling<'_>,
    stage: &[TokenStream],
) -> TokenStream {
    let LoopArrays { shared, own, found } = LoopArrays::of(group);
    let (shared, own, found) = (ident(&shared), ident(&own), ident(&found));
    let listing = Listing::new(
        &plan.column,
        function,
        &spelling.naming,
        &spelling.reserved(),
    );
    let mut writer = Writer::new(&listing, spelling);
    writer.arrays = Some(ColumnArrays {
        shared: shared.clone(),
        own: own.clone(),
    });
    let statements = writer.statements();
    let results = writer.values(&plan.column.outputs);
    let rows = (0..results.len()).map(literal_index);
    let values = plan.group.shared.iter().map(|&k| &stage[k]);
    let own_rows = plan.own_rows().into_iter().map(|row| {
        let values = row.into_iter().map(|k| &stage[k]);
        quote! { [#(#values),*] }
    });
    let (count, height) = (
        literal_index(plan.group.own.len()),
        literal_index(results.len()),
    );
    let title = comment("the same for each column: row by row what it reads, and its results");
    quote! {
        #title
        let #shared = [#(#values),*];
        let #own = [#(#own_rows),*];
        let mut #found = [[T::from_f64(0.0); #count]; #height];
        for c in 0..#count {
            #statements
            #(#found[#rows][c] = #results;)*
        }
    }
}

fn literal_index(index: usize) -> Literal {
    Literal::usize_unsuffixed(index)
}
