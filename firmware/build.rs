//! Generates the models, and the motions with which the controllers are checked.

mod build_c;

use std::path::PathBuf;
use std::{env, fs};

use bgdyn_codegen::build_script::{Build, Error};
use nalgebra::{Matrix3, Vector3};
use textbook::Body;

/// The measured arms.
const ARMS: [&str; 3] = ["scara", "puma560", "panda"];

fn main() -> Result<(), Error> {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("a build script"));
    for robot in ARMS {
        Build::new(format!("../specs/{robot}.yaml"))
            .methods(["dynamics"])
            .write()?;
    }
    let robots = ARMS.map(bodies).concat();
    fs::write(out.join("bodies.rs"), robots).expect("OUT_DIR can be written");
    fs::write(out.join("motions.rs"), reference::motions()).expect("OUT_DIR can be written");
    if env::var_os("CARGO_FEATURE_C").is_some() {
        let rust_flags = env::var("CARGO_ENCODED_RUSTFLAGS").unwrap_or_default();
        build_c::build(&ARMS, &out, &rust_flags);
    }
    // In the linker's search path.
    fs::copy("memory.x", out.join("memory.x")).expect("memory.x");
    println!("cargo::rustc-link-search={}", out.display());
    println!("cargo::rerun-if-changed=memory.x");
    Ok(())
}

/// Returns a mechanism of `specs/` for the textbook recursions: `SCARA`, a constant array of bodies, and
/// `SCARA_GRAVITY`.
fn bodies(robot: &str) -> String {
    let text = fs::read_to_string(format!("../specs/{robot}.yaml")).expect("a spec");
    let (mechanism, _) = bgdyn_codegen::read(&text, Some(robot));
    let mechanism = mechanism.expect("a sound spec");
    let bodies = textbook::mechanism::bodies(&mechanism);
    let gravity = vector(&textbook::mechanism::vector(mechanism.gravity()));
    let (name, count) = (robot.to_uppercase(), bodies.len());
    let list: String = bodies.iter().map(body).collect();
    format!(
        "/// Moving bodies.\npub const {name}: [Body; {count}] = [{list}];\n\
         /// Acceleration of free fall, m/s².\npub const {name}_GRAVITY: Vector3<f64> = {gravity};\n"
    )
}

fn body(body: &Body) -> String {
    let Body {
        parent,
        slides,
        mass,
        ..
    } = body;
    let (rotation, translation) = (
        matrix(&body.placement.rotation),
        vector(&body.placement.translation),
    );
    let (axis, com, inertia) = (vector(&body.axis), vector(&body.com), matrix(&body.inertia));
    format!(
        "Body {{ parent: {parent:?}, slides: {slides:?}, placement: Placement {{ rotation: {rotation}, \
         translation: {translation} }}, axis: {axis}, mass: {mass:?}, com: {com}, inertia: {inertia} }},"
    )
}

fn vector(v: &Vector3<f64>) -> String {
    format!("Vector3::new({:?}, {:?}, {:?})", v.x, v.y, v.z)
}

fn matrix(m: &Matrix3<f64>) -> String {
    let entries: Vec<String> = m.transpose().iter().map(|x| format!("{x:?}")).collect();
    format!("Matrix3::new({})", entries.join(", "))
}
