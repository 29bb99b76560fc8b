//! Emits the functions of a scene as methods of its struct.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::super::body::{self, vector};
use super::super::code::Spelling;
use super::super::explain::checked;
use super::super::tokens::{argument_type, ident, number};
use super::parts::{
    StructField, coordinate_parts, input_parts, literal, mode_parts, moving_parts, of_named,
};
use super::rigid_contacts;
use crate::function::Function;
use crate::interface::SceneInterface;
use crate::method::{Method, SceneFunction};
use crate::scene::StateLayout;

/// Returns the result type of a scene function, and its parts.
fn result_of(role: SceneFunction, scene: &SceneInterface) -> (&'static str, Vec<StructField>) {
    let layout = &scene.layout;
    match role {
        SceneFunction::Derivative => ("Rates", moving_parts(layout)),
        SceneFunction::Inverse => ("Coordinates", coordinate_parts(layout)),
        SceneFunction::Inputs => ("Input", input_parts(layout)),
        SceneFunction::Events => ("Events", vec![]),
        SceneFunction::Contacts => ("Contacts", mode_parts(layout)),
        SceneFunction::Power => ("Power", of_named(&scene.entries)),
        SceneFunction::Energy => ("Energy", of_named(&scene.entries)),
        SceneFunction::Outputs => ("Output", of_named(&scene.outputs)),
        SceneFunction::Jacobian
        | SceneFunction::InputJacobian
        | SceneFunction::ToCanonical
        | SceneFunction::FromCanonical
        | SceneFunction::CanonicalRates
        | SceneFunction::RigidContactStates
        | SceneFunction::RigidContactMaps
        | SceneFunction::RigidContactBiases
        | SceneFunction::PositionRates
        | SceneFunction::ClosingStep => ("", vec![]),
    }
}

/// Returns a scene function as a method.
pub(super) fn method(function: &Function, scene: &SceneInterface, plain: bool) -> TokenStream {
    let Method::Scene(role) = function.method else {
        unreachable!("a scene has functions of its own only")
    };
    let signature = signature(role, scene);
    let (_, parts) = result_of(role, scene);
    let (layout, is_checked) = (&scene.layout, function.shape().checked());
    let finish = |values: &[TokenStream]| finish(role, layout, &parts, values, is_checked);
    let spelling = Spelling::of_scene(scene, plain);
    let body::FunctionBody { body, blocks } = body::body(function, &spelling, None, finish);
    let mut docs = vec![
        format!(" {}", role.summary()),
        String::new(),
        format!(
            " Operations: {} ({}).",
            function.operations(),
            function.formulation
        ),
    ];
    if is_checked {
        docs.extend([
            String::new(),
            " # Errors".into(),
            " Names the coordinate whose pivot vanishes where the mass matrix is singular, or the"
                .into(),
            " argument that is NaN or infinite.".into(),
        ]);
    }
    quote! {
        #(#[doc = #docs])*
        #signature {
            #body
        }
        #(#blocks)*
    }
}

/// Returns the signature of a scene function's method.
pub(super) fn signature(role: SceneFunction, scene: &SceneInterface) -> TokenStream {
    let method = Method::Scene(role);
    let name = ident(role.name());
    let arguments = method.arguments();
    let names = arguments.iter().map(|a| ident(a.name()));
    let types = arguments.iter().map(|a| argument_type(*a));
    let result = match role {
        SceneFunction::Events => quote! { __na::SVector<T, NE> },
        SceneFunction::RigidContactStates => rigid_contacts::states_type(&scene.layout),
        SceneFunction::RigidContactMaps => rigid_contacts::maps_type(&scene.layout),
        SceneFunction::RigidContactBiases => rigid_contacts::biases_type(&scene.layout),
        SceneFunction::PositionRates | SceneFunction::ClosingStep => {
            quote! { __na::SVector<T, NQ> }
        }
        SceneFunction::InputJacobian => quote! { __na::SMatrix<T, N, NU> },
        SceneFunction::Jacobian => quote! { (__na::SMatrix<T, N, N>, __na::SVector<T, N>) },
        SceneFunction::ToCanonical
        | SceneFunction::FromCanonical
        | SceneFunction::CanonicalRates => {
            quote! { __na::SVector<T, N> }
        }
        _ => {
            let name = ident(result_of(role, scene).0);
            quote! { #name<T> }
        }
    };
    let result = if method.shape().checked() {
        quote! { ::core::result::Result<#result, T::Singular<{ NV + NX }>> }
    } else {
        result
    };
    quote! { pub fn #name(&self, #(#names: #types),*) -> #result }
}

/// Returns the result of a scene function from its components.
fn finish(
    role: SceneFunction,
    layout: &StateLayout,
    parts: &[StructField],
    values: &[TokenStream],
    is_checked: bool,
) -> TokenStream {
    let method = Method::Scene(role);
    let names = pivot_names(layout);
    let rates_or_error = |rates: &TokenStream| checked(method, rates, &names);
    let refuse = is_checked.then(|| {
        let found = rates_or_error(&quote! { __rt::vector([T::from_f64(0.0); NV + NX]) });
        quote! { #found?; }
    });
    let ok = |value: TokenStream| match is_checked {
        true => quote! { #refuse ::core::result::Result::Ok(#value) },
        false => value,
    };
    match role {
        SceneFunction::Derivative => {
            let (values, coupled) = values.split_at(layout.nv() + layout.nx());
            let rates = rates_or_error(&vector(values));
            let names: Vec<_> = (0..values.len()).map(|i| format_ident!("r{i}")).collect();
            let mut coupled = coupled.iter();
            let velocities = layout.positions.iter().map(|p| match p.coordinate {
                Some(j) => {
                    let rate = ident(&layout.coordinates[j].rate_name);
                    quote! { state.#rate }
                }
                None => coupled.next().cloned().unwrap_or_default(),
            });
            let all: Vec<TokenStream> = velocities
                .chain(names.iter().map(|n| quote! { #n }))
                .collect();
            let whole = literal("Rates", parts, &all);
            quote! {
                let rates = #rates?;
                let [[#(#names),*]] = rates.data.0;
                ::core::result::Result::Ok(#whole)
            }
        }
        SceneFunction::Events => ok(vector(values)),
        SceneFunction::Contacts => {
            let one = |v: &[TokenStream]| match v {
                [slip, slip_rate, holding, margin] => quote! {
                    __rt::Contact {
                        slip: #slip, slip_rate: #slip_rate, holding: #holding, margin: #margin
                    }
                },
                _ => unreachable!("four numbers a contact"),
            };
            let all: Vec<TokenStream> = values.chunks(4).map(one).collect();
            ok(literal("Contacts", parts, &all))
        }
        SceneFunction::Power => {
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
        SceneFunction::RigidContactStates => rigid_contacts::states(values),
        SceneFunction::RigidContactMaps => ok(rigid_contacts::maps(layout, values)),
        SceneFunction::RigidContactBiases => rigid_contacts::biases(values),
        SceneFunction::Inverse => ok(literal("Coordinates", parts, values)),
        SceneFunction::Inputs => ok(literal("Input", parts, values)),
        SceneFunction::Energy => ok(literal("Energy", parts, values)),
        SceneFunction::Outputs => ok(literal("Output", parts, values)),
        SceneFunction::Jacobian => jacobian(layout, values),
        SceneFunction::InputJacobian => input_jacobian(layout, values),
        SceneFunction::ToCanonical => to_canonical(layout, values),
        SceneFunction::FromCanonical => from_canonical(layout, values),
        SceneFunction::CanonicalRates => canonical_rates(layout, values),
        SceneFunction::PositionRates | SceneFunction::ClosingStep => vector(values),
    }
}

/// Returns the names of the causes of missing rates.
fn pivot_names(layout: &StateLayout) -> TokenStream {
    match layout.loops.is_empty() {
        true => quote! { &RATE_NAMES },
        false => quote! { &PIVOT_NAMES },
    }
}

/// Checks results for singular matrices and values that are not finite, with variable names that begin
/// with `prefix`; if fewer than all rates are given, the rest is set to zero.
fn passed(
    role: SceneFunction,
    layout: &StateLayout,
    prefix: &str,
    values: &[TokenStream],
) -> (TokenStream, Vec<Ident>) {
    let all = layout.nv() + layout.nx();
    let zeros = (values.len()..all).map(|_| quote! { T::from_f64(0.0) });
    let padded: Vec<TokenStream> = values.iter().cloned().chain(zeros).collect();
    let padded = checked(Method::Scene(role), &vector(&padded), &pivot_names(layout));
    let names = (0..all).map(|i| format_ident!("{prefix}{i}"));
    let names: Vec<Ident> = names.collect();
    let bound = names
        .iter()
        .enumerate()
        .map(|(i, name)| match i < values.len() {
            true => quote! { #name },
            false => quote! { _ },
        });
    let statement = quote! {
        let [[#(#bound),*]] = #padded?.data.0;
    };
    (statement, names[..values.len()].to_vec())
}

/// Converts columns of v̇, ẋ and the rates of coupled positions to columns of ẏ, with the rates of the other
/// positions from the velocities.
fn jacobian(layout: &StateLayout, values: &[TokenStream]) -> TokenStream {
    let (statements, columns) = columns(SceneFunction::Jacobian, layout, values);
    let (along_time, along_state) = columns.split_last().expect("a column of time");
    quote! {
        #statements
        ::core::result::Result::Ok((
            __rt::matrix([#(#along_state),*]),
            __rt::vector(#along_time),
        ))
    }
}

/// Returns the matrix of columns by the inputs.
fn input_jacobian(layout: &StateLayout, values: &[TokenStream]) -> TokenStream {
    let (statements, columns) = columns(SceneFunction::InputJacobian, layout, values);
    quote! {
        #statements
        ::core::result::Result::Ok(__rt::matrix([#(#columns),*]))
    }
}

/// Returns the columns of a Jacobian of ẏ, and the statements before them.
fn columns(
    role: SceneFunction,
    layout: &StateLayout,
    values: &[TokenStream],
) -> (TokenStream, Vec<TokenStream>) {
    let (nq, rates) = (layout.nq(), layout.nv() + layout.nx());
    let rows = rates + layout.coupled().len();
    let columns = values.chunks(rows.max(1)).enumerate();
    let mut statements = TokenStream::new();
    let columns: Vec<TokenStream> = columns
        .map(|(k, column)| {
            let (column, coupled) = column.split_at(rates);
            let (statement, names) = passed(role, layout, &format!("column{k}_"), column);
            statements.extend(statement);
            let mut coupled = coupled.iter();
            let of_positions = layout.positions.iter().map(|p| match p.coordinate {
                Some(j) => {
                    let own = role == SceneFunction::Jacobian && k == nq + j;
                    let slope = if own { 1.0 } else { 0.0 };
                    let slope = number(slope);
                    quote! { T::from_f64(#slope) }
                }
                None => coupled.next().cloned().unwrap_or_default(),
            });
            quote! { [#(#of_positions,)* #(#names),*] }
        })
        .collect();
    (statements, columns)
}

/// Returns the code for a state with momenta from its parts.
fn to_canonical(layout: &StateLayout, momenta: &[TokenStream]) -> TokenStream {
    let positions = layout.positions.iter().map(|p| &p.name);
    let states = layout.states.iter().map(|s| &s.name);
    let field = |name: &String| {
        let name = ident(name);
        quote! { state.#name }
    };
    let all = positions.map(field).chain(momenta.iter().cloned());
    vector(&all.chain(states.map(field)).collect::<Vec<_>>())
}

/// Returns the code for a state from one with momenta.
fn from_canonical(layout: &StateLayout, velocities: &[TokenStream]) -> TokenStream {
    let (nq, nv, nx) = (layout.nq(), layout.nv(), layout.nx());
    let (statement, names) = passed(SceneFunction::FromCanonical, layout, "velocity", velocities);
    let kept = |prefix: &'static str, n: usize| {
        (0..n)
            .map(move |i| format_ident!("{prefix}{i}"))
            .collect::<Vec<_>>()
    };
    let (positions, states) = (kept("position", nq), kept("state", nx));
    let skipped = (0..nv).map(|_| quote! { _ });
    quote! {
        #statement
        let [[#(#positions,)* #(#skipped,)* #(#states),*]] = z.data.0;
        ::core::result::Result::Ok(__rt::vector([#(#positions,)* #(#names,)* #(#states),*]))
    }
}

/// Returns the code for q̇, ṗ, ẋ.
fn canonical_rates(layout: &StateLayout, values: &[TokenStream]) -> TokenStream {
    let role = SceneFunction::CanonicalRates;
    let (velocities, rates) = values.split_at(layout.nq());
    let (check_velocities, velocities) = passed(role, layout, "velocity", velocities);
    let (check_rates, rates) = passed(role, layout, "rate", rates);
    quote! {
        #check_velocities
        #check_rates
        ::core::result::Result::Ok(__rt::vector([#(#velocities,)* #(#rates),*]))
    }
}
