//! Emits a symmetric matrix whose entries are mainly inner products of the vectors of two tables.
//!
//! The tables contain results of earlier blocks, the vectors of rows component by component. So the loop
//! over the rows of a column runs in the lanes of a register.

use std::collections::BTreeSet;

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::code::Naming;
use super::writer::Writer;
use crate::expr::Signed;
use crate::function::{Block, Function, InnerProducts, in_triangle};

/// Returns the code for the matrix of a block with products.
pub(super) fn matrix(function: &Function, naming: &Naming<'_>, block: &Block) -> TokenStream {
    let products = &block.products;
    let looped: BTreeSet<(usize, usize)> =
        products.iter().flat_map(InnerProducts::places).collect();
    let triangle = (0..).flat_map(|row| (0..=row).map(move |column| (row, column)));
    let alone = triangle.take(block.outputs.len());
    let alone: Vec<(usize, usize)> = alone.filter(|place| !looped.contains(place)).collect();
    let entry = |&(row, column): &(usize, usize)| block.outputs[in_triangle(row, column)];
    let written: Vec<Signed> = alone.iter().map(entry).collect();
    let vectors = products
        .iter()
        .flat_map(|p| p.rows.values().chain(p.columns.values()));
    let all: Vec<Signed> = written.iter().chain(vectors.flatten()).copied().collect();
    let mut writer = Writer::new(function, naming, &all);
    let statements = writer.block(&all, function);
    let values = writer.results(&written);
    let entries = alone.iter().zip(values).map(|(&(row, column), value)| {
        let (row, column) = (place(row), place(column));
        quote! { entries.data.0[#column][#row] = #value; }
    });
    let entries: Vec<TokenStream> = entries.collect();
    let loops = products.iter().map(|p| inner_products(&mut writer, p));
    let loops: Vec<TokenStream> = loops.collect();
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
fn inner_products(writer: &mut Writer<'_>, products: &InnerProducts) -> TokenStream {
    let columns = products.runs.iter().map(|(column, _)| {
        let values = writer.results(&products.columns[column]);
        quote! { [#(#values),*] }
    });
    let columns: Vec<TokenStream> = columns.collect();
    let terms = products.rows.values().next().map_or(0, Vec::len);
    let last = products.rows.keys().next_back().copied().unwrap_or(0);
    let zero = quote! { T::from_f64(0.0) };
    let components = (0..terms).map(|i| {
        let value = |row: usize| match products.rows.get(&row) {
            Some(vector) => writer.results(&vector[i..=i]).remove(0),
            None => zero.clone(),
        };
        let values: Vec<TokenStream> = (0..=last).map(value).collect();
        quote! { [#(#values),*] }
    });
    let components: Vec<TokenStream> = components.collect();
    let runs = products.runs.iter().map(|(column, rows)| {
        let run = [*column, rows.start, rows.end].map(place);
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

fn place(index: usize) -> Literal {
    Literal::usize_unsuffixed(index)
}
