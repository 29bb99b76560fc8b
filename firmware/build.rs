//! Generates the models, and the motions that the controllers are checked with.

use std::fmt::Write;
use std::path::PathBuf;
use std::{env, fs};

use bgdyn_codegen::build_script::{Build, Error};
use control::Record;
use nalgebra::{Matrix3, Vector3};
use reference::{DAMPING, PAYLOAD, STIFFNESS};
use reference::{puma560_motion, scara_motion, scara_payload_motion};
use textbook::Body;

fn main() -> Result<(), Error> {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("a build script"));
    for robot in ["scara", "puma560", "panda"] {
        Build::new(format!("../specs/{robot}.yaml"))
            .methods(["dynamics"])
            .write()?;
    }
    let robots = ["scara", "puma560", "panda"].map(bodies).concat();
    fs::write(out.join("bodies.rs"), robots).expect("OUT_DIR can be written");
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

/// A mechanism of `specs/` as the textbook takes it: `SCARA`, a constant array of bodies, and
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
