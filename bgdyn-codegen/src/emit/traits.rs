//! Emits the trait implementations of a mechanism's module.
//!
//! They describe its joints and frames, and delegate to its methods.

use bgdyn_runtime::QuasiJointKind;
use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::closure;
use super::constants::size;
use super::joint_by_joint::joint_by_joint;
use super::tokens::{argument_type, ident, return_type};
use crate::bond_graph::{ClosedTree, JointSegment, Site, SiteId, joint_segments};
use crate::method::Method;

/// The parts of a module that its traits provide.
pub(super) struct Traits<'a> {
    /// The struct's name.
    pub(super) name: &'a Ident,
    /// Its methods.
    pub(super) methods: &'a [Method],
    pub(super) sites: &'a [Site],
    /// The joints; `None` if their number is a guess, for any number.
    pub(super) joints: Option<Vec<JointSegment>>,
    /// The loops.
    pub(super) closed: Option<&'a ClosedTree>,
}

impl Traits<'_> {
    /// Returns the implementations, and the types of the frames. If the number of joints is a guess, the
    /// code never runs.
    pub(super) fn tokens(&self) -> TokenStream {
        let has = |m: &Method| self.methods.contains(m);
        let loops = self.closed.map_or_else(Vec::new, Method::of_closed);
        let whole = Method::OF_TRAIT.iter().chain(&loops).all(has);
        let dynamics = whole.then(|| self.dynamics());
        let description = self.description();
        let coriolis = has(&Method::CoriolisMatrix)
            .then(|| self.delegated(quote! { Coriolis }, None, &[Method::CoriolisMatrix]));
        let derivatives = [
            Method::InverseDynamicsDerivatives,
            Method::ForwardDynamicsDerivatives,
        ];
        let slopes = derivatives.iter().all(has);
        let slopes = slopes.then(|| {
            let slopes = self.delegated(quote! { Derivatives }, None, &derivatives);
            let groups = self.joint_groups();
            quote! { #slopes #groups }
        });
        let sites = (0..self.sites.len()).map(SiteId);
        let sites: Vec<SiteId> = sites
            .filter(|&site| Method::of_site(site).iter().all(has))
            .collect();
        let kinematics = sites.iter().map(|&site| {
            let frame = frame_type(&self.sites[site.0].name);
            let methods = Method::of_site(site);
            self.delegated(quote! { Kinematics }, Some(frame), &methods)
        });
        let names = sites.iter().map(|site| self.sites[site.0].name.as_str());
        let frames = (!sites.is_empty()).then(|| frames(names));
        quote! { #dynamics #description #coriolis #slopes #(#kinematics)* #frames }
    }

    /// Returns the parameters of the implementation other than the scalar.
    fn sizes(&self) -> Option<TokenStream> {
        (self.joints.is_none()).then(|| quote! { , const NQ: usize, const NV: usize })
    }

    /// Returns the body of a trait's method: a call of the struct's method.
    fn body(&self, call: TokenStream) -> TokenStream {
        match &self.joints {
            Some(_) => call,
            None => quote! { ::core::unreachable!() },
        }
    }

    /// Returns the implementation of a trait, for a frame if one is given.
    fn delegated(&self, of: TokenStream, frame: Option<Ident>, methods: &[Method]) -> TokenStream {
        let (name, sizes) = (self.name, self.sizes());
        let methods = methods.iter().map(|&m| self.delegate(m));
        let frame = frame.map(|frame| quote! { frames::#frame, });
        quote! {
            impl<T: __Scalar #sizes> __rt::#of<#frame T, NQ, NV> for #name<T> {
                #(#methods)*
            }
        }
    }

    fn delegate(&self, method: Method) -> TokenStream {
        let own = ident(&method.name_in(self.closed, self.sites));
        let name = match method {
            Method::Pose(_) => ident("pose"),
            Method::Velocity(_) => ident("velocity"),
            Method::Jacobian(_) => ident("jacobian_world"),
            Method::JacobianDotV(_) => ident("jacobian_dot_v_world"),
            _ => ident(&method.name(self.sites)),
        };
        let arguments = method.arguments();
        let names: Vec<_> = arguments.iter().map(|a| ident(a.name())).collect();
        let types = arguments.iter().map(|a| argument_type(*a));
        let result = return_type(method.shape());
        let body = self.body(quote! { self.#own(#(#names),*) });
        quote! {
            fn #name(&self, #(#names: #types),*) -> #result {
                #body
            }
        }
    }

    fn description(&self) -> TokenStream {
        let name = self.name;
        let sizes = (self.joints.is_none()).then(|| quote! { , const NV: usize });
        let [names, labels, motions, limits] = match &self.joints {
            Some(_) => [
                quote! { JOINT_NAMES },
                quote! { JOINT_LABELS },
                quote! { JOINT_MOTIONS },
                quote! { JOINT_LIMITS },
            ],
            None => [0; 4].map(|_| quote! { ::core::unreachable!() }),
        };
        quote! {
            impl<T: __Scalar #sizes> __rt::Description<NV> for #name<T> {
                const JOINT_NAMES: [&'static str; NV] = #names;
                const JOINT_LABELS: [&'static str; NV] = #labels;
                const JOINT_MOTIONS: [__rt::Motion; NV] = #motions;
                const JOINT_LIMITS: [__rt::Limits; NV] = #limits;
            }
        }
    }

    /// Returns the trait `JointGroups`, where positions move joint by joint.
    fn joint_groups(&self) -> Option<TokenStream> {
        let none = Vec::new();
        let joints = self.joints.as_ref().unwrap_or(&none);
        if let Some(closed) = self.closed {
            let compound = |joint: &JointSegment| !joint.manifold.is_empty();
            let of_tree = joint_segments(&closed.tree);
            if closed.closure.closes_along() || of_tree.iter().any(compound) {
                return None;
            }
        }
        let (mut position, mut velocity, mut quasi) = (0, 0, Vec::new());
        for joint in joints {
            if let Some(kind) = QuasiJointKind::of_module(joint.manifold) {
                let kind = ident(&format!("{kind:?}"));
                let [position, velocity] = [position, velocity].map(size);
                quasi.push(quote! {
                    __rt::QuasiJoint {
                        kind: __rt::QuasiJointKind::#kind, position: #position, velocity: #velocity
                    }
                });
            }
            (position, velocity) = (position + joint.nq, velocity + joint.nv);
        }
        let name = self.name;
        Some(quote! {
            impl<T: __Scalar> __rt::JointGroups for #name<T> {
                const QUASI_JOINTS: &'static [__rt::QuasiJoint] = &[#(#quasi),*];
            }
        })
    }

    /// Returns the trait `Dynamics`: the methods, and the integration of positions.
    fn dynamics(&self) -> TokenStream {
        let (name, sizes) = (self.name, self.sizes());
        let methods = Method::OF_TRAIT.into_iter().map(|m| self.delegate(m));
        let names = self.body(quote! { &JOINT_NAMES });
        let [q, v] = [
            quote! { &__na::SVector<T, NQ> },
            quote! { &__na::SVector<T, NV> },
        ];
        let positions = [
            self.joint_method("neutral", &[], true),
            self.joint_method("position_rates", &[("q", &q, true), ("v", &v, false)], true),
            self.joint_method("normalize", &[("q", &q, true)], true),
            self.joint_method("sample", &[("u", &v, false)], true),
            self.joint_method("integrate", &[("q", &q, true), ("dv", &v, false)], true),
            self.joint_method("difference", &[("q1", &q, true), ("q0", &q, true)], false),
        ];
        quote! {
            impl<T: __Scalar #sizes> __rt::Dynamics<T, NQ, NV> for #name<T> {
                fn joint_names(&self) -> &'static [&'static str; NV] {
                    #names
                }
                #(#methods)*
                #(#positions)*
            }
        }
    }

    /// Returns a method that computes a vector joint by joint. The arguments have a name, a type, and
    /// whether they are positions; so has the result.
    fn joint_method(
        &self,
        name: &str,
        arguments: &[(&str, &TokenStream, bool)],
        positions: bool,
    ) -> TokenStream {
        let function = ident(name);
        let of = |positions: bool| ident(if positions { "NQ" } else { "NV" });
        let result = of(positions);
        let parameters = arguments.iter().map(|(name, of, _)| {
            let name = ident(name);
            quote! { #name: #of }
        });
        let joints = self.joints.as_deref().unwrap_or_default();
        let body = match self.closed {
            Some(closed) => closure::position_body(closed, joints, name, arguments),
            None => joint_by_joint(joints, name, arguments, positions),
        };
        let body = self.body(body);
        quote! {
            fn #function(&self, #(#parameters),*) -> __na::SVector<T, #result> {
                #body
            }
        }
    }
}

/// Returns the types for the frames.
fn frames<'a>(names: impl Iterator<Item = &'a str>) -> TokenStream {
    let frames = names.map(|name| {
        let (frame, doc) = (frame_type(name), format!(" The frame `{name}`."));
        quote! {
            #[doc = #doc]
            #[derive(Clone, Copy, Debug)]
            pub struct #frame;
            impl super::__rt::Frame for #frame {
                const NAME: &'static str = #name;
            }
        }
    });
    quote! {
        /// Links and frames as types, for the trait `Kinematics`.
        #[allow(non_camel_case_types, reason = "different names stay different")]
        pub mod frames {
            #(#frames)*
        }
    }
}

/// Returns the type of a frame in UpperCamelCase. A word that begins with a digit retains its `_`, so that
/// `tool_1` and `tool1` have different types.
fn frame_type(name: &str) -> Ident {
    let word = |word: &str| match word.split_at(1) {
        (first, rest) if first.starts_with(|c: char| c.is_ascii_digit()) => {
            format!("_{first}{rest}")
        }
        (first, rest) => first.to_ascii_uppercase() + rest,
    };
    ident(&name.split('_').map(word).collect::<String>())
}
