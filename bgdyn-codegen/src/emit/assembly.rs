//! Emits the function that assembles positions from anywhere.

use proc_macro2::TokenStream;
use quote::quote;

use super::closed_positions::start;
use super::constants::size;
use super::contacts::{argument_types, tree_integration};
use crate::bond_graph::ClosedTree;
use crate::mechanism::closure::{Closure, ClosureBlock};

/// Returns the constants and the function. It calls `constraint_residual` and `constraint_jacobian`.
pub(super) fn assembly(closed: &ClosedTree) -> (TokenStream, TokenStream) {
    let closure = &closed.closure;
    let constants = conditions(closure);
    let [q, moved] = argument_types();
    let (body, start) = (tree_integration(closed), start(closed));
    let branch = match closure.nonholonomic() {
        true => "",
        false => ", on the branch of `neutral`",
    };
    let doc = format!(
        " Returns positions at which all wheels touch and all loops close{branch}, from anywhere: Levenberg and Marquardt's"
    );
    let function = quote! {
        #[doc = #doc]
        /// method, at most 64 steps, each the shortest for its damping. The positions that change are those of the
        /// velocities that are `free`, as in [`TREE_JOINT_NAMES`]. The first attempt begins at `guess`, further ones on
        /// the way from there to the position `neutral`.
        ///
        /// # Errors
        /// Names the first loop that does not close, with the cause `NotAssembled`, or closes on another branch, with the
        /// cause `Branch`, or the first position of `guess` that is NaN or infinite.
        pub fn assemble(
            &self,
            guess: &__na::SVector<T, NQ>,
            free: &[bool; NT],
        ) -> ::core::result::Result<__na::SVector<T, NQ>, T::Singular<NQ>> {
            let of = __rt::closure::Mechanism {
                residual: |q: #q| self.constraint_residual(q),
                jacobian: |q: #q| self.constraint_jacobian(q),
                moved: |q: #q, moved: #moved| { #body },
            };
            let start = { #start };
            __rt::closure::assemble([*guess, start], &CONDITIONS, free, &of).finish(&CLOSING_NAMES)
        }
    };
    (constants, function)
}

/// Returns the constant with the rows that close, the blocks that tell the branch, and the joints of the loops.
fn conditions(closure: &Closure) -> TokenStream {
    let row = |row: &crate::mechanism::closure::LoopRow| {
        let closes = size(row.closes);
        match row.kind.has_positions() {
            true => quote! { ::core::option::Option::Some(#closes) },
            false => quote! { ::core::option::Option::None },
        }
    };
    let rows = closure.rows.iter().map(row);
    // With rows on velocities positions close by shortest steps, and no determinant tells a branch.
    let slips = closure.nonholonomic();
    let blocks = closure.blocks.iter().zip(&closure.signs);
    let blocks = blocks.filter(|_| !slips);
    let blocks = blocks.map(|(block, positive)| branch(closure, block, *positive));
    let joints = closure.positions.iter().enumerate();
    let joints = joints.filter_map(|(j, position)| Some((j, (*position)?)));
    let joints = joints.filter(|_| !slips).map(|(j, position)| {
        let [velocity, position] = [j, position.0].map(size);
        quote! { (#velocity, #position) }
    });
    quote! {
        /// What `assemble` closes.
        const CONDITIONS: __rt::closure::Conditions<NC> = __rt::closure::Conditions {
            rows: [#(#rows),*],
            blocks: &[#(#blocks),*],
            joints: &[#(#joints),*],
        };
    }
}

fn branch(closure: &Closure, block: &ClosureBlock, positive: bool) -> TokenStream {
    let rows = block.rows.iter().map(|&r| size(r));
    let columns = block.dependents.iter().map(|j| size(j.0));
    let first = block.rows.first().map_or(0, |&r| closure.rows[r].closes);
    let closes = size(first);
    quote! {
        __rt::closure::BranchBlock {
            rows: &[#(#rows),*],
            columns: &[#(#columns),*],
            positive: #positive,
            closes: #closes,
        }
    }
}
