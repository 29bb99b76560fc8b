//! Generates the models, and the motions that the controllers are checked with.

use std::fmt::Write;
use std::path::PathBuf;
use std::{env, fs};

use bgdyn_codegen::build_script::{Build, Error};
use control::Record;
use reference::{DAMPING, PAYLOAD, STIFFNESS};
use reference::{puma560_motion, scara_motion, scara_payload_motion};

fn main() -> Result<(), Error> {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("a build script"));
    for robot in ["scara", "puma560", "panda"] {
        Build::new(format!("../specs/{robot}.yaml"))
            .methods(["dynamics"])
            .write()?;
    }
    let mut text = String::new();
    motion(&mut text, "SCARA", &scara_motion());
    motion(&mut text, "PUMA560", &puma560_motion());
    motion(&mut text, "SCARA_PAYLOAD", &scara_payload_motion());
    for (name, what, x) in [
        ("STIFFNESS", "Kp, 1/s².", STIFFNESS),
        ("DAMPING", "Kd, 1/s.", DAMPING),
        ("PAYLOAD", "Mass of the part, kg.", PAYLOAD),
    ] {
        writeln!(text, "/// {what}\npub const {name}: Real = {x:?};").expect("memory");
    }
    fs::write(out.join("motions.rs"), text).expect("OUT_DIR can be written");
    // Where the linker looks.
    fs::copy("memory.x", out.join("memory.x")).expect("memory.x");
    println!("cargo::rustc-link-search={}", out.display());
    println!("cargo::rerun-if-changed=memory.x");
    Ok(())
}

/// A static array of the motion's records.
fn motion<const N: usize>(text: &mut String, name: &str, records: &[Record<f64, N>]) {
    let (count, list) = (records.len(), format!("{records:?}"));
    writeln!(
        text,
        "/// What the host found.\npub static {name}: [Record<Real, {N}>; {count}] = {list};"
    )
    .expect("memory");
}
