//! Generates mechanisms and scenes with all methods, and for each method, in `f64` and in `f32`, a
//! function that does not link if the method can panic.

use std::path::PathBuf;
use std::{env, fs};

use bgdyn_codegen::build_script::Build;
use quote::{format_ident, quote};
use syn::{
    File, FnArg, Ident, ImplItem, Item, ItemImpl, ItemMod, Pat, Signature, Type, Visibility,
};

const SPECS: [&str; 10] = [
    "specs/scara.yaml",
    "specs/puma560.yaml",
    "specs/panda.yaml",
    "firmware/specs/scara_payload.yaml",
    "tests/free_joints/quadrotor_arm.yaml",
    "tests/free_joints/any_length.yaml",
    "specs/loops/five_bar.yaml",
    "specs/loops/parallel_rods.yaml",
    "tests/actuated/crank_and_rod.yaml",
    "specs/constraints/rattleback.yaml",
];

/// Methods that are generated if they are asked for.
const ON_REQUEST: [&str; 7] = [
    "dynamics",
    "assemble",
    "constraint_bias",
    "constrained_dynamics",
    "project_velocity",
    "reactions",
    "joint_reactions",
];

/// Scenes with effects of every kind.
const SCENES: [&str; 7] = [
    "scara_everything",
    "puma_drives",
    "series_elastic_arm",
    "stick_slip",
    "ur5_contact",
    "crane",
    "hydraulic_cylinder",
];

fn main() {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("a build script"));
    let (mut models, mut names) = (String::new(), Vec::new());
    let mechanisms = SPECS
        .iter()
        .map(|spec| Build::new(format!("../../{spec}")).derivatives(true))
        .map(|build| build.bundle("bundled", ["mass_matrix", "bias", "forward_dynamics"]));
    let others = [Build::new("../../specs/loops/four_bar.yaml").methods(ON_REQUEST)];
    let scenes = SCENES.iter().map(|name| {
        let scene = format!("../../specs/scenes/{name}.scene.yaml");
        Build::new(scene).jacobian(true).canonical(true)
    });
    println!("cargo::rerun-if-changed=../../specs");
    println!("cargo::rerun-if-changed=../../firmware/specs");
    println!("cargo::rerun-if-changed=../free_joints");
    println!("cargo::rerun-if-changed=../actuated");
    for build in mechanisms.chain(others).chain(scenes) {
        let source = build.source();
        let source = source.unwrap_or_else(|error| panic!("{error}"));
        let mut file: File = syn::parse_str(&source.text).expect("Rust");
        let module = file.items.iter_mut().find_map(|item| match item {
            Item::Mod(module) => Some(module),
            _ => None,
        });
        prove(module.expect("a module"));
        models += &quote!(#file).to_string();
        names.push(format_ident!("{}", source.module));
    }
    let all = quote! {
        /// Keeps every function in the program; gives their number.
        pub fn all() -> usize { 0 #(+ #names::proved_f32::all() + #names::proved_f64::all())* }
    };
    fs::write(out.join("models.rs"), models + &all.to_string()).expect("OUT_DIR can be written");
}

/// Adds the modules `proved_f32` and `proved_f64`.
fn prove(module: &mut ItemMod) {
    let (_, items) = module.content.as_mut().expect("a body");
    let methods: Vec<(Type, Signature)> = items.iter().flat_map(methods).collect();
    assert!(methods.len() >= 9, "a model has more methods");
    for scalar in ["f32", "f64"] {
        let name = format_ident!("proved_{scalar}");
        let scalar = format_ident!("{scalar}");
        let wrappers = methods.iter().map(|(model, method)| wrapper(model, method));
        let names = methods.iter().map(|(model, method)| name_of(model, method));
        let text = quote! {
            pub mod #name {
                use super::*;
                type T = #scalar;
                #(#wrappers)*
                pub fn all() -> usize {
                    let all = [#(#names as *const ()),*];
                    core::hint::black_box(all).len()
                }
            }
        };
        // The alias is no generic parameter: associated items must name its trait explicitly.
        let text = text.to_string();
        let text = text.replace("T :: Singular", "< T as __Scalar > :: Singular");
        let text = text.replace("T :: Refused", "< T as __Scalar > :: Refused");
        items.push(syn::parse_str(&text).expect("Rust"));
    }
}

/// Returns the public inherent methods of a type.
fn methods(item: &Item) -> Vec<(Type, Signature)> {
    let Item::Impl(ItemImpl {
        trait_: None,
        self_ty,
        items,
        ..
    }) = item
    else {
        return Vec::new();
    };
    let method = |item: &ImplItem| match item {
        // The private ones are parts of them.
        ImplItem::Fn(method) if matches!(method.vis, Visibility::Public(_)) => {
            Some(((**self_ty).clone(), method.sig.clone()))
        }
        _ => None,
    };
    items.iter().filter_map(method).collect()
}

/// Returns the name of the function that must not panic: methods of several types have the same name.
fn name_of(of: &Type, method: &Signature) -> Ident {
    let Type::Path(path) = of else {
        panic!("a method of no named type")
    };
    let of = path
        .path
        .segments
        .last()
        .map(|segment| segment.ident.to_string());
    format_ident!("{}_{}", of.unwrap_or_default().to_lowercase(), method.ident)
}

/// Returns the method as a function that must not panic.
fn wrapper(of: &Type, method: &Signature) -> syn::ItemFn {
    let (name, own) = (name_of(of, method), &method.ident);
    let given: Vec<&syn::PatType> = method
        .inputs
        .iter()
        .filter_map(|argument| match argument {
            FnArg::Typed(argument) => Some(argument),
            FnArg::Receiver(_) => None,
        })
        .collect();
    // An unread argument is a pattern without a name.
    let names: Vec<_> = (0..given.len()).map(|k| format_ident!("x{k}")).collect();
    let types = given.iter().map(|argument| {
        let is_name = matches!(*argument.pat, Pat::Ident(_) | Pat::Wild(_));
        assert!(is_name, "an argument of {name} is no name");
        &argument.ty
    });
    let (receiver, passed) = match method.receiver() {
        Some(_) => (quote!(model: &#of,), quote!(model,)),
        None => (quote!(), quote!()),
    };
    let output = &method.output;
    let text = quote! {
        #[no_panic::no_panic]
        #[inline(never)]
        pub fn #name(#receiver #(#names: #types),*) #output { <#of>::#own(#passed #(#names),*) }
    };
    let named = quote!(#of).to_string();
    syn::parse_str(&text.to_string().replace("Self", &named)).expect("a function")
}
