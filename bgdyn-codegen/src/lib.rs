//! The code generator of bgdyn: converts a mechanism in YAML to Rust tokens or source text.
//!
//! The steps have one direction: [`mod@format`] (the parsed file) → [`mechanism`] (checked) →
//! [`bond_graph`] → [`formulation`] (equation (6) regrouped) → [`expr`] (the expression graph) → [`plan`]
//! (statements in order) → [`emit`] (Rust tokens). Data types import no steps; [`pipeline`] runs the steps in order.
//!
//! [`bgdyn_runtime`] defines units, frames, the order of spatial vectors and the sign of gravity.
//! `docs/extending.md` describes how to add a joint, an effect, a constraint, a formulation, a method or a backend.
#![forbid(unsafe_code)]

#[cfg(feature = "source")]
pub mod backend;
pub mod bond_graph;
#[cfg(feature = "source")]
pub mod build_script;
pub mod bundle;
pub mod choice;
pub mod closed_form;
pub mod column_loop;
pub mod conditioning;
pub mod declaration;
pub mod effect;
pub mod effort_sums;
pub mod emit;
pub mod engine;
pub mod expr;
pub mod fault;
pub mod files;
pub mod format;
pub mod formulation;
pub mod function;
pub mod generated;
mod inner_products;
pub mod interface;
pub mod layout;
mod legend;
pub mod machine;
pub mod math;
pub mod mechanism;
pub mod method;
pub mod model;
pub mod name;
pub mod options;
pub mod passes;
pub mod pipeline;
pub mod plan;
pub mod random;
mod read;
pub mod refusal;
pub mod scene;
pub mod selection;
mod split_blocks;
pub mod stub;
pub mod system;
pub mod tape;
pub mod unit;
pub mod verify;

#[cfg(feature = "source")]
pub use build_script::{Build, build};
pub use read::{Checked, SpecText, read, read_machine, read_scene};

/// The examples of `docs/extending.md`, compiled by `cargo test --doc -p bgdyn-codegen`.
#[cfg(doctest)]
mod pages {
    #[doc = include_str!("../../docs/extending.md")]
    struct Extending;
}
