//! Generates the models: OUT_DIR/gantry.rs, and OUT_DIR/wrist.rs with only the methods that the wrist's
//! controller calls.

use bgdyn_codegen::build_script::{Build, Error, build};

fn main() -> Result<(), Error> {
    build("../../specs/gantry.yaml")?;
    Build::new("specs/wrist.yaml")
        .methods(["inverse_dynamics", "forward_dynamics"])
        .frames(["tool"])
        .visibility("pub(crate)")
        .write()?;
    Ok(())
}
