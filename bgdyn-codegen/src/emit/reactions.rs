//! Emits what a module says of the loads of loops and contacts: their names, and those that nothing determines.

use bgdyn_runtime::Dd;
use proc_macro2::TokenStream;
use quote::quote;

use super::constants::size;
use super::tokens::number;
use crate::bond_graph::ClosedTree;
use crate::math::Vec3;
use crate::mechanism::closure::{
    ClosingRow, Closure, ContactShape, LoopRow, PlaneContact, RowKind,
};
use crate::mechanism::joint::DoubleDouble;
use crate::method::Method;

/// Whether a method returns loads of loops or contacts.
fn has_loads(method: &Method) -> bool {
    matches!(
        method,
        Method::Reactions | Method::ActuatedReactions(_) | Method::JointReactions
    )
}

/// Returns the constants of the reactions, if a method returns some.
pub(super) fn reaction_constants(closed: &ClosedTree, present: &[Method]) -> Option<TokenStream> {
    if !present.iter().any(has_loads) {
        return None;
    }
    let closure = &closed.closure;
    let names = closure.loops.iter().map(|one| one.name.as_str());
    let left_out: Vec<&LoopRow> = left_out(closure).collect();
    let undetermined = left_out.iter().map(|row| undetermined(closure, row));
    let (nr, nu) = (size(closure.loops.len()), size(left_out.len()));
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

/// Returns the rows without a multiplier.
fn left_out(closure: &Closure) -> impl Iterator<Item = &LoopRow> {
    let following = closure.following.iter().map(|one| &one.row);
    closure.dropped.iter().chain(following)
}

/// Returns the load of a row that was left out.
fn undetermined(closure: &Closure, row: &LoopRow) -> TokenStream {
    let one = &closure.loops[row.closes];
    let none = Vec3([Dd::ZERO; 3]);
    let unit = |k: usize| {
        let at = |i| if i == k { Dd::ONE } else { Dd::ZERO };
        Vec3(std::array::from_fn(at))
    };
    let axes = one.chain.start.rotation;
    let end = || one.chain.frames(&closure.start, &DoubleDouble);
    let (force, moment) = match row.kind {
        RowKind::Closing(ClosingRow::Place(k)) => (axes * unit(k), none),
        RowKind::Closing(ClosingRow::Tilt(k) | ClosingRow::Turn(k)) => (none, axes * unit(k)),
        RowKind::Closing(ClosingRow::Length) => {
            (axes * end().end().scale(Dd::ONE / one.length), none)
        }
        RowKind::Closing(ClosingRow::Angle) => {
            let across = (end().last_axes() * one.chain.end.rotation).column(0);
            (none, axes * across.cross(unit(2)))
        }
        RowKind::Contact(row) => match (row.contact_axis(), one.contact.as_ref()) {
            (Some(k), _) => (unit(k), none),
            (None, contact) => (contact.map_or(none, |contact| axes * edge(contact)), none),
        },
    };
    let [force, moment] = [force, moment].map(components);
    let (reaction, row) = (size(row.closes), closure.row_name(row));
    quote! {
        __rt::Undetermined { reaction: #reaction, row: #row, force: #force, moment: #moment }
    }
}

/// Returns the direction of a knife edge in the axes of its place.
fn edge(contact: &PlaneContact) -> Vec3<Dd> {
    match contact.shape {
        ContactShape::Edge(direction) | ContactShape::Disc(direction) => direction,
        ContactShape::Sphere | ContactShape::Ellipsoid(_) => Vec3([Dd::ZERO; 3]),
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
        Method::JointReactions => docs.extend([
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
    let some = closed.is_some_and(|closed| left_out(&closed.closure).next().is_some());
    if has_loads(&method) && some {
        docs.extend([
            "",
            " Statically indeterminate: loads along [`UNDETERMINED`] are left out, and not determined.",
        ]);
    }
    docs.into_iter().map(String::from).collect()
}
