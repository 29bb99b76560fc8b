//! Tests `bgdyn accuracy` without cargo.

use std::process::Command;

use super::{bgdyn, root, scratch, table_rows};

/// Runs the command without cargo.
fn without_cargo(arguments: &[&str]) -> std::process::Output {
    Command::new(env!("CARGO_BIN_EXE_bgdyn"))
        .arg("accuracy")
        .args(arguments)
        .env("CARGO", "/nonexistent")
        .env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR"))
        .current_dir(root())
        .output()
        .expect("the command starts")
}

#[test]
fn times_without_cargo_are_marked_as_estimates() {
    let csv = scratch("accuracy_estimates", "accuracy.csv", "");
    let out = csv.trim_end_matches("/accuracy.csv");
    let scene = "specs/scenes/stick_slip.scene.yaml";
    let done = without_cargo(&[scene, "--quick", "--end", "0.5", "--out", out]);
    let errors = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{errors}");
    assert!(errors.contains("times are estimated from operations: cargo cannot be run"));

    let text = std::fs::read_to_string(&csv).expect("a table");
    assert_eq!(
        text.lines().next(),
        Some(
            "scene,effects,method,step_or_tol,scalar,formulation,error,ns_per_simulated_ms,status"
        )
    );
    let rows = table_rows(&text);
    assert!(rows.len() > 20, "{text}");
    assert!(rows.iter().all(|r| r[8] != "ok"), "{text}");
    let held: Vec<_> = rows.iter().filter(|r| r[8] == "estimated").collect();
    assert!(held.len() > 20, "{text}");
    // Errors are those of the evaluator: they decrease with the step.
    let errors = held.iter().filter(|r| r[1] == "all" && r[2] == "rk4");
    let errors: Vec<f64> = errors.map(|r| r[6].parse().expect("an error")).collect();
    assert!(errors[2] < 0.2 * errors[0], "{errors:?}");
    assert!(text.contains("all but springs"), "{text}");
    // The cost of all effects, and without each.
    let costs = std::fs::read_to_string(format!("{out}/costs.csv")).expect("a table");
    let costs = table_rows(&costs);
    assert_eq!(costs[0][1], "all");
    assert!(costs.iter().any(|c| c[1] == "all but springs"), "{costs:?}");
    let numbers = |k: usize| {
        costs
            .iter()
            .map(move |c| c[k].parse::<f64>().expect("a number"))
    };
    let (operations, steps) = (numbers(2), numbers(7));
    let all: Vec<f64> = operations.collect();
    // The scene without an effect never has more operations, and every scene takes steps.
    assert!(all.iter().all(|n| *n >= 0.0 && *n <= all[0]), "{all:?}");
    assert!(
        numbers(3).all(|ns| ns >= 0.0) && steps.into_iter().all(|n| n >= 1.0),
        "{costs:?}"
    );
    let page = std::fs::read_to_string(format!("{out}/report.html")).expect("a page");
    assert!(page.contains("Times are estimates"));
}

#[test]
fn what_is_no_scene_is_refused() {
    let errors = bgdyn(&["accuracy", "specs/scara.yaml"]).bad_input();
    assert!(errors.contains("is a mechanism"), "{errors}");
    let errors = bgdyn(&[
        "accuracy",
        "specs/scenes/stick_slip.scene.yaml",
        "--end",
        "0",
    ]);
    assert!(errors.bad_usage().contains("greater than 0"));
}
