//! Tests gears and series elasticity: their laws, and other effects on a drive.

use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;

use super::common::{scene, state, told, try_scene};
use super::laws;
use super::one::{BLOCK, MASS, Tried, close, refused, text};

/// The drive of the tests, K = 50, D = 3, N²J = 4·0.25 = 1 kg.
const DRIVE: &str = "drive: { type: series_elastic, joint: slide, stiffness: 50 N/m, damping: 3 N*s/m, inertia: 0.25 kg, ratio: 2 }";

fn with(effects: &[&str], more: &str) -> SceneEquations {
    scene(&text(effects, more), BLOCK)
}

#[test]
fn a_gear_loses_on_both_ways() {
    let gear = "it: { type: gear, joint: slide, efficiency: 0.8 }";
    let tried = Tried::new(with(&[gear], "inputs: { slide: given }\n"));
    for (v, u, wanted) in [
        (1.0, 3.0, 2.4),
        (-1.0, -3.0, -2.4),
        (-1.0, 3.0, 3.75),
        (1.0, -3.0, -3.75),
    ] {
        let mut at = tried.at(&[0.0], &[v], &[], &[u]);
        at.modes[0] = v;
        close(MASS * tried.rates(at.clone())[0], wanted);
        // The losses (u − τ) v are never negative.
        let power = tried.system.function(SceneFunction::Power);
        let (values, _) = power.evaluate(at);
        close(values[2], (u - wanted) * v);
        assert!(values[2] > 0.0);
    }
    laws::hold(&tried.system);
}

/// At rest a gear holds if neither η τ nor τ/η would move the joint; friction of its joint is added.
#[test]
fn a_gear_holds_its_joint_against_less_than_its_losses() {
    let gear = "it: { type: gear, joint: slide, efficiency: 0.8 }";
    let push = "push: { type: wrench, at: hook, components: [fx] }";
    let friction = "dry: { type: coulomb, joint: slide, kinetic: 0.5, static: 1 }";
    for (effects, own) in [(&[gear, push][..], 0.0), (&[gear, push, friction][..], 1.0)] {
        let tried = Tried::new(with(effects, "inputs: { slide: given, push_fx: given }\n"));
        let contacts = tried.system.function(SceneFunction::Contacts);
        // u and the push against it.
        for (u, push) in [
            (3.0, -3.0),
            (3.0, -2.0),
            (-3.0, 4.0),
            (3.0, -4.9),
            (0.0, 0.2),
        ] {
            let at = tried.at(&[0.0], &[0.0], &[], &[push, u]);
            assert_eq!(tried.rates(at.clone())[0], 0.0);
            let holding: f64 = -(u + push);
            let (less, more) = (0.8_f64 * u - u, u / 0.8 - u);
            let least = less.min(more) - own;
            let most = less.max(more) + own;
            let (rows, _) = contacts.evaluate(at);
            for row in rows.chunks(4) {
                close(row[2], holding);
                close(row[3], (holding - least).min(most - holding));
            }
        }
    }
    laws::hold(&with(
        &[gear, push, friction],
        "inputs: { slide: given, push_fx: given }\n",
    ));
}

#[test]
fn a_drive_turns_its_joint_through_a_spring() {
    let tried = Tried::new(with(&[DRIVE], "inputs: { drive: given, slide: given }\n"));
    for [q, angle, v, rate, motor, own] in [
        [0.1, 0.3, 1.0, -0.5, 7.0, 2.0],
        [0.0, -0.2, 0.0, 4.0, 0.0, -1.0],
    ] {
        let effort = 50.0 * (angle - q) + 3.0 * (rate - v);
        let rates = tried.rates(tried.at(&[q, angle], &[v, rate], &[], &[motor, own]));
        close(rates[0], (effort + own) / MASS);
        close(rates[1], motor - effort);
    }
    laws::hold(&tried.system);
}

/// A drive starts without deflection, unless the scene gives its position.
#[test]
fn a_drive_starts_where_its_joint_starts() {
    let system = with(
        &[DRIVE],
        "initial: { slide: 0.2 m, slide_rate: 0.7 m/s, drive_rate: 0.1 m/s }\n",
    );
    let start = |x: &[bgdyn_runtime::Dd]| x.iter().map(|x| x.to_f64()).collect::<Vec<_>>();
    assert_eq!(start(&system.initial.q), [0.2, 0.2]);
    assert_eq!(start(&system.initial.v), [0.7, 0.1]);
}

/// Motors, friction, stops, gears and inputs reach the drive's coordinate.
#[test]
fn what_acts_on_a_drive_balances() {
    let effects = [
        DRIVE,
        "motor: { type: dc_motor, joint: drive, resistance: 0.5, inductance: 1 mH, torque_constant: 0.3, ratio: 3 }",
        "losses: { type: stribeck, joint: drive, kinetic: 1 N, static: 2 N, stribeck_speed: 0.2, width: 0.01, damping: 0.3 }",
        "ends: { type: stop, joint: drive, lower: -0.1, upper: 0.1, stiffness: 1e3, restitution: 0.3, impact_speed: 1 }",
        "gear: { type: gear, joint: drive, efficiency: 0.7 }",
    ];
    laws::hold(&with(&effects, "inputs: { drive: given }\n"));
}

/// Dry friction holds a drive: its spring then ends at a wall.
#[test]
fn dry_friction_holds_a_drive() {
    let friction = "hold: { type: coulomb, joint: drive, kinetic: 5 N, reference: table }";
    let system = with(&[DRIVE, friction], "inputs: { drive: given }\n");
    laws::hold(&system);
    let tried = Tried::new(system);
    let contacts = tried.system.function(SceneFunction::Contacts);
    // Inputs in the scene's order.
    let inputs = tried.system.scene.layout.inputs.iter();
    let names: Vec<&str> = inputs.map(|i| i.name.as_str()).collect();
    assert_eq!(names, ["table_rate", "table_acceleration", "drive"]);
    let (speed, acceleration, motor) = (0.5, 2.0, 1.0);
    let at = tried.at(
        &[0.1, 0.3],
        &[0.2, speed],
        &[],
        &[speed, acceleration, motor],
    );
    let effort = 50.0 * (0.3 - 0.1) + 3.0 * (speed - 0.2);
    let rates = tried.rates(at.clone());
    close(rates[0], effort / MASS);
    close(rates[1], acceleration);
    let (contact, _) = contacts.evaluate(at);
    let holding: f64 = acceleration - motor + effort;
    let wanted = [0.0, 0.0, holding, 5.0 - holding.abs()];
    for (got, wanted) in contact.iter().zip(wanted) {
        close(*got, wanted);
    }
}

/// Computed torque on a drive: N²J a + τ at the acceleration that the controller demands.
#[test]
fn a_controller_follows_a_drive() {
    let controller =
        "inputs: { drive: { computed_torque: { target: 0.4, stiffness: 100, damping: 20 } } }\n";
    let tried = Tried::new(with(&[DRIVE], controller));
    let input = tried.system.function(SceneFunction::Inputs);
    let (values, _) = input.evaluate(tried.at(&[0.1, 0.3], &[0.2, -0.5], &[], &[0.0]));
    let wanted = 100.0 * (0.4 - 0.3) + 20.0 * 0.5;
    close(values[0], wanted + 50.0 * 0.2 + 3.0 * -0.7);
}

#[test]
fn what_gears_and_drives_refuse() {
    refused(&[
        (
            "it: { type: gear, joint: slide, efficiency: 0 }",
            "0 }",
            "effect-sign",
            "`efficiency` is 0: it must be greater than 0",
        ),
        (
            "it: { type: gear, joint: slide, efficiency: 1.1 }",
            "1.1",
            "effect-sign",
            "`efficiency` is 1.1: it must be at most 1",
        ),
        (
            "it: { type: dc_motor, joint: slide, resistance: 1, torque_constant: 1, efficiency: 1.1 }",
            "1.1",
            "effect-sign",
            "`efficiency` is 1.1: it must be at most 1",
        ),
        (
            "it: { type: series_elastic, joint: slide, stiffness: 0, inertia: 1 }",
            "0, ine",
            "effect-sign",
            "`stiffness` is 0: it must be greater than 0",
        ),
        (
            "it: { type: series_elastic, joint: slide, stiffness: 9, inertia: 0 }",
            "0 }",
            "effect-sign",
            "`inertia` is 0: it must be greater than 0",
        ),
        (
            "it: { type: series_elastic, joint: slide, stiffness: 9, inertia: 1, ratio: -3 }",
            "-3",
            "effect-sign",
            "`ratio` is -3: it must be greater than 0",
        ),
        (
            "it: { type: series_elastic, joint: slide, stiffness: 9, inertia: 1, damping: -3 }",
            "-3",
            "effect-sign",
            "`damping` is -3: it must not be negative",
        ),
        (
            "it: { type: series_elastic, joint: slid, stiffness: 9, inertia: 1 }",
            "slid,",
            "unknown-name",
            "slide",
        ),
    ]);
}

/// Effects without influence, or with an undefined one.
#[test]
fn second_gears_and_rotors_of_drives_are_refused() {
    let gears = [
        "one: { type: gear, joint: slide, efficiency: 0.8 }",
        "two: { type: gear, joint: slide, efficiency: 0.9 }",
    ];
    let rotor = [DRIVE, "rotor: { type: rotor, joint: drive, inertia: 1 kg }"];
    let cases = [
        (gears, "scene.yaml:5:5: ", "[repeated-effect]"),
        (rotor, "scene.yaml:5:34: ", "[unknown-name]"),
    ];
    for (effects, place, rule) in cases {
        let text = text(&effects, "");
        let refusal = try_scene(&text, BLOCK).expect_err("a refusal");
        let shown = told(&refusal, &text);
        assert!(shown.starts_with(place) && shown.contains(rule), "{shown}");
    }
}

/// Inertia and ratio of a rotor as run-time parameters give the same results as constants.
#[test]
fn a_rotors_numbers_may_be_run_time_parameters() {
    const ARM: &str = "\
format: 1
links:
  - name: upper
    joint: { name: shoulder, type: revolute, axis: y }
    mass: 2
    com: [0.2, 0, 0.1]
    inertia: { xx: 0.02, yy: 0.03, zz: 0.03 }
  - name: lower
    parent: upper
    joint: { name: elbow, type: revolute, axis: [0.3, 0, 1], origin: { xyz: [0.4, 0, 0] } }
    mass: 1
    com: [0.2, 0.05, 0]
    inertia: { xx: 0.01, yy: 0.01, zz: 0.01 }
";
    let made = |inertia: &str, ratio: &str| {
        let rotor = format!(
            "{{ type: rotor, joint: elbow, inertia: {inertia}, ratio: {ratio}, on: upper, axis: [1, 2, 0] }}"
        );
        let text = format!(
            "scene: 1\nmechanism: arm.yaml\neffects: [inertia, velocity_products, gravity, motor: {rotor}]\n"
        );
        scene(&text, ARM)
    };
    let known = made("2e-4", "40");
    let open = made(
        "{ parameter: rotor_inertia, value: 1e-4 }",
        "{ parameter: gear_ratio, value: 50 }",
    );
    let names = open.scene.parameters.iter().map(|p| p.name.as_str());
    assert_eq!(names.collect::<Vec<_>>(), ["rotor_inertia", "gear_ratio"]);
    super::forms::hold(&open);
    super::laws::hold(&open);
    for seed in 0..10 {
        let at = state(&known, &mut Random(seed), true);
        let mut set = at.clone();
        set.parameters = ["2e-4", "40"]
            .map(|x| x.parse().expect("a number"))
            .to_vec();
        for role in [
            SceneFunction::Derivative,
            SceneFunction::Inverse,
            SceneFunction::Power,
        ] {
            let wanted: Vec<Dd> = known.function(role).evaluate(at.clone()).0;
            let found: Vec<Dd> = open.function(role).evaluate(set.clone()).0;
            for (found, wanted) in found.iter().zip(&wanted) {
                let off = (*found - *wanted).to_f64().abs();
                assert!(
                    off < 1e-24 * wanted.to_f64().abs().max(1.0),
                    "{role:?}: {off:e}"
                );
            }
        }
    }
}
