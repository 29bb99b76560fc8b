//! Mechanisms drawn for tests of ranks: links with joints, places between them.

use super::random_loops::{Loop, Text, number};

/// The axis of planar loops, and two directions perpendicular to it and to each other: along no axis of a link.
pub const NORMAL: [f64; 3] = [0.36, 0.48, 0.8];
pub const ACROSS: [[f64; 3]; 2] = [[0.8, -0.6, 0.0], [0.48, 0.64, -0.6]];

/// A body's mass, com and inertia.
const BODY: &str =
    "mass: 0.7, com: [0.05, 0.02, -0.01], inertia: { xx: 0.02, yy: 0.03, zz: 0.025, xz: 0.002 }";

pub fn vector(v: [f64; 3]) -> String {
    format!("[{:.6}, {:.6}, {:.6}]", v[0], v[1], v[2])
}

/// A point of the plane.
pub fn at(x: f64, y: f64) -> [f64; 3] {
    std::array::from_fn(|k| x * ACROSS[0][k] + y * ACROSS[1][k])
}

/// A mechanism on a body that is fixed, floats or turns about a ball.
pub fn on(root: &str) -> Text {
    Text {
        links: format!("  - {{ name: body_0, joint: {{ name: root, type: {root} }}, {BODY} }}\n"),
        frames: String::new(),
        loops: String::new(),
        origins: Vec::new(),
        all: Vec::new(),
    }
}

/// Adds a link.
pub fn link(text: &mut Text, (name, parent): (&str, &str), joint: &str) {
    text.links += &format!(
        "  - {{ name: {name}, parent: {parent}, joint: {{ name: {name}_joint, {joint} }}, {BODY} }}\n"
    );
}

pub fn turning(axis: [f64; 3], origin: [f64; 3]) -> String {
    let [axis, origin] = [axis, origin].map(vector);
    format!("type: continuous, axis: {axis}, origin: {{ xyz: {origin} }}")
}

/// Adds a loop between places on two links, each with its origin.
pub fn connect(
    text: &mut Text,
    kind: &'static str,
    ends: [(&str, &str); 2],
    (axis, more): ([f64; 3], &str),
) {
    let k = text.all.len();
    for (end, (link, origin)) in ["a", "b"].into_iter().zip(ends) {
        text.frames += &format!("  - {{ name: {end}{k}, link: {link}, origin: {origin} }}\n");
    }
    let own = match kind {
        "hinge" | "slider" => format!("    axis: {}\n", vector(axis)),
        _ => String::new(),
    };
    text.loops += &format!(
        "  - name: loop_{k}\n    type: {kind}\n    a: {{ frame: a{k} }}\n    b: {{ frame: b{k} }}\n{own}{more}"
    );
    let exact = |x: f64| number(&format!("{x:.6}"));
    let axis = axis.map(exact);
    text.all.push(Loop { kind, axis });
}

pub fn xyz(origin: [f64; 3]) -> String {
    format!("{{ xyz: {} }}", vector(origin))
}

/// Crank, coupler and rocker of a four-bar in the plane, without its pin.
pub fn four_bar(root: &str, [crank, ground]: [f64; 2]) -> Text {
    let mut text = on(root);
    link(&mut text, ("crank", "body_0"), &turning(NORMAL, [0.0; 3]));
    link(
        &mut text,
        ("coupler", "crank"),
        &turning(NORMAL, at(crank, 0.0)),
    );
    link(
        &mut text,
        ("rocker", "body_0"),
        &turning(NORMAL, at(ground, 0.0)),
    );
    text
}

/// A spherical four-bar with its hinge at this distance from the centre.
pub fn spherical(root: &str, apart: f64) -> Text {
    let mut text = on(root);
    for (name, parent, axis) in [
        ("crank", "body_0", [0.0, 0.0, 1.0]),
        ("coupler", "crank", [0.6, 0.0, 0.8]),
        ("rocker", "body_0", [0.0, 0.6, 0.8]),
    ] {
        link(&mut text, (name, parent), &turning(axis, [0.0; 3]));
    }
    let hinge = [0.48, 0.64, 0.6];
    let end = xyz(hinge.map(|x| apart * x));
    let ends = [("coupler", end.as_str()), ("rocker", end.as_str())];
    connect(&mut text, "hinge", ends, (hinge, ""));
    text
}
