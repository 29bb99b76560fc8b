//! Generates the modules: mechanisms in single states, mechanisms with loops, and scenes with known motions. Their
//! specs are written to `OUT_DIR` too.

#[allow(dead_code)]
#[path = "../../../../bgdyn-codegen/tests/scenes/written.rs"]
mod arm;
mod dependence;
mod loops;
mod mechanisms;
mod scenes;
#[path = "../../written.rs"]
mod written;

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap());
    let folder = root.join("..");
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    println!("cargo::rerun-if-changed=build");
    let others = [
        "../closed_loops",
        "../free_scenes",
        "../free_joints",
        "../../specs",
    ];
    for watched in ["written.rs", "specs", "scenes"].into_iter().chain(others) {
        println!("cargo::rerun-if-changed={}", folder.join(watched).display());
    }
    let mechanisms = mechanisms::write(&folder, &out);
    let loops = loops::write(&folder, &out);
    let scenes = scenes::write(&folder, &out);
    fs::write(out.join("mechanisms.rs"), mechanisms).unwrap();
    fs::write(out.join("loops.rs"), loops).unwrap();
    fs::write(out.join("scenes.rs"), scenes).unwrap();
}
