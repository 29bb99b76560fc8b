//! Tests that the laws are satisfied for any combination of effects.

use super::common::scene;
use super::{forms, laws};
use bgdyn_codegen::random::Random;

/// An arm that swings and reaches, with a frame to pull at.
const ARM: &str = "\
format: 1
links:
  - name: arm
    joint: { name: swing, type: revolute, axis: y, limits: { lower: -5 deg, upper: 10 deg } }
    mass: 2
    com: [0.2, 0.05, -0.1]
    inertia: { xx: 0.02, yy: 0.05, zz: 0.04, xz: 0.003 }
  - name: slide
    parent: arm
    joint: { name: reach, type: prismatic, axis: x, origin: { xyz: [0.4, 0, 0.1] } }
    mass: 0.7
    com: [0.1, 0.02, 0]
    inertia: { xx: 0.002, yy: 0.003, zz: 0.003 }
frames:
  - { name: anchor, link: world, origin: { xyz: [0.1, 0.3, 0.5] } }
  - { name: hook, link: slide, origin: { xyz: [0.2, 0, 0.05] } }
";

/// Effects, each after the effects that it needs.
const EFFECTS: [&[&str]; 14] = [
    &["gravity"],
    &["velocity_products"],
    &["inertia: distributed"],
    &["rubbing: { type: viscous, joint: swing, damping: 0.3, reference: belt }"],
    &["dry: { type: coulomb, joint: reach, kinetic: 2 N, static: 3 N }"],
    &["smooth: { type: coulomb_smooth, joint: swing, kinetic: 0.4, width: 0.1, reference: belt }"],
    &[
        "curve: { type: stribeck, joint: reach, kinetic: 2 N, static: 3 N, stribeck_speed: 0.3, width: 0.05, damping: 0.2 }",
    ],
    &[
        "bristles: { type: lugre, joint: swing, stiffness: 1e4, damping: 100, viscous: 90, kinetic: 0.5, static: 0.8, stribeck_speed: 0.01 }",
    ],
    &["rope: { type: spring, between: [anchor, hook], stiffness: 80, rest: 0.2, reference: hand }"],
    &["oil: { type: damper, between: [anchor, hook], damping: 6 }"],
    &["ends: { type: stop, joint: swing, stiffness: 4e3, restitution: 0.4, impact_speed: 1 }"],
    &["gear: { type: gear, joint: reach, efficiency: 0.75 }"],
    &["rotor: { type: rotor, joint: swing, inertia: 2 kg*cm^2, ratio: 30 }"],
    &[
        "drive: { type: series_elastic, joint: swing, stiffness: 90, damping: 0.4, inertia: 3 kg*cm^2, ratio: 20 }",
        "held: { type: coulomb, joint: drive, kinetic: 0.6, static: 0.9 }",
        "motor: { type: dc_motor, joint: drive, resistance: 0.8, torque_constant: 0.05, ratio: 20, efficiency: 0.9 }",
    ],
];

/// Number of combinations.
const TRIED: u64 = 8;

#[test]
fn random_combinations_of_effects_balance() {
    let mut random = Random(7);
    for _ in 0..TRIED {
        let mut chosen: Vec<&str> = Vec::new();
        for effects in EFFECTS {
            if random.signed() > 0.0 {
                chosen.extend(effects);
            }
        }
        let list: Vec<String> = chosen.iter().map(|e| format!("  - {e}\n")).collect();
        let list = if list.is_empty() {
            "  - gravity\n".into()
        } else {
            list.concat()
        };
        let text = format!(
            "scene: 1\nmechanism: arm.yaml\neffects:\n{list}inputs: {{ swing: given, reach: given }}\n"
        );
        let system = scene(&text, ARM);
        laws::hold(&system);
        forms::hold(&system);
    }
}
