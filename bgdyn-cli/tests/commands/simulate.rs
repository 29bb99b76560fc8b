//! `bgdyn simulate`.

use std::f64::consts::PI;
use std::fs;
use std::path::PathBuf;

use crate::{Run, bgdyn, scratch, table_rows};

const BLOCK: &str = "\
format: 1
links:
  - name: block
    joint: { name: slide, type: prismatic, axis: x }
    mass: 2 kg
effects:
  rubber: { type: spring, joint: slide, stiffness: 50 N/m }
";

/// Released at 0.1 m, it oscillates with ω = 5 rad/s.
const SCENE: &str = "\
scene: 1
mechanism: block.yaml
effects: [rubber]
initial: { slide: 0.1 m }
integration: { method: rk4, step: 1 ms, end: 2 s }
";

/// A run of the block's scene, with its table.
fn block(test: &str, scene: &str, options: &[&str]) -> (Run, String) {
    scratch(test, "block.yaml", BLOCK);
    let scene = scratch(test, "swing.scene.yaml", scene);
    let out: PathBuf = [env!("CARGO_TARGET_TMPDIR"), test, "out"].iter().collect();
    let folder = out.display().to_string();
    let arguments = ["simulate", scene.as_str(), "--out", &folder];
    let run = bgdyn(&[&arguments, options].concat());
    let table = fs::read_to_string(out.join("swing.csv")).unwrap_or_default();
    if !table.is_empty() {
        let picture = fs::read_to_string(out.join("swing.svg")).expect("a plot");
        assert!(picture.contains("</svg>"));
    }
    (run, table)
}

fn rows(table: &str) -> Vec<Vec<f64>> {
    let number = |x: &String| x.parse::<f64>().expect("a number");
    let rows = table_rows(table).into_iter();
    rows.map(|row| row.iter().map(number).collect()).collect()
}

#[test]
fn every_kind_of_method_follows_the_known_motion() {
    let ways: [(&str, &[&str], f64); 6] = [
        ("as_written", &[], 1e-9),
        (
            "controlled",
            &["--method", "dopri5", "--tolerance", "1e-9"],
            1e-8,
        ),
        (
            "slopes",
            &["--method", "rodas4", "--tolerance", "1e-8"],
            1e-6,
        ),
        ("implicit", &["--method", "gauss3", "--step", "0.02"], 1e-8),
        (
            "momenta",
            &["--method", "canonical_gauss3", "--step", "0.02"],
            1e-8,
        ),
        (
            "euler",
            &["--method", "semi_implicit_euler", "--step", "1e-4"],
            1e-3,
        ),
    ];
    for (name, options, allowed) in ways {
        let options = [options, &["--points", "21"]].concat();
        let (run, table) = block(&format!("simulate_{name}"), SCENE, &options);
        let told = run.good();
        assert!(told.contains("drift: "), "{told}");
        assert!(table.starts_with("t [s],slide [m],slide_rate [m/s]\n"));
        let rows = rows(&table);
        assert_eq!(rows.len(), 21);
        for (i, row) in rows.iter().enumerate() {
            let t = 0.1 * i as f64;
            let wanted = [t, 0.1 * (5.0 * t).cos(), -0.5 * (5.0 * t).sin()];
            for (found, wanted) in row.iter().zip(wanted) {
                let off = (found - wanted).abs();
                assert!(off < allowed, "{name}, t = {t}: {found}, not {wanted}");
            }
        }
    }
}

/// The block on the belt, in closed form: it slips for 3π/20 s and sticks for 0.2 s. The report has six
/// digits, the table all.
#[test]
fn events_are_told_when_they_are() {
    let out: PathBuf = [env!("CARGO_TARGET_TMPDIR"), "simulate_belt"]
        .iter()
        .collect();
    let folder = out.display().to_string();
    let scene = "specs/scenes/stick_slip.scene.yaml";
    let told = bgdyn(&["simulate", scene, "--out", &folder, "--points", "6"]).good();
    let table = fs::read_to_string(out.join("stick_slip.csv")).expect("a table");
    let times: Vec<f64> = rows(&table).iter().map(|row| row[0]).collect();
    let mut wanted = 0.4;
    let events = told.lines().filter(|line| line.starts_with("  t = "));
    let mut count = 0;
    for (i, line) in events.enumerate() {
        let (t, what) = line["  t = ".len()..].split_once(" s: ").expect("a time");
        let told = t.parse::<f64>().expect("a time");
        assert!(
            (told - wanted).abs() <= 5.1e-6 * wanted,
            "{line}, not {wanted}"
        );
        assert!(t.len() <= "0.400000".len(), "{line}");
        let off = times.iter().map(|t| (t - wanted).abs()).fold(1.0, f64::min);
        assert!(off < 1e-9, "no row at {wanted}");
        let expected = ["`belt` is released, -1", "`belt` is held"][i % 2];
        assert_eq!(what, expected);
        wanted += [3.0 * PI / 20.0, 0.2][i % 2];
        count += 1;
    }
    assert_eq!(count, 14);
    assert!(told.contains("events: 14\n"));
    assert!(told.contains("  belt_mode   0\n"), "{told}");
    // Six points, and a row for each event.
    let table = fs::read_to_string(out.join("stick_slip.csv")).expect("a table");
    assert_eq!(rows(&table).len(), 20);
    // Friction dissipates the energy from the belt, except the final energy of the spring.
    assert!(told.contains("belt             1.45500              0        1.40960"));
}

#[test]
fn coarse_runs_are_warned_of() {
    let options = ["--method", "semi_implicit_euler", "--step", "0.1"];
    let (run, _) = block("simulate_coarse", SCENE, &options);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stderr.contains("the energy does not add up"));
    assert!(run.stderr.contains("a run with half the step differs"));
    let (run, _) = block("simulate_fine", SCENE, &[]);
    assert_eq!(run.stderr, "");
}

/// With ω h = 50 each step multiplies the motion by 50⁴/24.
#[test]
fn a_run_that_fails_keeps_what_there_is() {
    let options = ["--step", "10", "--end", "1000", "--points", "101"];
    let (run, table) = block("simulate_failing", SCENE, &options);
    assert!(run.stdout.contains("steps: 5"), "{}", run.stdout);
    let told = run.bad_input();
    assert!(told.contains("the run ends early at t = 5"), "{told}");
    assert!(told.contains("slide = "), "{told}");
    let rows = rows(&table);
    let last = rows.last().expect("a row");
    assert!(rows.len() > 50 && rows.len() < 70, "{}", rows.len());
    assert!(last.iter().all(|x| x.is_finite()) && last[1].abs() > 1e250);
}

#[test]
fn what_is_refused() {
    let refused: [(&[&str], &str); 12] = [
        (&["--method", "euler"], "there is no method `euler`"),
        (&["--tolerance", "1e-8"], "`rk4` does not go by a tolerance"),
        (&["--step", "0"], "greater than 0"),
        (
            &["--step", "-1"],
            "`--step -1`: write a number greater than 0",
        ),
        (&["--tolerance", "-1e-9"], "greater than 0"),
        (&["--end", "-2"], "greater than 0"),
        (&["--end", "inf"], "`--end inf`: "),
        (&["--end", "NaN"], "`--end NaN`: "),
        (&["--step", "1 kg"], "`--step 1 kg`: `1 kg` is a mass"),
        (&["--points", "1"], "the start and the end are 2"),
        (&["--step", "1e-12"], "take a longer step"),
        (&["--step", "1", "--tolerance", "1"], "cannot be used with"),
    ];
    for (i, (options, said)) in refused.iter().enumerate() {
        let (run, table) = block(&format!("simulate_refused_{i}"), SCENE, options);
        let told = run.bad_usage();
        assert!(told.contains(said), "{told}");
        assert_eq!(table, "");
    }
    let told = bgdyn(&["simulate", "specs/slider.yaml"]).bad_input();
    assert!(told.contains("is a mechanism"), "{told}");
    let told = bgdyn(&["simulate", "--help"]).good();
    assert!(told.contains("Example:"), "{told}");
}

/// A belt speeds up for a second, then turns back faster than its grip can follow.
#[test]
fn modes_are_resolved_where_a_table_bends() {
    let scene = "\
scene: 1
mechanism: block.yaml
effects: [grip: { type: coulomb, joint: slide, kinetic: 2 N, reference: belt }]
inputs: { belt_rate: { table: [[0 s, 0], [1 s, 0.5], [2 s, -1.5]] } }
integration: { method: rk4, step: 3 ms, end: 3 s }
";
    let (run, table) = block("corner", scene, &["--points", "4"]);
    run.good();
    let rows = rows(&table);
    assert!(rows.len() >= 4, "{rows:?}");
    for row in rows {
        // Carried for a second, then left behind: 2 kg under 2 N lose 1 m/s every second.
        let (t, late) = (row[0], (row[0] - 1.0).max(0.0));
        let place = 0.25 * (t - late) * (t - late) + 0.5 * late - 0.5 * late * late;
        assert!((row[1] - place).abs() < 1e-9, "{row:?}, not {place}");
    }
}

/// Friction of 2 N cannot hold 2 kg under a force of 6 N.
#[test]
fn friction_that_cannot_hold_lets_go_at_the_start() {
    let scene = "\
scene: 1
mechanism: block.yaml
effects: [grip: { type: coulomb, joint: slide, kinetic: 2 N }]
inputs: { slide: 6 N }
integration: { method: rk4, step: 1 ms, end: 1 s }
";
    let (run, table) = block("lets_go", scene, &["--points", "2"]);
    run.good();
    let rows = rows(&table);
    // (6 − 2) N on 2 kg for 1 s.
    assert!((rows[1][1] - 1.0).abs() < 1e-9, "{rows:?}");
}

/// A force of at most 1 N pulls 2 kg towards 1 m by a stiffness of 10 N/m: constant up to 0.9 m, then a part of an
/// oscillation. A step that averaged both sides of the limit would be off by 1e-6.
#[test]
fn a_step_ends_where_an_input_reaches_its_limit() {
    let scene = "\
scene: 1
mechanism: block.yaml
effects: [inertia]
inputs: { slide: { pd: { target: 1 m, stiffness: 10 }, limit: 1 N } }
integration: { method: rk4, step: 10 ms, end: 1.95 s }
";
    let (run, table) = block("limited", scene, &["--points", "2"]);
    let told = run.good();
    assert!(told.contains("drives"), "{told}");
    let rows = rows(&table);
    let (t, place) = (rows[1][0], rows[1][1]);
    let reached = (2.0 * 0.9 / 0.5_f64).sqrt();
    let (w, after) = (5.0_f64.sqrt(), t - reached);
    let wanted = 1.0 - 0.1 * (w * after).cos() + 0.5 * reached / w * (w * after).sin();
    assert!((place - wanted).abs() < 2e-10, "{place}, not {wanted}");
}

/// A controller that is sampled every 50 ms: between two samples the block moves under a constant force.
#[test]
fn a_sampled_controller_is_held_between_its_samples() {
    let scene = "\
scene: 1
mechanism: block.yaml
effects: [inertia]
inputs: { slide: { pd: { target: 1 m, stiffness: 10, damping: 3 } } }
control: { period: 50 ms, delay: 20 ms }
integration: { method: rk4, step: 7 ms, end: 1 s }
";
    let (run, table) = block("sampled", scene, &["--points", "101"]);
    run.good();
    let (mut q, mut v, mut effort, mut late) = (0.0, 0.0, 0.0, 0.0);
    let mut by_hand = vec![[q, v]];
    for point in 0..100 {
        // Samples are at 0, 50, 100, … ms and act at 20, 70, 120, … ms.
        if point % 5 == 0 {
            late = 10.0 * (1.0 - q) - 3.0 * v;
        }
        if point % 5 == 2 {
            effort = late;
        }
        let (h, a) = (0.01, effort / 2.0);
        q += h * v + 0.5 * h * h * a;
        v += h * a;
        by_hand.push([q, v]);
    }
    let rows = rows(&table);
    assert_eq!(rows.len(), by_hand.len());
    for (row, wanted) in rows.iter().zip(&by_hand) {
        let off = (row[1] - wanted[0]).abs().max((row[2] - wanted[1]).abs());
        assert!(off < 1e-9, "{row:?}, not {wanted:?}");
    }
}

/// The controller believes in 3 kg without a spring: 2 q̈ + 9 q̇ + (50 + 30) q = 30.
#[test]
fn a_controller_may_have_a_model_of_its_own() {
    scratch(
        "model",
        "heavy.yaml",
        BLOCK.replace("mass: 2 kg", "mass: 3 kg"),
    );
    let scene = "\
scene: 1
mechanism: block.yaml
effects: [inertia, rubber]
inputs: { slide: { computed_torque: { target: 1 m, stiffness: 10, damping: 3 } } }
controller_model: { mechanism: heavy.yaml, effects: [inertia] }
integration: { method: dop853, tolerance: 1e-12, end: 2 s }
";
    let (run, table) = block("model", scene, &["--points", "101"]);
    run.good();
    let (decay, frequency) = (2.25, (40.0_f64 - 2.25 * 2.25).sqrt());
    for row in rows(&table) {
        let t = row[0];
        let turned = (frequency * t).cos() + decay / frequency * (frequency * t).sin();
        let wanted = 0.375 * (1.0 - (-decay * t).exp() * turned);
        assert!((row[1] - wanted).abs() < 1e-9, "{row:?}, not {wanted:?}");
    }
}
