//! Tests errors in scenes: all of them are reported at once, each with its location and advice.

use bgdyn_codegen::refusal::Refusal;

use super::common::{scene, told, try_scene};

const MECHANISM: &str = "\
format: 1
name: arm
links:
  - name: upper
    joint: { name: shoulder, type: revolute, axis: y }
    mass: 2
    com: [0.2, 0, 0]
  - name: lower
    parent: upper
    joint: { name: elbow, type: revolute, axis: y, origin: { xyz: [0.4, 0, 0] } }
    mass: 1
    com: [0.2, 0, 0]
  - name: hand
    parent: lower
    joint: { name: wrist, type: revolute, origin: { xyz: [0.3, 0, 0] } }
    mass: 0.1
effects:
  bearing: { type: viscous, joint: shoulder, damping: 0.3 }
  brake: { type: coulomb, joint: wrist, kinetic: 0.2 }
";

/// Returns the messages about a scene.
fn said(text: &str) -> String {
    match try_scene(text, MECHANISM) {
        Err(refusal) => told(&refusal, text),
        Ok((_, findings)) => findings.render("scene.yaml", text),
    }
}

#[test]
fn every_mistake_is_told_at_once() {
    let text = "\
scene: 2
mechanism: arm.yaml
lock: { wrist: 30 mm, ankle: 0 }
effects:
  - gravty
  - gravity: [0, 0]
  - inertia: spread
  - bearing: { type: spring }
  - brake
  - bearing
  - bearing
  - drag_1: { type: viscous, joint: sholder, damping: 0.1 }
  - drag_2: { type: viscous, joint: elbow, damping: -0.1 }
  - drag_3: { type: viscous, joint: elbow, damping: 0.1 N*s/m }
  - drag_4: { type: viscous, joint: elbow }
  - motor: { type: dc_motor, joint: elbow, resistance: 0, torque_constant: 0.1 }
  - shoulder: { type: spring, joint: elbow, stiffness: 1 }
inputs:
  sholder: 2
  elbow: { sawtooth: 2 }
  shoulder: { table: [[0, 1], [0, 2]] }
initial: { elbow: 3 m, elbow_speed: 1 }
outputs: [elbow, hnad]
integration: { method: magic, step: 0, end: 5 }
";
    insta::assert_snapshot!(said(text));
}

#[test]
fn a_method_and_what_its_steps_go_by_fit_together() {
    let mut told = String::new();
    for run in [
        "{ method: rk5 }",
        "{ method: gauss2, tolerance: 1e-6 }",
        "{ method: rodas4, step: 1 ms, tolerance: 1e-6 }",
        "{ method: dop853, tolerance: 0 }",
        "{ step: 1 ms, tolerance: 1 ms }",
    ] {
        let text =
            format!("scene: 1\nmechanism: arm.yaml\neffects: [inertia]\nintegration: {run}\n");
        told += &said(&text);
    }
    insta::assert_snapshot!(told);
}

#[test]
fn a_run_is_as_the_scene_says() {
    use bgdyn_codegen::scene::{Integration, IntegratorName, StepControl};
    use bgdyn_runtime::ImpactLaw;
    let run = |text: &str| {
        let text = format!("scene: 1\nmechanism: arm.yaml\neffects: [inertia]\n{text}");
        scene(&text, MECHANISM).scene.integration
    };
    let wanted = |method, step_control, end| Integration {
        method,
        step_control,
        end,
        impacts: ImpactLaw::Newton,
    };
    let usual = wanted(IntegratorName::Rk4, StepControl::Step(1e-3), 1.0);
    assert_eq!(run(""), usual);
    let text = "integration: { method: rodas4, end: 2 s }";
    let chosen = wanted(IntegratorName::Rodas4, StepControl::Tolerance(1e-8), 2.0);
    assert_eq!(run(text), chosen);
    let text = "integration: { method: dopri5, step: 2 ms }";
    assert_eq!(
        run(text),
        wanted(IntegratorName::Dopri5, StepControl::Step(2e-3), 1.0)
    );
    for method in IntegratorName::ALL {
        let text = format!("integration: {{ method: {} }}", method.name());
        assert_eq!(run(&text).method, method);
    }
}

#[test]
fn outputs_are_looked_up_last() {
    let text = "scene: 1\nmechanism: arm.yaml\neffects: [inertia]\noutputs: [elbow, hnad]\n";
    insta::assert_snapshot!(said(text));
}

#[test]
fn a_locked_joint_takes_no_effect() {
    let text = "scene: 1\nmechanism: arm.yaml\nlock: { wrist: 0 }\neffects: [gravity, brake]\n";
    insta::assert_snapshot!(said(text));
}

/// The hand is a point on its axis: with point masses it has no inertia about it.
#[test]
fn a_joint_without_inertia_is_named() {
    let text = "scene: 1\nmechanism: arm.yaml\neffects: [gravity]\n";
    insta::assert_snapshot!(said(text));
}

#[test]
fn a_mechanism_that_is_wrong_is_shown_as_it_is() {
    let text = "scene: 1\nmechanism: arm.yaml\n";
    let broken = MECHANISM
        .replace("damping: 0.3", "damping: -0.3")
        .replace("type: coulomb", "type: colomb");
    let Err(Refusal::Mechanism { path, faults, .. }) = try_scene(text, &broken) else {
        panic!("the mechanism is wrong");
    };
    assert_eq!(path, "arm.yaml");
    insta::assert_snapshot!(faults.render("arm.yaml", &broken));
}

#[test]
fn a_scene_is_told_by_its_first_key() {
    use bgdyn_codegen::format::is_scene;
    assert!(is_scene("# a comment\n\nscene: 1\nmechanism: x.yaml"));
    assert!(is_scene("{ \"scene\": 1, mechanism: x.yaml }"));
    assert!(!is_scene("format: 1\nscene: 1"));
    assert!(!is_scene(""));
}

/// If any line of a scene or of its mechanism is missing or truncated, a replacement module exists, with
/// each name once.
#[test]
fn every_refused_scene_has_a_stand_in() {
    use bgdyn_codegen::files::{beside, mechanism_of, stem};
    use bgdyn_codegen::interface::SceneInterface;
    let spoiled = |text: &str| -> Vec<String> {
        let lines: Vec<&str> = text.lines().collect();
        let without = |i: usize| [&lines[..i], &lines[i + 1..]].concat().join("\n");
        let cut = |i: usize| {
            let half = lines[i].chars().count() / 2;
            let half: String = lines[i].chars().take(half).collect();
            [&lines[..i], &[half.as_str()], &lines[i + 1..]]
                .concat()
                .join("\n")
        };
        (0..lines.len())
            .flat_map(|i| [without(i), cut(i)])
            .collect()
    };
    for path in super::common::specs() {
        let text = std::fs::read_to_string(&path).expect("a scene");
        let of = mechanism_of(&text).expect("a mechanism");
        let file = beside(&path, &of);
        let mechanism = std::fs::read_to_string(&file).expect("a mechanism");
        let named = stem(&file);
        let scenes = spoiled(&text).into_iter().map(|t| (t, mechanism.clone()));
        let mechanisms = spoiled(&mechanism).into_iter().map(|m| (text.clone(), m));
        for (text, mechanism) in scenes.chain(mechanisms) {
            let told = Some((mechanism.as_str(), named.as_str()));
            let guess = SceneInterface::guess(&text, "scene", told).expect("a stand-in");
            let layout = &guess.layout;
            let rates = layout.coordinates.iter().map(|c| &c.rate_name);
            let names = layout.coordinates.iter().map(|c| &c.name);
            let states = layout.states.iter().map(|s| &s.name);
            let mut all: Vec<&String> = names.chain(rates).chain(states).collect();
            let count = all.len();
            all.sort();
            all.dedup();
            assert_eq!(all.len(), count, "{text}\n{mechanism}");
            assert_eq!(guess.initial.q.len(), layout.nq());
            assert_eq!(guess.mode_coordinates.len(), layout.modes.len());
        }
    }
}

#[test]
fn a_sum_is_called_what_it_contains() {
    let mechanism =
        format!("{MECHANISM}constraints:\n  motor: {{ type: prescribed, joint: elbow }}\n");
    let told = |course: &str| {
        let text = format!(
            "scene: 1\nmechanism: arm.yaml\neffects: [inertia]\ninputs:\n  elbow: {course}\n"
        );
        match try_scene(&text, &mechanism) {
            Err(refusal) => told(&refusal, &text),
            Ok(_) => String::new(),
        }
    };
    let table = "{ table: [[0 s, 0], [1 s, 20 deg]] }";
    let step = "{ step: { before: 0, after: 1, time: 1 s } }";
    for (course, word) in [
        (table.to_owned(), "a table"),
        (format!("{{ sum: [1, {table}] }}"), "a table"),
        (step.to_owned(), "it jumps"),
        (format!("{{ sum: [{table}, {step}] }}"), "it jumps"),
    ] {
        let said = told(&course);
        assert!(
            said.contains("[prescribed-with-corners]") && said.contains(word),
            "{course}: {said}"
        );
    }
}
