//! The functions of a scene as methods of its struct.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::super::body::{self, vector};
use super::super::code::Naming;
use super::super::{argument_type, ident};
use super::parts::{
    Field, coordinate_parts, input_parts, literal, mode_parts, moving_parts, of_named,
};
use crate::function::Function;
use crate::method::{Method, Role};
use crate::scene::Layout;
use crate::system::System;

/// The type that a role's function returns, and its parts.
fn result_of(role: Role, system: &System) -> (&'static str, Vec<Field>) {
    let layout = &system.scene.layout;
    match role {
        Role::Derivative => ("Rates", moving_parts(layout)),
        Role::Inverse => ("Coordinates", coordinate_parts(layout)),
        Role::Inputs => ("Input", input_parts(layout)),
        Role::Events => ("Events", vec![]),
        Role::Contacts => ("Contacts", mode_parts(layout)),
        Role::Power => ("Power", of_named(&system.entries)),
        Role::Energy => ("Energy", of_named(&system.entries)),
        Role::Outputs => ("Output", of_named(&system.outputs)),
    }
}

pub(super) fn method(function: &Function, system: &System) -> TokenStream {
    let Method::Scene(role) = function.method else {
        unreachable!("a scene has functions of its own only")
    };
    let name = ident(function.name());
    let arguments = function.method.arguments();
    let names = arguments.iter().map(|a| ident(a.name()));
    let types = arguments.iter().map(|a| argument_type(*a));
    let (result_name, parts) = result_of(role, system);
    let result_name = ident(result_name);
    let result = match role {
        Role::Events => quote! { __na::SVector<T, NE> },
        _ => quote! { #result_name<T> },
    };
    let checked = function.shape().checked();
    let result = if checked {
        quote! { ::core::result::Result<#result, T::Singular<{ NV + NX }>> }
    } else {
        result
    };
    let layout = &system.scene.layout;
    let finish = |values: &[TokenStream]| finish(role, layout, &parts, values, checked);
    let naming = Naming::of_scene(&system.scene);
    let body::Body { body, blocks } = body::body(function, &naming, finish);
    let mut docs = vec![
        format!(" {}", role.summary()),
        String::new(),
        format!(
            " Operations: {} ({}).",
            function.operations(),
            function.formulation
        ),
    ];
    if checked {
        docs.extend([
            String::new(),
            " # Errors".into(),
            " Names the coordinate whose pivot vanishes where the mass matrix is singular.".into(),
        ]);
    }
    quote! {
        #(#[doc = #docs])*
        pub fn #name(&self, #(#names: #types),*) -> #result {
            #body
        }
        #(#blocks)*
    }
}

/// The result of a role from its components.
fn finish(
    role: Role,
    layout: &Layout,
    parts: &[Field],
    values: &[TokenStream],
    checked: bool,
) -> TokenStream {
    let refuse = checked.then(|| {
        quote! {
            T::finish(__rt::vector([T::from_f64(0.0); NV + NX]), refused, &RATE_NAMES)?;
        }
    });
    let ok = |value: TokenStream| match checked {
        true => quote! { #refuse ::core::result::Result::Ok(#value) },
        false => value,
    };
    match role {
        Role::Derivative => {
            let rates = vector(values);
            let names: Vec<_> = (0..values.len()).map(|i| format_ident!("r{i}")).collect();
            let velocities = layout.coordinates.iter().filter(|c| c.stored).map(|c| {
                let rate = ident(&c.rate_name);
                quote! { state.#rate }
            });
            let all: Vec<TokenStream> = velocities
                .chain(names.iter().map(|n| quote! { #n }))
                .collect();
            let whole = literal("Rates", parts, &all);
            quote! {
                let rates = T::finish(#rates, refused, &RATE_NAMES)?;
                let [[#(#names),*]] = rates.data.0;
                ::core::result::Result::Ok(#whole)
            }
        }
        Role::Events => ok(vector(values)),
        Role::Contacts => {
            let one = |v: &[TokenStream]| match v {
                [slip, slip_rate, holding, limit] => quote! {
                    __rt::Contact {
                        slip: #slip, slip_rate: #slip_rate, holding: #holding, limit: #limit
                    }
                },
                _ => unreachable!("four numbers a contact"),
            };
            let all: Vec<TokenStream> = values.chunks(4).map(one).collect();
            ok(literal("Contacts", parts, &all))
        }
        Role::Power => {
            let one = |v: &[TokenStream]| match v {
                [supplied, stored, dissipated] => quote! {
                    __rt::Balance {
                        supplied: #supplied, stored_rate: #stored, dissipated: #dissipated
                    }
                },
                _ => unreachable!("three numbers an entry"),
            };
            let all: Vec<TokenStream> = values.chunks(3).map(one).collect();
            ok(literal("Power", parts, &all))
        }
        Role::Inverse => ok(literal("Coordinates", parts, values)),
        Role::Inputs => ok(literal("Input", parts, values)),
        Role::Energy => ok(literal("Energy", parts, values)),
        Role::Outputs => ok(literal("Output", parts, values)),
    }
}
