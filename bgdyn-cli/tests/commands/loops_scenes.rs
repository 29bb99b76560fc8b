//! Scenes of mechanisms with loops: runs, values, faults of the start.

use serde_json::{Value, json};

use crate::{bgdyn, root, scratch};

/// Writes a scene of the slider-crank with these keys.
fn scene(name: &str, keys: &str) -> String {
    let mechanism = root().join("specs/loops/slider_crank.yaml");
    let text = format!(
        "scene: 1\nmechanism: {}\neffects: [gravity, inertia, velocity_products]\n{keys}\n",
        mechanism.display()
    );
    scratch("loops_scenes", &format!("{name}.scene.yaml"), text)
}

const RUN: &str = "integration: { method: dop853, tolerance: 1e-12, end: 3 s }";

/// The last sample of the reference motion slider_crank.json.
#[test]
fn a_run_ends_where_the_reference_does() {
    let keys = format!(
        "inputs: {{ crank_angle: 0.5 N*m }}\ninitial: {{ crank_angle: 0.3, crank_angle_rate: 4 }}\n{RUN}"
    );
    let file = scene("run", &keys);
    let out = std::path::Path::new(&file).with_file_name("run");
    let out = out.to_str().expect("a path");
    let report = bgdyn(&["simulate", &file, "--out", out]).good();
    let table = std::fs::read_to_string(format!("{out}/run.csv")).expect("a table");
    let mut lines = table.lines();
    assert_eq!(
        lines.next(),
        Some(
            "t [s],crank_angle [rad],rod_angle [rad],slider_position [m],crank_angle_rate [rad/s]"
        ),
        "{report}"
    );
    let last: Vec<f64> = lines
        .last()
        .expect("a row")
        .split(',')
        .map(|x| x.parse().expect("a number"))
        .collect();
    let wanted = [
        3.0,
        0.07254320953286617,
        -0.061534827042954425,
        0.6994436832033417,
        6.726659589110112,
    ];
    for (found, wanted) in last.iter().zip(wanted) {
        assert!((found - wanted).abs() < 1e-9 * wanted.abs(), "{last:?}");
    }
}

/// Starts: positions and velocities of dependent joints determine the others.
#[test]
fn a_start_may_be_that_of_dependent_joints() {
    let keys = "initial: { slider_position: 0.6, slider_position_rate: -0.5 }";
    let file = scene("slider", keys);
    let states = scratch(
        "loops_scenes",
        "start.json",
        json!({ "states": [{}] }).to_string(),
    );
    let run = ["eval", &file, "position_rates", "--states", &states];
    let rates: Value = serde_json::from_str(&bgdyn(&run).good()).expect("JSON");
    let slider = rates["results"][0][2].as_f64().expect("a number");
    assert!((slider + 0.5).abs() < 1e-15, "{rates}");
    let run = ["eval", &file, "closing_step", "--states", &states];
    let steps: Value = serde_json::from_str(&bgdyn(&run).good()).expect("JSON");
    for k in 0..3 {
        let step = steps["results"][0][k].as_f64().expect("a number");
        assert!(step.abs() < 1e-15, "{steps}");
    }
}

#[test]
fn starts_that_loops_do_not_reach_are_refused() {
    for (name, keys, words) in [
        (
            "reach",
            "initial: { slider_position: 0.8 }",
            [
                "open-start",
                "`rod_pin` does not close",
                "nearest that closes is",
            ],
        ),
        (
            "twice",
            "initial: { crank_angle: 0.3, slider_position: 0.6 }",
            [
                "contradicting-start",
                "`slider_position` is 0.6 m here",
                "0.689536 m",
            ],
        ),
        (
            "rates",
            "initial: { crank_angle: 0.3, crank_angle_rate: 4, slider_position_rate: 1 m/s }",
            [
                "contradicting-start",
                "`slider_position_rate` is 1 m/s",
                "-0.296372 m/s",
            ],
        ),
        (
            "held",
            "effects: [gravity, { f: { type: coulomb, joint: slider_position, kinetic: 3 N } }]",
            [
                "dependent-joint",
                "`coulomb` can hold a joint at rest",
                "`independent:`",
            ],
        ),
        (
            "locked",
            "lock: { slider_position: 0.8 }",
            ["open-start", "lock.slider_position", "`rod_pin`"],
        ),
        (
            "unknown",
            "lock: { crank: 0 }",
            ["unknown-name", "crank_angle", "slider_position"],
        ),
        (
            "torque",
            "inputs: { slider_position: { computed_torque: { target: 0.6 m } }, crank_angle: { computed_torque: { target: 0.5 } } }",
            [
                "followed-joints",
                "`computed_torque` of 1 joint in loops, `slider_position`",
                "contradict each other: leave 1 of them out",
            ],
        ),
    ] {
        let mut file = scene(name, keys);
        if keys.starts_with("effects") {
            let text = std::fs::read_to_string(&file).expect("the scene");
            let text = text.replacen("effects: [gravity, inertia, velocity_products]\n", "", 1);
            file = scratch("loops_scenes", &format!("{name}.scene.yaml"), text);
        }
        let said = bgdyn(&["check", &file]).bad_input();
        for word in words {
            assert!(said.contains(word), "{name}: {word}: {said}");
        }
    }
}

/// An overridden start is closed again.
#[test]
fn runs_from_other_starts_are_closed() {
    let file = scene(
        "sweep",
        "integration: { method: rk4, step: 1 ms, end: 0.1 s }",
    );
    let out = std::path::Path::new(&file).with_file_name("sweep");
    let out = out.to_str().expect("a path");
    let run = [
        "simulate",
        &file,
        "--out",
        out,
        "--sweep",
        "crank_angle=-1:1:5",
    ];
    bgdyn(&run).good();
    let refused = bgdyn(&[
        "simulate",
        &file,
        "--out",
        out,
        "--initial",
        "slider_position=0.8",
    ]);
    let said = format!("{}{}", refused.stdout, refused.stderr);
    assert!(said.contains("`rod_pin` does not close"), "{said}");
}

/// The drawing has the loop with its flow source, and the effects at dependent joints.
#[test]
fn the_graph_of_a_scene_has_its_loops() {
    let keys = "inputs: { slider_position: 2 N }";
    let mut text = std::fs::read_to_string(scene("drawn", keys)).expect("the scene");
    text = text.replacen(
        "velocity_products]",
        "velocity_products, { pin: { type: viscous, joint: rod_angle, damping: 1 } }]",
        1,
    );
    let file = scratch("loops_scenes", "drawn.scene.yaml", text);
    let drawn = bgdyn(&["graph", &file, "--format", "dot"]).good();
    for word in ["loop rod_pin", "Sf: 0, effort λ", "pin (viscous)", "Se: P₃"] {
        assert!(drawn.contains(word), "{word}: {drawn}");
    }
    assert!(!drawn.contains("Se: P₁"), "the crank has no drive: {drawn}");
    assert!(!drawn.contains("Not drawn"), "{drawn}");
}

/// Returns a column of the table of a run.
fn column(out: &str, name: &str, title: &str) -> Vec<f64> {
    let table = std::fs::read_to_string(format!("{out}/{name}.csv")).expect("a table");
    let mut lines = table.lines();
    let titles = lines.next().expect("titles").split(',');
    let at = titles
        .into_iter()
        .position(|own| own == title)
        .expect("a column");
    let entry = |line: &str| {
        line.split(',')
            .nth(at)
            .expect("an entry")
            .parse()
            .expect("a number")
    };
    lines.map(entry).collect()
}

/// The slider follows a harmonic motion, from its place and velocity there.
#[test]
fn a_slider_follows_its_target() {
    let keys = "inputs: { slider_position: { computed_torque: { target: { harmonic: { amplitude: 50 mm, frequency: 0.5 Hz, offset: 550 mm } }, stiffness: 100, damping: 20 } } }\ninitial: { slider_position: 550 mm, slider_position_rate: 0.15707963267948966 }\nintegration: { method: dop853, tolerance: 1e-12, end: 3 s }";
    let file = scene("follows", keys);
    let out = std::path::Path::new(&file).with_file_name("follows");
    let out = out.to_str().expect("a path");
    bgdyn(&["simulate", &file, "--out", out, "--points", "31"]).good();
    let times = column(out, "follows", "t [s]");
    let places = column(out, "follows", "slider_position [m]");
    assert_eq!(places.len(), 31);
    for (t, x) in times.iter().zip(&places) {
        let wanted = 0.55 + 0.05 * (std::f64::consts::PI * t).sin();
        assert!((x - wanted).abs() < 1e-10, "{x} at {t} s, not {wanted}");
    }
}

/// A run from the velocity of the slider, by an option, is the run from the velocity of the crank.
#[test]
fn a_run_may_start_with_the_velocity_of_a_dependent_joint() {
    let keys = format!("initial: {{ crank_angle: 0.7, crank_angle_rate: 4 }}\n{RUN}");
    let file = scene("rates", &keys);
    let run = |name: &str, more: &[&str]| {
        let out = std::path::Path::new(&file).with_file_name(name);
        let out = out.to_str().expect("a path").to_owned();
        let run = [
            &["simulate", &file, "--out", &out, "--end", "0.5 s"][..],
            more,
        ]
        .concat();
        bgdyn(&run).good();
        column(&out, "rates", "crank_angle [rad]")
    };
    let by_crank = run("by_crank", &[]);
    let states = scratch(
        "loops_scenes",
        "rates.json",
        json!({ "states": [{}] }).to_string(),
    );
    let rates = bgdyn(&["eval", &file, "position_rates", "--states", &states]).good();
    let rates: Value = serde_json::from_str(&rates).expect("JSON");
    let slider = rates["results"][0][2].as_f64().expect("a number");
    let by_slider = run(
        "by_slider",
        &["--initial", &format!("slider_position_rate={slider}")],
    );
    for (x, y) in by_crank.iter().zip(&by_slider) {
        assert!((x - y).abs() < 1e-10, "{x} and {y}");
    }
    let options = [
        "--initial",
        "slider_position_rate=0.3",
        "--initial",
        "crank_angle_rate=4",
    ];
    let run = [&["simulate", &file][..], &options].concat();
    let refused = bgdyn(&run).bad_input();
    assert!(
        refused.contains("`slider_position_rate` is 0.3 m/s here"),
        "{refused}"
    );
}
