//! The models of the firmware, generated for the host.

use bgdyn_codegen::build_script::{Build, Error};

fn main() -> Result<(), Error> {
    for spec in [
        "../../specs/scara.yaml",
        "../../specs/puma560.yaml",
        "../specs/scara_payload.yaml",
    ] {
        Build::new(spec).methods(["dynamics"]).write()?;
    }
    Ok(())
}
