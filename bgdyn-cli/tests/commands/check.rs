//! `bgdyn check`.

use serde_json::Value;

use crate::{bgdyn, scratch};

const TWO_FAULTS: &str = "\
format: 1
links:
  - name: arm
    joint: { name: shoulder, type: revolute }
    mass: -1
  - name: hand
    parent: amr
";

#[test]
fn a_good_spec_is_one_line() {
    let run = bgdyn(&["check", "tests/golden/specs/scara4.yaml"]);
    assert_eq!(run.stderr, "");
    assert_eq!(run.good(), "ok: scara4, NQ 4, NV 4: j1, j2, j3, j4\n");
}

#[test]
fn every_fault_starts_with_its_place() {
    let file = scratch("check_faults", "arm.yaml", TWO_FAULTS);
    let run = bgdyn(&["check", &file]);
    assert_eq!(run.stdout, "");
    let stderr = run.bad_input();
    let headlines: Vec<&str> = stderr.lines().filter(|l| l.starts_with(&file)).collect();
    assert_eq!(headlines.len(), 2, "{stderr}");
    assert!(headlines[0].starts_with(&format!("{file}:5:11: links[0].mass: ")));
    assert!(headlines[1].starts_with(&format!("{file}:7:13: links[1].parent: ")));
    assert!(stderr.starts_with(headlines[0]));
    assert_eq!(stderr.lines().last(), Some("2 faults"));
}

#[test]
fn the_path_is_printed_as_given() {
    let stderr = bgdyn(&["check", "specs/../specs/invalid/negative_mass.yaml"]).bad_input();
    assert!(stderr.starts_with("specs/../specs/invalid/negative_mass.yaml:16:11: "));
    assert_eq!(stderr.lines().last(), Some("1 fault"));
}

#[test]
fn every_invalid_spec_is_refused() {
    let folder = crate::root().join("specs/invalid");
    let mut count = 0;
    for entry in folder.read_dir().expect("the folder") {
        let path = entry.expect("an entry").path();
        let name = path.display().to_string();
        let run = bgdyn(&["check", &name]);
        assert_eq!(run.stdout, "", "{name}");
        let stderr = run.bad_input();
        assert!(stderr.starts_with(&format!("{name}:")), "{stderr}");
        assert_eq!(stderr.lines().last(), Some("1 fault"), "{name}");
        count += 1;
    }
    assert!(count > 40);
}

#[test]
fn warnings_do_not_refuse() {
    let text = "\
format: 1
links:
  - name: arm
    joint: { name: shoulder, type: revolute, origin: { rpy: [1.5708, 0, 0] } }
    mass: 1
    com: [1, 0, 0]
";
    let file = scratch("check_warning", "arm.yaml", text);
    let run = bgdyn(&["check", &file]);
    assert!(
        run.stderr.starts_with(&format!("{file}:4:61: warning: ")),
        "{}",
        run.stderr
    );
    assert_eq!(run.good(), "ok: arm, NQ 1, NV 1: shoulder\n");
    let report = bgdyn(&["check", &file, "--json"]).good();
    let report: Value = serde_json::from_str(&report).expect("JSON");
    assert_eq!(report["ok"], true);
    assert_eq!(report["findings"][0]["severity"], "warning");
}

#[test]
fn findings_as_json() {
    let file = scratch("check_json", "arm.yaml", TWO_FAULTS);
    let run = bgdyn(&["check", &file, "--json"]);
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(run.bad_input(), "2 faults\n");
    assert_eq!(report["ok"], false);
    assert_eq!(report["model"], Value::Null);
    let fault = &report["findings"][0];
    assert_eq!(fault["line"], 5);
    assert_eq!(fault["column"], 11);
    assert_eq!(fault["path"], "links[0].mass");
    assert_eq!(fault["rule"], "negative-mass");
    assert_eq!(report["findings"][1]["help"], "did you mean `arm`?");

    let good = bgdyn(&["check", "tests/golden/specs/dpend2.yaml", "--json"]).good();
    let good: Value = serde_json::from_str(&good).expect("JSON");
    let model = serde_json::json!({ "name": "dpend2", "nq": 2, "nv": 2, "coordinates": ["j1", "j2"], "positions": ["j1", "j2"], "parameters": [], "snapped": null });
    assert_eq!(good["model"], model);
    assert_eq!(good["ok"], true);
    assert_eq!(good["findings"], Value::Array(vec![]));
}

/// The duration of an impact is that of a half oscillation of a linear spring, or of Hertz's law, for the mass that moves.
#[test]
fn compliant_contacts_tell_their_time() {
    let linear = 1e3 * std::f64::consts::PI * (2.0_f64 / 1e5).sqrt();
    let hertz = 1e3 * 3.218 * (1.3_f64 * 1.3 / 4e12).powf(0.2);
    let one = |file: &str, ms: f64, end: &str| {
        let printed = bgdyn(&["check", file]).good();
        let line = printed.lines().nth(1).expect("a second line");
        let start = "compliant contacts: an impact at 1 m/s lasts ";
        let rest = line.strip_prefix(start).expect(start);
        let (found, rest) = rest.split_once(" ms at ").expect("a time");
        let found: f64 = found.parse().expect("a number");
        assert!((found - ms).abs() < 1e-4, "{found} {ms}");
        assert!(rest.ends_with(end), "{rest}");
    };
    one(
        "tests/contact/linear.scene.yaml",
        linear,
        "`touch` (2 kg); 14.0496 steps in the shortest",
    );
    one(
        "tests/contact/bowling.scene.yaml",
        hertz,
        " steps in the shortest",
    );
    let scene = format!(
        "scene: 1\nmechanism: {}/tests/contact/weight.yaml\neffects:\n  - inertia\n  - touch: {{ type: compliant_contact, contact: foot, linear_stiffness: 1e5 N/m }}\ninitial: {{ height: 1 mm }}\nintegration: {{ step: 10 ms }}\n",
        env!("CARGO_MANIFEST_DIR").trim_end_matches("/bgdyn-cli")
    );
    let file = scratch("check_contact", "coarse.scene.yaml", &scene);
    let too_few = "; 1.40496 steps in the shortest: too few, take shorter steps, a tolerance or a softer contact";
    one(&file, linear, too_few);
    let json = bgdyn(&["check", &file, "--json"]).good();
    let json: Value = serde_json::from_str(&json).expect("JSON");
    let time = &json["scene"]["contact_times"][0];
    assert_eq!(
        (&time["name"], &time["mass"]),
        (&"touch".into(), &2.0.into())
    );
}

#[test]
fn files_that_cannot_be_read() {
    let stderr = bgdyn(&["check", "nowhere.yaml"]).bad_input();
    assert!(
        stderr.starts_with("bgdyn: nowhere.yaml cannot be read: "),
        "{stderr}"
    );
    let file = scratch("check_bytes", "arm.yaml", b"format: 1\nlabel: \xff\n");
    let stderr = bgdyn(&["check", &file]).bad_input();
    assert!(
        stderr.starts_with(&format!("bgdyn: {file}:2:1: this line is not UTF-8")),
        "{stderr}"
    );
}

#[test]
fn parameters_are_listed() {
    let text = "\
format: 1
links:
  - name: arm
    joint: { name: shoulder, type: revolute }
    mass: { parameter: payload, value: 1500 g }
";
    let file = scratch("check_parameters", "arm.yaml", text);
    assert_eq!(
        bgdyn(&["check", &file]).good(),
        "ok: arm, NQ 1, NV 1: shoulder\n"
    );
    let report = bgdyn(&["check", &file, "--json"]).good();
    let report: Value = serde_json::from_str(&report).expect("JSON");
    let payload = serde_json::json!([{
        "name": "payload", "meaning": "mass of link `arm`", "default": 1.5, "unit": "kg",
    }]);
    assert_eq!(report["model"]["parameters"], payload);
}

#[test]
fn a_urdf_is_recognised() {
    for (name, text) in [
        ("plain.urdf", "<robot name=\"a\"><link name=\"b\"/></robot>"),
        (
            "headed.urdf",
            "\u{feff}<?xml version=\"1.0\"?>\n<robot name=\"a\"/>",
        ),
        ("told.urdf", "\n<!-- an arm -->\n<robot name=\"a\"/>"),
    ] {
        let file = scratch("check_urdf", name, text);
        let told = format!(
            "bgdyn: {file}:1:1: this is a URDF, not a spec: `bgdyn import {file}` writes the spec of it [urdf-given]\n"
        );
        for command in ["check", "ops", "simulate"] {
            assert_eq!(bgdyn(&[command, &file]).bad_input(), told);
        }
    }
    let yaml = "# <robot name=\"a\"/>\nformat: 2\n";
    let file = scratch("check_urdf", "quoted.yaml", yaml);
    assert!(!bgdyn(&["check", &file]).bad_input().contains("URDF"));
}

#[test]
fn what_snapping_changed_is_printed() {
    let spec = "\
format: 1
links:
  - name: arm
    joint: { name: shoulder, type: revolute, axis: [1e-11, 0, 1] }
    mass: 1
    com: [0.1, 0, 0]
";
    let file = scratch("check_snapped", "arm.yaml", spec);
    let text = bgdyn(&["check", &file]).good();
    let wanted = "snapped: 1 direction, 1.0e-11 rad off (`links[0].joint.axis`)";
    assert!(text.contains(wanted), "{text}");
}
