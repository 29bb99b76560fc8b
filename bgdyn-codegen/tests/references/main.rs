//! Tests against values from outside of the generator, and against the equations as printed.

#[path = "../common/allocator.rs"]
mod allocator;

#[path = "../common/mod.rs"]
mod common;
mod golden;
mod golden_centroidal;
mod golden_operational;
mod golden_poses;
mod golden_regressors;
mod golden_second;
mod golden_values;
mod lagrange_oracle;
mod paper_oracle;
