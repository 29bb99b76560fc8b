//! Emits the constants of a scene's module: sizes and names.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::constants::size;
use super::super::tokens::ident;
use super::parts::{StructField, moving_parts, of_named};
use crate::interface::SceneInterface;
use crate::scene::StateLayout;

pub(super) fn constants(scene: &SceneInterface) -> TokenStream {
    let layout = &scene.layout;
    let list = |name: &str, about: &str, length: &str, names: Vec<String>| {
        let (name, length, about) = (ident(name), ident(length), format!(" {about}"));
        quote! { #[doc = #about] pub const #name: [&str; #length] = [#(#names),*]; }
    };
    let sizes = [
        ("NQ", "Number of positions.", layout.nq()),
        ("NV", "Number of velocities.", layout.nv()),
        ("NX", "Number of first-order states.", layout.nx()),
        (
            "N",
            "Numbers that change in time: positions, velocities, first-order states.",
            layout.nq() + layout.nv() + layout.nx(),
        ),
        ("NM", "Number of modes.", layout.modes.len()),
        ("NU", "Number of inputs.", layout.inputs.len()),
        ("NY", "Number of outputs.", scene.outputs.len()),
        ("NE", "Number of events.", layout.events.len()),
    ];
    let sizes = sizes.iter().map(|(name, about, n)| {
        let (name, about, n) = (ident(name), format!(" {about}"), size(*n));
        quote! { #[doc = #about] pub const #name: usize = #n; }
    });
    let names = |parts: Vec<StructField>| parts.into_iter().map(|p| p.name).collect::<Vec<_>>();
    let part_names = |parts: &[crate::scene::Variable]| -> Vec<String> {
        parts.iter().map(|p| p.name.clone()).collect()
    };
    let state = list(
        "STATE_NAMES",
        "Parts of the state.",
        "N",
        names(moving_parts(layout)),
    );
    let modes = list("MODE_NAMES", "Modes.", "NM", part_names(&layout.modes));
    let inputs = list("INPUT_NAMES", "Inputs.", "NU", part_names(&layout.inputs));
    let outputs = names(of_named(&scene.outputs));
    let outputs = list("OUTPUT_NAMES", "Outputs.", "NY", outputs);
    let events = list("EVENT_NAMES", "Events.", "NE", part_names(&layout.events));
    let of_event = layout.events.iter().map(|e| match layout.mode_of(e) {
        Some(mode) => {
            let mode = size(mode);
            quote! { ::core::option::Option::Some(#mode) }
        }
        None => quote! { ::core::option::Option::None },
    });
    let rate_names: Vec<&String> = layout
        .coordinates
        .iter()
        .map(|c| &c.name)
        .chain(layout.states.iter().map(|s| &s.name))
        .collect();
    let entries = of_named(&scene.entries);
    let entry_count = size(entries.len());
    let entry_names = entries.iter().map(|e| &e.name);
    let coordinates = layout.coordinates.iter().map(|c| &c.name);
    let loops = loops(layout, &rate_names);
    quote! {
        #(#sizes)*
        #state
        #modes
        #inputs
        #outputs
        #events
        /// The coordinates, in the order of the velocities.
        pub const COORDINATE_NAMES: [&str; NV] = [#(#coordinates),*];
        /// The mode that each event may change.
        pub const EVENT_MODES: [::core::option::Option<usize>; NE] = [#(#of_event),*];
        /// Entries of the balance of power.
        pub const ENTRY_NAMES: [&str; #entry_count] = [#(#entry_names),*];
        /// Names in errors: of coordinates, then of first-order states.
        pub const RATE_NAMES: [&str; NV + NX] = [#(#rate_names),*];
        #loops
    }
}

/// Returns the constants of a scene with loops: names in errors, and the dependent joints.
fn loops(layout: &StateLayout, rate_names: &[&String]) -> TokenStream {
    if layout.loops.is_empty() {
        return TokenStream::new();
    }
    let loops = &layout.loops;
    let names = size(rate_names.len() + loops.len());
    let dependents = layout.closing.iter().map(|&(position, closes)| {
        let [position, closes] = [position, closes].map(size);
        quote! {
            __rt::closure::Dependent { velocity: #position, position: #position, closes: #closes }
        }
    });
    let count = size(layout.closing.len());
    quote! {
        /// Names in errors: those of [`RATE_NAMES`], then of the loops and contacts.
        pub const PIVOT_NAMES: [&str; #names] = [#(#rate_names,)* #(#loops),*];
        /// The positions that change where loops close and wheels touch.
        const DEPENDENTS: [__rt::closure::Dependent; #count] = [#(#dependents),*];
    }
}
