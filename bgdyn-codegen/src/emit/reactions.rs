//! Emits what a module says of the loads of loops and contacts: their names, and those that nothing determines.

use bgdyn_runtime::Dd;
use proc_macro2::TokenStream;
use quote::quote;

use super::constants::size;
use super::tokens::number;
use crate::bond_graph::ClosedTree;
use crate::math::Vec3;
use crate::method::Method;
use crate::plan::{UndeterminedLoad, undetermined_loads};

/// Returns the constants of the reactions, if a method returns some.
pub(super) fn reaction_constants(closed: &ClosedTree, present: &[Method]) -> Option<TokenStream> {
    if !present.iter().any(|method| method.has_loads()) {
        return None;
    }
    let closure = &closed.closure;
    let names = closure.loops.iter().map(|one| one.name.as_str());
    let loads = undetermined_loads(closure);
    let undetermined = loads.iter().map(undetermined);
    let (nr, nu) = (size(closure.loops.len()), size(loads.len()));
    Some(quote! {
        /// Number of the loops and contacts.
        pub const NR: usize = #nr;
        /// Names of the loops and contacts, in the order of `reactions`.
        pub const REACTION_NAMES: [&str; NR] = [#(#names),*];
        /// The loads that equations of rigid bodies do not determine, because their rows hold at every position of the
        /// joints, or follow from other rows: the components of `reactions` along them are zero, and the links of the
        /// loop may carry any such load in addition; where the row follows from others, these carry the opposite. Axes
        /// as those of `reactions`; of a universal joint at the position `neutral`; at the centre of a spherical loop.
        pub const UNDETERMINED: [__rt::Undetermined; #nu] = [#(#undetermined),*];
    })
}

/// Returns a load that nothing determines.
fn undetermined(load: &UndeterminedLoad) -> TokenStream {
    let [force, moment] = [load.force, load.moment].map(components);
    let (reaction, row) = (size(load.reaction), &load.row);
    quote! {
        __rt::Undetermined { reaction: #reaction, row: #row, force: #force, moment: #moment }
    }
}

fn components(of: Vec3<Dd>) -> TokenStream {
    let all = of.0.map(|x| {
        let size = number(x.to_f64().abs());
        match x.to_f64() < 0.0 {
            true => quote! { -#size },
            false => quote! { #size },
        }
    });
    quote! { [#(#all),*] }
}

/// Describes the axes and the directions of the loads that a method returns.
pub(super) fn reaction_docs(method: Method, closed: Option<&ClosedTree>) -> Vec<String> {
    let mut docs: Vec<&str> = Vec::new();
    match method {
        Method::Reactions | Method::ActuatedReactions(_) => docs.extend([
            "",
            " Of a loop: what the link of place a exerts on that of place b, the moment about the origin of place b, in the",
            " axes of the link of place a; the world's if that is the world. The opposite acts on the link of place a. Of a",
            " wheel or a ball: what the plane exerts at the contact, ahead, along the axle in the plane, and along the",
            " plane's normal; of a ball along x, y and z of the plane. Of a knife edge: what acts on it, in the axes of",
            " its link. All other efforts on the joints are zero.",
        ]),
        Method::JointReactions | Method::ActuatedJointReactions(_) => docs.extend([
            "",
            " The component along or about a free axis is the effort of its drive. The force of a link without a parent is",
            " that of the world.",
        ]),
        Method::ConstrainedDynamics | Method::ConstraintBias => docs.extend([
            "",
            " For velocities with B q̇ ≠ 0 the result is off in proportion to B q̇: see `project_velocity`.",
        ]),
        _ => {}
    }
    if matches!(method, Method::ActuatedJointReactions(_)) {
        docs.push(" Independent joints that are not actuated have the effort that `a` needs beside `tau`: zero if both belong");
        docs.push(" together, by `forward_dynamics` or `inverse_dynamics`.");
    }
    let some = closed.is_some_and(|closed| !undetermined_loads(&closed.closure).is_empty());
    if method.has_loads() && some {
        docs.extend([
            "",
            " Statically indeterminate: loads along [`UNDETERMINED`] are left out, and not determined.",
        ]);
    }
    docs.into_iter().map(String::from).collect()
}
