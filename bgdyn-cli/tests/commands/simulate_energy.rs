//! Tests the judgement of a run's energy account.

use crate::{bgdyn, scratch};

const ARM: &str = "\
format: 1
links:
  - name: upper
    joint: { name: shoulder, type: revolute, axis: y }
    mass: 2
    com: [0.2, 0, 0]
    inertia: { xx: 0.01, yy: 0.02, zz: 0.02 }
  - name: lower
    parent: upper
    joint: { name: elbow, type: revolute, axis: y, origin: { xyz: [0.4, 0, 0] } }
    mass: 1
    com: [0.2, 0, 0]
    inertia: { xx: 0.01, yy: 0.02, zz: 0.02 }
";

/// Returns the stderr of a run of the arm.
fn told(test: &str, effects: &str, start: &str, run: &str) -> String {
    scratch(test, "arm.yaml", ARM);
    let scene = format!(
        "scene: 1\nmechanism: arm.yaml\neffects: [{effects}]\ninitial: {{ {start} }}\nintegration: {{ {run} }}\n"
    );
    let scene = scratch(test, "free.scene.yaml", &scene);
    let out = format!("{}/{test}/out", env!("CARGO_TARGET_TMPDIR"));
    let run = bgdyn(&["simulate", &scene, "--out", &out]);
    assert!(run.stdout.contains("drift: "), "{}", run.stdout);
    run.stderr
}

#[test]
fn a_free_motion_that_keeps_its_energy_is_no_cause_for_a_warning() {
    for (i, method) in ["rk4", "dop853", "gauss2"].into_iter().enumerate() {
        let run = format!("method: {method}, step: 1 ms, end: 0.2 s");
        let start = "shoulder_rate: 1, elbow_rate: -2";
        let told = told(
            &format!("free_motion_{i}"),
            "inertia, velocity_products",
            start,
            &run,
        );
        assert!(!told.contains("energy does not add up"), "{method}: {told}");
    }
}

#[test]
fn rest_at_an_equilibrium_is_no_cause_for_a_warning() {
    let start = "shoulder: 1.5707963267948966";
    let told = told(
        "rest",
        "inertia, gravity, velocity_products",
        start,
        "method: rk4, step: 1 ms, end: 0.2 s",
    );
    assert!(!told.contains("energy does not add up"), "{told}");
}

#[test]
fn a_free_motion_that_loses_its_energy_is_told_of() {
    let start = "shoulder_rate: 8, elbow_rate: -16";
    let told = told(
        "lossy",
        "inertia, velocity_products",
        start,
        "method: rk4, step: 0.1 s, end: 4 s",
    );
    assert!(told.contains("energy does not add up"), "{told}");
}
