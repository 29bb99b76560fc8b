//! Emits the module of a refused spec with all names that a caller can use.
//!
//! The user sees only the error of the spec and no further errors at every call.
//!
//! The types are those of the real module, so that type inference gives the same result. If the number of
//! joints is a guess, the methods take vectors of any size.

use proc_macro2::TokenStream;
use quote::quote;

use super::base_access::base_access;
use super::constants::{operations, size};
use super::output_options::{OutputOptions, rebuild};
use super::prescribed::prescribed_constants;
use super::tokens::{argument_type, fields, ident, return_type, serde, struct_ident};
use super::traits::Traits;
use crate::bond_graph::{JointSegment, Site, SiteId};
use crate::expr::Operations;
use crate::interface::Interface;
use crate::mechanism::Pose;
use crate::method::{Argument, Method, Operational, PayloadRegressor};
use crate::name::is_identifier;

/// Returns the module with bodies that never run.
pub fn stub(interface: &Interface, output: &OutputOptions) -> TokenStream {
    let name = output.module_ident(&interface.name);
    let model = ident(&struct_ident(&interface.name));
    let (bgdyn, visibility) = (&output.bgdyn, &output.visibility);
    let rebuild = rebuild(output);
    let doc = format!(" The spec {} was refused: see the error.", output.source);
    let constants = constants(interface);
    let parameters = interface.parameters.iter();
    let fields = fields(
        parameters.clone().map(String::as_str),
        parameters.map(|_| doc.clone()),
    );
    let sites = sites(interface);
    let prescribed = interface.prescribed.len();
    let mut possible = Method::possible(&sites);
    possible.extend((prescribed > 0).then_some(Method::DriveEfforts(prescribed)));
    possible.extend(Method::on_request());
    let of_sites = (0..sites.len()).flat_map(|site| Operational::of_site(SiteId(site)));
    possible.extend(of_sites.map(Method::Operational));
    let of_sites = (0..sites.len()).flat_map(|site| PayloadRegressor::of_site(SiteId(site)));
    possible.extend(of_sites.map(Method::Payload));
    let methods = possible.iter();
    let methods = methods.map(|&m| method(m, &sites, interface.certain));
    let names: Vec<String> = possible.iter().map(|m| m.name(&sites)).collect();
    let nothing = names.iter().map(|n| (n.as_str(), Operations::default()));
    let operations = operations(nothing);
    let traits = Traits {
        name: &model,
        methods: &possible,
        sites: &sites,
        closed: None,
        joints: (interface.certain).then(|| vec![JointSegment::PLAIN; interface.joints.len()]),
    };
    let traits = traits.tokens();
    let base = base_access(interface.base);
    let serde = serde(&model, interface.parameters.iter().map(String::as_str));
    quote! {
        #[doc = #doc]
        #[allow(unused, unreachable_pub, clippy::all, reason = "stands in for a refused spec")]
        #visibility mod #name {
            use #bgdyn::runtime as __rt;
            use __rt::nalgebra as __na;
            use __rt::Scalar as __Scalar;
            #rebuild
            #constants
            #[doc = #doc]
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub struct #model<T = f64> { #fields }
            impl<T: __Scalar> ::core::default::Default for #model<T> {
                fn default() -> Self {
                    ::core::unreachable!()
                }
            }
            #serde
            impl<T: __Scalar> #model<T> {
                #(#methods)*
                #base
            }
            #traits
            #operations
        }
    }
}

/// Returns all links and frames, because the default ones of the corrected spec are not known.
fn sites(interface: &Interface) -> Vec<Site> {
    let names = interface.links.iter().chain(&interface.frames);
    let site = |name: &String| Site {
        name: name.clone(),
        link: None,
        pose: Pose::IDENTITY,
        exported_by_default: true,
    };
    names.filter(|n| is_identifier(n)).map(site).collect()
}

fn constants(interface: &Interface) -> TokenStream {
    let (joints, links) = (&interface.joints, &interface.links);
    let prescribed = prescribed_constants(&interface.prescribed);
    let (nv, count) = (size(joints.len()), size(links.len()));
    quote! {
        /// Number of positions.
        pub const NQ: usize = #nv;
        /// Number of velocities.
        pub const NV: usize = #nv;
        /// Names of the moving joints, in the order of the velocities.
        pub const JOINT_NAMES: [&str; NV] = [#(#joints),*];
        /// Names of the positions.
        pub const POSITION_NAMES: [&str; NQ] = [#(#joints),*];
        /// Names that the joints have elsewhere; without such a name the joint's own.
        pub const JOINT_LABELS: [&str; NV] = [#(#joints),*];
        /// Names of the links, parents before children.
        pub const LINK_NAMES: [&str; #count] = [#(#links),*];
        /// Names of the bodies of regressors.
        pub const BODY_NAMES: [&str; NV] = JOINT_NAMES;
        /// The base parameters.
        pub const BASE_PARAMETERS: [&str; 10 * NV] = [""; 10 * NV];
        /// The kind of each velocity: angular or linear.
        pub const JOINT_MOTIONS: [__rt::Motion; NV] = [__rt::Motion::Rotation; NV];
        /// Limits of the moving joints; infinite where the spec states none.
        pub const JOINT_LIMITS: [__rt::Limits; NV] =
            [__rt::Limits { lower: 0.0, upper: 0.0, velocity: 0.0, effort: 0.0 }; NV];
        #prescribed
    }
}

/// Returns a method; if the size is a guess, it is generic over the sizes of the vectors.
fn method(method: Method, sites: &[Site], sized: bool) -> TokenStream {
    let name = ident(&method.name(sites));
    let arguments = method.arguments();
    let names = arguments.iter().map(|a| ident(a.name()));
    let result = return_type(method.shape());
    // Generic parameters with these names hide the module's constants.
    // Nothing determines the sizes of a method of the mechanism alone.
    let alone = [&[][..], &[Argument::BodyParameters]].contains(&arguments);
    let (sizes, types): (_, Vec<_>) = if sized || alone {
        (None, arguments.iter().map(|a| argument_type(*a)).collect())
    } else if arguments == [Argument::Q] {
        // Only the positions determine the number of velocities.
        let q = quote! { &__na::SVector<T, NV> };
        (Some(quote! { <const NV: usize> }), vec![q])
    } else {
        let sizes = quote! { <const NQ: usize, const NV: usize> };
        let types = arguments.iter().map(|a| argument_type(*a)).collect();
        (Some(sizes), types)
    };
    let doc = format!(" {}", method.summary(sites));
    quote! {
        #[doc = #doc]
        pub fn #name #sizes(&self, #(#names: #types),*) -> #result {
            ::core::unreachable!()
        }
    }
}
