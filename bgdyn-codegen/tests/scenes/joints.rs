//! Tests one declaration for several joints.

use bgdyn_codegen::fault::Faults;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::system::SceneEquations;

use super::common::{scene, state, told, try_scene};

/// Three turning joints, one that slides; effects of the file for `EFFECTS`.
const ARM: &str = "\
format: 1
links:
  - name: upper
    joint: { name: shoulder, type: revolute, axis: y }
    mass: 2
    com: [0.1, 0, 0.2]
  - name: lower
    parent: upper
    joint: { name: elbow, type: revolute, axis: x, origin: { xyz: [0, 0, 0.5] } }
    mass: 1
    com: [0.1, 0.1, 0.2]
  - name: fist
    parent: lower
    joint: { name: wrist, type: revolute, axis: z, origin: { xyz: [0.1, 0, 0.4] } }
    mass: 1
    com: [0.2, 0.1, 0.1]
  - name: probe
    parent: fist
    joint: { name: reach, type: prismatic, axis: x, origin: { xyz: [0.1, 0, 0.1] } }
    mass: 0.5
";

fn arm(effects: &str) -> String {
    match effects {
        "" => ARM.to_owned(),
        effects => format!("{ARM}effects:\n{effects}"),
    }
}

fn called(effects: &str) -> String {
    format!("scene: 1\nmechanism: arm.yaml\neffects:\n  - inertia\n  - gravity\n{effects}")
}

fn names(system: &SceneEquations) -> Vec<&str> {
    let all = system.scene.elements.iter().map(|e| e.name.as_str());
    all.filter(|n| !["inertia", "gravity"].contains(n))
        .collect()
}

/// Both scenes have the same accelerations, for any names of their effects.
fn same(one: &SceneEquations, other: &SceneEquations) {
    let [a, b] = [one, other].map(|s| s.function(SceneFunction::Derivative));
    for seed in 0..4 {
        let at = state(one, &mut Random(seed), true);
        let mut there = at.clone();
        there.modes.truncate(other.scene.layout.modes.len());
        let (found, _) = a.evaluate(at);
        let (wanted, _) = b.evaluate(there);
        for (x, y) in found.iter().zip(&wanted) {
            let off = (*x - *y).to_f64().abs();
            assert!(
                off <= 1e-24 * (1.0 + y.to_f64().abs()),
                "{found:?} {wanted:?}"
            );
        }
    }
}

#[test]
fn all_joints_have_the_effect() {
    let all = scene(
        &called("  - bearing\n"),
        &arm("  bearing: { type: viscous, joints: all, damping: 0.3 }\n"),
    );
    let each = ["shoulder", "elbow", "wrist", "reach"];
    let wanted = each.map(|joint| format!("bearing_{joint}"));
    assert_eq!(names(&all), wanted);
    let alone = each
        .map(|joint| format!("  - b_{joint}: {{ type: viscous, joint: {joint}, damping: 0.3 }}\n"));
    same(&all, &scene(&called(&alone.concat()), ARM));
}

#[test]
fn a_list_says_which() {
    let some = "  - grip: { type: stribeck, joints: [wrist, shoulder], kinetic: 1 N*m, static: 2 N*m, stribeck_speed: 0.1 rad/s, width: 0.01 rad/s }\n";
    let some = scene(&called(some), ARM);
    assert_eq!(names(&some), ["grip_wrist", "grip_shoulder"]);
    let alone = ["wrist", "shoulder"].map(|joint| format!("  - {joint}_grip: {{ type: stribeck, joint: {joint}, kinetic: 1 N*m, static: 2 N*m, stribeck_speed: 0.1 rad/s, width: 0.01 rad/s }}\n"));
    same(&some, &scene(&called(&alone.concat()), ARM));
}

/// States, modes and inputs have the names of the effects; a parameter is common to all.
#[test]
fn each_effect_has_a_state_of_its_own_and_one_parameter() {
    let text = called(
        "  - drive: { type: dc_motor, joints: [shoulder, elbow], resistance: 1, inductance: 1 mH, torque_constant: { parameter: k, value: 0.1 N*m/A } }\n  - hold: { type: coulomb, joints: all, kinetic: 0.1 }\ninitial: { drive_elbow_current: 2 A }\n",
    );
    let system = scene(&text, ARM);
    let layout = &system.scene.layout;
    let inputs: Vec<&str> = layout.inputs.iter().map(|i| i.name.as_str()).collect();
    assert_eq!(inputs, ["drive_shoulder", "drive_elbow"]);
    let modes: Vec<&str> = layout.modes.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(
        modes,
        ["hold_shoulder", "hold_elbow", "hold_wrist", "hold_reach"]
    );
    let parameters = system.scene.parameters.iter();
    assert_eq!(
        parameters.map(|p| p.name.as_str()).collect::<Vec<_>>(),
        ["k"]
    );
    assert_eq!(system.initial.v[5].to_f64(), 2.0);
}

/// A scene may give the mechanism's effect other joints, and lock some: `all` are the moving ones.
#[test]
fn scenes_vary_the_joints() {
    let mechanism = arm("  bearing: { type: viscous, joints: all, damping: 0.3 }\n");
    let varied = |entry: &str, more: &str| {
        let system = scene(&format!("{}{more}", called(entry)), &mechanism);
        names(&system)
            .into_iter()
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    assert_eq!(varied("  - bearing: { joint: elbow }\n", ""), ["bearing"]);
    assert_eq!(
        varied("  - bearing: { joints: [elbow] }\n", ""),
        ["bearing_elbow"]
    );
    assert_eq!(varied("  - friction\n", "").len(), 4);
    let locked = varied("  - bearing\n", "lock: { shoulder: 0.3, reach: 0 }\n");
    assert_eq!(locked, ["bearing_elbow", "bearing_wrist"]);
}

#[test]
fn wrong_joints_are_refused() {
    let cases = [
        ("joints: some, damping: 1", "neither `all` nor a list"),
        (
            "joints: [elbow, wrist, elbow], damping: 1",
            "`elbow` is in the list twice",
        ),
        (
            "joints: [elbow, wrench], damping: 1",
            "no moving joint is called `wrench`",
        ),
        (
            "joints: all, joint: elbow, damping: 1",
            "has both `joint` and `joints`",
        ),
        ("damping: 1", "or `joints: all` for one effect at each"),
        ("joints: all, damping: 1 N*m*s/rad", "damping"),
    ];
    for (keys, wanted) in cases {
        let text = called(&format!("  - b: {{ type: viscous, {keys} }}\n"));
        let said = match try_scene(&text, ARM) {
            Err(refusal) => told(&refusal, &text),
            Ok((_, Faults(all))) => panic!("{keys}: accepted, {all:?}"),
        };
        assert!(said.contains(wanted), "{keys}: {said}");
    }
}
