//! Emits the function that assembles positions from anywhere.

use proc_macro2::TokenStream;
use quote::quote;

use super::closed_positions::start;
use super::constants::size;
use super::contacts::{argument_types, tree_integration};
use crate::bond_graph::ClosedTree;
use crate::mechanism::closure::Closure;
use crate::plan::{AssemblyConditions, BranchConditions};

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
    let conditions = AssemblyConditions::new(closure);
    let rows = conditions.rows.iter().map(|row| match row {
        Some(closes) => {
            let closes = size(*closes);
            quote! { ::core::option::Option::Some(#closes) }
        }
        None => quote! { ::core::option::Option::None },
    });
    let blocks = conditions.blocks.iter().map(branch);
    let joints = conditions.joints.iter().map(|&(velocity, position)| {
        let [velocity, position] = [velocity, position].map(size);
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

fn branch(block: &BranchConditions) -> TokenStream {
    let rows = block.rows.iter().map(|&r| size(r));
    let columns = block.columns.iter().map(|&j| size(j));
    let (positive, closes) = (block.positive, size(block.closes));
    quote! {
        __rt::closure::BranchBlock {
            rows: &[#(#rows),*],
            columns: &[#(#columns),*],
            positive: #positive,
            closes: #closes,
        }
    }
}
