//! Tests the refusals of names in effects: of what does not exist, is fixed to the world, or is used twice.

use super::refused_bodies::{oil, plain, refused};

#[test]
fn names_that_join_nothing() {
    refused(
        &oil("cut: { type: orifice, from: pump, to: hoze, flow: 1e-7 }"),
        "unknown-name",
        "cut",
        &["`hoze`", "`hose`"],
    );
    refused(
        &oil("cut: { type: orifice, from: hose, to: hose, flow: 1e-7 }"),
        "joined-to-nothing",
        "cut",
        &["same node"],
    );
    refused(
        &oil(
            "sump: { type: tank }\nvalve: { type: four_way_valve, supply: pump, tank: sump, a: hose, b: hose, flow: 1e-7 }",
        ),
        "joined-to-nothing",
        "valve",
        &["`a` and `b`"],
    );
    refused(
        &oil("ram: { type: cylinder, area_a: 1 cm^2 }"),
        "effect-place",
        "ram",
        &["`joint`, `between`"],
    );
    refused(
        &plain("push: { type: wrench, at: anchor }"),
        "effect-place",
        "push",
        &["fixed to the world"],
    );
    refused(
        &plain("water: { type: drag, at: anchor, linear: 1 }"),
        "effect-place",
        "water",
        &["fixed to the world"],
    );
    refused(
        &plain("part: { type: payload, at: anchor, mass: 1 kg }"),
        "effect-place",
        "part",
        &["fixed to the world"],
    );
    refused(
        &plain("push: { type: wrench, at: lugg }"),
        "unknown-name",
        "push",
        &["`lug`"],
    );
    refused(
        &plain("push: { type: wrench, at: lug, axes: body }"),
        "unknown-name",
        "push",
        &["world, link"],
    );
    refused(
        &plain("push: { type: wrench, at: lug, components: [fx, fw] }"),
        "unknown-name",
        "push",
        &["`fw`"],
    );
    refused(
        &plain("push: { type: wrench, at: lug, components: [fx, fx] }"),
        "effect-components",
        "push",
        &["twice"],
    );
    refused(
        &plain("push: { type: wrench, at: lug, components: [] }"),
        "effect-components",
        "push",
        &["empty"],
    );
}

#[test]
fn names_that_stand_twice() {
    refused(
        &oil(
            "cut: { type: orifice, from: pump, to: hose, flow: 1e-7, opening: push_fx }\npush: { type: wrench, at: lug, components: [fx] }",
        ),
        "repeated-name",
        "scene: 1",
        &["`push_fx`", "two inputs"],
    );
    refused(
        &oil(
            "ram: { type: cylinder, joint: slide, area_a: 1 cm^2, dead_a: 1 l }\nram_a: { type: line, volume: 1 cm^3 }",
        ),
        "repeated-name",
        "ram_a:",
        &["`ram_a`", "`ram`"],
    );
    refused(
        &oil(
            "jack: { type: cylinder, joint: slide, area_a: 1 cm^2, area_b: 1 cm^2, dead_a: 1 l, dead_b: 1 l }",
        ),
        "repeated-name",
        "jack:",
        &["`jack_b` is already the name of a joint, a link or a frame"],
    );
    refused(
        &oil("hose: { type: line, volume: 1 cm^3 }"),
        "repeated-effect",
        "hose",
        &["twice"],
    );
    refused(
        &plain(
            "part: { type: payload, at: lug, mass: { parameter: m, value: 1 kg }, com: [0, 0, { parameter: m, value: 1 m }] }",
        ),
        "parameter-twice",
        "part",
        &["`m`"],
    );
}
