//! Tests modes at the start of a scene: determined if missing, refused if contradictory.

use super::common::{scene, told, try_scene};
use super::one::text;
use bgdyn_codegen::system::SceneEquations;

/// 2 kg on a vertical slide.
const BLOCK: &str = "format: 1\nlinks:\n  - name: block\n    joint: { name: slide, type: prismatic, axis: z }\n    mass: 2 kg\n";

const FRICTION: &str = "grip: { type: coulomb, joint: slide, kinetic: 3 N, static: 5 N }";
const MOTOR: &str = "it: { type: dc_motor, joint: slide, resistance: 2, inductance: 1 mH, torque_constant: 0.5, current_limit: 4 }";

fn falling(more: &str) -> String {
    text(&["gravity", FRICTION], more)
}

fn modes(text: &str) -> Vec<f64> {
    let system: SceneEquations = scene(text, BLOCK);
    system.initial.modes.iter().map(|m| m.to_f64()).collect()
}

#[test]
fn modes_that_are_left_out_agree_with_the_state() {
    // 19.6 N of weight against 5 N.
    assert_eq!(modes(&falling("")), [-1.0]);
    assert_eq!(modes(&falling("initial: { slide_rate: 2 }\n")), [1.0]);
    assert_eq!(modes(&text(&[FRICTION], "")), [0.0]);
    assert_eq!(
        modes(&text(&[FRICTION], "initial: { slide_rate: -1e-3 }\n")),
        [-1.0]
    );
    // Inputs that the scene drives are used, inputs of the caller are taken as 0.
    let driven = "inputs: { slide: { constant: 6 N } }\n";
    assert_eq!(modes(&text(&[FRICTION], driven)), [1.0]);
    assert_eq!(
        modes(&text(&[FRICTION], "inputs: { slide: given }\n")),
        [0.0]
    );
    // A current below its limits, at the upper one under a voltage that holds it, beyond it.
    let current = |at: f64, volts: f64| {
        let more = format!(
            "inputs: {{ it: {{ constant: {volts} V }} }}\ninitial: {{ it_current: {at} A }}\n"
        );
        modes(&text(&[MOTOR], &more))
    };
    assert_eq!(current(1.0, 24.0), [-1.0, 1.0]);
    assert_eq!(current(4.0, 24.0), [0.0, 1.0]);
    assert_eq!(current(4.0, 7.9), [-1.0, 1.0]);
    assert_eq!(current(-4.0, -8.1), [-1.0, 0.0]);
    assert_eq!(current(6.0, 24.0), [1.0, 1.0]);
}

#[test]
fn a_mode_that_agrees_may_be_stated() {
    assert_eq!(modes(&falling("initial: { grip_mode: -1 }\n")), [-1.0]);
    let pushed = "inputs: { slide: given }\ninitial: { grip_mode: 1 }\n";
    // Whether it slips depends on the caller.
    assert_eq!(modes(&text(&[FRICTION], pushed)).len(), 1);
}

#[test]
fn a_stated_mode_that_contradicts_is_refused_with_its_place_and_the_numbers() {
    let cases = [
        (
            falling("initial: { slide_rate: 2, grip_mode: 0 }\n"),
            "`grip_mode` begins with 0, but `slide_rate` begins with 2 m/s against its counterpart: its mode is 1",
        ),
        (
            falling("initial: { slide_rate: 2, grip_mode: -1 }\n"),
            "`grip_mode` begins with -1, but `slide_rate` begins with 2 m/s against its counterpart: its mode is 1",
        ),
        (
            falling("initial: { grip_mode: 0 }\n"),
            "`grip_mode` begins with 0, but holding takes 19.62 N, 14.62 N more than it can hold: its mode is -1",
        ),
        (
            text(&[FRICTION], "initial: { grip_mode: 1 }\n"),
            "`grip_mode` begins with 1, but at rest it is held: that takes 0 N: its mode is 0",
        ),
    ];
    let limited = [
        (
            1.0,
            24.0,
            "upper_limit_mode: 0",
            "`it_upper_limit_mode` begins with 0, but `it_current` begins with 1 A and its limit is 4 A: its mode is -1",
        ),
        (
            1.0,
            24.0,
            "lower_limit_mode: 0",
            "`it_lower_limit_mode` begins with 0, but `it_current` begins with 1 A and its limit is -4 A: its mode is 1",
        ),
        (
            4.0,
            24.0,
            "upper_limit_mode: -1",
            "`it_upper_limit_mode` begins with -1, but `it_current` begins at its limit and is held there: its mode is 0",
        ),
        (
            4.0,
            7.9,
            "upper_limit_mode: 0",
            "`it_upper_limit_mode` begins with 0, but `it_current` begins at its limit and leaves it: its mode is -1",
        ),
    ];
    let limited = limited.map(|(current, volts, mode, wanted)| {
        let more = format!(
            "inputs: {{ it: {{ constant: {volts} V }} }}\ninitial: {{ it_current: {current} A, it_{mode} }}\n"
        );
        (text(&[MOTOR], &more), wanted)
    });
    for (text, wanted) in cases.into_iter().chain(limited) {
        let Err(refusal) = try_scene(&text, BLOCK) else {
            panic!("not refused: {text}");
        };
        let told = told(&refusal, &text);
        assert!(told.contains(wanted), "{told}");
        assert!(told.contains("initial"), "{told}");
    }
}
