//! The option `--engine`: the numbers do not depend on it, and the command says what computed them.

use std::fs;

use crate::{bgdyn, scratch};

const STICK_SLIP: &str = "specs/scenes/stick_slip.scene.yaml";

/// Returns whether this command makes machine code here; says why if not.
fn has_machine_code() -> bool {
    let states = scratch("engines_asked", "states.json", r#"{"states": []}"#);
    let arguments = ["eval", "specs/scara.yaml", "gravity", "--states", &states];
    let run = bgdyn(&[&arguments[..], &["--engine", "jit"]].concat());
    if run.code != Some(0) {
        assert!(run.stderr.contains("no machine code: "), "{}", run.stderr);
        println!("{}", run.stderr);
    }
    run.code == Some(0)
}

/// Runs the scene by an engine; returns the table, and what is printed.
fn simulated(engine: &str) -> (String, String) {
    let out = format!("{}/engines_{engine}", env!("CARGO_TARGET_TMPDIR"));
    let options = ["--engine", engine, "--end", "2 s", "--out", &out];
    let run = bgdyn(&[&["simulate", STICK_SLIP], &options[..]].concat());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let table = fs::read_to_string(format!("{out}/stick_slip.csv")).expect("a table");
    (table, run.stdout)
}

#[test]
fn a_run_has_the_same_digits_by_every_engine() {
    let (tape, told) = simulated("tape");
    assert!(told.contains(", by tape\n"), "{told}");
    assert!(tape.lines().count() > 1000, "{tape}");
    let (table, told) = simulated("auto");
    assert_eq!(table, tape);
    if has_machine_code() {
        // The start and the balance of energy call some functions a few times only.
        assert!(told.contains(", by machine code ("), "{told}");
        assert!(told.contains(") and tape ("), "{told}");
        let (table, told) = simulated("jit");
        assert_eq!(table, tape);
        assert!(told.contains(", by machine code\n"), "{told}");
    }
}

#[test]
fn a_batch_names_its_engine() {
    let out = format!("{}/engines_batch", env!("CARGO_TARGET_TMPDIR"));
    let sweep = ["--sweep", "slide=0:0.1:3", "--end", "0.1"];
    let run = |engine: &str| {
        let arguments = ["simulate", STICK_SLIP, "--out", &out, "--engine", engine];
        let run = bgdyn(&[&arguments[..], &sweep].concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let table = fs::read_to_string(format!("{out}/stick_slip_batch.csv"));
        (table.expect("a table"), run.stdout)
    };
    let (tape, told) = run("tape");
    assert!(told.ends_with("computed by tape\n"), "{told}");
    let (table, told) = run("auto");
    assert_eq!(table, tape);
    assert!(told.contains("\ncomputed by "), "{told}");
}

/// Few states are computed by the tape, which starts at once; nothing is said of it unless somebody asks.
#[test]
fn values_are_the_same_by_every_engine() {
    let states = r#"{"states": [{"q": [0.1, -2.0, 0.3, 7.0], "v": [1, 2, 3, 4], "tau_in": [1, 2, 3, 4]},
        {"q": [1e7, 0, 0, 0], "v": [1, 2, 3, 4], "tau_in": [1, 2, 3, 4]}]}"#;
    let states = scratch("engines_eval", "states.json", states);
    let by = |options: &[&str]| {
        let arguments = [
            "eval",
            "specs/scara.yaml",
            "forward_dynamics",
            "--states",
            &states,
        ];
        let run = bgdyn(&[&arguments[..], options].concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        (run.stdout, run.stderr)
    };
    let (usual, told) = by(&[]);
    assert_eq!(told, "");
    let (tape, told) = by(&["--engine", "tape"]);
    assert_eq!(
        (tape.as_str(), told.as_str()),
        (usual.as_str(), "bgdyn: computed by tape\n")
    );
    if has_machine_code() {
        let (code, told) = by(&["--engine", "jit"]);
        assert_eq!(
            (code, told.as_str()),
            (usual, "bgdyn: computed by machine code\n")
        );
    }
}

#[test]
fn an_unknown_engine_is_bad_usage() {
    let told = bgdyn(&["simulate", STICK_SLIP, "--engine", "fast"]).bad_usage();
    assert!(told.contains("'fast'"), "{told}");
}
