//! Generates the models, and the motions with which the controllers are checked.

use std::path::PathBuf;
use std::{env, fs};

use bgdyn_codegen::build_script::{Build, Error};

fn main() -> Result<(), Error> {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("a build script"));
    for spec in [
        "../../specs/scara.yaml",
        "../../specs/puma560.yaml",
        "../specs/scara_payload.yaml",
    ] {
        Build::new(spec).methods(["dynamics"]).write()?;
    }
    fs::write(out.join("motions.rs"), reference::motions()).expect("OUT_DIR can be written");
    Ok(())
}
