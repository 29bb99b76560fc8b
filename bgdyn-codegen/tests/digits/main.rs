//! Tests of lost digits, single hard states, and any argument.

#[path = "../common/allocator.rs"]
mod allocator;

mod accuracy;
mod bars;
#[path = "../common/mod.rs"]
mod common;
mod guard;
mod hard_cases;
mod limits;
