//! Emits the module's constants: sizes, names, motions, limits, and operation counts of each method.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::prescribed::prescribed_constants;
use super::tokens::{ident, number};
use crate::expr::Operations;
use crate::function::Function;
use crate::mechanism::{CoordinateId, Limits};
use crate::method::Method;
use crate::model::Model;
use crate::plan::operational_pivot_names;

/// Returns the constants at the beginning of the module.
pub(super) fn constants(model: &Model) -> TokenStream {
    let mechanism = &model.mechanism;
    let (nq, nv) = (size(mechanism.nq()), size(mechanism.nv()));
    let joints = model.bond_graph.coordinates.iter().map(|c| c.name.as_str());
    let positions = model.bond_graph.positions.iter().map(|p| p.name.as_str());
    let labels = model
        .bond_graph
        .coordinates
        .iter()
        .enumerate()
        .map(|(j, c)| {
            let joint = mechanism.joint(CoordinateId(j));
            let ending = c.name.strip_prefix(&joint.name).unwrap_or_default();
            let label = joint.label.as_ref().unwrap_or(&joint.name);
            format!("{label}{ending}")
        });
    let links = mechanism.links().iter().filter(|link| !link.hidden);
    let links: Vec<&str> = links.map(|l| l.name.as_str()).collect();
    let count = size(links.len());
    let motions = model.bond_graph.coordinates.iter().map(|c| match c.linear {
        false => ident("Rotation"),
        true => ident("Translation"),
    });
    let prescribed = prescribed_constants(&mechanism.prescribed_names());
    let regressors = regressor_constants(model);
    let operational = operational_constants(model);
    let contacts = contact_constants(model);
    let limits = (0..mechanism.nv()).map(|j| limits(&mechanism.joint(CoordinateId(j)).limits));
    quote! {
        /// Number of positions.
        pub const NQ: usize = #nq;
        /// Number of velocities.
        pub const NV: usize = #nv;
        /// Names of the moving joints, in the order of the velocities.
        pub const JOINT_NAMES: [&str; NV] = [#(#joints),*];
        /// Names of the positions; those of the joints where every joint has one.
        pub const POSITION_NAMES: [&str; NQ] = [#(#positions),*];
        /// Names that the joints have elsewhere; without such a name the joint's own.
        pub const JOINT_LABELS: [&str; NV] = [#(#labels),*];
        /// Names of the links, parents before children.
        pub const LINK_NAMES: [&str; #count] = [#(#links),*];
        /// The kind of each velocity: angular or linear.
        pub const JOINT_MOTIONS: [__rt::Motion; NV] = [#(__rt::Motion::#motions),*];
        /// Limits of the moving joints; infinite where the spec states none.
        pub const JOINT_LIMITS: [__rt::Limits; NV] = [#(#limits),*];
        #prescribed
        #regressors
        #operational
        #contacts
    }
}

/// Returns the names of the pivots of operational inertias, for a model with such.
fn operational_constants(model: &Model) -> Option<TokenStream> {
    let graph = &model.bond_graph;
    let inverts = model.all_methods().any(Method::inverts_task);
    let names = operational_pivot_names(graph.closed.as_deref(), graph);
    let count = size(names.len());
    inverts.then(|| {
        quote! {
            /// Names of the joints, of loops and contacts after them, and of the directions of a frame after these: the causes
            /// of missing operational inertias.
            pub const OPERATIONAL_PIVOT_NAMES: [&str; #count] = [#(#names),*];
        }
    })
}

/// Returns the names of the contacts, for a model with methods of them.
fn contact_constants(model: &Model) -> Option<TokenStream> {
    let names = model.contact_names();
    let count = size(names.len());
    (!names.is_empty()).then(|| {
        quote! {
            /// Names of the contacts, in the order of the file; a capsule has two, a box eight.
            pub const CONTACT_NAMES: [&str; #count] = [#(#names),*];
        }
    })
}

/// Returns the names of the bodies and of the base parameters, for a model with regressors.
fn regressor_constants(model: &Model) -> TokenStream {
    if !model.has_regressors() {
        return quote! {};
    }
    let (bodies, base) = (model.body_names(), &model.base_parameters);
    let (nb, np) = (size(bodies.len()), size(base.len()));
    quote! {
        /// Names of the bodies of regressors: the links that joints move, each with all that is fixed to it.
        pub const BODY_NAMES: [&str; #nb] = [#(#bodies),*];
        /// The base parameters as formulas of the parameters of the bodies.
        pub const BASE_PARAMETERS: [&str; #np] = [#(#base),*];
    }
}

fn limits(limits: &Limits) -> TokenStream {
    let bound = |x: Option<f64>, none: TokenStream| match x {
        Some(x) => {
            let size = number(x.abs());
            if x < 0.0 {
                quote! { -#size }
            } else {
                quote! { #size }
            }
        }
        None => none,
    };
    let (above, below) = (quote! { f64::INFINITY }, quote! { f64::NEG_INFINITY });
    let (lower, upper) = (
        bound(limits.lower, below),
        bound(limits.upper, above.clone()),
    );
    let (velocity, effort) = (
        bound(limits.velocity, above.clone()),
        bound(limits.effort, above),
    );
    quote! {
        __rt::Limits { lower: #lower, upper: #upper, velocity: #velocity, effort: #effort }
    }
}

/// Returns the table of operation counts.
pub(super) fn operations<'a>(
    functions: impl ExactSizeIterator<Item = (&'a str, Operations)>,
) -> TokenStream {
    let count = size(functions.len());
    let entries = functions.map(|(name, operations)| {
        let Operations {
            mul,
            add,
            div,
            sqrt,
            sincos,
            other,
        } = operations;
        let counts = [mul, add, div, sqrt, sincos, other].map(size);
        quote! { (#name, __rt::Operations::new([#(#counts),*])) }
    });
    quote! {
        /// What one call of each method executes: multiplications, additions, divisions, roots,
        /// pairs of sine and cosine, others.
        pub const OPERATIONS: [(&str, __rt::Operations); #count] = [#(#entries),*];
    }
}

/// Returns the operation counts of a model's functions.
pub(super) fn operation_counts(functions: &[&Function]) -> TokenStream {
    operations(functions.iter().map(|f| (f.name(), f.operations())))
}

/// Returns a size as a literal without a type.
pub(super) fn size(n: usize) -> Literal {
    Literal::usize_unsuffixed(n)
}
