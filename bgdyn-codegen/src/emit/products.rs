//! Emits a symmetric matrix whose entries are mainly inner products of the vectors of two tables.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::code::{Binding, Spelling};
use super::writer::Writer;
use crate::function::Function;
use crate::plan::{Listing, ProductPlan, ProductTable};

/// Returns the code for the matrix of a block with products.
pub(super) fn matrix(
    function: &Function,
    plan: &ProductPlan<'_>,
    spelling: &Spelling<'_>,
) -> TokenStream {
    let listing = Listing::new(
        &plan.block,
        function,
        &spelling.naming,
        &spelling.reserved(),
    );
    let writer = Writer::new(&listing, spelling);
    let statements = writer.statements();
    let entries = plan.entries().map(|((row, column), value)| {
        let (row, column) = (literal_index(row), literal_index(column));
        let value = writer.operand(value, Binding::Sum);
        quote! { entries.data.0[#column][#row] = #value; }
    });
    let loops = plan
        .tables
        .iter()
        .map(|table| inner_products(&writer, table));
    quote! {
        #statements
        let mut entries = __rt::matrix([[T::from_f64(0.0); NV]; NV]);
        #(#entries)*
        #(#loops)*
        __rt::mirror(&mut entries);
        entries
    }
}

/// Returns the call that computes products: a vector for each run, the rows' vectors component by
/// component.
fn inner_products(writer: &Writer<'_>, table: &ProductTable) -> TokenStream {
    let columns = table.columns.iter().map(|vector| {
        let values = writer.values(vector);
        quote! { [#(#values),*] }
    });
    let components = table.components.iter().map(|component| {
        let values = component.iter().map(|value| match value {
            Some(value) => writer.operand(*value, Binding::Sum),
            None => quote! { T::from_f64(0.0) },
        });
        quote! { [#(#values),*] }
    });
    let runs = table.runs.iter().map(|run| {
        let run = run.map(literal_index);
        quote! { [#(#run),*] }
    });
    quote! {
        __rt::inner_products(
            &mut entries,
            &[#(#components),*],
            &[#(#columns),*],
            &[#(#runs),*],
        );
    }
}

fn literal_index(index: usize) -> Literal {
    Literal::usize_unsuffixed(index)
}
