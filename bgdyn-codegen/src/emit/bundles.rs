//! Emits bundles: a function that returns the results of several methods, and the struct with them.

use proc_macro2::TokenStream;
use quote::quote;

use super::body::{FunctionBody, Sizes, body, result};
use super::code::Spelling;
use super::tokens::{argument_type, ident, struct_ident, value_type};
use crate::model::{Bundle, BundlePart, Model};
use crate::plan::summary_of;

/// Returns the struct of a bundle's results.
pub(super) fn bundle_struct(bundle: &Bundle, model: &Model, of: &str) -> TokenStream {
    let function = bundle.function.name();
    let name = ident(&struct_ident(function));
    let about = format!(" Results of [`{of}::{function}`].");
    let fields = bundle.parts.iter().map(|part| {
        let (name, ty) = (ident(&part.name), value_type(part.method.shape()));
        let summary = format!(" {}", summary_of(part.method, model));
        let units = format!(" Units: {}.", part.method.units());
        quote! {
            #[doc = #summary]
            #[doc = #units]
            pub #name: #ty,
        }
    });
    quote! {
        #[doc = #about]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct #name<T = f64> {
            #(#fields)*
        }
    }
}

/// Returns the function of a bundle, and those of its blocks.
pub(super) fn bundle_function(bundle: &Bundle, model: &Model, plain: bool) -> TokenStream {
    let function = &bundle.function;
    let (name, results) = (
        ident(function.name()),
        ident(&struct_ident(function.name())),
    );
    let arguments = function.method.arguments();
    let names = arguments.iter().map(|a| ident(a.name()));
    let types = arguments.iter().map(|a| argument_type(*a));
    let closed = model.bond_graph.closed.as_deref();
    let sizes = Sizes {
        nv: model.mechanism.nv(),
        of_tree: closed.map(|closed| closed.tree.coordinates.len()),
        of_task: bundle.parts.iter().any(|part| part.method.inverts_task()),
    };
    let checked = function.shape().checked();
    let field = |part: &BundlePart, values: &[TokenStream]| {
        let name = ident(&part.name);
        let value = result(part.method, sizes, &values[part.outputs.clone()]);
        match part.method.shape().checked() {
            true => quote! { #name: { #value }? },
            false => quote! { #name: #value },
        }
    };
    let finish = |values: &[TokenStream]| {
        let fields = bundle.parts.iter().map(|part| field(part, values));
        let all = quote! { #results { #(#fields),* } };
        match checked {
            true => quote! { ::core::result::Result::Ok(#all) },
            false => all,
        }
    };
    let returned = match checked {
        true => quote! { ::core::result::Result<#results<T>, T::Singular<NV>> },
        false => quote! { #results<T> },
    };
    let spelling = Spelling::of_model(model, plain);
    let FunctionBody { body, blocks } = body(function, &spelling, None, finish);
    let docs = docs(bundle);
    quote! {
        #(#[doc = #docs])*
        pub fn #name(&self, #(#names: #types),*) -> #returned {
            #body
        }
        #(#blocks)*
    }
}

fn docs(bundle: &Bundle) -> Vec<String> {
    let parts = bundle.parts.iter().map(|part| format!("`{}`", part.name));
    let function = &bundle.function;
    let mut docs = vec![
        format!(" {} in one call.", parts.collect::<Vec<_>>().join(", ")),
        String::new(),
        format!(
            " Operations: {} ({}).",
            function.operations(),
            function.formulation
        ),
    ];
    if function.shape().checked() {
        docs.extend([
            String::new(),
            " # Errors".into(),
            " Those of its methods; then none of them has a result.".into(),
        ]);
    }
    docs
}
