//! Emits the module that replaces a refused scene.
//!
//! It has the scene's types with the parts known from the file, and methods that never run.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::constants::operations;
use super::super::output_options::{OutputOptions, rebuild};
use super::super::tokens::{ident, struct_ident, structure};
use super::{constants, method, system, types};
use crate::expr::Operations;
use crate::interface::SceneInterface;
use crate::method::SceneFunction;

/// Returns the module with bodies that never run.
pub fn scene_stub(scene: &SceneInterface, output: &OutputOptions) -> TokenStream {
    let name = output.module_ident(&scene.name);
    let model = ident(&struct_ident(&scene.name));
    let (bgdyn, visibility) = (&output.bgdyn, &output.visibility);
    let rebuild = rebuild(output);
    let doc = format!(" The scene {} was refused: see the error.", output.source);
    let structure = structure(&model, &doc, &scene.parameters);
    let (constants, types) = (constants::constants(scene), types::types(scene));
    // What is of modes or of rigid contacts exists only if there are some.
    let layout = &scene.layout;
    let exists = |role: &SceneFunction| match role {
        SceneFunction::Contacts => !layout.modes.is_empty(),
        SceneFunction::RigidContactStates
        | SceneFunction::RigidContactMaps
        | SceneFunction::RigidContactBiases => !layout.rigid_contacts.is_empty(),
        _ => true,
    };
    let roles = SceneFunction::ALL.into_iter().filter(exists);
    let methods = roles.clone().map(|role| {
        let signature = method::signature(role, scene);
        quote! {
            #[doc = #doc]
            #signature {
                ::core::unreachable!()
            }
        }
    });
    let traits = [
        system::system_trait(scene, &model),
        system::slope_trait(&model),
        system::canonical_trait(&model),
    ];
    let names: Vec<&str> = roles.map(SceneFunction::name).collect();
    let operations = operations(names.iter().map(|name| (*name, Operations::default())));
    quote! {
        #[doc = #doc]
        #[allow(unused, unreachable_pub, clippy::all, reason = "stands in for a refused scene")]
        #visibility mod #name {
            use #bgdyn::runtime as __rt;
            use __rt::nalgebra as __na;
            use __rt::Scalar as __Scalar;
            #rebuild
            #constants
            #structure
            #types
            impl<T: __Scalar> #model<T> {
                #(#methods)*
            }
            #(#traits)*
            #operations
        }
    }
}
