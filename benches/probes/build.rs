//! Generates the mechanisms of `specs/`; beside each it tells the probes which joints slide.

#[path = "../build/robots.rs"]
mod robots;

use std::env;
use std::path::PathBuf;

use textbook::mechanism::{bodies, slides};

fn main() {
    let specs = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap()).join("../../specs");
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    robots::generate(&specs, &out, |_, mechanism, _| {
        format!("{:?}", slides(&bodies(mechanism)))
    });
}
