//! The private methods that find the cause of an error: an argument that is NaN or infinite. They run after a failure.

use std::collections::BTreeMap;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::code::Naming;
use super::tokens::{argument_type, ident};
use crate::function::Function;
use crate::method::{Argument, Method, SceneFunction};

/// The methods that the checked ones among these functions call, one for each list of arguments;
/// `error` is the type of the error.
pub(super) fn explainers(
    functions: &[Function],
    naming: &Naming<'_>,
    error: &TokenStream,
) -> TokenStream {
    let checked = functions.iter().filter(|f| f.shape().checked());
    let by_name: BTreeMap<&str, Method> = checked.map(|f| (name(f.method), f.method)).collect();
    let methods = by_name.into_iter().map(|(name, method)| {
        let arguments = method.arguments();
        let (name, names) = (ident(name), arguments.iter().map(|a| ident(a.name())));
        let types = arguments.iter().map(|a| argument_type(*a));
        let looks = arguments.iter().map(|&argument| look(argument, naming));
        let parameters = parameters(&naming.parameters);
        quote! {
            /// The error with its cause: which argument is NaN or infinite, if one is.
            #[cold]
            fn #name(&self, error: #error, #(#names: #types),*) -> #error {
                T::explain(error, |look| {
                    #(#looks)*
                    #parameters
                })
            }
        }
    });
    quote! { #(#methods)* }
}

/// The call of a method's explainer, for `map_err`.
pub(super) fn explain(method: Method) -> TokenStream {
    let (name, names) = (ident(name(method)), method.arguments().iter());
    let names = names.map(|a| ident(a.name()));
    quote! { |error| self.#name(error, #(#names),*) }
}

/// What a method's explainer is called.
fn name(method: Method) -> &'static str {
    match method {
        Method::Scene(SceneFunction::FromCanonical) => "explain_from_canonical",
        Method::Scene(SceneFunction::CanonicalRates) => "explain_canonical_rates",
        _ => "explain",
    }
}

/// Shows an argument: its name, the names of its components, their values.
fn look(argument: Argument, naming: &Naming<'_>) -> TokenStream {
    let text = argument.name();
    let name: Ident = ident(text);
    let (modes, inputs) = match naming.layout {
        Some(layout) => (!layout.modes.is_empty(), !layout.inputs.is_empty()),
        None => (false, false),
    };
    match argument {
        Argument::Q | Argument::V | Argument::A | Argument::Tau => {
            quote! { look(#text, &JOINT_NAMES, #name.as_slice()); }
        }
        Argument::State => {
            let modes = modes.then(|| {
                quote! { look("modes", &MODE_NAMES, state.modes().as_slice()); }
            });
            quote! { look(#text, &STATE_NAMES, state.vector().as_slice()); #modes }
        }
        Argument::Input if inputs => {
            quote! { look(#text, &INPUT_NAMES, input.vector().as_slice()); }
        }
        Argument::Modes if modes => quote! { look(#text, &MODE_NAMES, modes.as_slice()); },
        Argument::Input | Argument::Modes => quote! {},
        Argument::Canonical => quote! { look(#text, &STATE_NAMES, #name.as_slice()); },
        Argument::Time => quote! { look(#text, &[#text], &[t]); },
        Argument::Accelerations => unreachable!("nothing that takes accelerations is checked"),
    }
}

/// Shows the run-time parameters.
fn parameters(names: &[&str]) -> Option<TokenStream> {
    let fields = names.iter().map(|name| ident(name));
    (!names.is_empty()).then(|| quote! { look("self", &[#(#names),*], &[#(self.#fields),*]); })
}
