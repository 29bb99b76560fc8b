//! A SCARA moves a part from one place to another: computed torque at 1 kHz with a model generated from
//! `specs/scara.yaml`, simulated with an arm that carries 2 kg unknown to the model.
//!
//! `cargo run --release -p controllers --example scara` prints a report and draws `target/scara/scara.svg`.

mod common;

use std::process::ExitCode;

use bgdyn::nalgebra::Point3;
use common::control::Gains;
use common::cycle::{Cycle, Gripper, Leg};
use common::machine::{Machine, machine};
use common::{Cell, Joints};

// The controller's model, and the arm with an open gripper.
bgdyn::bgdyn!("../../specs/scara.yaml");
// The arm with the part.
bgdyn::bgdyn!("plants/scara_loaded.yaml");

use scara::Scara;
use scara_loaded::ScaraLoaded;

/// Lengths of the arms, m.
const ARMS: (f64, f64) = (0.325, 0.275);
/// Height of the tool with the quill retracted, m.
const TOP: f64 = 0.24;

fn main() -> ExitCode {
    common::run("scara", cell)
}

fn cell() -> Result<Cell<Scara, Scara, Scara, ScaraLoaded, 4>, String> {
    let machine = machine!(scara, Scara);

    // Positions of the tool: x, y, z in m and its angle about the vertical.
    let place = |x, y, z, angle: f64| joints(&machine, &Point3::new(x, y, z), angle.to_radians());
    let home = place(0.45, 0.10, 0.22, 0.0)?;
    let above_pick = place(0.42, -0.22, 0.20, 0.0)?;
    let pick = place(0.42, -0.22, 0.08, 0.0)?;
    let above_place = place(0.10, 0.32, 0.20, 90.0)?;
    let put = place(0.10, 0.32, 0.08, 90.0)?;

    let legs = vec![
        Leg::new("approach", above_pick, 0.40),
        Leg::new("down", pick, 0.25),
        Leg::new("grasp", pick, 0.10).then(Gripper::Takes),
        Leg::new("up", above_pick, 0.25),
        Leg::new("over", above_place, 0.50),
        Leg::new("down", put, 0.25),
        Leg::new("release", put, 0.15).then(Gripper::Releases),
        Leg::new("up", above_place, 0.25),
        Leg::new("home", home, 0.45),
    ];
    Ok(Cell {
        name: "scara",
        title: "SCARA: pick and place with a part the controller does not know",
        plant: "Plant: the same arm; while carrying, + 2 kg at the tool.",
        machine,
        generated: Scara::default(),
        model: Scara::default(),
        empty: Scara::default(),
        loaded: ScaraLoaded::default(),
        cycle: Cycle { start: home, legs },
        gains: Gains::critical(10.0),
    })
}

/// Inverse kinematics, elbow to the left.
///
/// The law of cosines gives the elbow from the distance, the direction then gives the shoulder; the
/// quill's axis points down, so that its displacement and rotation are opposite to the world's z.
fn joints(machine: &Machine<4>, tool: &Point3<f64>, angle: f64) -> Result<Joints<4>, String> {
    let (upper, fore) = ARMS;
    let square = tool.x * tool.x + tool.y * tool.y;
    let cosine = (square - upper * upper - fore * fore) / (2.0 * upper * fore);
    if cosine.abs() > 1.0 {
        return Err(format!("{tool} is out of reach"));
    }
    let elbow = cosine.acos();
    let shoulder = tool.y.atan2(tool.x) - (fore * elbow.sin()).atan2(upper + fore * elbow.cos());
    let q = Joints::from([shoulder, elbow, TOP - tool.z, shoulder + elbow - angle]);

    // Checks the constants above against the spec by forward kinematics.
    let off = ((machine.tool)(&q) - tool).norm();
    if off > 1e-9 {
        return Err(format!("inverse kinematics misses {tool} by {off} m"));
    }
    Ok(q)
}
