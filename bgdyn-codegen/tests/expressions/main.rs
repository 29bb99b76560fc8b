//! Tests of the expression graph: folding, values, derivatives, factoring, cost.

#[path = "../common/allocator.rs"]
mod allocator;

#[path = "../common/mod.rs"]
mod common;
mod cost;
mod expr;
mod expr_values;
mod factor;
