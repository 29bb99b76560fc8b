//! The named parts of a scene's types.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::super::tokens::{ident, number};
use crate::scene::StateLayout;
use crate::system::Named;

/// A part of a named type: name, documentation.
pub(super) struct StructField {
    pub(super) name: String,
    pub(super) about: String,
}

pub(super) fn field(name: impl Into<String>, about: impl Into<String>) -> StructField {
    StructField {
        name: name.into(),
        about: about.into(),
    }
}

/// Returns positions, velocities and first-order states: the parts that have rates.
pub(super) fn moving_parts(layout: &StateLayout) -> Vec<StructField> {
    let positions = layout.positions.iter().map(|p| field(&p.name, p.about()));
    let velocities = layout.coordinates.iter();
    let velocities = velocities.map(|c| field(&c.rate_name, c.about_velocity()));
    let states = layout.states.iter().map(|part| {
        let unit = part.dimension.si();
        field(&part.name, format!("{}, {unit}", part.about))
    });
    positions.chain(velocities).chain(states).collect()
}

pub(super) fn mode_parts(layout: &StateLayout) -> Vec<StructField> {
    let modes = layout.modes.iter();
    modes
        .map(|part| field(format!("{}_mode", part.name), &part.about))
        .collect()
}

pub(super) fn of_named(parts: &[Named]) -> Vec<StructField> {
    parts.iter().map(|n| field(&n.name, &n.about)).collect()
}

/// Returns a type with public parts of the same type.
pub(super) fn named_type(
    name: &str,
    about: &str,
    parts: &[StructField],
    of: TokenStream,
) -> TokenStream {
    let name = ident(name);
    let about = format!(" {about}");
    let names: Vec<_> = parts.iter().map(|p| ident(&p.name)).collect();
    let docs = parts.iter().map(|p| {
        let mut about = p.about.clone();
        if let Some(first) = about.get(..1) {
            about = first.to_uppercase() + &about[1..];
        }
        format!(" {about}.")
    });
    let fields = match parts {
        [] => quote! { #[doc(hidden)] pub scalar: ::core::marker::PhantomData<T>, },
        _ => quote! { #(#[doc = #docs] pub #names: #of,)* },
    };
    quote! {
        #[doc = #about]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct #name<T = f64> { #fields }
    }
}

pub(super) fn literal(name: &str, parts: &[StructField], values: &[TokenStream]) -> TokenStream {
    let name = ident(name);
    if parts.is_empty() {
        return quote! { #name { scalar: ::core::marker::PhantomData } };
    }
    let names = parts.iter().map(|p| ident(&p.name));
    quote! { #name { #(#names: #values),* } }
}

pub(super) fn coordinate_parts(layout: &StateLayout) -> Vec<StructField> {
    let coordinates = layout.coordinates.iter();
    coordinates
        .map(|c| {
            let [_, velocity, effort] = c.dimensions.map(|d| d.si());
            let about = format!(
                "acceleration ({velocity})/s, or effort {effort}, of `{}`",
                c.name
            );
            field(&c.name, about)
        })
        .collect()
}

pub(super) fn input_parts(layout: &StateLayout) -> Vec<StructField> {
    let inputs = layout.inputs.iter();
    inputs
        .map(|part| {
            field(
                &part.name,
                format!("{}, {}", part.about, part.dimension.si()),
            )
        })
        .collect()
}

pub(super) fn signed(x: f64) -> TokenStream {
    let size = number(x.abs());
    let sign = (x < 0.0).then(|| quote! { - });
    quote! { T::from_f64(#sign #size) }
}

pub(super) fn names_of(parts: &[StructField]) -> Vec<proc_macro2::Ident> {
    parts.iter().map(|p| ident(&p.name)).collect()
}

pub(super) fn numbered(prefix: &str, parts: &[StructField]) -> Vec<TokenStream> {
    let name = |i| format_ident!("{prefix}{i}");
    (0..parts.len())
        .map(|i| {
            let name = name(i);
            quote! { #name }
        })
        .collect()
}
