//! Prescribed joints: what the commands print of them, and a run.

use std::fs;

use serde_json::{Value, json};

use crate::{bgdyn, root, scratch};

const CAROUSEL: &str = "specs/constraints/carousel.yaml";

#[test]
fn check_ops_and_graph_name_the_joint() {
    let checked = bgdyn(&["check", CAROUSEL]).good();
    let lines: Vec<&str> = checked.lines().collect();
    assert_eq!(
        lines,
        [
            "ok: carousel, NQ 2, NV 2: swing, tilt",
            "prescribed: turntable"
        ]
    );
    let counted = bgdyn(&["ops", CAROUSEL]).good();
    assert!(counted.contains("drive_efforts"), "{counted}");
    let drawn = bgdyn(&["graph", CAROUSEL, "--format", "dot"]).good();
    assert!(drawn.contains("Sf: q̇₁(t), supplies P₁, N·m"), "{drawn}");
    assert!(drawn.contains("Se: P₂, N·m"), "{drawn}");
    assert!(!drawn.contains("Se: P₁"), "{drawn}");
    let refused = bgdyn(&["equations", CAROUSEL]).bad_input();
    assert!(
        refused.contains("no closed form: the motion of the joint `turntable` is prescribed"),
        "{refused}"
    );
}

/// At rest in the lowest position the motor accelerates the inertia about the axis of the table:
/// 0.8 + 0.8 · 0.9² + 0.0001 + 3 · 0.95² + 0.03 kg·m².
#[test]
fn eval_gives_the_effort_of_the_drive() {
    let state = json!({ "states": [{ "q": [0, 0], "v": [0, 0], "a": [0, 0] }] });
    let states = scratch("prescribed_eval", "states.json", state.to_string());
    let parameter = "turntable_acceleration=2";
    let run = [
        "eval",
        CAROUSEL,
        "drive_efforts",
        "--states",
        &states,
        "--parameter",
        parameter,
    ];
    let found: Value = serde_json::from_str(&bgdyn(&run).good()).expect("JSON");
    let moment = found["results"][0][0].as_f64().expect("a number");
    assert!((moment - 2.0 * 4.1856).abs() < 1e-12, "{moment}");
}

/// The course drives the table, and its motor's work is the energy that the friction takes and the links keep.
#[test]
fn a_run_has_the_power_of_the_drive_in_its_balance() {
    let text = fs::read_to_string(root().join(CAROUSEL)).expect("the carousel");
    scratch("prescribed_run", "carousel.yaml", text);
    let scene = scratch(
        "prescribed_run",
        "ride.scene.yaml",
        "scene: 1\nmechanism: carousel.yaml\neffects: [gravity, inertia, velocity_products, hinge: { type: viscous, joint: swing, damping: 2 }]\ninputs: { turntable: { harmonic: { amplitude: 90 deg, frequency: 0.25 Hz } } }\noutputs: [turntable, turntable_rate, swing, passenger]\nintegration: { method: rk4, step: 1 ms, end: 1 s }\n",
    );
    let out = scratch("prescribed_run", "out/made", "");
    let out = out.trim_end_matches("made");
    let run = bgdyn(&["simulate", &scene, "--out", out]).good();
    let row = |name: &str| -> Vec<f64> {
        let line = run.lines().find(|line| line.trim_start().starts_with(name));
        let line = line.unwrap_or_else(|| panic!("no row `{name}`: {run}"));
        let numbers = line.split_whitespace().skip(1);
        numbers.map(|x| x.parse().expect("a number")).collect()
    };
    let (drives, sum) = (row("prescribed_drives"), row("sum"));
    assert!(drives[0].abs() > 0.1 && drives[1..] == [0.0, 0.0], "{run}");
    assert!(
        (sum[0] - sum[1] - sum[2]).abs() < 1e-4 * sum[0].abs(),
        "{run}"
    );
    let table = fs::read_to_string(format!("{out}ride.csv")).expect("a table");
    let last: Vec<f64> = table
        .lines()
        .last()
        .expect("a row")
        .split(',')
        .map(|x| x.parse().expect("a number"))
        .collect();
    // A quarter of a period: the table is at its amplitude, and at rest.
    assert!(
        (last[1] - std::f64::consts::FRAC_PI_2).abs() < 1e-12,
        "{last:?}"
    );
    assert!(last[2].abs() < 1e-12, "{last:?}");
}
