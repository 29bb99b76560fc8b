//! Emits what a module says of the actuated joints of a mechanism with loops.

use proc_macro2::TokenStream;
use quote::quote;

use super::constants::size;
use crate::bond_graph::{ClosedTree, Multibody};
use crate::method::Method;
use crate::plan::actuated_pivot_names;

/// Returns the constants of the actuated joints, if the file names them.
pub(super) fn actuated_constants(
    closed: &ClosedTree,
    graph: &Multibody,
    present: &[Method],
) -> Option<TokenStream> {
    let actuated = closed.closure.actuated.as_ref()?;
    let names = closed.joint_names(actuated);
    let na = size(names.len());
    let inverse = |m: &Method| matches!(m, Method::ActuatedInverse(_));
    let pivots = present.iter().any(inverse).then(|| {
        let all = actuated_pivot_names(closed, graph);
        let count = size(all.len());
        quote! {
            /// Names of the actuated joints, of the loops after them, and of the joints after these: the causes of
            /// missing efforts of the actuated joints.
            pub const ACTUATED_PIVOT_NAMES: [&str; #count] = [#(#all),*];
        }
    });
    Some(quote! {
        /// Number of actuated joints.
        pub const NA: usize = #na;
        /// Names of the actuated joints, in the order of the open tree.
        pub const ACTUATED: [&str; NA] = [#(#names),*];
        #pivots
    })
}

/// Returns the line of documentation about the actuated joints, if the file names them.
pub(super) fn actuated_docs(closed: &ClosedTree) -> Option<String> {
    let actuated = closed.closure.actuated.as_ref()?;
    let names = closed.joint_names(actuated).join("`, `");
    Some(match closed.closure.drives() {
        Some(_) => format!(
            " Actuated: `{names}`. The trait `Dynamics` has the efforts along the independent velocities, as `bias` and `gravity` do."
        ),
        None => format!(" Actuated: `{names}`."),
    })
}

/// Describes how the efforts of the actuated joints are determined, and the errors of the function: lines of
/// documentation.
pub(super) fn inverse_docs(closed: Option<&ClosedTree>) -> Vec<String> {
    let actuated = closed.and_then(|closed| Some((closed, closed.closure.drives()?)));
    let Some((closed, actuated)) = actuated else {
        return Vec::new();
    };
    if actuated.joints.len() == closed.closure.independents.len() {
        return Vec::new();
    }
    let weights = match actuated.efforts.windows(2).all(|pair| pair[0] == pair[1]) {
        true => {
            " More joints are actuated than velocities are independent: these efforts have the least sum of squares."
        }
        false => {
            " More joints are actuated than velocities are independent: these efforts, each over the joint's limit of effort, have the least sum of squares."
        }
    };
    vec![String::new(), weights.into()]
}
