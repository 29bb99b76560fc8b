//! Generates the mechanisms of `specs/`; beside each it tells the probes which joints slide.

#[path = "../build/robots.rs"]
mod robots;
#[path = "../build/specs.rs"]
mod specs;

use std::env;
use std::path::Path;

use textbook::mechanism::{bodies, slides};

fn main() {
    let folder = Path::new(&env::var("CARGO_MANIFEST_DIR").unwrap()).join("../../specs");
    specs::generate(&folder, |_, mechanism, _| {
        format!("{:?}", slides(&bodies(mechanism)))
    });
}
