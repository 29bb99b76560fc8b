//! The spec that `bgdyn identify` writes, in styles of YAML that differ: read again it has the numbers that were found.

use std::fs;

use serde_json::Value;

use crate::bgdyn;
use crate::identify_logs::{arm, csv, files, simulated, text, truth};

/// Effects of single joints, in one line and in several.
const EFFECTS: &str = "
effects:
  turn_wet: { type: viscous, joint: turn, damping: 0.5 } # guessed
  lift_wet:
    type: viscous
    # With its unit.
    damping: 1.5 N*m*s/rad
    joint: lift
  bend_dry: { type: coulomb, kinetic: 0.1, joint: bend }
  turn_drive: { type: rotor, joint: turn, inertia: 200 g*cm^2, ratio: 50 }
";

/// The arm with every collection in block style; the upper link has no centre of mass in its file, the fore link no
/// inertia.
const BLOCKS: &str = "format: 1
name: arm
links:
- name: column
  joint:
    name: turn
    type: revolute
  mass: 6 kg
  com:
  - 10 mm
  - 0.02 # by its drawing
  - 0.15
  inertia:
    xx: 0.06
    yy: 0.06
    zz: 0.03
- name: upper
  parent: column
  joint:
    name: lift
    type: revolute
    axis: y
    origin:
      xyz: [0.05, 0, 0.3]
  inertia:
    xx: 0.012
    yy: 0.07

    zz: 0.07
    xy: 0
    xz: 0
    yz: 0
  mass: 4
- name: fore
  mass: 2.5
  com:
    - 0.15
    - 0
    - 0.01
  parent: upper
  joint:
    name: bend
    type: revolute
    axis: y
    origin:
      xyz: [0.4, 0, 0]
      rpy: [20 deg, 0, 0]
- name: payload
  parent: fore
  joint:
    type: fixed
    origin: { xyz: [0.3, 0, 0] }
  mass: 1
  com: [0, 0, 0.05]
  inertia:
    solid: box
    size:
    - 0.1
    - 0.1
    - 0.12";

/// Identifies the truth from a spec, and again from the spec that is written; returns that spec.
fn written_and_read_again(name: &str, spec: &str) -> String {
    let log = csv(&simulated(&truth(), 6, 8.0));
    let folder = files(name, spec, &[("log.csv", log)]);
    let path = |name: &str| text(&folder.join(name));
    let identified = |spec: &str, more: &[&str]| -> Value {
        let usual = ["identify", spec, &path("log.csv"), "--rotors", "--json"];
        serde_json::from_str(&bgdyn(&[&usual, more].concat()).good()).expect("JSON")
    };
    let found = identified(&path("arm.yaml"), &["-o", &path("found.yaml")]);
    bgdyn(&["check", &path("found.yaml")]).good();
    let again = identified(&path("found.yaml"), &[]);
    let all = |found: &Value, of: &str| -> Vec<f64> {
        let links = found["links"].as_array().expect("links").iter();
        let numbers = links.flat_map(|link| link["parameters"].as_array().expect("parameters"));
        let columns = found["columns"].as_array().expect("columns").iter();
        let columns = columns.filter(|column| column["name"] != "offset");
        let number = |one: &Value| one[of].as_f64().expect("a number");
        numbers.chain(columns).map(number).collect()
    };
    let (values, read) = (all(&found, "value"), all(&again, "file"));
    assert_eq!(values.len(), 40 + 9);
    assert_eq!(values.len(), read.len());
    for (k, (value, read)) in values.iter().zip(&read).enumerate() {
        let near = 1e-5 * value.abs() + 1e-8;
        assert!(
            (value - read).abs() < near,
            "{k}: {value} found, {read} read"
        );
    }
    fs::read_to_string(folder.join("found.yaml")).expect("the spec")
}

#[test]
fn effects_of_single_joints_are_replaced_in_place() {
    let written = written_and_read_again("identify_effects", &(arm(1.0) + EFFECTS));
    let line = |of: &str| {
        let found = written.lines().find(|line| line.contains(of));
        found.unwrap_or_else(|| panic!("no `{of}` in\n{written}"))
    };
    let wet = line("turn_wet: { type: viscous, joint: turn, damping: ");
    assert!(
        wet.contains("# guessed; ± ") && wet.ends_with("; was 0.5"),
        "{wet}"
    );
    let other = line("    damping: ");
    assert!(other.ends_with("; was 1.5 N*m*s/rad"), "{other}");
    assert!(line("bend_dry: ").ends_with("; was 0.1"), "{written}");
    assert!(line("turn_drive: ").contains("ratio: 50 }"), "{written}");
    // What is declared is not added.
    for gone in ["turn_viscous", "lift_viscous", "bend_coulomb", "turn_rotor"] {
        assert!(!written.contains(gone), "{gone} in\n{written}");
    }
    for new in ["bend_viscous", "turn_coulomb", "lift_coulomb", "lift_rotor"] {
        line(&format!("  {new}: {{ type: "));
    }
    assert!(written.contains("\n    # With its unit.\n"));
}

#[test]
fn block_style_is_kept_and_missing_keys_are_added() {
    let written = written_and_read_again("identify_blocks", BLOCKS);
    for kept in [
        "  com:\n  - ",
        "  inertia:\n    xx: ",
        "\n\n    zz: ",
        " # by its drawing; ± ",
    ] {
        assert!(written.contains(kept), "`{kept}` in\n{written}");
    }
    // Products of inertia that the log does not change are zeros.
    assert!(written.contains("xy: 0, xz: 0, yz: 0 }"), "{written}");
    assert!(written.contains("\n  com: [0.") && written.contains("# was not given"));
    assert!(written.contains("\n  inertia: { xx: "), "{written}");
}

#[test]
fn lines_that_end_as_on_windows_are_read_again() {
    // A key that is missing becomes a line of its own.
    let spec = (arm(1.0) + EFFECTS).replace("    com: [0.2, 0.01, 0.02]\n", "");
    let spec = spec.replace('\n', "\r\n");
    let written = written_and_read_again("identify_returns", &spec);
    assert!(written.contains("# guessed; ± ") && written.contains("; was 0.5\r\n"));
    let lines = written.matches('\n').count();
    assert_eq!(lines, written.matches("\r\n").count(), "{written}");
    assert!(!written.contains("\r\r"), "{written}");
}
