//! The specs that are compared with other systems.

use std::env;
use std::path::{Path, PathBuf};

/// Returns the paths that `BGDYN_PEERS` names, one per line.
pub fn paths() -> Vec<PathBuf> {
    println!("cargo::rerun-if-env-changed=BGDYN_PEERS");
    let root = Path::new(&env::var("CARGO_MANIFEST_DIR").unwrap()).join("../../..");
    let specs = env::var("BGDYN_PEERS").unwrap_or("tests/golden/specs/scara4.yaml".into());
    let lines = specs.lines().filter(|line| !line.is_empty());
    lines.map(|spec| root.join(spec)).collect()
}
