//! Checks that errors of every phase of a scene's check are reported in one run, each once, without their
//! consequences.

use bgdyn_codegen::fault::Faults;
use bgdyn_codegen::read_scene;
use bgdyn_codegen::refusal::Refusal;

use super::common::try_scene;

const MECHANISM: &str = "\
format: 1
name: arm
links:
  - name: upper
    joint: { name: shoulder, type: revolute, axis: y }
    mass: 2
    com: [0.2, 0, 0.1]
    inertia: { xx: 0.1, yy: 0.1, zz: 0.1 }
  - name: lower
    parent: upper
    joint: { name: elbow, type: revolute, axis: y, origin: { xyz: [0.4, 0, 0] } }
    mass: 1
    com: [0.2, 0, 0]
    inertia: { xx: 0.1, yy: 0.1, zz: 0.1 }
effects:
  bearing: { type: viscous, joint: shoulder, damping: 0.3 }
  motor: { type: dc_motor, joint: elbow, resistance: 2, inductance: 1 mH, torque_constant: 0.1 }
";

/// One error of each phase: a replacement in the valid scene.
const MISTAKES: [(&str, &str); 12] = [
    ("scene: 1", "scene: 3"),
    ("description: sound", "descripton: sound"),
    ("name: scene", "name: other"),
    ("shoulder: 0 deg", "shoulder: 0 kg"),
    ("damping: 0.3", "damping: -0.3"),
    ("stiffness: 4", "stiffnes: 4"),
    ("- gravity", "- gravty"),
    ("elbow: 10 deg", "elbow: 10 deg, elbw_rate: 1"),
    ("constant: 2", "constnt: 2"),
    ("[elbow, lower]", "[elbow, lowr]"),
    ("method: rk4", "method: rk5"),
    ("step: 1 ms", "step: -1 ms"),
];

const SOUND: &str = "\
scene: 1
name: scene
description: sound
mechanism: arm.yaml
lock: { shoulder: 0 deg }
effects:
  - gravity
  - inertia
  - motor
  - rub: { type: viscous, joint: elbow, damping: 0.3 }
  - coil: { type: spring, joint: elbow, stiffness: 4 }
inputs: { elbow: { constant: 2 } }
initial: { elbow: 10 deg }
outputs: [elbow, lower]
integration: { method: rk4, step: 1 ms }
";

fn refused(text: &str, mechanism: &str) -> Faults {
    match try_scene(text, mechanism) {
        Err(Refusal::Spec(faults)) => faults,
        Err(other) => panic!("{other:?}"),
        Ok(_) => panic!("accepted:\n{text}"),
    }
}

/// Returns the location and message of each finding, without the lists of names.
fn lines(faults: &Faults) -> Vec<(usize, &'static str)> {
    let of = |f: &bgdyn_codegen::fault::Fault| (f.position.line, f.rule);
    faults.0.iter().map(of).collect()
}

#[test]
fn the_scene_is_sound_without_the_mistakes() {
    assert!(try_scene(SOUND, MECHANISM).is_ok());
}

/// Any two errors are reported together, from any phases, and nothing else.
#[test]
fn no_mistake_hides_another() {
    let spoil = |text: &str, i: usize| {
        let (good, bad) = MISTAKES[i];
        assert!(text.contains(good), "{good}");
        text.replacen(good, bad, 1)
    };
    let alone: Vec<(usize, &str)> = (0..MISTAKES.len())
        .map(|i| {
            let found = lines(&refused(&spoil(SOUND, i), MECHANISM));
            assert_eq!(found.len(), 1, "{:?}: {found:?}", MISTAKES[i]);
            found[0]
        })
        .collect();
    for i in 0..MISTAKES.len() {
        for k in i + 1..MISTAKES.len() {
            let found = lines(&refused(&spoil(&spoil(SOUND, i), k), MECHANISM));
            let mut wanted = vec![alone[i], alone[k]];
            wanted.sort();
            let mut sorted = found.clone();
            sorted.sort();
            assert_eq!(sorted, wanted, "{:?} {:?}", MISTAKES[i], MISTAKES[k]);
        }
    }
    let all = (0..MISTAKES.len()).fold(SOUND.to_owned(), |text, i| spoil(&text, i));
    let mut wanted = alone;
    wanted.sort();
    let mut found = lines(&refused(&all, MECHANISM));
    found.sort();
    assert_eq!(found, wanted);
}

/// Parts that a refused effect would have added are not reported as missing.
#[test]
fn what_follows_from_a_refused_effect_is_not_told() {
    let text = "\
scene: 1
mechanism: arm.yaml
effects:
  - gravity
  - inertia
  - motor: { resistance: -2 }
  - box: { type: geer, joint: elbow, ratio: 10 }
  - rub: { type: viscous, joint: box, damping: 0.1 }
  - oil: { type: fluid, density: 870, bulk_modulus: 1.4 Gpa }
  - pump: { type: supply, presure: 10 bar }
  - pan: { type: tank }
  - valve: { type: orifice, from: pump, to: pan, flow: 1 l, opening: lever }
inputs: { motor: 3, lever: 1, levr: 2 }
initial: { motor_current: 0, box: 0.1, elbo: 1 }
outputs: [motor_current, valve_flow, elbow, elboww]
";
    let faults = refused(text, MECHANISM);
    let told = faults.render("scene.yaml", text);
    let at: Vec<usize> = faults.0.iter().map(|f| f.position.line).collect();
    let one_each = [6, 7, 9, 10, 12, 13, 14, 15];
    let lines: std::collections::BTreeSet<usize> = at.iter().copied().collect();
    assert_eq!(lines.into_iter().collect::<Vec<_>>(), one_each, "{told}");
    for name in ["`levr`", "`elbo`", "`elboww`"] {
        assert!(told.contains(name), "{told}");
    }
    for name in [
        "called `motor`",
        "state `box`",
        "node `pump`",
        "joint `box`",
    ] {
        assert!(!told.contains(name), "{name}: {told}");
    }
}

/// An invalid mechanism does not hide errors of the scene itself.
#[test]
fn a_scene_is_checked_beside_its_mechanism() {
    let text = "\
scene: 2
mechanism: arm.yaml
effects:
  - rub: { type: viscous, joint: elbow, damping: 1 kg }
integration: { method: rk5 }
";
    let wanted = [(1, "version"), (4, "unit-misfit"), (5, "unknown-name")];
    let broken = MECHANISM.replace("mass: 2", "mass: -2");
    let Err(Refusal::Mechanism { faults, scene, .. }) = try_scene(text, &broken) else {
        panic!("the mechanism is wrong");
    };
    assert_eq!(lines(&faults), [(6, "negative-mass")]);
    assert_eq!(lines(&scene), wanted);
    let Err(Refusal::Spec(faults)) = read_scene(text, "scene", |_| Err("gone".into())) else {
        panic!("there is no mechanism");
    };
    assert_eq!(faults.0.len(), wanted.len() + 1);
    let nameless = text.replace("mechanism: arm.yaml\n", "");
    assert_eq!(refused(&nameless, MECHANISM).0.len(), wanted.len() + 1);
}

/// A mechanism's effects are checked although its links are invalid.
#[test]
fn broken_links_hide_no_effects() {
    let broken = MECHANISM
        .replace("mass: 2", "mass: two")
        .replace("damping: 0.3", "dampng: 0.3");
    let (_, faults) = bgdyn_codegen::read(&broken, Some("arm"));
    assert_eq!(lines(&faults).len(), 2, "{faults:?}");
}

#[test]
fn a_scene_has_its_keys_in_any_order() {
    use bgdyn_codegen::format::is_scene;
    let moved =
        "\u{feff}# an arm\n---\n".to_owned() + &SOUND.replacen("scene: 1\n", "", 1) + "scene: 1\n";
    let last = SOUND.replacen("scene: 1\n", "", 1) + "\"scene\": 1\n";
    for text in [moved, last] {
        assert!(is_scene(&text), "{text}");
        assert!(try_scene(&text, MECHANISM).is_ok(), "{text}");
    }
    for text in [
        "%YAML 1.2\n---\nname: x\nscene: 1\n",
        "{ mechanism: [a, {b: c}], lock: { scene: 2 }, scene: 1 }",
        "mechanism: arm.yaml\neffects: [gravity]\n",
        "name: &a x\nlock: { ? [1, 2] : 3 }\ninitial: *a\nscene: 1\n",
        "scene: 1\nname: [unclosed\n",
    ] {
        assert!(is_scene(text), "{text}");
    }
    for text in [
        "format: 1\nlinks: []\nscene: 1\n",
        "links: []\nmechanism: x\n",
        "name: { scene: 1 }\n",
        "description: |\n  scene: 1\nlinks: []\n",
        "- scene\n- 1\n",
        "scene",
        "",
        "\t",
    ] {
        assert!(!is_scene(text), "{text}");
    }
}
