//! Emits the function that sets the motion of a base that is given at run time.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::mechanism::BASE_PARAMETERS;

/// Returns `set_base_motion`; nothing unless the motion of the base is `given`.
pub(super) fn base_access(given: bool) -> TokenStream {
    if !given {
        return TokenStream::new();
    }
    let sets = BASE_PARAMETERS.iter().flat_map(|(name, ..)| {
        let part = format_ident!("{}", name.trim_start_matches("base_"));
        ["x", "y", "z"]
            .into_iter()
            .enumerate()
            .map(move |(k, axis)| {
                let field = format_ident!("{name}_{axis}");
                quote! { self.#field = motion.#part[#k]; }
            })
    });
    quote! {
        /// Sets the motion of the base: the nine fields `base_…`. Efforts and accelerations depend on it.
        /// Poses, velocities and energies are relative to the base.
        pub fn set_base_motion(&mut self, motion: &__rt::BaseMotion<T>) {
            #(#sets)*
        }
    }
}
