//! Tests `bgdyn accuracy` without cargo.

use std::process::Command;

use bgdyn_accuracy::generate::variants;
use bgdyn_codegen::files::{beside, stem};
use bgdyn_codegen::read_scene;

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

/// Studies a scene without cargo; returns the rows with all effects that have an error.
fn studied(test: &str, scene: &str, end: &str) -> Vec<Vec<String>> {
    let csv = scratch(test, "accuracy.csv", "");
    let out = csv.trim_end_matches("/accuracy.csv");
    let done = without_cargo(&[scene, "--quick", "--end", end, "--out", out]);
    let errors = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{errors}");
    let text = std::fs::read_to_string(&csv).expect("a table");
    let rows = table_rows(&text).into_iter();
    rows.filter(|r| r[1] == "all" && r[8] == "estimated")
        .map(|r| r.iter().map(|field| field.to_string()).collect())
        .collect()
}

/// Returns the steps or tolerances of a method and its errors, as far as they fall.
fn errors_of(rows: &[Vec<String>], method: &str) -> Vec<(f64, f64)> {
    let number = |text: &str| {
        text.trim_end_matches(" s")
            .parse::<f64>()
            .expect("a number")
    };
    let rows = rows.iter().filter(|r| r[2] == method);
    let mut all: Vec<(f64, f64)> = rows.map(|r| (number(&r[3]), number(&r[6]))).collect();
    // The scene's own step, at the end, is no part of the sequence; errors at rounding have no order.
    let halved = all.windows(2).take_while(|w| w[1].0 < 0.6 * w[0].0);
    all.truncate(halved.count() + 1);
    all.retain(|(_, error)| *error > 1e-11);
    all
}

/// Returns the order of a method over its last steps.
fn order_of(rows: &[Vec<String>], method: &str) -> f64 {
    let all = errors_of(rows, method);
    let last = &all[all.len().saturating_sub(4)..];
    let (first, last) = (last[0], last[last.len() - 1]);
    (first.1 / last.1).ln() / (first.0 / last.0).ln()
}

/// Checks the orders of some methods at an output of a body that tumbles and falls.
fn check_tumbling(test: &str, output: &str) {
    let body = "format: 1\nname: body\nlinks:\n  - name: body\n    joint: { name: free, type: floating }\n    mass: 2\n    com: [0.1, 0, 0]\n    inertia: { xx: 0.1, yy: 0.2, zz: 0.25 }\nframes:\n  - { name: tip, link: body, origin: { xyz: [0.3, 0.1, 0] } }\n";
    scratch(test, "body.yaml", body);
    let scene = format!(
        "scene: 1\nmechanism: body.yaml\neffects: [inertia, velocity_products, gravity]\ninitial: {{ free_rx_velocity: 3, free_ry_velocity: 2 }}\noutputs: [{output}]\n"
    );
    let scene = scratch(test, "tumble.scene.yaml", scene);
    let rows = studied(test, &scene, "2");
    for (method, order) in [
        ("semi_implicit_euler", 1.0),
        ("midpoint", 2.0),
        ("rk4", 4.0),
        ("gauss2", 4.0),
    ] {
        let found = order_of(&rows, method);
        assert!((found - order).abs() < 0.3, "{output}, {method}: {found}");
    }
    assert!(errors_of(&rows, "dop853").last().expect("errors").1 < 1e-7);
    assert!(!rows.iter().any(|r| r[2].starts_with("canonical")));
}

#[test]
fn sites_of_free_bodies_have_the_orders_of_the_methods() {
    check_tumbling("accuracy_free_tip", "tip");
}

/// A quaternion is continuous along a run: errors of its components are differences.
#[test]
fn quaternions_have_the_orders_of_the_methods() {
    check_tumbling("accuracy_free_quaternion", "free_qy");
}

/// A ball that bounces: an impact is anywhere in a step of `moreau`, and the others end their steps there. Between impacts
/// they follow its parabolas exactly.
#[test]
fn bouncing_is_of_order_one_in_steps_and_exact_from_event_to_event() {
    let rows = studied(
        "accuracy_bounces",
        "tests/rigid_contact/bounces.scene.yaml",
        "1.5",
    );
    let stepped = order_of(&rows, "moreau");
    assert!((0.7..1.5).contains(&stepped), "{stepped}");
    for method in ["rk4", "gauss2", "rodas4", "dopri5", "dop853"] {
        let errors: Vec<&String> = rows
            .iter()
            .filter(|r| r[2] == method)
            .map(|r| &r[6])
            .collect();
        assert!(!errors.is_empty(), "{method} has no rows");
        for error in errors {
            let error: f64 = error.parse().expect("an error");
            assert!(error < 1e-12, "{method}: {error}");
        }
    }
}

/// A disc that rolls with a constant acceleration: steps are exact, and agree with the reference from event to event. Others
/// have velocities along axes of the disc, so that J̇ v is not 0, and the errors of their orders.
#[test]
fn rolling_is_exact_in_steps() {
    let rows = studied(
        "accuracy_rolls",
        "tests/rigid_contact/rolls.scene.yaml",
        "0.5",
    );
    let stepped = rows.iter().filter(|r| r[2] == "moreau").map(|r| &r[6]);
    let stepped: Vec<f64> = stepped
        .map(|error| error.parse().expect("an error"))
        .collect();
    assert!(
        stepped.len() > 1 && stepped.iter().all(|error| *error < 1e-13),
        "{stepped:?}"
    );
    for (method, order) in [("midpoint", 2.0), ("rk4", 4.0)] {
        let found = order_of(&rows, method);
        assert!((found - order).abs() < 0.3, "{method}: {found}");
    }
}

/// A leg on a spring that takes off and lands: from event to event each method keeps its own order.
#[test]
fn from_event_to_event_methods_keep_their_orders() {
    let rows = studied(
        "accuracy_hopper",
        "specs/contact/hopper_hops.scene.yaml",
        "0.5",
    );
    for (method, order) in [("midpoint", 2.0), ("rk4", 4.0), ("gauss2", 4.0)] {
        let found = order_of(&rows, method);
        assert!((found - order).abs() < 0.3, "{method}: {found}");
    }
    for method in ["dopri5", "dop853", "rodas4"] {
        let last = errors_of(&rows, method).pop();
        assert!(last.is_none_or(|(_, error)| error < 1e-7), "{method}");
    }
}

/// The program that is compiled runs each scene with rigid contacts from event to event, but for `moreau`, and no scene in
/// momenta that it does not have.
#[test]
fn compiled_studies_go_from_event_to_event_where_they_have_to() {
    let calls = |file: &str| {
        let path = root().join(file);
        let text = |path: &std::path::Path| std::fs::read_to_string(path).expect("a file");
        let load = |mechanism: &str| Ok(text(&beside(&path, mechanism)));
        let read = read_scene(&text(&path), &stem(&path), load);
        let system = read.unwrap_or_else(|_| panic!("{file} is refused")).0;
        variants(&system, None)
    };
    let hopper = calls("specs/contact/hopper_hops.scene.yaml").expect("a module");
    let has = |text: &str, call: &str, scheme: &str| {
        let mut lines = text.lines().filter(|line| line.contains(call));
        let scheme = format!("bgdyn_accuracy::{scheme}");
        let line = lines.next().unwrap_or_else(|| panic!("no {call}"));
        assert!(line.contains(&scheme), "{line}");
    };
    for call in [
        "methods(all::",
        "single(all::",
        "reference(all::",
        "formulation(\"recursion\"",
        "price(\"all\"",
    ] {
        has(&hopper, call, "ByEvents");
    }
    has(&hopper, "price(\"all but contact\"", "AsItIs");
    // The scene's own integrator is `moreau`.
    has(&hopper, "ablation_with_slope(\"all\"", "AsItIs");
    assert!(!hopper.contains("momenta("));
    let top = calls("tests/free_scenes/heavy_top_run.scene.yaml").expect("a module");
    has(&top, "methods(all::", "AsItIs");
    assert!(!top.contains("momenta("));
    let pendulum = calls("specs/scenes/stick_slip.scene.yaml").expect("a module");
    assert!(pendulum.contains("test_case.momenta(all::") && !pendulum.contains("ByEvents"));
    let quadruped = calls("specs/contact/quadruped_rigid.scene.yaml");
    assert!(quadruped.is_err_and(|why| why.contains("12 rigid contacts")));
}

#[test]
fn what_has_no_reference_is_refused() {
    for (scene, number) in [("quadruped_rigid", 12), ("gripper_lifts", 24)] {
        let scene = format!("specs/contact/{scene}.scene.yaml");
        let errors = bgdyn(&["accuracy", &scene]).bad_input();
        let told = format!("has {number} rigid contacts");
        assert!(
            errors.contains(&told) && errors.contains("at most 8") && errors.contains("use `comp"),
            "{errors}"
        );
    }
    // A disc that turns where it is.
    let disc = "tests/free_scenes/disc_run.scene.yaml";
    let out = scratch("accuracy_still", "accuracy.csv", "");
    let out = out.trim_end_matches("/accuracy.csv");
    let done = without_cargo(&[disc, "--quick", "--end", "0.5", "--out", out]);
    let errors = String::from_utf8_lossy(&done.stderr);
    assert_eq!(done.status.code(), Some(1), "{errors}");
    assert!(errors.contains("`free_x` does not move"), "{errors}");
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
