//! An arm with a prismatic sled, and every effect in the notation of files.

/// Returns a revolute and a prismatic joint; `inertia` and `gravity` may be empty, `effects` follow.
pub fn mechanism(gravity: &str, inertia: &str, effects: &str) -> String {
    format!(
        "format: 1\nname: m\n{gravity}\nlinks:\n\
         \x20 - name: arm\n    joint: {{ name: turn, type: revolute, axis: y }}\n\
         \x20   mass: 2\n    com: [0.3, 0.1, 0]\n{inertia}\
         \x20 - name: sled\n    parent: arm\n\
         \x20   joint: {{ name: slide, type: prismatic, axis: x, origin: {{ xyz: [0.5, 0, 0] }}, limits: {{ lower: -0.2, upper: 0.2 }} }}\n\
         \x20   mass: 1\n    com: [0, 0.2, 0]\n\
         frames:\n  - {{ name: tip, link: sled, origin: {{ xyz: [0.1, 0, 0] }} }}\n  - {{ name: anchor, link: world, origin: {{ xyz: [0, 0, 1] }} }}\ncontacts:\n  tip_floor: {{ link: sled, at: [0.1, 0, 0], radius: 20 mm, on: floor }}\nplanes:\n  floor: {{ offset: -0.4 m }}\n{effects}"
    )
}

pub const TENSOR: &str = "    inertia: { xx: 0.1, yy: 0.12, zz: 0.05, xy: 0.01 }\n";

pub const ALL: &str = "scene: 1\nmechanism: m.yaml\neffects: [gravity, inertia, velocity_products]\ninputs: { turn: given, slide: given }\n";

/// The notation of each effect that a file declares.
pub const WRITTEN: &[(&str, &str)] = &[
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
        "orientation_spring",
        "{ type: orientation_spring, between: [anchor, tip], stiffness: 20, damping: 1 }",
    ),
    (
        "damper",
        "{ type: damper, between: [anchor, tip], damping: 5 }",
    ),
    (
        "stop",
        "{ type: stop, joint: slide, stiffness: 1e4, restitution: 0.5, impact_speed: 1 }",
    ),
    (
        "compliant_contact",
        "{ type: compliant_contact, contact: tip_floor, stiffness: 2e5, damping: 0.3, kinetic: 0.5, static: 0.6, stribeck_speed: 0.1, width: 0.01 }",
    ),
    (
        "rigid_contact",
        "{ type: rigid_contact, contact: tip_floor, friction: 0.5, restitution: 0.2 }",
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

/// Hydraulics act together: a cylinder between a valve and a pump, with all hydraulic elements.
pub const CIRCUIT: &str = "{ type: fluid, bulk_modulus: 1 GPa }
  pump: { type: supply, pressure: 16 MPa }
  sump: { type: tank }
  hose: { type: line, volume: 2 cm^3 }
  knee: { type: junction }
  first: { type: orifice, from: pump, to: knee, flow: 2e-7 }
  second: { type: orifice, from: knee, to: hose, flow: 2e-7 }
  valve: { type: four_way_valve, supply: hose, tank: sump, a: ram_a, b: ram_b, flow: 2e-7 }
  gap: { type: leakage, from: ram_a, to: ram_b, conductance: 4e-12 }
  ram: { type: cylinder, joint: slide, area_a: 8 cm^2, area_b: 8 cm^2, dead_a: 300 cm^3, dead_b: 300 cm^3, stroke: 0.4 m, offset: -0.2 m }";

/// Returns the names of the declarations in `written`.
pub fn names(written: &str) -> String {
    let others = written.lines().skip(1).filter_map(|l| l.split(':').next());
    let names: Vec<&str> = others.map(str::trim).collect();
    ["extra"]
        .into_iter()
        .chain(names)
        .collect::<Vec<_>>()
        .join(", ")
}
