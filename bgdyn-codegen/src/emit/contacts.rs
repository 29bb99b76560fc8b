//! Emits what only mechanisms have whose positions close along velocities: those with wheels or knife edges, and those
//! with loops through joints of several velocities.
//!
//! These are names of the open tree and of the rows, and the functions of positions of the trait `Dynamics`. All
//! positions of the open tree are in q. With wheels and knife edges each may have any value: the velocities decide how
//! they change together.

use proc_macro2::TokenStream;
use quote::quote;

use super::closed_positions::{dependent, row_docs, start, tree_constants};
use super::constants::size;
use super::joint_by_joint::joint_by_joint;
use crate::bond_graph::{ClosedTree, JointSegment, Multibody, joint_segments};
use crate::method::Method;
use crate::plan::closing_names;

/// Returns the constants of the module, and the functions of the struct.
pub(super) fn contact_access(
    closed: &ClosedTree,
    graph: &Multibody,
    present: &[Method],
) -> (TokenStream, TokenStream) {
    let closure = &closed.closure;
    let independents = closure.independents.iter().map(|j| size(j.0));
    let closing = closes(closed).then(|| closing_constants(closed, graph));
    let (what, row) = match closure.nonholonomic() {
        true => ("constraints", "the constraint, and the direction"),
        false => (
            "loops",
            "the loop, and the direction in the axes of its place a",
        ),
    };
    let of_tree = tree_constants(closed, graph, (what, row), present);
    let constants = quote! {
        #of_tree
        /// The independent velocities among those of the open tree.
        const INDEPENDENTS: [usize; NV] = [#(#independents),*];
        #closing
    };
    let close = present.contains(&Method::ClosingStep).then(|| {
        let [q, moved] = argument_types();
        let body = tree_integration(closed);
        quote! {
            /// Returns `q` with positions changed so that all wheels touch and all loops close: Newton's method, at
            /// most 11 steps of at most 0.5 rad or m. The positions that change are those of [`DEPENDENTS`].
            ///
            /// # Errors
            /// Names the first constraint that does not hold: it is out of reach, or at a singular position.
            pub fn close(
                &self,
                q: &__na::SVector<T, NQ>,
            ) -> ::core::result::Result<__na::SVector<T, NQ>, T::Singular<NQ>> {
                let moved = |q: #q, moved: #moved| { #body };
                __rt::closure::close_along(*q, &DEPENDENTS, |q| self.closing_step(q), moved)
                    .finish(&CLOSING_NAMES)
            }
        }
    });
    (constants, quote! { #close })
}

/// Returns whether rows decide about positions.
fn closes(closed: &ClosedTree) -> bool {
    !closed.closure.position_rows().is_empty()
}

fn closing_constants(closed: &ClosedTree, graph: &Multibody) -> TokenStream {
    let closing = closing_names(closed, graph);
    let dependents = closed.closure.closing().map(|j| dependent(closed, j));
    let dependents: Vec<TokenStream> = dependents.collect();
    let [nl, nd] = [closing.len(), dependents.len()].map(size);
    quote! {
        /// Names of the positions, and of the constraints after them: the causes of positions that do not close.
        pub const CLOSING_NAMES: [&str; #nl] = [#(#closing),*];
        /// The joints whose positions close.
        pub const DEPENDENTS: [__rt::closure::Dependent; #nd] = [#(#dependents),*];
    }
}

/// Returns the types of positions, and of velocities of the open tree.
pub(super) fn argument_types() -> [TokenStream; 2] {
    [
        quote! { &__na::SVector<T, NQ> },
        quote! { &__na::SVector<T, NT> },
    ]
}

/// Returns the position after constant velocities `moved` of the open tree.
pub(super) fn tree_integration(closed: &ClosedTree) -> TokenStream {
    let [q, moved] = argument_types();
    let arguments = [("q", &q, true), ("moved", &moved, false)];
    joint_by_joint(&joint_segments(&closed.tree), "integrate", &arguments, true)
}

/// Returns the body of a method of the trait `Dynamics` that computes a vector joint by joint.
pub(super) fn contact_position_body(closed: &ClosedTree, name: &str) -> TokenStream {
    let of_tree = joint_segments(&closed.tree);
    let [q, moved] = argument_types();
    let arguments = [("q", &q, true), ("moved", &moved, false)];
    let body = |arguments: &[(&str, &TokenStream, bool)], positions| {
        joint_by_joint(&of_tree, name, arguments, positions)
    };
    let tree_integration = tree_integration(closed);
    let moved_along = quote! { let moved = |q: #q, moved: #moved| { #tree_integration }; };
    let closed_again = closes(closed).then(|| {
        quote! {
            let q = __rt::closure::close_along(q, &DEPENDENTS, |q| self.closing_step(q), moved)
                .or_all_nan();
        }
    });
    match name {
        "neutral" => start(closed),
        "position_rates" => {
            let body = body(&arguments, true);
            quote! {
                let moved = self.tree_velocity(q, v);
                #body
            }
        }
        "integrate" => quote! {
            #moved_along
            let q = __rt::closure::follow(q, |q| self.tree_velocity(q, dv), moved);
            #closed_again
            q
        },
        "sample" => {
            let body = body(&[("moved", &moved, false)], true);
            let sampled = quote! {
                let mut moved = __na::SVector::<T, NT>::from_element(T::from_f64(0.5));
                for (&j, &u) in INDEPENDENTS.iter().zip(u.iter()) {
                    if let ::core::option::Option::Some(moved) = moved.get_mut(j) {
                        *moved = u;
                    }
                }
                let q = { #body };
                #moved_along
            };
            let slips = closed.closure.nonholonomic();
            if slips && !closes(closed) {
                return quote! { #sampled q };
            }
            let (start, way) = (start(closed), independent_way(&of_tree));
            let sampled = quote! {
                #sampled
                let start = { #start };
                let way = {
                    let (q1, q0) = (&q, &start);
                    #way
                };
                let share = T::from_f64(1.0 / __rt::closure::PARTS as f64);
                let part = way.map(|x| x * share);
            };
            // Along rows on velocities wheels would leave the sampled positions: they close there, or next to them.
            if slips {
                return quote! {
                    #sampled
                    let mut own = __na::SVector::<T, NT>::from_element(T::from_f64(0.0));
                    for (&j, &part) in INDEPENDENTS.iter().zip(part.iter()) {
                        if let ::core::option::Option::Some(own) = own.get_mut(j) {
                            *own = part;
                        }
                    }
                    let close = |q| {
                        __rt::closure::close_along(q, &DEPENDENTS, |q| self.closing_step(q), moved)
                    };
                    close(q).or(__rt::closure::walk(start, |q| close(moved(q, &own))))
                };
            }
            quote! {
                #sampled
                __rt::closure::walk(start, |q| {
                    let q = __rt::closure::follow(q, |q| self.tree_velocity(q, &part), moved);
                    __rt::closure::close_along(q, &DEPENDENTS, |q| self.closing_step(q), moved)
                })
            }
        }
        "difference" => independent_way(&of_tree),
        _ => body(&[("q", &q, true)], true),
    }
}

/// Returns the independent velocities of the way in the open tree from `q0` to `q1`.
fn independent_way(of_tree: &[JointSegment]) -> TokenStream {
    let [q, _] = argument_types();
    let arguments = [("q1", &q, true), ("q0", &q, true)];
    let body = joint_by_joint(of_tree, "difference", &arguments, false);
    quote! {
        let moved = { #body };
        let mut own = __na::SVector::<T, NV>::from_element(T::from_f64(0.0));
        for (own, &j) in own.iter_mut().zip(INDEPENDENTS.iter()) {
            if let ::core::option::Option::Some(&moved) = moved.get(j) {
                *own = moved;
            }
        }
        own
    }
}

/// Returns the lines of documentation about the constraints, or the loops through joints of several velocities.
pub(super) fn contact_docs(closed: &ClosedTree) -> Vec<String> {
    let what = match closed.closure.nonholonomic() {
        true => "Constraints",
        false => "Loops",
    };
    let mut docs = row_docs(closed, what);
    docs.extend(
        [
            "",
            " `integrate` follows the constraints at constant independent velocities, to fourth order in their size.",
            " `difference` has the independent velocities of the way in the open tree: it is the inverse of `integrate`",
            " to second order, and exact where the other velocities are constant multiples of them.",
        ]
        .map(String::from),
    );
    docs
}
