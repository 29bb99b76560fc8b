//! The module that stands in for a refused scene.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::{Place, ident, rebuild, struct_ident};

/// The module that stands in for a refused scene: its types without parts, and no functions. What
/// a scene's parts are called is known only once it is sound.
pub fn scene_fallback(stem: &str, place: &Place) -> TokenStream {
    let name = place.module_ident(stem);
    let model = ident(&struct_ident(stem));
    let visibility = &place.visibility;
    let rebuild = rebuild(place);
    let doc = format!(" The scene {} was refused: see the error.", place.source);
    let types = [
        "State",
        "Rates",
        "Coordinates",
        "Input",
        "Output",
        "Energy",
        "Power",
    ];
    let types = types.iter().map(|name| ident(name)).chain([model]);
    let types = types.map(|name| {
        quote! {
            #[doc = #doc]
            #[derive(Clone, Copy, Debug, Default, PartialEq)]
            pub struct #name<T = f64> { scalar: ::core::marker::PhantomData<T> }
        }
    });
    quote! {
        #[doc = #doc]
        #[allow(unused, unreachable_pub, clippy::all, reason = "stands in for a refused scene")]
        #visibility mod #name {
            #rebuild
            #(#types)*
        }
    }
}
