//! Emits the start of a mechanism with loops or contacts, and the joints whose positions close.

use bgdyn_runtime::Dd;
use proc_macro2::TokenStream;
use quote::quote;

use super::constants::size;
use super::tokens::number;
use crate::bond_graph::ClosedTree;
use crate::mechanism::CoordinateId;

/// Returns a dependent joint with its position and its loop.
pub(super) fn dependent(closed: &ClosedTree, j: CoordinateId) -> TokenStream {
    let closure = &closed.closure;
    let block = closure
        .blocks
        .iter()
        .find(|block| block.dependents.contains(&j));
    let row = block.and_then(|block| block.rows.first());
    let closes = row.map_or(0, |&r| closure.rows[r].closes);
    let mut compounds = closure.compounds.iter();
    let own = compounds.find(|joint| joint.degrees.velocities.contains(&j));
    let first = own.and_then(|joint| joint.degrees.positions.first());
    let position = closure.positions[j.0].as_ref().or(first).map_or(0, |p| p.0);
    let [velocity, position, closes] = [j.0, position, closes].map(size);
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
