//! Computed torques by a model that differs from the scene: the efforts are those of the model's own scene, which this
//! file reads by itself and inverts by the literal sum.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::read_scene;
use bgdyn_codegen::refusal::Refusal;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;

use super::common::{state, told};

/// A spatial arm with an elastic elbow, a hand whose load is a parameter, and frictions; NUMBERS scale its bodies.
fn arm(scale: f64, turn: &str) -> String {
    let [m, i] = [2.5 * scale, 0.05 * scale];
    format!(
        "format: 1
links:
  - name: column
    joint: {{ name: waist, type: revolute, axis: [0.1, -0.2, 0.97], origin: {{ xyz: [0.1, 0.2, 0.3] }} }}
    mass: {m}
    com: [0.03, 0.05, -0.02]
    inertia: {{ xx: {i}, yy: 0.04, zz: 0.06, xy: 0.002, xz: -0.003, yz: 0.004 }}
  - name: upper
    parent: column
    joint: {{ name: shoulder, type: revolute, axis: [0.3, 0.9, -0.1], origin: {{ xyz: [0.05, 0.1, 0.4], rpy: [{turn}, 0.2, -0.1] }} }}
    mass: 3.1
    com: [0.2, {c}, 0.03]
    inertia: {{ xx: 0.02, yy: 0.09, zz: 0.08, xy: 0.001, xz: 0.002, yz: -0.003 }}
  - name: fore
    parent: upper
    joint: {{ name: slide, type: prismatic, axis: [0.8, 0.1, 0.5], origin: {{ xyz: [0.4, 0.02, 0.1] }} }}
    mass: {{ parameter: load, value: 1.5 }}
    com: [0.1, 0.02, -0.04]
    inertia: {{ xx: 0.01, yy: 0.02, zz: 0.03 }}
effects:
  dry: {{ type: coulomb, joint: waist, kinetic: {dry}, static: 3 }}
  smooth: {{ type: coulomb_smooth, joint: shoulder, kinetic: {dry}, width: 0.1 }}
  oil: {{ type: viscous, joints: all, damping: {dry} }}
  rotor_of_waist: {{ type: rotor, joint: waist, inertia: 0.0002, ratio: {ratio} }}
  wire: {{ type: spring, joint: slide, stiffness: {{ parameter: wire_stiffness, value: 40 }} }}
",
        c = 0.01 * scale,
        dry = 1.5 * scale,
        ratio = 60.0 * scale,
    )
}

const LAWS: [(&str, f64, f64); 3] = [
    ("waist", 90.0, 12.0),
    ("shoulder", 70.0, 9.0),
    ("slide", 400.0, 31.0),
];
/// The target begins at FROM and moves at RATE.
const FROM: f64 = 0.375;
const RATE: f64 = 0.75;

fn inputs() -> String {
    let law = |(joint, k, d): (&str, f64, f64)| {
        format!(
            "  {joint}: {{ computed_torque: {{ target: {{ ramp: {{ from: {FROM}, rate: {RATE} }} }}, stiffness: {k}, damping: {d} }} }}\n"
        )
    };
    format!("inputs:\n{}", LAWS.map(law).concat())
}

fn scene(effects: &str, more: &str) -> String {
    format!(
        "scene: 1\nmechanism: plant.yaml\neffects: [{effects}]\n{}{more}",
        inputs()
    )
}

fn try_read(text: &str) -> Result<SceneEquations, Refusal> {
    let load = |path: &str| match path {
        "plant.yaml" => Ok(arm(1.0, "0.3")),
        "nominal.yaml" => Ok(arm(1.25, "0.35")),
        "broken.yaml" => Ok(arm(1.25, "0.35").replace("2.5", "x").replace("3.1", "-3")),
        "renamed.yaml" => Ok(arm(1.0, "0.3").replace("waist", "column_turn")),
        _ => Err("there is no such file".into()),
    };
    read_scene(text, "run", load).map(|(system, _)| system)
}

fn read(text: &str) -> SceneEquations {
    try_read(text).unwrap_or_else(|refusal| panic!("{}", told(&refusal, text)))
}

/// The efforts of the controllers of a scene.
fn controlled(system: &SceneEquations, at: &Inputs<Dd>) -> Vec<Dd> {
    let (values, _) = system.function(SceneFunction::Inputs).evaluate(at.clone());
    values
}

/// The efforts that a scene needs at the accelerations of the laws, by the literal sum. Its layout has the joints of the
/// laws only.
fn needed(system: &SceneEquations, at: &Inputs<Dd>) -> Vec<Dd> {
    let number = Dd::from_f64;
    let t = at.t.expect("a time");
    let a = LAWS.iter().enumerate().map(|(j, &(_, k, d))| {
        let error = number(FROM) + number(RATE) * t - at.q[j];
        error * number(k) + (number(RATE) - at.v[j]) * number(d)
    });
    let at = Inputs {
        a: a.collect(),
        ..at.clone()
    };
    system.literal_inverse().evaluate(at).0
}

fn assert_equal(found: &[Dd], wanted: &[Dd], what: &str) {
    assert_eq!(found.len(), wanted.len(), "{what}");
    let size = wanted.iter().fold(1.0, |s: f64, w| s.max(w.to_f64().abs()));
    for (i, (f, w)) in found.iter().zip(wanted).enumerate() {
        let off = (*f - *w).to_f64().abs();
        assert!(off < 1e-26 * size, "{what}, {i}: {off:e} of {size:e}");
    }
}

const ALL: &str = "gravity, inertia, velocity_products, dry, smooth, oil, rotor_of_waist, wire";

/// Another mechanism, and other effects: at random states with several effects at once.
#[test]
fn efforts_are_those_of_the_model() {
    for (effects, believed) in [
        (ALL, ALL),
        (ALL, "gravity, inertia, velocity_products"),
        (ALL, "gravity: [0, 0.1, -9.7], inertia, smooth, wire"),
        (
            "gravity, dry, inertia, oil",
            "inertia, dry, smooth, rotor_of_waist",
        ),
    ] {
        for mechanism in ["plant.yaml", "nominal.yaml"] {
            let list = format!(
                "[{}]",
                believed.replace("gravity: [0, 0.1, -9.7]", "{ gravity: [0, 0.1, -9.7] }")
            );
            let model =
                format!("controller_model: {{ mechanism: {mechanism}, effects: {list} }}\n");
            let plant = read(&scene(effects, &model));
            let alone = scene("", "")
                .replace("[]", &list)
                .replace("plant.yaml", mechanism);
            let alone = read(&alone);
            let mut random = Random(11);
            for slipping in [true, false] {
                let mut at = state(&plant, &mut random, slipping);
                at.t = Some(Dd::from_f64(random.signed()));
                let mut measured = at.clone();
                // The parameters of the plant are none of the controllers'.
                measured.parameters = values(&alone);
                at.parameters = at
                    .parameters
                    .iter()
                    .map(|&p| p * Dd::from_f64(1.7))
                    .collect();
                measured.modes.truncate(alone.scene.layout.modes.len());
                let wanted = needed(&alone, &measured);
                let what = format!("{effects} / {mechanism}: {believed}");
                assert_equal(&controlled(&plant, &at), &wanted, &what);
                // The machine is another one, or the test would see nothing.
                let own = needed(&plant, &at);
                assert!((own[0] - wanted[0]).to_f64().abs() > 1e-3, "{what}");
            }
        }
    }
}

fn values(system: &SceneEquations) -> Vec<Dd> {
    system.scene.parameters.iter().map(|p| p.default).collect()
}

/// Parameters of the model are numbers: those of the scene's file, of its own, or of the key.
#[test]
fn parameters_of_the_model_are_its_own() {
    let model = "controller_model: { parameters: { load: 4 kg, wire_stiffness: 25 N/m } }\n";
    let plant = read(&scene(ALL, model));
    let alone = read(&scene(ALL, ""));
    let names: Vec<&str> = alone
        .scene
        .parameters
        .iter()
        .map(|p| p.name.as_str())
        .collect();
    assert_eq!(names, ["load", "wire_stiffness"]);
    let mut random = Random(5);
    let mut at = state(&plant, &mut random, true);
    at.t = Some(Dd::from_f64(0.3));
    let believed = Inputs {
        parameters: vec![Dd::from_f64(4.0), Dd::from_f64(25.0)],
        ..at.clone()
    };
    let wanted = needed(&alone, &believed);
    assert_equal(&controlled(&plant, &at), &wanted, "parameters");
    // What a study sets is the machine.
    let load = plant
        .scene
        .override_named("parameter", "load", |k| k.is_parameter());
    let heavy = plant.with_overrides(&[(load.expect("a parameter"), Dd::from_f64(9.0))]);
    let heavy = heavy.expect("a heavy load");
    assert_eq!(values(&heavy)[0].to_f64(), 9.0);
    at.parameters = values(&heavy);
    assert_equal(
        &controlled(&heavy, &at),
        &wanted,
        "after a change of the machine",
    );
}

/// Locked joints are locked in the model, and the acceleration of the machine is that of the model where both agree.
#[test]
fn an_equal_model_is_the_scene() {
    for lock in ["", "lock: { slide: 0.1 }\n"] {
        let text = |more: &str| {
            let text = scene(ALL, &format!("{lock}{more}"));
            match lock.is_empty() {
                true => text,
                false => {
                    let lines = text.lines().filter(|line| !line.starts_with("  slide:"));
                    let text: Vec<&str> = lines.collect();
                    text.join("\n").replace(", wire", "") + "\n"
                }
            }
        };
        let [plain, with] =
            ["", "controller_model: { mechanism: plant.yaml }\n"].map(|m| read(&text(m)));
        let mut random = Random(3);
        let at = state(&plain, &mut random, true);
        let at = Inputs {
            t: Some(Dd::ZERO),
            ..at
        };
        assert_equal(&controlled(&with, &at), &controlled(&plain, &at), lock);
    }
}

/// A machine with an elastic drive under a rigid model: fewer states, found by name.
#[test]
fn a_model_may_have_fewer_states() {
    let bristle = "sticky: { type: lugre, joint: slide, kinetic: 1, static: 2, stribeck_speed: 0.01, stiffness: 1000, damping: 10 }";
    let plant = scene(
        &format!("{bristle}, {ALL}"),
        "controller_model: { effects: [gravity, inertia, dry] }\n",
    )
    .replace(&format!("[{bristle}"), &format!("[{{ {bristle} }}"));
    let plant = read(&plant);
    assert_eq!(plant.scene.layout.states.len(), 1);
    let alone = read(&scene("gravity, inertia, dry", ""));
    let mut random = Random(8);
    let mut at = state(&plant, &mut random, true);
    at.t = Some(Dd::ZERO);
    let measured = Inputs {
        x: vec![],
        parameters: values(&alone),
        ..at.clone()
    };
    let wanted = needed(&alone, &measured);
    assert_equal(&controlled(&plant, &at), &wanted, "without the bristle");
    // An ablated scene keeps its controllers.
    let fewer = plant.scene.with_effects(|element| element.name != "sticky");
    assert!(fewer.controller_model.is_some());
    let without_mode = plant.scene.with_effects(|element| element.name != "dry");
    assert!(without_mode.controller_model.is_none());
}

#[test]
fn refused() {
    for (effects, model, wanted) in [
        (
            "inertia",
            "{ mechanism: none.yaml }",
            "run.yaml:8:32: controller_model.mechanism: in the model of the controllers: the mechanism `none.yaml` cannot be read: there is no such file [no-mechanism]",
        ),
        (
            "inertia",
            "{ effects: [inertia, dry] }",
            "the model of the controllers has the mode `dry`, which the scene does not have [controller-model]",
        ),
        (
            "inertia",
            "{ effects: [inertia, rust] }",
            "in the model of the controllers: no effect",
        ),
        (
            "inertia",
            "{ parameters: { lod: 3 } }",
            "in the model of the controllers: no run-time parameter is called `lod`: did you mean `load`? [unknown-name]",
        ),
        (
            "inertia",
            "{ parameters: { load: 3 m } }",
            "controller_model.parameters.load: `3 m` is a length; a mass belongs here",
        ),
        (
            "inertia",
            "{ mechanism: renamed.yaml }",
            "in the model of the controllers: ",
        ),
        ("inertia", "{ mechanisms: plant.yaml }", "mechanisms"),
        ("inertia", "nominal.yaml", "the model of the controllers"),
    ] {
        let text = scene(effects, &format!("controller_model: {model}\n"));
        let refusal = try_read(&text).expect_err(model);
        let shown = told(&refusal, &text).replace("scene.yaml", "run.yaml");
        assert!(shown.contains(wanted), "{model}\n{wanted}\n{shown}");
    }
    // Faults of the model's mechanism are those of its file.
    let text = scene("inertia", "controller_model: { mechanism: broken.yaml }\n");
    let Err(Refusal::Mechanism { path, faults, .. }) = try_read(&text) else {
        panic!("a broken mechanism");
    };
    assert_eq!(path, "broken.yaml");
    assert!(faults.count() >= 1);
    // Without a computed torque nobody reads the model.
    let text = "scene: 1\nmechanism: plant.yaml\neffects: [inertia]\ninputs: { waist: 2 }\ncontroller_model: { effects: [inertia] }\n";
    let refusal = try_read(text).expect_err("no computed torque");
    assert!(told(&refusal, text).contains("no input of the scene is a `computed_torque`"));
}
