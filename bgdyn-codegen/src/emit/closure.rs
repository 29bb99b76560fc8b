//! Emits what only mechanisms with loops have.
//!
//! These are names of the open tree and of the rows, the function that closes positions, and the functions of
//! positions of the trait `Dynamics`.

use proc_macro2::TokenStream;
use quote::quote;

use super::closed_positions::{dependent, row_docs, start, tree_constants};
use super::constants::size;
use super::contacts::{contact_access, contact_docs, contact_position_body};
use super::joint_by_joint::joint_by_joint;
use super::polygon_closing::{PolygonClosing, polygon_closing};
use crate::bond_graph::{ClosedTree, JointSegment, Multibody, joint_segments};
use crate::method::Method;
use crate::plan::{closing_names, independent_positions};

/// Returns the constants of the module, and the functions of the struct.
pub(super) fn closure_access(
    closed: &ClosedTree,
    graph: &Multibody,
    present: &[Method],
) -> (TokenStream, TokenStream) {
    if closed.closure.closes_along() {
        return contact_access(closed, graph, present);
    }
    let closure = &closed.closure;
    let closing = closing_names(closed, graph);
    let dependents: Vec<TokenStream> = closure.dependents().map(|j| dependent(closed, j)).collect();
    let free = independent_positions(closed).into_iter().map(size);
    let free: Vec<_> = free.collect();
    let [nl, nd, nf] = [closing.len(), dependents.len(), free.len()].map(size);
    let row = "the loop, and the direction in the axes of its place a";
    let of_tree = tree_constants(closed, graph, ("loops", row), present);
    let constants = quote! {
        #of_tree
        /// Names of the positions, and of the loops after them: the causes of positions that do not close.
        pub const CLOSING_NAMES: [&str; #nl] = [#(#closing),*];
        /// The dependent joints of the loops.
        pub const DEPENDENTS: [__rt::closure::Dependent; #nd] = [#(#dependents),*];
        /// Positions of the independent joints in loops.
        const INDEPENDENT_POSITIONS: [usize; #nf] = [#(#free),*];
    };
    let form = polygon_closing(closed);
    let close = present.contains(&Method::ClosingStep).then(|| {
        let docs = closing_docs(form.as_ref());
        let closing = match &form {
            None => {
                quote! { __rt::closure::close(*q, &DEPENDENTS, |q| self.closing_step(q)) }
            }
            Some(form) => in_closed_form(closed, form, &[quote! { q }, none()]),
        };
        quote! {
            #(#[doc = #docs])*
            ///
            /// # Errors
            /// Names the first loop that does not close, with the cause `OutOfReach`.
            pub fn close(
                &self,
                q: &__na::SVector<T, NQ>,
            ) -> ::core::result::Result<__na::SVector<T, NQ>, T::Singular<NQ>> {
                #closing.finish(&CLOSING_NAMES)
            }
        }
    });
    let function = form.map(|form| form.function);
    (constants, quote! { #close #function })
}

/// Returns the lines about the way in which `close` closes.
fn closing_docs(form: Option<&PolygonClosing>) -> &'static [&'static str] {
    match form {
        None => &[
            " Returns `q` with the dependent positions changed so that all loops close: Newton's method, at most 11",
            " steps of at most 0.5 rad or m, from the dependent positions in `q`.",
        ],
        Some(form) if form.others.is_empty() => &[
            " Returns `q` with the dependent positions changed so that all loops close: in closed form, on the branch that",
            " is nearer to the dependent positions in `q`, angles with the whole turns nearest to those in `q`.",
        ],
        Some(_) => &[
            " Returns `q` with the dependent positions changed so that all loops close: planar loops in closed form, on the",
            " branch that is nearer to those in `q`, angles with the whole turns nearest to those in `q`; the others by",
            " Newton's method, at most 11 steps of at most 0.5 rad or m.",
        ],
    }
}

fn none() -> TokenStream {
    quote! { ::core::option::Option::None }
}

/// Returns the closing of positions, and of the branch that they are on.
fn in_closed_form(
    closed: &ClosedTree,
    form: &PolygonClosing,
    arguments: &[TokenStream; 2],
) -> TokenStream {
    let [q, branch] = arguments;
    let polygons = quote! { self.close_polygons(#q, #branch) };
    if form.others.is_empty() {
        return polygons;
    }
    let others = form.others.iter().map(|&j| dependent(closed, j));
    quote! { #polygons.then(&[#(#others),*], NQ, |q| self.closing_step(q)) }
}

/// Returns the body of a method of the trait `Dynamics` that computes a vector joint by joint; the arguments are
/// those of [`joint_by_joint`].
pub(super) fn position_body(
    closed: &ClosedTree,
    joints: &[JointSegment],
    name: &str,
    arguments: &[(&str, &TokenStream, bool)],
) -> TokenStream {
    if closed.closure.closes_along() {
        return contact_position_body(closed, name);
    }
    let of_tree = joint_segments(&closed.tree);
    let q = quote! { &__na::SVector<T, NQ> };
    let moved = quote! { &__na::SVector<T, NT> };
    let tree_arguments = [("q", &q, true), ("moved", &moved, false)];
    match name {
        "neutral" => start(closed),
        "position_rates" => {
            let body = joint_by_joint(&of_tree, name, &tree_arguments, true);
            quote! {
                let moved = self.tree_velocity(q, v);
                #body
            }
        }
        "integrate" => {
            let body = joint_by_joint(&of_tree, name, &tree_arguments, true);
            let Some(form) = polygon_closing(closed) else {
                return quote! {
                    let moved = self.tree_velocity(q, dv);
                    let q = { #body };
                    __rt::closure::close(q, &DEPENDENTS, |q| self.closing_step(q))
                        .or_nan(&DEPENDENTS, &INDEPENDENT_POSITIONS)
                };
            };
            let branch = quote! { ::core::option::Option::Some(q) };
            let closing = in_closed_form(closed, &form, &[quote! { &moved }, branch]);
            quote! {
                let moved = self.tree_velocity(q, dv);
                let moved = { #body };
                #closing.or_nan(&DEPENDENTS, &INDEPENDENT_POSITIONS)
            }
        }
        "sample" => {
            let body = joint_by_joint(joints, name, arguments, true);
            let start = start(closed);
            quote! {
                let (start, target) = ({ #start }, { #body });
                let free = (&INDEPENDENT_POSITIONS[..], &DEPENDENTS[..]);
                __rt::closure::towards(start, target, free, |q| self.closing_step(q))
            }
        }
        "difference" => joint_by_joint(joints, name, arguments, false),
        _ => joint_by_joint(joints, name, arguments, true),
    }
}

/// Returns the lines of documentation about the loops: which rows hold at every position, which joints follow.
pub(super) fn loop_docs(closed: &ClosedTree) -> Vec<String> {
    if closed.closure.closes_along() {
        return contact_docs(closed);
    }
    row_docs(closed, "Loops")
}
