//! The expression graph: each value of a function is one node, shared and folded.
//!
//! Equal nodes exist only once ([`Graph`] is hash-consed). Operands are [`Signed`], a node with a sign, so
//! that negation is free and x − y, y − x share one node. Constants are double-double and folded
//! accurately enough to prove that regrouped expressions are equal. Counting, evaluation, differentiation
//! and emission are passes over the graph, each in its own file.

mod adjoint;
mod arrange;
mod build;
mod copy;
mod cost;
mod count;
mod diff;
mod error;
mod eval;
mod factor;
mod fold;
mod fuse;
mod graph;
mod index;
mod labels;
mod naming;
mod needed;
mod node;
mod quotient;
mod signs;

pub use adjoint::adjoints;
pub use arrange::reassociate;
pub use bgdyn_runtime::Operations;
pub use build::{Builder, Expr};
pub use copy::copy_into;
pub(crate) use copy::{AngleSum, angle_sums, copy_with_pivots, copy_with_turns};
pub(crate) use cost::reads;
pub use cost::{Cost, cost};
pub use count::{count, reachable};
pub use diff::Tangent;
pub use error::{Bound, ErrorBound};
pub use eval::{Inputs, evaluate};
pub use factor::{factor, factored_cost};
pub use fuse::fuse;
pub use graph::Graph;
pub(crate) use index::QuickMap;
pub use naming::Name;
pub(crate) use needed::NeededNodes;
pub use node::{Constant, Leaf, Node, NodeId, Signed};
pub use quotient::fold_reciprocals;
pub use signs::absorb_negations;
