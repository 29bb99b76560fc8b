//! Compares compiled code with the evaluator, with equation (6), with its own counts and its own text:
//! every spec of the repository and random trees.

mod agreement;
#[path = "../../../../bgdyn-codegen/tests/common/mod.rs"]
mod common;
#[path = "../../../numeric/counted.rs"]
mod counted;
mod counting;
#[path = "../../generate.rs"]
mod generate;
mod literal;
mod rounded;
mod scalars;
mod specs;
mod tested;
