//! Tests of what generated code calls: rotations, inertias, poses, inner products, blocks at rest.

#[path = "../exact/mod.rs"]
mod exact;
mod joint_columns;
mod log_cholesky;
mod pose;
mod products;
// That of the generator, whose crate depends on this one.
#[allow(dead_code)]
#[path = "../../src/random.rs"]
mod random;
mod rotations;
mod stiction;
