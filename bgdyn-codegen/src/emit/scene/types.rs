//! Emits the types of a scene's module, and their conversions from and to vectors.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::tokens::{ident, serde};
use super::parts::{
    StructField, coordinate_parts, field, input_parts, literal, mode_parts, moving_parts,
    named_type, names_of, numbered, of_named, signed,
};
use crate::interface::SceneInterface;

pub(super) fn types(scene: &SceneInterface) -> TokenStream {
    let layout = &scene.layout;
    let (moving, modes) = (moving_parts(layout), mode_parts(layout));
    let mut whole = moving_parts(layout);
    whole.extend(mode_parts(layout));
    let t = quote! { T };
    let state = named_type("State", "State of the scene.", &whole, t.clone());
    let rates = named_type(
        "Rates",
        "Rates of the state's parts, per second.",
        &moving,
        t.clone(),
    );
    let coordinates = coordinate_parts(layout);
    let about = "One number per coordinate: accelerations, or efforts.";
    let coordinates = named_type("Coordinates", about, &coordinates, t.clone());
    let inputs = input_parts(layout);
    let input = named_type("Input", "Inputs of the scene.", &inputs, t.clone());
    let outputs = of_named(&scene.outputs);
    let output = named_type("Output", "Outputs of the scene.", &outputs, t.clone());
    let entries = of_named(&scene.entries);
    let energy = named_type("Energy", "Energy stored, J.", &entries, t);
    let balance = quote! { __rt::Balance<T> };
    let power = named_type("Power", "Balance of power, W.", &entries, balance);
    let names = modes.iter().map(|m| field(m.name.clone(), m.about.clone()));
    let names: Vec<StructField> = names.collect();
    let contact = quote! { __rt::Contact<T> };
    let contacts = (!names.is_empty()).then(|| {
        named_type(
            "Contacts",
            "What can hold a coordinate, mode by mode.",
            &names,
            contact,
        )
    });
    let conversions = conversions(scene, &moving, &modes, &inputs, &outputs);
    let serde = [("State", &whole), ("Input", &inputs)]
        .map(|(name, parts)| serde(&ident(name), parts.iter().map(|p| p.name.as_str())));
    quote! { #state #rates #coordinates #input #output #energy #power #contacts #conversions #(#serde)* }
}

/// Returns the conversions between named parts and vectors, and the start of the scene.
fn conversions(
    scene: &SceneInterface,
    moving: &[StructField],
    modes: &[StructField],
    inputs: &[StructField],
    outputs: &[StructField],
) -> TokenStream {
    let initial = &scene.initial;
    let start: Vec<TokenStream> = initial
        .q
        .iter()
        .chain(&initial.v)
        .chain(&initial.x)
        .chain(&initial.modes)
        .map(|x| signed(x.to_f64()))
        .collect();
    let all = || moving.iter().chain(modes).map(|p| field(&p.name, ""));
    let whole: Vec<StructField> = all().collect();
    let start = literal("State", &whole, &start);
    let zeros: Vec<TokenStream> = inputs.iter().map(|_| signed(0.0)).collect();
    let no_input = literal("Input", inputs, &zeros);
    let (y, m): (Vec<_>, Vec<_>) = (numbered("y", moving), numbered("m", modes));
    let values: Vec<TokenStream> = y.iter().chain(&m).cloned().collect();
    let from = literal("State", &whole, &values);
    let moving_names = names_of(moving);
    let mode_names = names_of(modes);
    let input_names = names_of(inputs);
    let output_names = names_of(outputs);
    let u = numbered("u", inputs);
    let from_input = literal("Input", inputs, &u);
    let rates = literal("Rates", moving, &y);
    quote! {
        impl<T: __Scalar> ::core::default::Default for State<T> {
            /// Where the scene begins.
            fn default() -> Self { #start }
        }
        impl<T: __Scalar> State<T> {
            /// Positions, velocities and first-order states in the order of [`STATE_NAMES`].
            pub fn vector(&self) -> __na::SVector<T, N> {
                __rt::vector([#(self.#moving_names),*])
            }
            /// Modes in the order of [`MODE_NAMES`].
            pub fn modes(&self) -> __na::SVector<T, NM> {
                __rt::vector([#(self.#mode_names),*])
            }
            /// The state of these parts.
            pub fn from_vectors(state: &__na::SVector<T, N>, modes: &__na::SVector<T, NM>) -> Self {
                let ([[#(#y),*]], [[#(#m),*]]) = (state.data.0, modes.data.0);
                #from
            }
        }
        impl<T: __Scalar> Rates<T> {
            /// Rates in the order of [`STATE_NAMES`].
            pub fn vector(&self) -> __na::SVector<T, N> {
                __rt::vector([#(self.#moving_names),*])
            }
            /// The rates of these parts.
            pub fn from_vector(rates: &__na::SVector<T, N>) -> Self {
                let [[#(#y),*]] = rates.data.0;
                #rates
            }
        }
        impl<T: __Scalar> ::core::default::Default for Input<T> {
            /// No input.
            fn default() -> Self { #no_input }
        }
        impl<T: __Scalar> Input<T> {
            /// The inputs in the order of [`INPUT_NAMES`].
            pub fn vector(&self) -> __na::SVector<T, NU> {
                __rt::vector([#(self.#input_names),*])
            }
            /// These inputs.
            pub fn from_vector(input: &__na::SVector<T, NU>) -> Self {
                let [[#(#u),*]] = input.data.0;
                #from_input
            }
        }
        impl<T: __Scalar> Output<T> {
            /// The outputs in the order of [`OUTPUT_NAMES`].
            pub fn vector(&self) -> __na::SVector<T, NY> {
                __rt::vector([#(self.#output_names),*])
            }
        }
    }
}
