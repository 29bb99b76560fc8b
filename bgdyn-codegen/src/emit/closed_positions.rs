//! Emits what mechanisms with loops and those with contacts have in common.
//!
//! These are names of the open tree and of the rows, the start, and the joints whose positions close.

use bgdyn_runtime::Dd;
use proc_macro2::TokenStream;
use quote::quote;

use super::actuated::{actuated_constants, actuated_docs};
use super::constants::size;
use super::reactions::reaction_constants;
use super::tokens::number;
use crate::bond_graph::{ClosedTree, Multibody};
use crate::mechanism::CoordinateId;
use crate::mechanism::closure::LoopRow;
use crate::method::Method;
use crate::plan::{dependent_joint, pivot_names, tree_pivot_names};

/// Returns a dependent joint with its position and its loop.
pub(super) fn dependent(closed: &ClosedTree, j: CoordinateId) -> TokenStream {
    let joint = dependent_joint(closed, j);
    let [velocity, position, closes] = [joint.velocity, joint.position, joint.closes].map(size);
    quote! {
        __rt::closure::Dependent { velocity: #velocity, position: #position, closes: #closes }
    }
}

/// Returns the closed position of the start.
pub(super) fn start(closed: &ClosedTree) -> TokenStream {
    let part = |x: &Dd| {
        let [hi, lo] = [x.hi(), x.lo()].map(|part| {
            let size = number(part.abs());
            if part < 0.0 {
                quote! { -#size }
            } else {
                quote! { #size }
            }
        });
        quote! { T::from_parts(#hi, #lo) }
    };
    let parts = closed.closure.start.iter().map(part);
    quote! { __rt::vector([#(#parts),*]) }
}

/// Returns the constants for the open tree and the rows; `what` is the word for loops or constraints, `row` describes
/// the name of a row.
pub(super) fn tree_constants(
    closed: &ClosedTree,
    graph: &Multibody,
    (what, row): (&str, &str),
    present: &[Method],
) -> TokenStream {
    let (tree, closure) = (&closed.tree, &closed.closure);
    let of_tree: Vec<&str> = tree.coordinates.iter().map(|c| c.name.as_str()).collect();
    let rows = closure.rows.iter().map(|row| closure.row_name(row));
    let rows: Vec<String> = rows.collect();
    let pivots = pivot_names(closed, graph);
    let tree_pivots = present.iter().any(|m| m.of_tree() && m.shape().checked());
    let tree_pivots = tree_pivots.then(|| {
        let all = tree_pivot_names(closed);
        let (n, doc) = (
            size(all.len()),
            format!(" Names of the joints of the open tree, and of the {what} after them."),
        );
        quote! {
            #[doc = #doc]
            pub const TREE_PIVOT_NAMES: [&str; #n] = [#(#all),*];
        }
    });
    let [nt, nc, np] = [of_tree.len(), rows.len(), pivots.len()].map(size);
    let reactions = reaction_constants(closed, present);
    let actuated = actuated_constants(closed, graph, present);
    let docs = [
        format!(" Number of rows of the {what}."),
        format!(" Names of the rows of the {what}: {row}."),
        format!(
            " Names of the joints, and of the {what} after them: the causes of missing accelerations."
        ),
    ];
    let [of_number, of_rows, of_pivots] = &docs;
    quote! {
        /// Number of velocities of the open tree.
        pub const NT: usize = #nt;
        #[doc = #of_number]
        pub const NC: usize = #nc;
        /// Names of the joints of the open tree, in the order of its velocities.
        pub const TREE_JOINT_NAMES: [&str; NT] = [#(#of_tree),*];
        #[doc = #of_rows]
        pub const CONSTRAINT_NAMES: [&str; NC] = [#(#rows),*];
        #[doc = #of_pivots]
        pub const PIVOT_NAMES: [&str; #np] = [#(#pivots),*];
        #tree_pivots
        #actuated
        #reactions
    }
}

/// Returns the lines of documentation about loops or constraints, with this word for them: which joints follow, which
/// rows hold at every position.
pub(super) fn row_docs(closed: &ClosedTree, what: &str) -> Vec<String> {
    let (tree, closure) = (&closed.tree, &closed.closure);
    let quoted = |name: String| format!("`{name}`");
    let rows = |rows: &[LoopRow]| {
        let names = rows.iter().map(|row| quoted(closure.row_name(row)));
        names.collect::<Vec<_>>().join(", ")
    };
    let dependents = closure
        .dependents()
        .map(|j| quoted(tree.coordinates[j.0].name.clone()));
    let dependents: Vec<String> = dependents.collect();
    let mut docs = vec![
        String::new(),
        format!(
            " {what}: the velocities of {} follow from the others.",
            dependents.join(", ")
        ),
        format!(" Rows: {}.", rows(&closure.rows)),
    ];
    docs.extend(actuated_docs(closed));
    if !closure.dropped.is_empty() {
        let dropped = rows(&closure.dropped);
        docs.push(format!(
            " Left out, because they hold at every position of the joints: {dropped}."
        ));
    }
    if !closure.following.is_empty() {
        let following: Vec<LoopRow> = closure.following.iter().map(|one| one.row).collect();
        let following = rows(&following);
        docs.push(format!(
            " Left out, because they follow from the others; their multipliers are not determined: {following}."
        ));
    }
    docs
}
