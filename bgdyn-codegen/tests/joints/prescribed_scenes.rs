//! Scenes of mechanisms with prescribed joints, against the scene in which these joints are free: efforts, energies,
//! power of the drives; courses with their derivatives; what such scenes refuse.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::read_scene;
use bgdyn_codegen::refusal::Refusal;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::verify::{check_scene, explain};
use bgdyn_runtime::Dd;

use super::robot::{close, largest};

/// A chain, and a link beside it that no prescribed joint moves.
const LINKS: &str = "format: 1
name: arm
links:
  - name: table
    joint: { name: turn, type: continuous, axis: [0.1, 0, 1] }
    mass: 3
    com: [0.05, 0.02, 0]
    inertia: { xx: 0.1, yy: 0.12, zz: 0.2 }
  - name: upper
    parent: table
    joint: { name: swing, type: revolute, axis: y, origin: { xyz: [0.4, 0, 0.1] } }
    mass: { parameter: load, value: 1.2 }
    com: [0, 0.02, -0.3]
    inertia: { xx: 0.02, yy: 0.03, zz: 0.01 }
  - name: slide
    parent: upper
    joint: { name: reach, type: prismatic, axis: [0, 0.2, 1], origin: { xyz: [0, 0, -0.3] } }
    mass: 0.8
    com: [0.02, 0, -0.1]
    inertia: { xx: 0.01, yy: 0.01, zz: 0.005 }
  - name: hand
    parent: slide
    joint: { name: wrist, type: revolute, axis: x, origin: { xyz: [0, 0, -0.2] } }
    mass: 0.4
    com: [0, 0.03, -0.1]
    inertia: { xx: 0.002, yy: 0.002, zz: 0.001 }
  - name: door
    joint: { name: hinge, type: revolute, axis: [1, 1, 0] }
    mass: 0.5
    com: [0.1, 0, 0.2]
    inertia: { xx: 0.01, yy: 0.01, zz: 0.01 }
";
const PRESCRIBED: &str = "constraints:
  feed: { type: prescribed, joint: reach }
  motor: { type: prescribed, joint: turn }
";
/// The places of the prescribed joints in q and v of the free mechanism.
const DRIVEN: [usize; 2] = [0, 2];
const EFFECTS: &str = "inertia, velocity_products, gravity, \
                       bearing: { type: viscous, joint: swing, damping: { parameter: loss, value: 0.3 } }, \
                       spool: { type: rotor, joint: wrist, on: slide, inertia: 1e-3, ratio: 9, axis: [0, 1, 1] }, \
                       part: { type: payload, at: hand, mass: { parameter: grip, value: 0.3 }, com: [0.1, 0, 0] }, \
                       spring: { type: spring, joint: wrist, stiffness: 3 }, \
                       blow: { type: wrench, at: door }";

fn read(prescribed: bool, effects: &str, keys: &str) -> Result<SceneEquations, Refusal> {
    let scene = format!("scene: 1\nmechanism: arm.yaml\neffects: [{effects}]\n{keys}\n");
    let own = if prescribed { PRESCRIBED } else { "" };
    let mechanism = format!("{LINKS}{own}");
    read_scene(&scene, "scene", |_| Ok(mechanism.clone())).map(|(system, _)| system)
}

fn scene(prescribed: bool, effects: &str, keys: &str) -> SceneEquations {
    let found = read(prescribed, effects, keys);
    found.unwrap_or_else(|e| panic!("{effects}: {e:?}"))
}

fn values(system: &SceneEquations, role: SceneFunction, at: &Inputs<Dd>) -> Vec<Dd> {
    let (found, refused) = system.function(role).evaluate(at.clone());
    assert!(refused.is_none(), "{role:?}: {refused:?}");
    found
}

fn kept(x: &[Dd]) -> Vec<Dd> {
    let own = (0..x.len()).filter(|k| !DRIVEN.contains(k));
    own.map(|k| x[k]).collect()
}

/// A state of the scene with free joints, and the same of the other one.
fn states(own: &SceneEquations, free: &SceneEquations, seed: u64) -> [Inputs<Dd>; 2] {
    let mut random = Random(seed);
    let mut some = |n: usize, size: f64| -> Vec<Dd> {
        (0..n)
            .map(|_| Dd::from_f64(size * random.signed()))
            .collect()
    };
    let layout = &free.scene.layout;
    // Of both scenes, the inputs that are no motions of prescribed joints are those of the wrench.
    let state = Inputs {
        q: some(layout.nq(), 1.5),
        v: some(layout.nv(), 1.0),
        a: some(layout.nv(), 2.0),
        u: some(layout.inputs.len(), 3.0),
        parameters: free.scene.parameters.iter().map(|p| p.default).collect(),
        t: Some(Dd::from_f64(0.3)),
        ..Inputs::default()
    };
    let value = |name: &str| {
        let input = layout.inputs.iter().position(|part| part.name == name);
        let [turn, reach] = DRIVEN;
        match (name, input) {
            (_, Some(k)) => state.u[k],
            ("turn", _) => state.q[turn],
            ("turn_rate", _) => state.v[turn],
            ("turn_acceleration", _) => state.a[turn],
            ("reach", _) => state.q[reach],
            ("reach_rate", _) => state.v[reach],
            ("reach_acceleration", _) => state.a[reach],
            _ => panic!("no input `{name}`"),
        }
    };
    let other = Inputs {
        q: kept(&state.q),
        v: kept(&state.v),
        a: kept(&state.a),
        u: own
            .scene
            .layout
            .inputs
            .iter()
            .map(|p| value(&p.name))
            .collect(),
        ..state.clone()
    };
    [state, other]
}

#[test]
fn parameters_and_inputs() {
    let own = scene(true, EFFECTS, "");
    let names = |system: &SceneEquations| -> Vec<String> {
        let all = system.scene.parameters.iter();
        all.map(|p| p.name.clone()).collect()
    };
    assert_eq!(names(&own), ["load", "grip", "loss"]);
    assert_eq!(names(&own), names(&scene(false, EFFECTS, "")));
    let layout = &own.scene.layout;
    assert_eq!(layout.prescribed, ["turn", "reach"]);
    let inputs: Vec<&str> = layout.inputs.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(
        inputs[..6],
        [
            "turn",
            "turn_rate",
            "turn_acceleration",
            "reach",
            "reach_rate",
            "reach_acceleration"
        ]
    );
    assert_eq!((layout.nq(), layout.nv()), (3, 3));
}

#[test]
fn efforts_energies_and_power_are_those_with_free_joints() {
    for effects in [
        EFFECTS,
        "inertia, velocity_products",
        "inertia, gravity",
        "gravity",
    ] {
        let (own, free) = (scene(true, effects, ""), scene(false, effects, ""));
        for seed in 0..4 {
            let [all, at] = states(&own, &free, seed);
            let efforts = values(&free, SceneFunction::Inverse, &all);
            let found = values(&own, SceneFunction::Inverse, &at);
            close(&found, &kept(&efforts), 1e-25, largest(&efforts), effects);
            // Forward dynamics under the efforts that these accelerations need.
            let forward = own.driven();
            let under = Inputs {
                a: found.clone(),
                ..at.clone()
            };
            let (rates, refused) = forward.evaluate(under);
            assert_eq!(refused, None);
            close(&rates[..at.v.len()], &at.a, 1e-20, 1.0, effects);
            let [energy, other] = [(&own, &at), (&free, &all)].map(|(system, at)| {
                let entries = system.entries.iter().map(|e| e.name.clone());
                let values = values(system, SceneFunction::Energy, at);
                let all: Vec<(String, Dd)> = entries.zip(values).collect();
                all
            });
            for (name, stored) in other {
                let own = energy.iter().find(|(n, _)| *n == name);
                let found = own.map_or(Dd::ZERO, |(_, stored)| *stored);
                close(
                    &[found],
                    &[stored],
                    1e-25,
                    1.0,
                    &format!("{effects}: {name}"),
                );
            }
            // The drives supply P σ, with P of the free mechanism at the accelerations of the scene.
            let rates = values(&own, SceneFunction::Derivative, &at);
            let mut moved = all.clone();
            let places = (0..all.v.len()).filter(|k| !DRIVEN.contains(k));
            places.zip(&rates).for_each(|(k, &a)| moved.a[k] = a);
            let needed = values(&free, SceneFunction::Inverse, &moved);
            let expected = DRIVEN.iter().map(|&k| needed[k] * all.v[k]);
            let expected = expected.fold(Dd::ZERO, |sum, x| sum + x);
            let power = values(&own, SceneFunction::Power, &at);
            let entry = own
                .entries
                .iter()
                .position(|e| e.name == "prescribed_drives");
            let entry = entry.expect("the drives");
            close(
                &power[3 * entry..][..1],
                &[expected],
                1e-22,
                largest(&needed),
                effects,
            );
        }
    }
}

/// The generator's check: equation (6) under the laws, the balance of power, the Jacobian under the courses.
#[test]
fn scenes_with_prescribed_joints_are_verified() {
    let courses = "inputs: { turn: { harmonic: { amplitude: 40 deg, frequency: 0.4 Hz, phase: 20 deg } }, reach: { ramp: { from: 0.1, rate: 0.2 } } }";
    for (effects, keys) in [
        (EFFECTS, ""),
        (EFFECTS, courses),
        ("inertia, gravity", courses),
        ("gravity", courses),
        (
            "inertia, velocity_products, grip: { type: coulomb, joint: wrist, kinetic: 0.2, static: 0.3 }",
            courses,
        ),
    ] {
        let system = scene(true, effects, keys);
        let roles = system.roles_with(true, true);
        assert!(!roles.contains(&SceneFunction::ToCanonical));
        let functions: Vec<Function> = roles
            .into_iter()
            .map(|role| system.function(role))
            .collect();
        let found = check_scene(&system, &functions);
        assert!(found.is_empty(), "{effects}: {}", explain(&found));
    }
}

/// The course and both derivatives, in closed form.
#[test]
fn courses_have_exact_derivatives() {
    let system = scene(
        true,
        "inertia",
        "inputs: { turn: { harmonic: { amplitude: 0.5, frequency: 0.25 Hz, phase: 0.25, offset: 0.125 } }, reach: { ramp: { from: 0.5, rate: -0.25 } } }",
    );
    let t = Dd::from_f64(1.375);
    let at = Inputs {
        q: vec![Dd::ZERO; 3],
        v: vec![Dd::ZERO; 3],
        u: vec![Dd::ZERO; 6],
        parameters: vec![Dd::ONE],
        t: Some(t),
        ..Inputs::default()
    };
    let found = values(&system, SceneFunction::Inputs, &at);
    let turn = Dd::PI * 0.5_f64.into();
    let (sin, cos) = (turn * t + 0.25_f64.into()).sin_cos();
    let half = Dd::from_f64(0.5);
    let expected = [
        half * sin + 0.125_f64.into(),
        half * turn * cos,
        -(half * turn * turn * sin),
        Dd::from_f64(0.5 - 0.25 * 1.375),
        Dd::from_f64(-0.25),
        Dd::ZERO,
    ];
    close(&found, &expected, 1e-29, 1.0, "courses");
}

/// A locked joint is the constant case: it has no inputs, and its parameters are gone.
#[test]
fn lock_is_the_constant_case() {
    let lock = "lock: { turn: 0.7, reach: 120 mm }\n";
    let (own, free) = (scene(true, EFFECTS, lock), scene(false, EFFECTS, lock));
    assert_eq!(own.scene.layout, free.scene.layout);
    let names = |s: &SceneEquations| -> Vec<String> {
        s.scene.parameters.iter().map(|p| p.name.clone()).collect()
    };
    assert_eq!(names(&own), names(&free));
    let one = scene(true, EFFECTS, "lock: { turn: 0.7 }");
    assert_eq!(one.scene.layout.prescribed, ["reach"]);
    let held = scene(true, EFFECTS, "inputs: { turn: { constant: 0.7 } }");
    let mut random = Random(5);
    let mut some =
        |n: usize| -> Vec<Dd> { (0..n).map(|_| Dd::from_f64(random.signed())).collect() };
    let at = Inputs {
        q: some(3),
        v: some(3),
        u: some(one.scene.layout.inputs.len()),
        parameters: one.scene.parameters.iter().map(|p| p.default).collect(),
        t: Some(Dd::ZERO),
        ..Inputs::default()
    };
    let mut with = at.clone();
    with.u = [
        vec!["0.7".parse().expect("a number"), Dd::ZERO, Dd::ZERO],
        at.u.clone(),
    ]
    .concat();
    let expected = values(&one, SceneFunction::Derivative, &at);
    let found = values(&held, SceneFunction::Derivative, &with);
    close(&found, &expected, 1e-24, 1.0, "a locked joint");
}

/// Asserts one fault whose text has these words.
fn refused(effects: &str, keys: &str, rule: &str, words: &[&str]) {
    let faults = match read(true, effects, keys) {
        Err(Refusal::Spec(faults)) => faults,
        other => panic!("{effects}{keys}: {:?}", other.map(|_| "accepted")),
    };
    assert_eq!(faults.0.len(), 1, "{:?}", faults.0);
    let fault = &faults.0[0];
    let said = format!("{} {}", fault.message, fault.help.as_deref().unwrap_or(""));
    assert_eq!(fault.rule, rule, "{said}");
    assert!(fault.help.is_some(), "{rule}: no help");
    for word in words {
        assert!(said.contains(word), "{word}: {said}");
    }
}

#[test]
fn what_scenes_with_prescribed_joints_refuse() {
    let refused_course = |course: &str, rule, words: &[&str]| {
        refused("inertia", &format!("inputs: {{ {course} }}"), rule, words);
    };
    refused_course(
        "turn: { table: [[0 s, 0], [1 s, 20 deg]] }",
        "prescribed-with-corners",
        &[
            "`turn` is a table",
            "velocity jumps",
            "`harmonic`",
            "`given`",
        ],
    );
    refused_course(
        "turn_rate: { constant: 2 }",
        "rate-of-prescribed",
        &["`turn_rate` follows", "`turn: given`"],
    );
    refused_course(
        "reach: { pd: { target: 0.5, stiffness: 100, damping: 20 } }",
        "drive",
        &["`pd` controls the position of a joint", "`constant`"],
    );
    for (effect, site) in [
        ("pull: { type: wrench, at: hand }", "hand"),
        (
            "rope: { type: spring, between: [door, hand], stiffness: 20 }",
            "hand",
        ),
        ("air: { type: drag, at: table, linear: 1 }", "table"),
    ] {
        refused(
            &format!("inertia, {effect}"),
            "",
            "effect-beyond-prescribed",
            &[site, "prescribed joint", "lock `"],
        );
    }
    refused(
        "inertia, velocity_products",
        "integration: { method: canonical_midpoint, step: 1 ms, end: 1 s }",
        "canonical-prescribed",
        &["`turn` is prescribed", "method:"],
    );
    let drive = "inertia, m: { type: viscous, joint: turn, damping: 1 }";
    refused(
        drive,
        "",
        "effect-on-prescribed",
        &["the motion of `turn` is prescribed"],
    );
}

/// Controllers know the signals of the scene, whatever the caller gives for them: motions of prescribed joints, a wrench,
/// a moving counterpart. So does a model of the controllers.
#[test]
fn computed_torques_know_the_signals() {
    let effects =
        format!("{EFFECTS}, belt: {{ type: viscous, joint: hinge, reference: belt, damping: 4 }}");
    let law = "{ computed_torque: { target: { ramp: { from: 0.25, rate: 0.5 } }, stiffness: 90, damping: 12 } }";
    let keys = format!(
        "inputs:
  turn: {{ harmonic: {{ amplitude: 0.8, frequency: 0.7 Hz }} }}
  reach: {{ quintic: {{ to: 0.3, duration: 1 s }} }}
  blow_fz: {{ constant: 9 }}
  belt_rate: {{ harmonic: {{ amplitude: 0.5, frequency: 1 Hz }} }}
  swing: {law}
  wrist: {law}
  hinge: {law}
"
    );
    for model in ["", "controller_model: { mechanism: arm.yaml }\n"] {
        let system = scene(true, &effects, &format!("{keys}{model}"));
        let layout = &system.scene.layout;
        for seed in 0..4 {
            let mut random = Random(70 + seed);
            let mut some =
                |n: usize| -> Vec<Dd> { (0..n).map(|_| Dd::from_f64(random.signed())).collect() };
            let mut at = Inputs {
                q: some(layout.nq()),
                v: some(layout.nv()),
                u: some(layout.inputs.len()),
                parameters: system.scene.parameters.iter().map(|p| p.default).collect(),
                t: Some(Dd::from_f64(0.25 * seed as f64)),
                ..Inputs::default()
            };
            at.u = values(&system, SceneFunction::Inputs, &at);
            let found = values(&system, SceneFunction::Derivative, &at);
            let number = Dd::from_f64;
            let t = at.t.expect("a time");
            let followed = layout.coordinates.iter().enumerate();
            for (j, coordinate) in followed {
                let error = number(0.25) + number(0.5) * t - at.q[j];
                let wanted = error * number(90.0) + (number(0.5) - at.v[j]) * number(12.0);
                let off = (found[j] - wanted).to_f64().abs();
                assert!(
                    off < 1e-24 * largest(&found),
                    "{model}, {}: {off:e}",
                    coordinate.name
                );
            }
        }
    }
}
