//! `bgdyn simulate` and `bgdyn eval` of scenes with joints of several degrees of freedom.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::{Run, bgdyn};

fn scene(name: &str) -> String {
    format!("tests/free_scenes/{name}.scene.yaml")
}

/// Simulates a scene for a short time into a folder of its own; returns the folder.
fn simulated(test: &str, name: &str, more: &[&str]) -> (PathBuf, Run) {
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let (file, folder) = (scene(name), out.display().to_string());
    let usual = [
        "simulate", &file, "--out", &folder, "--end", "0.05s", "--points", "11",
    ];
    (out, bgdyn(&[&usual, more].concat()))
}

/// Returns the error of a run that is refused.
fn refused(test: &str, name: &str, more: &[&str]) -> String {
    simulated(test, name, more).1.bad_input()
}

/// Returns the columns' names and the rows of a table.
fn table(folder: &Path, name: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let text = fs::read_to_string(folder.join(format!("{name}.csv"))).expect("a table");
    let mut lines = text.lines();
    let names = lines.next().expect("a head").split(',').map(str::to_owned);
    let row = |line: &str| {
        line.split(',')
            .map(|x| x.parse().expect("a number"))
            .collect()
    };
    (names.collect(), lines.map(row).collect())
}

#[test]
fn tables_have_positions_and_velocities_by_name() {
    let (folder, run) = simulated("free_table", "heavy_top_run", &[]);
    run.good();
    let (names, rows) = table(&folder, "heavy_top_run");
    let wanted = [
        "t [s]",
        "ball_qx [1]",
        "ball_qy [1]",
        "ball_qz [1]",
        "ball_qw [1]",
        "ball_rx_velocity [rad/s]",
        "ball_ry_velocity [rad/s]",
        "ball_rz_velocity [rad/s]",
    ];
    assert_eq!(names, wanted);
    assert_eq!(rows.len(), 11);
    for row in rows {
        let square: f64 = row[1..5].iter().map(|x| x * x).sum();
        assert!((square - 1.0).abs() < 1e-15, "t = {}: {square}", row[0]);
    }
}

/// Points between the steps of a method with long steps are unit quaternions too.
#[test]
fn points_between_steps_are_orientations() {
    let more = ["--method", "dop853", "--tolerance", "1e-5"];
    let (folder, run) = simulated("free_dense", "heavy_top_run", &more);
    run.good();
    for row in table(&folder, "heavy_top_run").1 {
        let square: f64 = row[1..5].iter().map(|x| x * x).sum();
        assert!((square - 1.0).abs() < 1e-15, "t = {}: {square}", row[0]);
    }
}

#[test]
fn a_run_begins_in_a_pose() {
    let more = [
        "--initial",
        "free.xyz=1, 20 cm, 3",
        "--initial",
        "free.rpy=0, 0, 90 deg",
    ];
    let (folder, run) = simulated("free_pose", "disc_run", &more);
    run.good();
    let half = 0.5_f64.sqrt();
    let start = &table(&folder, "disc_run").1[0];
    assert_eq!(start[..8], [0.0, 1.0, 0.2, 3.0, 0.0, 0.0, half, half]);
    let error = refused("free_long", "disc_run", &["--initial", "free_qx=0.5"]);
    assert!(error.contains("`free` has the length 1.11803"), "{error}");
    let (_, few) = simulated("free_few", "disc_run", &["--initial", "free.rpy=0, 1"]);
    let error = few.bad_usage();
    assert!(error.contains("2 numbers: write 3"), "{error}");
}

#[test]
fn momenta_are_refused_by_name() {
    let method = ["--method", "canonical_gauss2"];
    let error = simulated("free_momenta", "buoy_run", &method).1.bad_usage();
    assert!(
        error.contains("`free`") && error.contains("use `gauss2`"),
        "{error}"
    );
    let error = bgdyn(&["generate", &scene("cart_run"), "--canonical"]).bad_usage();
    assert!(error.contains("Lie–Poisson"), "{error}");
}

/// The page has a body for each link that moves, followers and links inside universal joints included.
#[test]
fn the_page_has_every_moving_body() {
    for (name, kinds) in [
        ("buoy_run", &["floating", "revolute", "spherical"][..]),
        (
            "cart_run",
            &[
                "planar",
                "revolute",
                "revolute",
                "revolute",
                "prismatic",
                "prismatic",
                "revolute",
            ],
        ),
    ] {
        let (folder, run) = simulated(&format!("free_page_{name}"), name, &[]);
        run.good();
        let page = fs::read_to_string(folder.join(format!("{name}.html"))).expect("a page");
        let data = page
            .split("type=\"application/json\"")
            .nth(1)
            .and_then(|rest| rest.split_once('>'))
            .and_then(|(_, rest)| rest.split("</script>").next());
        let data: Value = serde_json::from_str(data.expect("data")).expect("JSON");
        let bodies = data["bodies"].as_array().expect("bodies");
        let found: Vec<&str> = bodies
            .iter()
            .filter_map(|body| body["joint"]["type"].as_str())
            .collect();
        assert_eq!(found, kinds);
        for body in &bodies[1..] {
            let turns = body["turn"].as_array().expect("orientations");
            assert_eq!(turns.len() % 4, 0);
            let first = turns[..4]
                .iter()
                .map(|x| x.as_f64().expect("a number") / 1e5);
            let square: f64 = first.map(|x| x * x).sum();
            assert!((square - 1.0).abs() < 1e-4, "{name}: {}", body["name"]);
        }
    }
}

/// Rates, and the length of quaternions in states.
#[test]
fn functions_of_a_scene_take_unit_quaternions() {
    let states = Path::new(env!("CARGO_TARGET_TMPDIR")).join("free_states.json");
    let text = r#"{ "states": [
        { "y": { "ball_qx": 0.6, "ball_qw": 0.8, "ball_rx_velocity": 2, "ball_ry_velocity": 0 } },
        { "y": { "ball_qx": 0.6, "ball_qw": 0.9 } } ] }"#;
    fs::write(&states, text).expect("a file");
    let states = states.display().to_string();
    let run = bgdyn(&[
        "eval",
        &scene("heavy_top_run"),
        "derivative",
        "--states",
        &states,
    ]);
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let rates = report["results"][0].as_array().expect("rates");
    let wanted = [0.8, 0.0, 0.0, -0.6];
    for (found, wanted) in rates.iter().zip(wanted) {
        let off = (found.as_f64().expect("a number") - wanted).abs();
        assert!(off < 1e-15, "{rates:?}");
    }
    assert!(report["results"][1].is_null(), "{report}");
    let error = report["errors"].to_string();
    assert!(
        error.contains("`ball`") && error.contains("1.08"),
        "{error}"
    );
}
