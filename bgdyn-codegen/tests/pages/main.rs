//! Tests that compare pages of the documentation with what is generated, and write them on request.

mod closed_form;
#[path = "../common/mod.rs"]
mod common;
mod performance;
mod untuned_arms;
