//! `bgdyn excite`: files, faults, and logs of its motions.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::identify_logs::{arm, csv, files, log_of_states, text, truth};
use crate::{bgdyn, scratch, table_rows};

/// A search that is short enough for a test.
const SHORT: [&str; 6] = ["--starts", "6", "--ascents", "1", "--steps", "12"];

/// Logarithm of the deviation of a parameter that is not seen: larger than any of those that are.
const UNSEEN: f64 = 9.0;

/// Plans a motion into a folder of this name; returns the folder and the JSON.
pub(crate) fn planned(name: &str, spec: &str, more: &[&str]) -> (PathBuf, Value) {
    let folder: PathBuf = [env!("CARGO_TARGET_TMPDIR"), name].iter().collect();
    let _ = fs::remove_dir_all(&folder);
    let out = text(&folder);
    let search: &[&str] = if more.contains(&"--starts") {
        &[]
    } else {
        &SHORT
    };
    let run = bgdyn(&[&["excite", spec, "-o", &out, "--json"], search, more].concat());
    let json = serde_json::from_str(&run.good()).expect("JSON");
    (folder, json)
}

fn number(of: &Value) -> f64 {
    of.as_f64().expect("a number")
}

/// Checks and runs the scene of a motion; returns the largest distance of the run from the plan.
fn run_of(folder: &Path, stem: &str, names: &[&str], more: &[&str]) -> f64 {
    let path = |name: &str| text(&folder.join(name));
    let scene = path(&format!("{stem}_motion.scene.yaml"));
    bgdyn(&["check", &scene]).good();
    let shorter = ["--points", "101"];
    let out = path("run");
    bgdyn(&[&["simulate", &scene, "--out", &out], &shorter[..], more].concat()).good();
    let read = |name: String| fs::read_to_string(folder.join(name)).expect("a table");
    let run = read(format!("run/{stem}_motion.csv"));
    let plan = read(format!("{stem}_motion.csv"));
    let plan = plan.split_once('\n').expect("a remark").1;
    let header: Vec<&str> = plan.lines().next().expect("names").split(',').collect();
    let plan = table_rows(plan);
    let rows = table_rows(&run);
    let mut most = 0.0_f64;
    for row in rows.iter().take(100) {
        let t: f64 = row[0].parse().expect("a time");
        // 500 rows a second.
        let at = &plan[(t * 500.0).round() as usize];
        for (j, name) in names.iter().enumerate() {
            let column = header.iter().position(|h| *h == format!("q_{name}"));
            let planned: f64 = at[column.expect("the column")].parse().expect("a position");
            let ran: f64 = row[1 + j].parse().expect("a position");
            most = most.max((planned - ran).abs());
        }
    }
    most
}

#[test]
fn the_panda_gets_a_motion_that_runs() {
    let more = ["--rotors", "--keep", "tool.z>0.1 m"];
    let (folder, found) = planned("excite_panda", "specs/panda.yaml", &more);
    for name in ["csv", "json", "scene.yaml", "html"] {
        assert!(
            folder.join(format!("panda_motion.{name}")).exists(),
            "{name}"
        );
    }
    assert_eq!(found["base"].as_array().expect("names").len(), 69);
    assert_eq!(found["margin"], 0.08);
    assert_eq!(
        (&found["weak"], &found["remarks"]),
        (&Value::Null, &serde_json::json!([]))
    );
    let stage = |of: &str| number(&found[of]["log_det"]);
    assert!(stage("first") < stage("best_start") && stage("best_start") < stage("motion"));
    assert!(number(&found["motion"]["condition"]) < number(&found["first"]["condition"]));
    assert!(number(&found["keep"][0]["distance"]) > 0.0);
    for joint in found["joints"].as_array().expect("joints") {
        for what in ["position", "speed", "acceleration", "effort"] {
            let used = number(&joint["used"][what]);
            assert!(used > 0.0 && used <= 1.0, "{joint}");
        }
    }
    let names = [
        "joint1", "joint2", "joint3", "joint4", "joint5", "joint6", "joint7",
    ];
    let off = run_of(&folder, "panda", &names, &["--step", "4 ms"]);
    assert!(off < 1e-5, "the run leaves the plan by {off}");
    let page = fs::read_to_string(folder.join("panda_motion.html")).expect("the page");
    assert!(page.contains("\"nearest\"") && page.contains("default-src 'none'"));
    assert!(!page.contains("src=") && !page.contains("url(") && !page.contains("@NAME@"));
    // The plan is not taken for a log.
    let plan = text(&folder.join("panda_motion.csv"));
    let told = bgdyn(&["identify", "specs/panda.yaml", &plan]).bad_input();
    assert!(
        told.contains("[missing-column]") && told.contains("predicted_tau_joint1"),
        "{told}"
    );
}

#[test]
fn a_slide_runs_and_a_seed_gives_the_same_bytes() {
    let more = ["--keep", "tool.z>0.02 m", "--seed", "3"];
    let (first, _) = planned("excite_scara", "specs/scara.yaml", &more);
    let (second, _) = planned("excite_scara_again", "specs/scara.yaml", &more);
    for name in ["csv", "json", "scene.yaml", "html"] {
        let read =
            |folder: &Path| fs::read(folder.join(format!("scara_motion.{name}"))).expect("a file");
        assert!(read(&first) == read(&second), "{name}");
    }
    let table = fs::read_to_string(first.join("scara_motion.csv")).expect("the table");
    assert!(table.contains(",0.000000000") && !table.contains("-0.000000000"));
    let off = run_of(
        &first,
        "scara",
        &["shoulder", "elbow", "stroke", "turn"],
        &[],
    );
    assert!(off < 1e-5, "the run leaves the plan by {off}");
}

/// Logs a motion on the true arm, and identifies the arm from it; returns condition and parameters that are seen.
fn identified(name: &str, motion: &Value) -> (f64, usize, f64) {
    let frequency = number(&motion["frequency"]);
    let series = |joint: &Value, t: f64| -> [f64; 3] {
        let list = |key: &str| joint[key].as_array().expect("numbers").clone();
        let terms = list("sine").into_iter().zip(list("cosine")).enumerate();
        terms.fold(
            [number(&joint["centre"]), 0.0, 0.0],
            |[q, v, a], (k, (s, c))| {
                let w = frequency * (k + 1) as f64;
                let (s, c, (sine, cosine)) = (number(&s), number(&c), (w * t).sin_cos());
                [
                    q + (s * sine - c * cosine) / w,
                    v + s * cosine + c * sine,
                    a + w * (c * cosine - s * sine),
                ]
            },
        )
    };
    let joints = motion["joints"].as_array().expect("joints").clone();
    let log = log_of_states(&truth(), name, 20.0, &|j, t| series(&joints[j], t));
    let folder = files(name, &arm(1.0), &[("log.csv", csv(&log))]);
    let path = |name: &str| text(&folder.join(name));
    let more = ["--rotors", "--cut", "10 Hz", "--json"];
    let run = bgdyn(
        &[
            &["identify", &path("arm.yaml"), &path("log.csv")],
            &more[..],
        ]
        .concat(),
    );
    let found: Value = serde_json::from_str(&run.good()).expect("JSON");
    let base = found["base"].as_array().expect("base");
    let seen = base.iter().filter(|p| p["seen"] == true).count();
    let deviations = base
        .iter()
        .map(|p| p["deviation"].as_f64().map_or(UNSEEN, f64::ln));
    let mean = deviations.sum::<f64>() / base.len() as f64;
    (number(&found["condition"]), seen, mean.exp())
}

#[test]
fn a_log_of_the_motion_identifies_better_than_one_of_a_random_motion() {
    let spec = scratch("excite_arm_spec", "arm.yaml", arm(1.0));
    let (_, random) = planned(
        "excite_arm_random",
        &spec,
        &["--rotors", "--starts", "1", "--steps", "0"],
    );
    let (_, motion) = planned(
        "excite_arm",
        &spec,
        &["--rotors", "--starts", "30", "--steps", "90"],
    );
    let (random, motion) = (
        identified("excite_log_random", &random),
        identified("excite_log", &motion),
    );
    assert!(
        motion.0 < 0.7 * random.0,
        "condition {} for {}",
        motion.0,
        random.0
    );
    assert!(
        motion.1 >= random.1,
        "{} are seen for {}",
        motion.1,
        random.1
    );
    assert!(
        motion.2 < random.2,
        "deviations {} for {}",
        motion.2,
        random.2
    );
}

#[test]
fn a_period_that_one_log_showed_counts() {
    let spec = scratch("excite_prior_spec", "arm.yaml", arm(1.0));
    let log = csv(&crate::identify_logs::simulated(&truth(), 6, 12.0));
    let log = scratch("excite_prior_spec", "log.csv", log);
    let random = ["--starts", "1", "--steps", "0"];
    let (_, alone) = planned("excite_alone", &spec, &random);
    let (_, after) = planned(
        "excite_after",
        &spec,
        &[&random[..], &["--prior", &log]].concat(),
    );
    assert_eq!(alone["joints"][0]["sine"], after["joints"][0]["sine"]);
    let condition = |of: &Value| number(&of["motion"]["condition"]);
    let gap = fs::read_to_string(&log).expect("the log");
    let gap: Vec<&str> = gap
        .lines()
        .enumerate()
        .filter(|(i, _)| !(300..400).contains(i))
        .map(|(_, l)| l)
        .collect();
    let gap = scratch("excite_prior_spec", "gap.csv", gap.join("\n"));
    let told = bgdyn(&["excite", &spec, "--prior", &gap]).bad_input();
    assert!(
        told.contains("gap.csv:301:1:") && told.contains("[gap]"),
        "{told}"
    );
    assert!(condition(&after) < condition(&alone));
}
