//! A PUMA 560 moves a part from one place to another: computed torque at 1 kHz with a model generated from
//! `specs/puma560.yaml`, simulated with an arm that carries 2 kg unknown to the model.
//!
//! `cargo run --release -p controllers --example puma560` prints a report and draws `target/puma560/puma560.svg`.

#[path = "../common/mod.rs"]
mod common;
mod geared;

use std::process::ExitCode;

use common::control::Gains;
use common::cycle::{Cycle, Gripper, Leg};
use common::machine::machine;
use common::{Cell, Joints};
use geared::Geared;

// The controller's model, and the arm with an open gripper.
bgdyn::bgdyn!("../../../specs/puma560.yaml");
// The arm with the part.
bgdyn::bgdyn!("../plants/puma560_loaded.yaml");

use puma560::Puma560;
use puma560_loaded::Puma560Loaded;

/// Reflected inertia of motor and drive at the joint, kg·m² (after Armstrong, Khatib, Burdick 1986). It is
/// most of the inertia that the wrist's motors move; the controller's model and the plant have the same
/// values.
const ROTORS: [f64; 6] = [1.14, 4.71, 0.83, 0.200, 0.179, 0.193];

fn main() -> ExitCode {
    common::run("puma560", cell)
}

type Arm = Geared<Puma560, 6>;

fn cell() -> Result<Cell<Puma560, Arm, Arm, Geared<Puma560Loaded, 6>, 6>, String> {
    let home = pose(0.0, 60.0, -30.0, 0.0);
    let above_pick = pose(-45.0, 40.0, -50.0, -45.0);
    let pick = pose(-45.0, 20.0, -65.0, -45.0);
    let above_place = pose(50.0, 25.0, -20.0, 50.0);
    let put = pose(50.0, 5.0, -30.0, 50.0);

    let legs = vec![
        Leg::new("approach", above_pick, 1.2),
        Leg::new("down", pick, 0.8),
        Leg::new("grasp", pick, 0.3).then(Gripper::Takes),
        Leg::new("up", above_pick, 0.8),
        Leg::new("over", above_place, 2.3),
        Leg::new("down", put, 0.8),
        Leg::new("release", put, 0.4).then(Gripper::Releases),
        Leg::new("up", above_place, 0.8),
        Leg::new("home", home, 1.4),
    ];
    Ok(Cell {
        name: "puma560",
        title: "PUMA 560: pick and place with a part the controller does not know",
        plant: "Plant: the same arm and rotors; while carrying, + 2 kg at the tool.",
        machine: machine!(puma560, Puma560),
        generated: Puma560::default(),
        model: geared(Puma560::default()),
        empty: geared(Puma560::default()),
        loaded: geared(Puma560Loaded::default()),
        cycle: Cycle { start: home, legs },
        gains: Gains::critical(6.0),
    })
}

fn geared<M>(arm: M) -> Geared<M, 6> {
    Geared {
        arm,
        rotors: Joints::from(ROTORS),
    }
}

/// Returns a pose with the tool pointing down, all angles in degrees: the direction of the waist, the
/// elevation of upper arm and forearm above the horizontal, and the rotation of the hand.
///
/// Joint angles are relative to the previous link: at the elbow's zero the forearm is perpendicular to the
/// upper arm, at the bend's zero the hand is in line with the forearm.
fn pose(waist: f64, upper_arm: f64, forearm: f64, hand: f64) -> Joints<6> {
    let elbow = forearm - 90.0 - upper_arm;
    let bend = -90.0 - forearm;
    Joints::from([waist, upper_arm, elbow, 0.0, bend, hand].map(f64::to_radians))
}
