//! Emits private methods that pass a failed function's arguments to a callback.
//!
//! The callback searches them for the cause of the error: an argument that is NaN or infinite.

use std::collections::BTreeMap;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::tokens::{argument_type, ident};
use crate::layout::StateLayout;
use crate::method::{Argument, Directional, Method, Operational, SceneFunction};
use crate::plan::Naming;

/// Returns the methods that the checked functions call, one for each list of arguments.
pub(super) fn explainers(
    methods: impl Iterator<Item = Method>,
    naming: &Naming<'_>,
) -> TokenStream {
    let checked = methods.filter(|method| method.shape().checked());
    let by_name: BTreeMap<&str, Method> = checked.map(|method| (name(method), method)).collect();
    let methods = by_name.into_iter().map(|(name, method)| {
        let arguments = method.arguments();
        let (name, names) = (ident(name), arguments.iter().map(|a| ident(a.name())));
        let types = arguments.iter().map(|a| argument_type(*a));
        let looks = arguments.iter().map(|&argument| look(argument, naming));
        let parameters = parameters(&naming.parameters);
        quote! {
            /// Shows the arguments after a failure: one that is NaN or infinite is its cause.
            #[cold]
            fn #name(&self, look: &mut __rt::Look<'_, T>, #(#names: #types),*) {
                #(#looks)*
                #parameters
            }
        }
    });
    quote! { #(#methods)* }
}

/// Returns these accelerations, or rates, as a `Result`; if they do not all exist, the arguments are
/// searched. The code for this is in the failing branch only, so that it costs nothing elsewhere.
pub(super) fn checked(method: Method, values: &TokenStream, names: &TokenStream) -> TokenStream {
    let (explain, arguments) = (ident(name(method)), method.arguments().iter());
    let arguments = arguments.map(|a| ident(a.name()));
    quote! {{
        let found = #values;
        if T::succeeded(&found, refused) {
            ::core::result::Result::Ok(found)
        } else {
            T::failed(found, refused, #names, |look| self.#explain(look, #(#arguments),*))
                .map_or(::core::result::Result::Ok(found), ::core::result::Result::Err)
        }
    }}
}

/// Returns the name of a method's explainer.
fn name(method: Method) -> &'static str {
    match method {
        Method::Scene(SceneFunction::FromCanonical) => "explain_from_canonical",
        Method::Scene(SceneFunction::CanonicalRates) => "explain_canonical_rates",
        Method::ConstrainedDynamics => "explain_tree",
        Method::ProjectVelocity => "explain_velocities",
        Method::ActuatedInverse(_) => "explain_inverse",
        Method::ActuatedForward(_) | Method::ActuatedReactions(_) => "explain_actuated",
        Method::Operational(Operational::Bias(_)) => "explain_motion",
        Method::Operational(_) | Method::Contact(_) => "explain_position",
        Method::Directional(Directional::ForwardAlong) => "explain_direction",
        Method::Directional(_) => "explain_adjoint",
        _ => "explain",
    }
}

/// Emits the callback for an argument: the argument, the names of its components, their values.
fn look(argument: Argument, naming: &Naming<'_>) -> TokenStream {
    let name: Ident = ident(argument.name());
    let has = |part: fn(&StateLayout) -> bool| naming.layout.is_some_and(part);
    let modes = has(|layout| !layout.modes.is_empty());
    let inputs = has(|layout| !layout.inputs.is_empty());
    let look = |argument: TokenStream, names: TokenStream, values: TokenStream| {
        quote! { look(__rt::Argument::#argument, #names, #values); }
    };
    let (joints, states) = (quote! { &JOINT_NAMES }, quote! { &STATE_NAMES });
    match argument {
        Argument::Q => look(
            quote! { Q },
            quote! { &POSITION_NAMES },
            quote! { #name.as_slice() },
        ),
        Argument::V => look(quote! { V }, joints, quote! { #name.as_slice() }),
        Argument::Tau => look(quote! { Tau }, joints, quote! { #name.as_slice() }),
        Argument::TreeV | Argument::TreeTau => {
            let of = match argument {
                Argument::TreeV => quote! { Qd },
                _ => quote! { Tau },
            };
            look(
                of,
                quote! { &TREE_JOINT_NAMES },
                quote! { #name.as_slice() },
            )
        }
        Argument::ActuatedTau => look(
            quote! { Tau },
            quote! { &ACTUATED },
            quote! { #name.as_slice() },
        ),
        Argument::A => look(quote! { A }, joints, quote! { #name.as_slice() }),
        Argument::State => {
            let state = look(
                quote! { State },
                states,
                quote! { state.vector().as_slice() },
            );
            let values = quote! { state.modes().as_slice() };
            let modes = modes.then(|| look(quote! { Modes }, quote! { &MODE_NAMES }, values));
            quote! { #state #modes }
        }
        Argument::Input if inputs => {
            let values = quote! { input.vector().as_slice() };
            look(quote! { Input }, quote! { &INPUT_NAMES }, values)
        }
        Argument::Modes if modes => {
            let values = quote! { modes.as_slice() };
            look(quote! { Modes }, quote! { &MODE_NAMES }, values)
        }
        Argument::Input | Argument::Modes => quote! {},
        // Arguments of methods that always have a result.
        Argument::ReferenceV | Argument::ReferenceA => quote! {},
        Argument::Direction | Argument::BodyParameters => quote! {},
        Argument::AlongA => quote! {},
        Argument::AlongQ => look(quote! { Dq }, joints, quote! { #name.as_slice() }),
        Argument::AlongV => look(quote! { Dv }, joints, quote! { #name.as_slice() }),
        Argument::AlongTau => look(quote! { Dtau }, joints, quote! { #name.as_slice() }),
        Argument::Cotangent => look(quote! { L }, joints, quote! { #name.as_slice() }),
        Argument::Canonical => look(quote! { Canonical }, states, quote! { #name.as_slice() }),
        Argument::Time => look(quote! { Time }, quote! { &["t"] }, quote! { &[t] }),
        Argument::Accelerations => {
            unreachable!("nothing of a scene that takes accelerations is checked")
        }
    }
}

/// Emits the callback for the run-time parameters.
fn parameters(names: &[&str]) -> Option<TokenStream> {
    let fields = names.iter().map(|name| ident(name));
    let values = quote! { &[#(self.#fields),*] };
    (!names.is_empty())
        .then(|| quote! { look(__rt::Argument::Parameters, &[#(#names),*], #values); })
}
