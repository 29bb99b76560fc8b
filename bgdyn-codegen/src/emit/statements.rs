//! Emits the statements of a block from its listing.

use proc_macro2::TokenStream;
use quote::quote;

use super::tokens::{comment, ident, number};
use super::writer::Writer;
use crate::expr::Node;
use crate::plan::{ArgumentNames, BlockStep, Comments, Listing, NamedConstant};

impl Writer<'_> {
    /// Emits the statements of the block.
    pub(super) fn statements(&self) -> TokenStream {
        let Listing {
            block,
            arguments,
            constants,
            unit,
            lines,
            ..
        } = self.listing;
        let is_constant = |node| matches!(block.graph.node(node), Node::Constant(_));
        let has_constants = !self.spelling.plain && block.nodes().any(is_constant);
        let constants = constants.iter().map(constant);
        let arguments = arguments.iter().map(argument);
        let k = has_constants.then(|| quote! { let k = <T as __Scalar>::from_f64; });
        let lines = lines.iter().map(|line| {
            let comments = comments(&line.comments);
            let statement = self.statement(line.step);
            quote! { #comments #statement }
        });
        let whole = quote! { #(#constants)* #(#arguments)* #k #(#lines)* };
        let unit = unit.as_deref().filter(|_| !whole.is_empty()).map(comment);
        quote! { #unit #whole }
    }

    fn statement(&self, step: &BlockStep) -> TokenStream {
        match step {
            BlockStep::Constant(_) => TokenStream::new(),
            BlockStep::Value(id) => {
                let name = self.listing.name(*id).map(ident);
                let value = self.operation(self.listing.block.graph.node(*id)).tokens;
                quote! { let #name = #value; }
            }
            BlockStep::Sines(angles) => self.sines(angles),
            BlockStep::Begin(first) => self.begin(*first),
            BlockStep::Store(output) => self.store(*output),
        }
    }
}

fn comments(comments: &Comments) -> TokenStream {
    let heading = comments.heading.map(comment);
    let unit = comments.unit.as_deref().map(comment);
    let title = comments.title.as_deref().map(comment);
    quote! { #heading #unit #title }
}

/// Emits the definition of a named number.
fn constant(constant: &NamedConstant) -> TokenStream {
    let (about, name) = (format!(" {}", constant.about), ident(&constant.identifier));
    let value = number(constant.value.to_f64());
    quote! { #[doc = #about] const #name: f64 = #value; }
}

/// Binds the components of an argument that are read.
fn argument(argument: &ArgumentNames) -> TokenStream {
    let name = ident(argument.argument.name());
    let part = |variable: &Option<String>| match variable.as_deref().map(ident) {
        Some(variable) => quote! { #variable },
        None => quote! { _ },
    };
    let parts = argument.components.iter().map(|(_, name)| part(name));
    quote! { let [[#(#parts),*]] = #name.data.0; }
}
