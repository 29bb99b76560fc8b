//! Tests that formulations equal each other and obey the laws of mechanics.

#[path = "../common/allocator.rs"]
mod allocator;

mod bundles;
mod centroidal;
mod checked;
#[path = "../common/mod.rs"]
mod common;
mod contacts;
mod derivatives_vs_literal;
mod laws;
mod long_chains;
mod massless;
mod motions;
mod no_moving_joint;
mod noisy_axes;
mod operational;
mod parameters;
mod payloads;
mod properties;
mod regressions;
mod regressors;
mod second_derivatives;
mod singular;
