//! What a scene leaves out costs nothing: its module is that of a mechanism that never had it.

use bgdyn_codegen::effect::EFFECTS;
use bgdyn_codegen::emit::{Place, scene_module};
use bgdyn_codegen::method::Role;
use bgdyn_codegen::model::scene_functions;
use bgdyn_codegen::system::System;

use super::common::{Random, scene, state};

/// A turning and a sliding joint; `inertia` and `gravity` may be left out, `effects` follow.
fn mechanism(gravity: &str, inertia: &str, effects: &str) -> String {
    format!(
        "format: 1\nname: m\n{gravity}\nlinks:\n\
         \x20 - name: arm\n    joint: {{ name: turn, type: revolute, axis: y }}\n\
         \x20   mass: 2\n    com: [0.3, 0.1, 0]\n{inertia}\
         \x20 - name: sled\n    parent: arm\n\
         \x20   joint: {{ name: slide, type: prismatic, axis: x, origin: {{ xyz: [0.5, 0, 0] }}, limits: {{ lower: -0.2, upper: 0.2 }} }}\n\
         \x20   mass: 1\n    com: [0, 0.2, 0]\n\
         frames:\n  - {{ name: tip, link: sled, origin: {{ xyz: [0.1, 0, 0] }} }}\n  - {{ name: anchor, link: world, origin: {{ xyz: [0, 0, 1] }} }}\n{effects}"
    )
}

const TENSOR: &str = "    inertia: { xx: 0.1, yy: 0.12, zz: 0.05, xy: 0.01 }\n";

const ALL: &str = "scene: 1\nmechanism: m.yaml\neffects: [gravity, inertia, velocity_products]\ninputs: { turn: given, slide: given }\n";

/// How each effect that a file declares is written.
const WRITTEN: &[(&str, &str)] = &[
    ("viscous", "{ type: viscous, joint: turn, damping: 0.4 }"),
    (
        "coulomb",
        "{ type: coulomb, joint: slide, kinetic: 3, static: 4 }",
    ),
    (
        "lugre",
        "{ type: lugre, joint: slide, stiffness: 1e5, damping: 300, viscous: 300, kinetic: 1, static: 1.5, stribeck_speed: 0.001 }",
    ),
    (
        "coulomb_smooth",
        "{ type: coulomb_smooth, joint: slide, kinetic: 3, width: 0.01 }",
    ),
    (
        "stribeck",
        "{ type: stribeck, joint: turn, kinetic: 3, static: 4, stribeck_speed: 0.1, width: 0.01 }",
    ),
    ("spring", "{ type: spring, joint: slide, stiffness: 50 }"),
    (
        "damper",
        "{ type: damper, between: [anchor, tip], damping: 5 }",
    ),
    (
        "stop",
        "{ type: stop, joint: slide, stiffness: 1e4, restitution: 0.5, impact_speed: 1 }",
    ),
    (
        "series_elastic",
        "{ type: series_elastic, joint: turn, stiffness: 90, inertia: 1e-4, ratio: 50 }",
    ),
    ("gear", "{ type: gear, joint: turn, efficiency: 0.9 }"),
    (
        "rotor",
        "{ type: rotor, joint: turn, inertia: 1e-4, ratio: 50 }",
    ),
    (
        "dc_motor",
        "{ type: dc_motor, joint: turn, resistance: 1, inductance: 1e-3, torque_constant: 0.05, ratio: 50 }",
    ),
    ("wrench", "{ type: wrench, at: tip }"),
    ("drag", "{ type: drag, at: tip, linear: 3 }"),
    ("payload", "{ type: payload, at: tip, mass: 2 kg }"),
    ("fluid", CIRCUIT),
    ("supply", CIRCUIT),
    ("tank", CIRCUIT),
    ("line", CIRCUIT),
    ("junction", CIRCUIT),
    ("cylinder", CIRCUIT),
    ("orifice", CIRCUIT),
    ("leakage", CIRCUIT),
    ("four_way_valve", CIRCUIT),
];

/// Hydraulics act together: a cylinder between a valve and a pump, with everything there is.
const CIRCUIT: &str = "{ type: fluid, bulk_modulus: 1 GPa }
  pump: { type: supply, pressure: 16 MPa }
  sump: { type: tank }
  hose: { type: line, volume: 2 cm^3 }
  knee: { type: junction }
  first: { type: orifice, from: pump, to: knee, flow: 2e-7 }
  second: { type: orifice, from: knee, to: hose, flow: 2e-7 }
  valve: { type: four_way_valve, supply: hose, tank: sump, a: ram_a, b: ram_b, flow: 2e-7 }
  gap: { type: leakage, from: ram_a, to: ram_b, conductance: 4e-12 }
  ram: { type: cylinder, joint: slide, area_a: 8 cm^2, area_b: 8 cm^2, dead_a: 300 cm^3, dead_b: 300 cm^3, stroke: 0.4 m, offset: -0.2 m }";

/// The names of what `written` declares.
fn names(written: &str) -> String {
    let others = written.lines().skip(1).filter_map(|l| l.split(':').next());
    let names: Vec<&str> = others.map(str::trim).collect();
    ["extra"]
        .into_iter()
        .chain(names)
        .collect::<Vec<_>>()
        .join(", ")
}

fn text(system: &System) -> String {
    let place = Place::source_text("scene.yaml".into());
    scene_module(system, &scene_functions(system), &place).to_string()
}

#[test]
fn an_effect_that_is_not_called_for_leaves_no_trace() {
    for effect in EFFECTS.iter().filter(|e| !e.built_in()) {
        let keyword = effect.keyword();
        let written = WRITTEN.iter().find(|(k, _)| *k == keyword);
        let (_, written) = written.unwrap_or_else(|| panic!("no example of `{keyword}`"));
        let declared = format!("effects:\n  extra: {written}\n");
        let (with, without) = (mechanism("", TENSOR, &declared), mechanism("", TENSOR, ""));
        assert_eq!(
            text(&scene(ALL, &with)),
            text(&scene(ALL, &without)),
            "{keyword}"
        );
        // Called for, it is there.
        let all = format!("velocity_products, {}]", names(written));
        let called = text(&scene(&ALL.replace("velocity_products]", &all), &with));
        assert_ne!(called, text(&scene(ALL, &without)), "{keyword}");
    }
}

#[test]
fn what_every_mechanism_has_leaves_no_trace_either() {
    let lumped = ALL.replace("inertia, ", "");
    let (with, without) = (mechanism("", TENSOR, ""), mechanism("", "", ""));
    assert_eq!(
        text(&scene(&lumped, &with)),
        text(&scene(&lumped, &without))
    );
    let weightless = ALL.replace("gravity, ", "");
    let none = mechanism("gravity: [0, 0, 0]", TENSOR, "");
    assert_eq!(
        text(&scene(&weightless, &with)),
        text(&scene(&weightless, &none))
    );
    // Without velocity products no velocity is read but to say how the positions change.
    let quasi_static = scene(&ALL.replace(", velocity_products", ""), &with);
    let body = quasi_static.function(Role::Derivative);
    let reads = bgdyn_codegen::expr::reachable(&body.graph, &body.blocks[0].outputs);
    let leaf = |i: usize| body.graph.node(bgdyn_codegen::expr::NodeId::at(i));
    let velocities = (0..reads.len()).filter(|&i| {
        use bgdyn_codegen::expr::{Leaf, Node};
        reads[i] && matches!(leaf(i), Node::Leaf(Leaf::Velocity(_)))
    });
    assert_eq!(velocities.count(), 0);
}

/// Effects that only add an effort, with a constant zero in them, are not there; with a run-time
/// parameter at zero they change nothing but the last digits.
#[test]
fn a_strength_of_zero_changes_nothing() {
    let plain = scene(ALL, &mechanism("", TENSOR, ""));
    let derivative = plain.function(Role::Derivative);
    for (kind, key, written) in [
        (
            "viscous",
            "damping",
            "{ type: viscous, joint: turn, damping: VALUE }",
        ),
        (
            "spring",
            "stiffness",
            "{ type: spring, joint: slide, stiffness: VALUE }",
        ),
        (
            "damper",
            "damping",
            "{ type: damper, between: [anchor, tip], damping: VALUE }",
        ),
        (
            "coulomb_smooth",
            "kinetic",
            "{ type: coulomb_smooth, joint: turn, kinetic: VALUE, width: 0.1 }",
        ),
    ] {
        let called = |value: &str| {
            let declared = format!("effects:\n  extra: {}\n", written.replace("VALUE", value));
            let text = ALL.replace("velocity_products]", "velocity_products, extra]");
            scene(&text, &mechanism("", TENSOR, &declared))
        };
        let zero = called("0").function(Role::Derivative);
        let open = called("{ parameter: strength, value: 0 }");
        let parametric = open.function(Role::Derivative);
        for seed in 0..50 {
            let exact = state(&open, &mut Random(seed), true);
            let inputs = bgdyn_codegen::expr::Inputs {
                q: exact.q.iter().map(|x| x.to_f64()).collect(),
                v: exact.v.iter().map(|x| x.to_f64()).collect(),
                u: exact.u.iter().map(|x| x.to_f64()).collect(),
                parameters: vec![0.0],
                t: Some(0.0),
                ..Default::default()
            };
            let wanted: Vec<f64> = derivative.evaluate(inputs.clone()).0;
            let found: Vec<f64> = zero.evaluate(inputs.clone()).0;
            assert_eq!(found, wanted, "{kind} with {key} 0");
            let found: Vec<f64> = parametric.evaluate(inputs).0;
            for (x, y) in found.iter().zip(&wanted) {
                let size = wanted.iter().fold(0.0_f64, |m, w| m.max(w.abs()));
                assert!(
                    (x - y).abs() <= 4.0 * f64::EPSILON * size,
                    "{kind}: {x} and {y}"
                );
            }
        }
    }
}
