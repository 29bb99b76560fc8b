//! Tests overrides of runs of `bgdyn simulate`, and batches.

use std::fs;
use std::path::PathBuf;

use crate::{Run, bgdyn, scratch, table_rows};

const BLOCK: &str = "\
format: 1
links:
  - name: block
    joint: { name: slide, type: prismatic, axis: x }
    mass: { parameter: block_mass, value: 2 kg }
effects:
  rubber: { type: spring, joint: slide, stiffness: 50 N/m }
";

/// With ω = √(50 N/m / m) the position is x₀ cos ω t.
const SCENE: &str = "\
scene: 1
mechanism: block.yaml
effects: [inertia, rubber]
initial: { slide: 0.1 m }
integration: { method: rk4, step: 5 ms, end: 1 s }
";

/// A run, with a file of its folder.
fn block(test: &str, options: &[&str], file: &str) -> (Run, String) {
    scratch(test, "block.yaml", BLOCK);
    let scene = scratch(test, "swing.scene.yaml", SCENE);
    let out: PathBuf = [env!("CARGO_TARGET_TMPDIR"), test, "out"].iter().collect();
    let folder = out.display().to_string();
    let run = bgdyn(&[&["simulate", scene.as_str(), "--out", &folder], options].concat());
    (run, fs::read_to_string(out.join(file)).unwrap_or_default())
}

fn swing(mass: f64, x: f64) -> f64 {
    x * (50.0 / mass).sqrt().cos()
}

fn close(text: &str, wanted: f64) {
    let found: f64 = text.parse().expect("a number");
    assert!((found - wanted).abs() < 1e-7, "{found}, not {wanted}");
}

#[test]
fn parameters_and_the_start_are_set_by_name() {
    let options = [
        "--parameter",
        "block_mass=3",
        "--initial",
        "slide=-0.2",
        "--points",
        "2",
    ];
    let (run, table) = block("many_set", &options, "swing.csv");
    run.good();
    let rows = table_rows(&table);
    close(&rows[rows.len() - 1][1], swing(3.0, -0.2));
}

#[test]
fn names_and_values_that_are_not_there_are_told() {
    let cases: [(&[&str], &str); 9] = [
        (
            &["--parameter", "blockmass=3"],
            "did you mean `block_mass`?",
        ),
        (&["--parameter", "zz=3"], "there are block_mass"),
        (&["--parameter", "block_mass"], "write NAME=VALUE"),
        (&["--initial", "slide_rat=1"], "did you mean `slide_rate`?"),
        (&["--initial", "slide=inf"], "`--initial slide=inf`: "),
        (
            &["--initial", "slide=1", "--initial", "slide=2"],
            "set twice",
        ),
        (&["--sweep", "slide=0:1"], "write NAME=FROM:TO:N"),
        (
            &["--sweep", "slide=0:1:3", "--sweep", "slide=0:1:3"],
            "varied twice",
        ),
        (
            &["--sweep", "slide=0:1:3", "--initial", "slide=1"],
            "varied as well",
        ),
    ];
    for (i, (options, told)) in cases.into_iter().enumerate() {
        let (run, _) = block(&format!("many_wrong_{i}"), options, "swing.csv");
        assert_eq!(run.code, Some(2), "{options:?}");
        assert!(run.stderr.contains(told), "{}", run.stderr);
    }
}

#[test]
fn a_grid_runs_the_same_by_any_number_of_threads() {
    let grid = ["--sweep", "slide=0.1:0.2:3", "--sweep", "block_mass=1:4:4"];
    let tables = ["1", "2", "3"].map(|threads| {
        let options = [&grid[..], &["--threads", threads]].concat();
        let (run, table) = block(&format!("many_grid_{threads}"), &options, "swing_batch.csv");
        let told = run.good();
        assert!(told.contains("(12 runs)"), "{told}");
        table
    });
    assert_eq!(tables[0], tables[1]);
    assert_eq!(tables[0], tables[2]);
    assert!(tables[0].starts_with("run,slide [m],block_mass [kg],slide end [m],slide min [m]"));
    let rows = table_rows(&tables[0]);
    assert_eq!(rows.len(), 12);
    for (i, row) in rows.iter().enumerate() {
        let (x, mass) = (0.1 + 0.05 * (i / 4) as f64, 1.0 + (i % 4) as f64);
        close(&row[1], x);
        close(&row[2], mass);
        close(&row[3], swing(mass, x));
        assert_eq!(row[11], "ok");
    }
}

#[test]
fn a_table_of_runs_keeps_those_that_fail() {
    let table = scratch(
        "many_table",
        "runs.csv",
        "block_mass [kg],slide\n# no mass, no acceleration\n\"2\",0.1\n0,0.1\n\n1,\"0.3 m\"\n",
    );
    let (run, found) = block("many_table", &["--batch", &table], "swing_batch.csv");
    assert_eq!(run.code, Some(1));
    assert!(run.stderr.contains("1 of 3 runs failed"), "{}", run.stderr);
    assert!(
        run.stdout
            .contains("run 2, block_mass = 0 kg, slide = 0.1 m: "),
        "{}",
        run.stdout
    );
    let rows = table_rows(&found);
    let statuses: Vec<&str> = rows.iter().map(|row| row[11].as_str()).collect();
    assert_eq!(statuses, ["ok", "failed", "ok"]);
    close(&rows[2][3], swing(1.0, 0.3));
    let wrong = scratch("many_table", "wrong.csv", "slide\n0.1\n0.1,2\n");
    let (run, _) = block("many_table", &["--batch", &wrong], "swing_batch.csv");
    let told = run.bad_input();
    assert!(
        told.contains("wrong.csv:3: 2 values for 1 quantities"),
        "{told}"
    );
}

#[test]
fn chance_is_the_seeds() {
    let of = |test: &str, seed: &str| {
        let options = ["--random", "slide=-1:1", "--runs", "5", "--seed", seed];
        let (run, table) = block(test, &options, "swing_batch.csv");
        run.good();
        table
    };
    let first = of("many_chance_1", "7");
    assert_eq!(first, of("many_chance_2", "7"));
    assert_ne!(first, of("many_chance_3", "8"));
    for row in table_rows(&first) {
        let x: f64 = row[1].parse().unwrap();
        assert!((-1.0..1.0).contains(&x));
        close(&row[2], swing(2.0, x));
    }
}

/// Each run of a batch decides for itself what sticks at its start: the spring pulls with 1 N or 5 N, friction
/// holds 2 N.
#[test]
fn every_run_of_a_batch_resolves_stiction_at_its_start() {
    scratch("many_start", "block.yaml", BLOCK);
    let scene = "\
scene: 1
mechanism: block.yaml
effects: [inertia, grip: { type: coulomb, joint: slide, kinetic: 2 N }, rubber]
integration: { method: rk4, step: 1 ms, end: 0.1 s }
outputs: [slide]
";
    let scene = scratch("many_start", "swing.scene.yaml", scene);
    let out: PathBuf = [env!("CARGO_TARGET_TMPDIR"), "many_start", "out"]
        .iter()
        .collect();
    let folder = out.display().to_string();
    let sweep = [
        "simulate",
        &scene,
        "--out",
        &folder,
        "--sweep",
        "slide=0.02:0.1:2",
    ];
    bgdyn(&sweep).good();
    let table = fs::read_to_string(out.join("swing_batch.csv")).expect("a table");
    let rows = table_rows(&table);
    close(&rows[0][2], 0.02);
    // About x = 2 N / 50 N/m, with ω = 5 rad/s.
    close(&rows[1][2], 0.04 + 0.06 * 0.5_f64.cos());
}
