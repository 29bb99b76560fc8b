//! The emitter: a model becomes the tokens of a Rust module. It knows no physics.

mod body;
mod code;
mod columns;
mod constants;
mod entries;
mod fallback;
mod loops;
mod names;
mod scene;
mod sines;
mod traits;
mod writer;

pub use fallback::fallback;
use heck::ToUpperCamelCase;
use proc_macro2::{Literal, Span, TokenStream};
use quote::quote;
pub use scene::{scene_fallback, scene_module};

use crate::function::Function;
use crate::mechanism::Parameter;
use crate::method::{Argument, Method, Shape};
use crate::model::Model;
use crate::name::is_identifier;

/// Where and from what the code is generated.
#[derive(Clone, Debug)]
pub struct Place {
    /// Path of the crate that re-exports the runtime: `::bgdyn`.
    pub bgdyn: TokenStream,
    /// Visibility of the module.
    pub visibility: TokenStream,
    /// Name of the module; the mechanism's where `None`.
    pub module: Option<String>,
    /// Name of the spec, for the header.
    pub source: String,
    /// Path to include, so that a change of the spec rebuilds; `None` where the build script sees
    /// to that.
    pub rebuild: Option<String>,
    /// Other files to include for the same reason: a scene's mechanism.
    pub also: Vec<String>,
}

impl Place {
    /// For source text that a crate includes which calls bgdyn by its own name.
    pub fn source_text(source: String) -> Self {
        Place {
            bgdyn: quote! { ::bgdyn },
            visibility: quote! { pub },
            module: None,
            source,
            rebuild: None,
            also: Vec::new(),
        }
    }

    /// The same for a crate that reaches bgdyn by this path.
    ///
    /// # Errors
    /// Where the path is not Rust.
    pub fn with_crate(self, path: &str) -> Result<Self, String> {
        let bgdyn = tokens("the path", path)?;
        Ok(Place { bgdyn, ..self })
    }

    /// The same with this visibility of the module.
    ///
    /// # Errors
    /// Where it is not Rust.
    pub fn with_visibility(self, visibility: &str) -> Result<Self, String> {
        let visibility = tokens("the visibility", visibility)?;
        Ok(Place { visibility, ..self })
    }

    /// The same with this name of the module.
    ///
    /// # Errors
    /// Where it is no snake_case identifier.
    pub fn with_module(self, name: &str) -> Result<Self, String> {
        if !is_identifier(name) {
            return Err(format!(
                "`{name}` cannot name a module: write words of a–z and digits joined by `_`"
            ));
        }
        let module = Some(name.to_string());
        Ok(Place { module, ..self })
    }

    /// The module's name for a mechanism of this name.
    fn module_ident(&self, mechanism: &str) -> proc_macro2::Ident {
        ident(self.module.as_deref().unwrap_or(mechanism))
    }
}

fn tokens(what: &str, text: &str) -> Result<TokenStream, String> {
    text.parse()
        .map_err(|e| format!("{what} `{text}` is not Rust: {e}"))
}

/// The module of a model.
pub fn module(model: &Model, place: &Place) -> TokenStream {
    let name = place.module_ident(model.mechanism.name());
    let bgdyn = &place.bgdyn;
    let visibility = &place.visibility;
    let docs = module_docs(model, place);
    let constants = constants::constants(model);
    let operations = constants::counted(&model.functions);
    let about = format!(" The mechanism `{}`.", model.mechanism.name());
    let structure = structure(&struct_name(model), &about, model.mechanism.parameters());
    let methods = model.functions.iter().map(|f| method(f, model));
    let struct_name = struct_name(model);
    let present: Vec<Method> = model.functions.iter().map(|f| f.method).collect();
    let traits = traits::Traits {
        name: &struct_name,
        methods: &present,
        sites: &model.bond_graph.sites,
        nv: Some(model.mechanism.nv()),
    };
    let traits = traits.tokens();
    let rebuild = rebuild(place);
    quote! {
        #(#[doc = #docs])*
        #[allow(
            unused,
            unreachable_pub,
            clippy::all,
            clippy::pedantic,
            clippy::nursery,
            reason = "generated: straight-line arithmetic with the mechanism's own numbers"
        )]
        #visibility mod #name {
            use #bgdyn::runtime as __rt;
            use __rt::nalgebra as __na;
            use __rt::Scalar as __Scalar;
            #rebuild
            #constants
            #structure
            impl<T: __Scalar> #struct_name<T> {
                #(#methods)*
            }
            #traits
            #operations
        }
    }
}

/// Includes the spec, which makes the compiler watch it.
fn rebuild(place: &Place) -> Option<TokenStream> {
    let path = place.rebuild.as_ref()?;
    let also = &place.also;
    Some(quote! {
        const _: &[u8] = ::core::include_bytes!(#path);
        #(const _: &[u8] = ::core::include_bytes!(#also);)*
    })
}

fn ident(name: &str) -> proc_macro2::Ident {
    proc_macro2::Ident::new(name, Span::call_site())
}

/// UpperCamelCase of the module's name.
pub fn struct_ident(name: &str) -> String {
    name.to_upper_camel_case()
}

fn struct_name(model: &Model) -> proc_macro2::Ident {
    ident(&struct_ident(model.mechanism.name()))
}

fn module_docs(model: &Model, place: &Place) -> Vec<String> {
    let mechanism = &model.mechanism;
    let mut docs = vec![
        format!(" Dynamics of `{}`.", mechanism.name()),
        String::new(),
        format!(
            " Generated by bgdyn {} from {}.",
            env!("CARGO_PKG_VERSION"),
            place.source
        ),
    ];
    if let Some(text) = mechanism.description() {
        docs.push(String::new());
        docs.extend(text.lines().map(|line| format!(" {}", line.trim_end())));
    }
    docs.push(String::new());
    docs.push(" | coordinate | joint | carries | unit |".into());
    docs.push(" |---|---|---|---|".into());
    for (j, c) in model.bond_graph.coordinates.iter().enumerate() {
        let link = &mechanism.links()[c.link.0].name;
        let unit = c.motion.unit();
        docs.push(format!(" | {j} | `{}` | `{link}` | {unit} |", c.name));
    }
    docs.push(String::new());
    docs.push(" | method | operations | formulation |".into());
    docs.push(" |---|---|---|".into());
    for f in &model.functions {
        docs.push(format!(
            " | `{}` | {} | {} |",
            f.name(),
            f.operations(),
            f.formulation
        ));
    }
    docs
}

/// The struct: one public field per run-time parameter, otherwise zero-sized.
fn structure(name: &proc_macro2::Ident, about: &str, parameters: &[Parameter]) -> TokenStream {
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

/// What reads and writes a struct of these fields, where the runtime has its feature `serde`.
fn serde<'a>(name: &proc_macro2::Ident, fields: impl Iterator<Item = &'a str>) -> TokenStream {
    let fields = fields.map(ident);
    quote! { __rt::__serde! { #name { #(#fields),* } } }
}

/// Public fields, so that a struct literal can set them; without any, one that takes no space and
/// uses the scalar type.
fn fields<'a>(
    names: impl ExactSizeIterator<Item = &'a str>,
    docs: impl Iterator<Item = String>,
) -> TokenStream {
    if names.len() == 0 {
        return quote! { scalar: ::core::marker::PhantomData<T>, };
    }
    let names = names.map(ident);
    quote! { #(#[doc = #docs] pub #names: T,)* }
}

fn number(x: f64) -> Literal {
    Literal::f64_unsuffixed(x)
}

fn argument_type(argument: Argument) -> TokenStream {
    match argument {
        Argument::Q => quote! { &__na::SVector<T, NQ> },
        Argument::V | Argument::A | Argument::Tau => quote! { &__na::SVector<T, NV> },
        Argument::State => quote! { &State<T> },
        Argument::Input => quote! { &Input<T> },
        Argument::Accelerations => quote! { &Coordinates<T> },
        Argument::Canonical => quote! { &__na::SVector<T, N> },
        Argument::Modes => quote! { &__na::SVector<T, NM> },
        Argument::Time => quote! { T },
    }
}

fn return_type(shape: Shape) -> TokenStream {
    match shape {
        Shape::Scalar => quote! { T },
        Shape::Vector => quote! { __na::SVector<T, NV> },
        Shape::CheckedVector => {
            quote! { ::core::result::Result<__na::SVector<T, NV>, T::Singular<NV>> }
        }
        Shape::Symmetric | Shape::Square => quote! { __na::SMatrix<T, NV, NV> },
        Shape::SquarePair => quote! { [__na::SMatrix<T, NV, NV>; 2] },
        Shape::CheckedSquares => {
            quote! { ::core::result::Result<[__na::SMatrix<T, NV, NV>; 3], T::Singular<NV>> }
        }
        Shape::Pose => quote! { __rt::Pose<T> },
        Shape::Spatial => quote! { __na::SVector<T, 6> },
        Shape::Jacobian => quote! { __na::SMatrix<T, 6, NV> },
        Shape::Parts | Shape::CheckedParts => unreachable!("a scene names its own results"),
    }
}

/// One method of the struct.
fn method(function: &Function, model: &Model) -> TokenStream {
    let name = ident(function.name());
    let arguments = function.method.arguments();
    let names = arguments.iter().map(|a| ident(a.name()));
    let types = arguments.iter().map(|a| argument_type(*a));
    let result = return_type(function.shape());
    let docs = method_docs(function, model);
    let finish =
        |values: &[TokenStream]| body::result(function.shape(), model.mechanism.nv(), values);
    let naming = code::Naming::of_model(model);
    let places = entries::places(function.shape(), model.mechanism.nv());
    let body::Body { body, blocks } = body::body(function, &naming, places, finish);
    quote! {
        #(#[doc = #docs])*
        pub fn #name(&self, #(#names: #types),*) -> #result {
            #body
        }
        #(#blocks)*
    }
}

fn method_docs(function: &Function, model: &Model) -> Vec<String> {
    let method = function.method;
    let mut docs = vec![
        format!(" {}", method.summary(&model.bond_graph.sites)),
        String::new(),
        format!(" Units: {}. Joints as in [`JOINT_NAMES`].", method.units()),
        String::new(),
        format!(
            " Operations: {} ({}).",
            function.operations(),
            function.formulation
        ),
    ];
    let unread = body::unread(function, model);
    if !unread.is_empty() {
        docs.extend([
            String::new(),
            format!(" Does not read: {}.", unread.join(", ")),
        ]);
    }
    if function.shape().checked() {
        docs.extend([
            String::new(),
            " # Errors".into(),
            " Names the joint whose pivot vanishes where the mass matrix is singular.".into(),
        ]);
    }
    docs
}

/// Formatted source text of a module's tokens.
#[cfg(feature = "source")]
pub fn source_text(module: TokenStream) -> String {
    let file = syn::parse2(module).expect("the emitter writes valid Rust");
    let text = prettyplease::unparse(&file);
    let lines = text.lines().map(|line| match comment(line) {
        Some(comment) => comment + "\n",
        None => line.to_string() + "\n",
    });
    lines.collect()
}

/// The comment that this line stands for, if it is the attribute of a statement's title.
#[cfg(feature = "source")]
fn comment(line: &str) -> Option<String> {
    let (margin, attribute) = line.split_at(line.len() - line.trim_start().len());
    let literal = attribute.strip_prefix("#[doc = ")?.strip_suffix(']')?;
    let text = syn::parse_str::<syn::LitStr>(literal).ok()?.value();
    let comment = text.starts_with(writer::COMMENT);
    comment.then(|| format!("{margin}{text}"))
}
