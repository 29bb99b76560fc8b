//! `bgdyn identify` on logs of known truth ([`crate::identify_logs`]).

use std::fs;

use serde_json::Value;

use crate::bgdyn;
use crate::identify_logs::{arm, csv, files, header, simulated, text, true_numbers, truth};

#[test]
fn a_log_gives_back_its_truth() {
    let (train, test) = (
        csv(&simulated(&truth(), 1, 20.0)),
        csv(&simulated(&truth(), 2, 10.0)),
    );
    let folder = files(
        "identify",
        &arm(1.0),
        &[("train.csv", train), ("test.csv", test)],
    );
    let path = |name: &str| text(&folder.join(name));
    let run = bgdyn(&[
        "identify",
        &path("arm.yaml"),
        &path("train.csv"),
        "--test",
        &path("test.csv"),
        "--rotors",
        "--json",
        "-o",
        &path("found.yaml"),
        "--report",
        &path("report"),
    ]);
    let found: Value = serde_json::from_str(&run.good()).expect("JSON");
    // Efforts of the other motion: the file is wrong, what is found leaves the noise.
    for joint in found["joints"].as_array().expect("joints") {
        let rms = |of: &str| joint["rms"][of].as_f64().expect("a number");
        assert!(rms("file") > 0.5 && rms("bodies") < 0.1, "{joint}");
        assert!(
            joint["by_velocity"].as_f64().expect("a share") < 0.3,
            "{joint}"
        );
        assert!(joint["sticking"].is_null(), "{joint}");
    }
    // Base parameters: K of the truth within the deviations.
    let numbers = true_numbers(&found["base_map"]["columns"]);
    let off = found["base"]
        .as_array()
        .expect("base")
        .iter()
        .zip(found["base_map"]["rows"].as_array().expect("rows"));
    let off: Vec<f64> = off
        .map(|(base, row)| {
            let row = row
                .as_array()
                .expect("a row")
                .iter()
                .map(|x| x.as_f64().expect("a number"));
            let truth: f64 = row.zip(&numbers).map(|(k, x)| k * x).sum();
            let get = |key: &str| base[key].as_f64().expect("a number");
            (get("value") - truth).abs() / get("deviation")
        })
        .collect();
    let within = |bound: f64| off.iter().filter(|x| **x < bound).count() as f64 / off.len() as f64;
    assert!(within(2.0) >= 0.85 && within(3.0) >= 0.94, "{off:?}");
    for link in found["links"].as_array().expect("links") {
        assert!(link["smallest_eigenvalue"].as_f64().expect("a number") > 0.0);
    }
    // The spec: valid, all else untouched, friction and rotors as effects.
    bgdyn(&["check", &path("found.yaml")]).good();
    let written = fs::read_to_string(folder.join("found.yaml")).expect("the spec");
    for line in [
        "# An arm with a payload.",
        "name: found",
        "# by its drawing; ± ",
        "was 4",
        "lift_rotor: { type: rotor, joint: lift, inertia: 0.",
        "bend_coulomb: { type: coulomb, joint: bend, kinetic: 0.",
    ] {
        assert!(written.contains(line), "{line}:\n{written}");
    }
    let page = fs::read_to_string(folder.join("report/arm.html")).expect("the page");
    assert!(page.contains("\"unseen\"") && page.contains("default-src 'none'"));
    assert!(!page.contains("src=") && !page.contains("url("));
}

#[test]
fn a_payload_is_found_alone() {
    let log = csv(&simulated(&arm(1.2), 3, 15.0));
    let folder = files("identify_payload", &arm(1.0), &[("log.csv", log)]);
    let path = |name: &str| text(&folder.join(name));
    let run = bgdyn(&[
        "identify",
        &path("arm.yaml"),
        &path("log.csv"),
        "--only",
        "payload",
        "--rotors",
        "--prior",
        "0.01",
        "--json",
        "-o",
        &path("found.yaml"),
    ]);
    let found: Value = serde_json::from_str(&run.good()).expect("JSON");
    let payload = &found["links"][3];
    let mass = payload["parameters"][0]["value"].as_f64().expect("a mass");
    assert!((mass / 1.2 - 1.0).abs() < 0.02, "{mass}");
    let written = fs::read_to_string(folder.join("found.yaml")).expect("the spec");
    assert!(
        written.contains("mass: 6   # by its drawing\n"),
        "other links are untouched:\n{written}"
    );
    assert_eq!(found["judged_on"], "last third");
}

#[test]
fn a_joint_that_sticks_is_named() {
    // Near rest something else holds the second joint, and its friction takes nothing.
    let (lift, still, coulomb) = (1, 0.15, 2.0);
    let mut rows = simulated(&truth(), 4, 20.0);
    let speed =
        |pair: &[Vec<f64>]| (pair[1][1 + lift] - pair[0][1 + lift]) / (pair[1][0] - pair[0][0]);
    let speeds: Vec<f64> = rows.windows(2).map(speed).collect();
    for (row, v) in rows
        .iter_mut()
        .zip(&speeds)
        .filter(|(_, v)| v.abs() < still)
    {
        row[4 + lift] -= coulomb * v.signum();
    }
    let folder = files("identify_sticking", &arm(1.0), &[("log.csv", csv(&rows))]);
    let path = |name: &str| text(&folder.join(name));
    let run = |more: &[&str]| {
        let (spec, log) = (path("arm.yaml"), path("log.csv"));
        let usual = ["identify", &spec, &log, "--rotors", "--cut", "20 Hz"];
        bgdyn(&[&usual, more].concat()).good()
    };
    let found: Value = serde_json::from_str(&run(&["--json"])).expect("JSON");
    let [turn, lift, bend] = [0, 1, 2].map(|j| found["joints"][j]["sticking"].clone());
    assert!(turn.is_null() && bend.is_null(), "{turn} {bend}");
    let below = lift["below"].as_f64().expect("a speed");
    assert!((0.1..0.25).contains(&below), "{below}");
    assert!(lift["factor"].as_f64().expect("a factor") > 6.0, "{lift}");
    let named = "lift: rows slower than";
    assert!(run(&[]).contains(named));
    assert!(!run(&["--skip-below", "0.3 rad/s"]).contains(named));
}

/// Runs with a changed log; returns stderr after checking that nothing was written.
fn refused(name: &str, log: &str, more: &[&str]) -> String {
    let folder = files(name, &arm(1.0), &[("log.csv", log.to_owned())]);
    let path = |name: &str| text(&folder.join(name));
    let (spec, log, found) = (path("arm.yaml"), path("log.csv"), path("found.yaml"));
    let run = bgdyn(&[&["identify", &spec, &log, "-o", &found], more].concat());
    assert_eq!(run.code, Some(1), "{}{}", run.stdout, run.stderr);
    assert!(!folder.join("found.yaml").exists() && run.stdout.is_empty());
    run.stderr
}

#[test]
fn each_fault_is_refused_at_its_place() {
    let rows = simulated(&truth(), 4, 6.0);
    let change = |of: &dyn Fn(&mut Vec<Vec<f64>>)| {
        let mut rows = rows.clone();
        of(&mut rows);
        csv(&rows)
    };
    let lines = |of: &dyn Fn(&mut Vec<String>)| {
        let mut lines: Vec<String> = csv(&rows).lines().map(String::from).collect();
        of(&mut lines);
        lines.join("\n") + "\n"
    };
    let cases: Vec<(&str, String, &[&str])> = vec![
        (
            "identify_gap",
            change(&|r| drop(r.drain(300..400))),
            &["302:1:", "[gap]", "cut the log there"],
        ),
        (
            "identify_back",
            change(&|r| r[50][0] = 0.1),
            &["52:1:", "[time-order]"],
        ),
        (
            "identify_nan",
            lines(&|l| {
                l[7] = l[7].replacen(',', ",nan,", 1);
                l[8] = l[8].split(',').map(|_| "x").collect::<Vec<_>>().join(",")
            }),
            &[
                "8:8:",
                "8 values instead of 7",
                "[wrong-count]",
                "9:1:",
                "[not-finite]",
            ],
        ),
        (
            "identify_missing",
            lines(&|l| {
                l[0] = l[0]
                    .replace("tau_bend", "tau_hand")
                    .replace("q_turn", "turn")
            }),
            &[
                "[missing-column]",
                "position of joint `turn`",
                "effort of joint `bend`",
                "tau_hand",
            ],
        ),
        (
            "identify_unit",
            lines(&|l| l.insert(1, "s,deg,mm,rad,N*m,N,N*m".into())),
            &["2:3:", "2:6:", "[wrong-unit]"],
        ),
        (
            "identify_degrees",
            change(&|r| r.iter_mut().for_each(|r| r[1] *= 57.3)),
            &["[wrong-unit]", "joint `turn` goes from", "deg"],
        ),
        (
            "identify_ms",
            change(&|r| r.iter_mut().for_each(|r| r[0] *= 1e3)),
            &["[wrong-unit]", "rows per second", "ms"],
        ),
        (
            "identify_constant",
            change(&|r| {
                r.iter_mut().for_each(|r| {
                    r[2] = 0.5;
                    r[6] = 1.0
                })
            }),
            &[
                "[constant-channel]",
                "joint `lift` stays at 0.5",
                "effort of joint `bend` is 1",
            ],
        ),
        (
            "identify_sign",
            change(&|r| r.iter_mut().for_each(|r| (4..7).for_each(|j| r[j] = -r[j]))),
            &["[wrong-sign]", "efforts are those of the negative model"],
        ),
        (
            "identify_rest",
            change(&|r| {
                r.iter_mut()
                    .enumerate()
                    .for_each(|(i, r)| (1..4).for_each(|j| r[j] = 0.3 + 1e-6 * (i % 2) as f64))
            }),
            &["[nothing-excited]", "no joint moves"],
        ),
        (
            "identify_short",
            change(&|r| r.truncate(60)),
            &["[too-short]"],
        ),
        ("identify_empty", String::new(), &["[empty-log]"]),
    ];
    for (name, log, wanted) in cases {
        let told = refused(name, &log, &[]);
        for text in wanted {
            assert!(
                told.contains(text),
                "{name}: `{text}` is missing in\n{told}"
            );
        }
        assert!(
            told.contains("help: ") && told.contains("nothing was written"),
            "{told}"
        );
    }
    let told = refused("identify_only", &csv(&rows), &["--only", "hand"]);
    assert!(told.contains("column, upper, fore, payload"), "{told}");
}

#[test]
fn names_and_units_of_other_loggers_are_read() {
    let rows = simulated(&truth(), 5, 8.0);
    let plain = files("identify_names", &arm(1.0), &[("log.csv", csv(&rows))]);
    let degrees: Vec<Vec<f64>> = rows
        .iter()
        .map(|r| {
            r.iter()
                .enumerate()
                .map(|(c, x)| match c {
                    0 => x * 1e3,
                    1..=3 => x.to_degrees(),
                    _ => *x,
                })
                .collect()
        })
        .collect();
    let mut other = csv(&degrees).replace(
        &header(),
        "stamp,joint_turn_pos,joint_lift_pos,joint_bend_pos,i_1,i_2,i_3\nms,deg,deg,deg,A,A,A",
    );
    other.insert_str(0, "# recorded by another tool\n");
    fs::write(plain.join("other.csv"), other).expect("a log");
    fs::write(
        plain.join("gains.csv"),
        "joint,gain\nturn,1\nlift,1\nbend,1\n",
    )
    .expect("gains");
    let path = |name: &str| text(&plain.join(name));
    let first = bgdyn(&[
        "identify",
        &path("arm.yaml"),
        &path("log.csv"),
        "--cut",
        "8 Hz",
        "--json",
    ])
    .good();
    let second = bgdyn(&[
        "identify",
        &path("arm.yaml"),
        &path("other.csv"),
        "--cut",
        "8 Hz",
        "--json",
        "--gains",
        &path("gains.csv"),
        "--columns",
        "time=stamp,q=joint_{}_pos,tau=i_{}",
    ])
    .good();
    let mass = |text: &str| {
        serde_json::from_str::<Value>(text).expect("JSON")["links"][1]["parameters"][1]["value"]
            .as_f64()
            .expect("a number")
    };
    assert!((mass(&first) - mass(&second)).abs() < 1e-3 * mass(&first).abs());
}

#[test]
fn friction_of_several_joints_at_once_is_known_and_cannot_be_replaced() {
    let effects = "effects:\n  wet: { type: viscous, joints: all, damping: 0.5 }\n";
    let log = csv(&simulated(&truth(), 8, 8.0));
    let folder = files(
        "identify_joints",
        &(arm(1.0) + effects),
        &[("log.csv", log)],
    );
    let path = |name: &str| text(&folder.join(name));
    let own = ["identify", &path("arm.yaml"), &path("log.csv")];
    let told = bgdyn(&[&own[..], &["-o", &path("found.yaml")]].concat()).bad_input();
    for joint in ["turn", "lift", "bend"] {
        let wanted = format!("effect `wet_{joint}` is written for several joints at once");
        assert!(told.contains(&wanted), "{told}");
    }
}
