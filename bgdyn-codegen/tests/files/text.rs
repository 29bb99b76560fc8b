//! Compares the generated text with the text stored beside the tests, so that reviews show a change of the
//! output.
//!
//! The stored text was written by another process; `tests/compiled` compares the text of every spec
//! between two processes.

use std::collections::BTreeMap;
use std::path::Path;

use bgdyn_codegen::build_script::Build;
use bgdyn_codegen::random::Random;

fn text(spec: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../specs")
        .join(spec);
    let source = Build::new(path).source();
    source.unwrap_or_else(|error| panic!("{error}")).text
}

#[test]
fn text_of_the_double_pendulum() {
    insta::assert_snapshot!(text("double_pendulum.yaml"));
}

#[test]
fn text_of_the_scara() {
    insta::assert_snapshot!(text("scara.yaml"));
}

/// The literal sum, whose text is longer, cut into blocks if it is too long.
#[test]
fn text_of_the_literal_sum() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/double_pendulum.yaml");
    let literal = Build::new(path)
        .formulation("literal")
        .methods(["mass_matrix"]);
    let source = literal.source();
    insta::assert_snapshot!(source.unwrap_or_else(|error| panic!("{error}")).text);
}

const LINKS: [&str; 6] = ["turret", "boom", "hub", "stick", "slide", "tip"];

/// An arm of noisy geometry: rotations, a welded hub, a translation; `doubled` has twice its mass and inertia.
fn arm(doubled: Option<usize>) -> String {
    let mut random = Random(41);
    let mut x = |size: f64| size * random.signed();
    let mut text = "format: 1\nlinks:\n".to_owned();
    for (i, link) in LINKS.iter().enumerate() {
        let parent = match i {
            0 => String::new(),
            _ => format!("    parent: {}\n", LINKS[i - 1]),
        };
        let (kind, axis) = match *link {
            "hub" => ("fixed", String::new()),
            "slide" => ("prismatic", axis(&mut x)),
            _ => ("continuous", axis(&mut x)),
        };
        let scale = if doubled == Some(i) { 2.0 } else { 1.0 };
        let [a, b, c] = [0.3 + x(0.1), 0.4 + x(0.1), 0.5 + x(0.1)].map(|x| scale * x);
        let (mass, p) = (scale * (1.5 + x(0.5)), [x(0.2), x(0.2), x(0.2)]);
        let origin = [x(0.3), x(0.3), x(0.3)];
        text += &format!(
            "  - name: {link}\n{parent}    joint: {{ name: {link}_joint, type: {kind}{axis}, origin: {{ xyz: {origin:?} }} }}\n    mass: {mass}\n    com: {p:?}\n    inertia: {{ xx: {a}, yy: {b}, zz: {c} }}\n"
        );
    }
    text
}

fn axis(x: &mut impl FnMut(f64) -> f64) -> String {
    format!(", axis: [{}, {}, {}]", x(1.0), x(1.0), x(1.0))
}

/// The named constants of a module: function and name, the links listed in the comment, the value.
fn named_constants(text: &str, stem: &str) -> BTreeMap<String, (Vec<String>, f64)> {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{stem}.yaml"));
    std::fs::write(&path, text).expect("a folder for tests");
    let methods = ["inverse_dynamics", "mass_matrix", "kinetic_energy"];
    let source = Build::new(path).methods(methods).source();
    let source = source.unwrap_or_else(|error| panic!("{error}")).text;
    let (mut found, mut function, mut about) = (BTreeMap::new(), "", "");
    for line in source.lines().map(str::trim) {
        if let Some(rest) = line.strip_prefix("pub fn ") {
            function = rest.split('(').next().unwrap_or(rest);
        } else if let Some(rest) = line.strip_prefix("/// ") {
            about = rest;
        } else if let Some((name, value)) = line.strip_prefix("const ").and_then(split_constant) {
            let links = about.split_once("; of ").map_or("", |(_, links)| links);
            let links = links.split(", ").filter(|link| !link.is_empty());
            let links = links.map(str::to_owned).collect();
            found.insert(format!("{function} {name}"), (links, value));
        }
    }
    found
}

/// Splits `NAME: f64 = 1.5;`, or with two words `NAME: (f64, f64) = (1.5, 1e-17);`.
fn split_constant(line: &str) -> Option<(&str, f64)> {
    let (name, rest) = line.split_once(": ")?;
    let (_, value) = rest.split_once("= ")?;
    let value = value
        .trim_start_matches('(')
        .split([',', ';', ')'])
        .next()?;
    Some((name, value.parse().ok()?))
}

/// A number changes with the mass and inertia of the links that its comment lists, and of no others.
#[test]
fn comments_list_the_links_of_a_number() {
    let before = named_constants(&arm(None), "named_arm");
    let listed = before.values().filter(|(links, _)| links.len() > 1);
    assert!(listed.count() > 20, "{before:#?}");
    for (i, link) in LINKS.iter().enumerate() {
        let after = named_constants(&arm(Some(i)), "named_arm");
        let mut compared = 0;
        for (name, (links, value)) in before.iter().filter(|(_, (links, _))| !links.is_empty()) {
            let Some((_, other)) = after.get(name) else {
                continue;
            };
            let changes = (other - value).abs() > 1e-9 * value.abs();
            assert_eq!(
                changes,
                links.iter().any(|l| l == link),
                "{link}: {name} {links:?}"
            );
            compared += 1;
        }
        assert!(compared > 20, "{link}: {compared}");
    }
}
