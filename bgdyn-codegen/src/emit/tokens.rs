//! Tokens for all parts of a module: identifiers, numbers, types, structs.

use heck::ToUpperCamelCase;
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use crate::mechanism::Parameter;
use crate::method::{Argument, Entries, ParameterSet, Shape};

/// Prefix of a doc attribute's text that becomes a comment, because tokens cannot contain comments.
pub(super) const COMMENT: &str = "//";

/// Returns a comment: a doc attribute until [`super::source_text`], because tokens cannot contain comments.
pub(super) fn comment(text: &str) -> TokenStream {
    let text = format!("{COMMENT} {text}");
    quote! { #[doc = #text] }
}

/// Returns an identifier; the name must be valid.
pub(super) fn ident(name: &str) -> Ident {
    Ident::new(name, Span::call_site())
}

/// Returns the module's name in UpperCamelCase.
pub fn struct_ident(name: &str) -> String {
    name.to_upper_camel_case()
}

/// Returns the struct: one public field per run-time parameter, otherwise zero-sized.
pub(super) fn structure(name: &Ident, about: &str, parameters: &[Parameter]) -> TokenStream {
    let mut docs = vec![about.to_owned()];
    if !parameters.is_empty() {
        docs.push(String::new());
        docs.push(" Its fields are run-time parameters; `default()` has the spec's values.".into());
    }
    let names = parameters.iter().map(|p| p.name.as_str());
    let field_docs = parameters.iter().map(|p| {
        let default = p.default.to_f64();
        format!(" Run-time parameter: {p}. Default {default:?}.")
    });
    let fields = fields(names, field_docs);
    let defaults = parameters.iter().map(|p| {
        let (name, size) = (ident(&p.name), number(p.default.to_f64().abs()));
        let sign = (p.default.to_f64() < 0.0).then(|| quote! { - });
        quote! { #name: T::from_f64(#sign #size) }
    });
    let scalar = parameters
        .is_empty()
        .then(|| quote! { scalar: ::core::marker::PhantomData });
    let serde = serde(name, parameters.iter().map(|p| p.name.as_str()));
    quote! {
        #(#[doc = #docs])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct #name<T = f64> { #fields }
        impl<T: __Scalar> ::core::default::Default for #name<T> {
            fn default() -> Self {
                Self { #(#defaults,)* #scalar }
            }
        }
        #serde
    }
}

/// Returns the serialisation of a struct with these fields, for the feature `serde` of the runtime.
pub(super) fn serde<'a>(name: &Ident, fields: impl Iterator<Item = &'a str>) -> TokenStream {
    let fields = fields.map(ident);
    quote! { __rt::__serde! { #name { #(#fields),* } } }
}

/// Returns public fields, so that a struct literal can set them; without any, a zero-sized field that uses
/// the scalar type.
pub(super) fn fields<'a>(
    names: impl ExactSizeIterator<Item = &'a str>,
    docs: impl Iterator<Item = String>,
) -> TokenStream {
    if names.len() == 0 {
        return quote! { scalar: ::core::marker::PhantomData<T>, };
    }
    let names = names.map(ident);
    quote! { #(#[doc = #docs] pub #names: T,)* }
}

/// Returns a finite number without a type, in its shortest form: `2.2e-17`, not `0.000000000000000022`.
pub(super) fn number(x: f64) -> Literal {
    let text = format!("{x:?}");
    text.parse().expect("a finite number is a literal")
}

/// Returns the type of an argument.
pub(super) fn argument_type(argument: Argument) -> TokenStream {
    match argument {
        Argument::Q => quote! { &__na::SVector<T, NQ> },
        Argument::V | Argument::A | Argument::Tau => quote! { &__na::SVector<T, NV> },
        Argument::TreeV | Argument::TreeTau => quote! { &__na::SVector<T, NT> },
        Argument::ActuatedTau => quote! { &__na::SVector<T, NA> },
        Argument::ReferenceV | Argument::ReferenceA | Argument::Direction => {
            quote! { &__na::SVector<T, NV> }
        }
        Argument::AlongQ
        | Argument::AlongV
        | Argument::AlongA
        | Argument::AlongTau
        | Argument::Cotangent => quote! { &__na::SVector<T, NV> },
        Argument::BodyParameters => quote! { &__na::SVector<T, { 10 * BODY_NAMES.len() }> },
        Argument::State => quote! { &State<T> },
        Argument::Input => quote! { &Input<T> },
        Argument::Accelerations => quote! { &Coordinates<T> },
        Argument::Canonical => quote! { &__na::SVector<T, N> },
        Argument::Modes => quote! { &__na::SVector<T, NM> },
        Argument::Time => quote! { T },
    }
}

/// Returns the type of a result: its values, or an error that names one of so many joints.
pub(super) fn return_type(shape: Shape) -> TokenStream {
    let value = value_type(shape);
    let joints = match shape {
        _ if !shape.checked() => return value,
        Shape::CheckedActuated(_) => quote! { NA },
        Shape::CheckedTree | Shape::CheckedTreeAndRows => quote! { NT },
        _ => quote! { NV },
    };
    quote! { ::core::result::Result<#value, T::Singular<#joints>> }
}

/// Returns the type of the values of a result.
pub(super) fn value_type(shape: Shape) -> TokenStream {
    match shape {
        Shape::Scalar => quote! { T },
        Shape::Vector | Shape::CheckedVector => quote! { __na::SVector<T, NV> },
        Shape::CheckedActuated(_) => quote! { __na::SVector<T, NA> },
        Shape::Symmetric | Shape::Square => quote! { __na::SMatrix<T, NV, NV> },
        Shape::SquarePair => quote! { [__na::SMatrix<T, NV, NV>; 2] },
        Shape::FourSquares => quote! { [__na::SMatrix<T, NV, NV>; 4] },
        Shape::FourCubes => quote! { [[__na::SMatrix<T, NV, NV>; NV]; 4] },
        Shape::CheckedSquares => quote! { [__na::SMatrix<T, NV, NV>; 3] },
        Shape::SlopesByTree => {
            quote! { (__na::SMatrix<T, NV, NT>, __na::SMatrix<T, NV, NV>) }
        }
        Shape::CheckedSlopesByTree => {
            let square = quote! { __na::SMatrix<T, NV, NV> };
            quote! { (__na::SMatrix<T, NV, NT>, #square, #square) }
        }
        Shape::Checked(entries) => match entries {
            Entries::Joints => quote! { __na::SMatrix<T, NV, NV> },
            Entries::Task => quote! { __na::SMatrix<T, 6, 6> },
            Entries::TaskColumns => quote! { __na::SMatrix<T, NV, 6> },
            Entries::TaskVector => quote! { __na::SVector<T, 6> },
            Entries::VectorTriple => quote! { [__na::SVector<T, NV>; 3] },
            Entries::Symmetric(rows) => {
                let rows = Literal::usize_unsuffixed(rows);
                quote! { __na::SMatrix<T, #rows, #rows> }
            }
            Entries::Columns(columns) => {
                let columns = Literal::usize_unsuffixed(columns);
                quote! { __na::SMatrix<T, NV, #columns> }
            }
            Entries::ParameterColumns(set) => {
                let columns = number_of(set);
                quote! { __na::SMatrix<T, NV, #columns> }
            }
        },
        Shape::VectorTriple => quote! { [__na::SVector<T, NV>; 3] },
        Shape::Pose => quote! { __rt::Pose<T> },
        Shape::Poses(count) => {
            let count = Literal::usize_unsuffixed(count);
            quote! { [__rt::Pose<T>; #count] }
        }
        Shape::Numbers(count) => {
            let count = Literal::usize_unsuffixed(count);
            quote! { __na::SVector<T, #count> }
        }
        Shape::Rows(rows) => {
            let rows = Literal::usize_unsuffixed(rows);
            quote! { __na::SMatrix<T, #rows, NV> }
        }
        Shape::Spatial => quote! { __na::SVector<T, 6> },
        Shape::Drives(_) => quote! { __na::SVector<T, NP> },
        Shape::Jacobian => quote! { __na::SMatrix<T, 6, NV> },
        Shape::Point => quote! { __na::SVector<T, 3> },
        Shape::PointJacobian => quote! { __na::SMatrix<T, 3, NV> },
        Shape::TreeVector | Shape::CheckedTree => quote! { __na::SVector<T, NT> },
        Shape::TreeMatrix => quote! { __na::SMatrix<T, NT, NV> },
        Shape::RowVector => quote! { __na::SVector<T, NC> },
        Shape::RowMatrix => quote! { __na::SMatrix<T, NC, NT> },
        Shape::CheckedTreeAndRows => quote! { (__na::SVector<T, NT>, __na::SVector<T, NC>) },
        Shape::CheckedWrenches => quote! { [__rt::Wrench<T>; NR] },
        Shape::LinkWrenches => quote! { [__rt::Wrench<T>; LINK_NAMES.len()] },
        Shape::ParameterColumns(set) => {
            let columns = number_of(set);
            quote! { __na::SMatrix<T, NV, #columns> }
        }
        Shape::ParameterVector(set) => {
            let count = number_of(set);
            quote! { __na::SVector<T, #count> }
        }
        Shape::Parts | Shape::CheckedParts => unreachable!("a scene names its own results"),
        Shape::Bundle | Shape::CheckedBundle => unreachable!("a bundle has a struct of its own"),
    }
}

/// Returns the number of these parameters.
fn number_of(set: ParameterSet) -> TokenStream {
    match set {
        ParameterSet::Bodies => quote! { { 10 * BODY_NAMES.len() } },
        ParameterSet::Base => quote! { { BASE_PARAMETERS.len() } },
        ParameterSet::Payload => quote! { 10 },
        ParameterSet::RunTime(number) => {
            let number = Literal::usize_unsuffixed(number);
            quote! { #number }
        }
    }
}
