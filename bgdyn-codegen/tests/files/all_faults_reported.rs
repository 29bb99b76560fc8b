//! Checks that all faults of a file are reported in one run, each with its location.

use bgdyn_codegen::read;

const SPEC: &str = "\
format: 1
name: other_name
snap: 1 deg
links:
  - name: upper_arm
    joint: { name: shoulder, type: revolut, axis: y }
    mass: heavy
    inertia: { xx: 0.002, yy: 0.018, zz: 0.9 }
  - name: forearm
    parent: uper_arm
    joint:
      name: elbow
      type: revolute
      axis: [0, 0, 0]
      limits: { lower: 1, upper: -1, velocity: -3 }
    mass: -2 kg
    weight: 3
  - name: hand
    parent: finger
  - name: finger
    parent: hand
    mass: 3 mm
    com: [0, 1]
frames:
  - { name: tool, link: hnd, origin: { rpy: [0, 0, ninety] } }
  - { name: hand }
";

#[test]
fn all_faults_are_reported_in_one_run() {
    let (mechanism, faults) = read(SPEC, Some("arm"));
    assert_eq!(mechanism, None);
    let places: Vec<String> = faults
        .0
        .iter()
        .map(|f| format!("{} {} {}", f.position, f.path, f.rule))
        .collect();
    let wanted = [
        "2:7 name name-differs-from-file",
        "3:7 snap snap-out-of-range",
        "6:36 links[0].joint.type unknown-joint-type",
        "7:11 links[0].mass wrong-type",
        "8:14 links[0].inertia triangle-inequality",
        "10:13 links[1].parent unknown-parent",
        "14:13 links[1].joint.axis zero-axis",
        "15:24 links[1].joint.limits.lower lower-above-upper",
        "15:48 links[1].joint.limits.velocity negative-limit",
        "16:11 links[1].mass negative-mass",
        "17:5 links[1] unknown-key",
        "19:13 links[2].parent cyclic-parents",
        "22:11 links[3].mass unit-misfit",
        "23:10 links[3].com wrong-length",
        "25:25 frames[0].link unknown-link",
        "25:52 frames[0].origin.rpy[2] wrong-type",
        "26:5 frames[1] missing-key",
        "26:13 frames[1].name repeated-name",
    ];
    assert_eq!(places, wanted);
    insta::assert_snapshot!(faults.render("specs/arm.yaml", SPEC));
}
