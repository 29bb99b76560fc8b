//! Generates the models: OUT_DIR/gantry.rs, and OUT_DIR/wrist.rs with what the wrist's controller
//! calls and nothing else.

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
