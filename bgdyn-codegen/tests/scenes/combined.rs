//! Tests effects in random combinations: the laws are satisfied for every combination.

use bgdyn_codegen::random::Random;
use std::path::Path;

use super::common::scene;
use super::laws;

/// Possible effects of a crane, each with the effects that it needs.
const CHOICES: [&str; 12] = [
    "gravity",
    "inertia",
    "velocity_products",
    "slew_friction",
    "load",
    "wind: { type: drag, at: hook, linear: 3 N*s/m, quadratic: 5 N*s^2/m^2, angular: 1 N*m*s/rad }",
    "push: { type: wrench, at: extension, axes: link }",
    "pull: { type: wrench, at: hook, components: [fx, fz] }",
    "oil pump sump luff_ram luff_valve luff_leak",
    "oil pump sump fold_ram fold_valve",
    "oil sump reach_ram bleed: { type: orifice, from: reach_ram_a, to: sump, flow: 1e-8, opening: tap, resistance: 1e9 }",
    "oil pump hose: { type: line, volume: 10 cm^3 } tee: { type: junction } one: { type: orifice, from: pump, to: tee, flow: 1e-7 } two: { type: leakage, from: hose, to: tee, conductance: 1e-12 }",
];

/// Splits `oil tee: { type: junction } pump` into its entries.
fn entries(choice: &str) -> Vec<String> {
    let (mut found, mut depth) = (vec![String::new()], 0);
    let mut after_key = false;
    for c in choice.chars() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        if c == ' ' && depth == 0 && !after_key {
            found.push(String::new());
        } else if let Some(entry) = found.last_mut() {
            entry.push(c);
        }
        after_key = c == ':';
    }
    found.retain(|e| !e.is_empty());
    found
}

#[test]
fn effects_in_random_combinations_keep_the_laws() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/crane.yaml");
    let crane = std::fs::read_to_string(path).expect("the crane");
    let mut random = Random(17);
    for _ in 0..10 {
        let mut effects: Vec<String> = Vec::new();
        for choice in CHOICES {
            if random.signed() > 0.0 {
                let new = entries(choice).into_iter();
                let new: Vec<String> = new.filter(|e| !effects.contains(e)).collect();
                effects.extend(new);
            }
        }
        let list: Vec<String> = effects.iter().map(|e| format!("  - {e}\n")).collect();
        let text = format!(
            "scene: 1\nmechanism: crane.yaml\neffects:\n{}initial: {{ luff: 30 deg, fold: -35 deg, reach: 0.6 m }}\n",
            list.concat()
        );
        let text = text.replace("effects:\ninitial", "effects: []\ninitial");
        laws::hold(&scene(&text, &crane));
    }
}
