//! Tests wrenches, drag and payloads: effects on a whole link.

use bgdyn_codegen::random::Random;
use std::path::Path;

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::{Method, SceneFunction};
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;

use super::bench::{Bench, agree, dd};
use super::common::scene;

const EXACT: f64 = 1e-24;

/// The UR5 with a frame `grip` that is neither at nor along its link's.
fn ur5() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/ur5.yaml");
    let grip = format!("frames:\n  - {{ name: grip, link: wrist_3, origin: {GRIP} }}");
    let text = std::fs::read_to_string(path).expect("the UR5");
    text.replace("frames:", &grip)
}

const GRIP: &str = "{ xyz: [20 mm, -10 mm, 90 mm], rpy: [0.3, -0.2, 0.5] }";

/// The UR5 with these effects beside gravity and inertia.
fn arm(effects: &str) -> SceneEquations {
    let text = format!(
        "scene: 1\nmechanism: ur5.yaml\neffects:\n  - gravity\n  - inertia\n  - velocity_products\n{effects}"
    );
    scene(&text, &ur5())
}

/// Sets two benches to the same random state.
fn anywhere(random: &mut Random, one: &mut Bench, other: &mut Bench) {
    for j in 0..6 {
        let mut next = || Dd::from_f64(2.0 * random.signed());
        (one.at.q[j], one.at.v[j], one.at.a[j]) = (next(), next(), next());
    }
    (other.at.q, other.at.v, other.at.a) = (one.at.q.clone(), one.at.v.clone(), one.at.a.clone());
}

/// A site's method of the plain mechanism, by the literal formulation.
fn site(
    name: &str,
    method: fn(bgdyn_codegen::bond_graph::SiteId) -> Method,
    at: &Inputs<Dd>,
) -> Vec<Dd> {
    let (mechanism, _) = bgdyn_codegen::read(&ur5(), Some("ur5"));
    let mechanism = mechanism.expect("the UR5");
    let graph = bgdyn_codegen::bond_graph::build(&mechanism);
    let found = graph.sites.iter().position(|s| s.name == name);
    let method = method(bgdyn_codegen::bond_graph::SiteId(found.expect("the site")));
    let literal = bgdyn_codegen::formulation::by_name("literal");
    let function = bgdyn_codegen::choice::Choice::new(&graph, literal).function(method);
    let (values, _) = function.expect("a function").evaluate(at.clone());
    values
}

#[test]
fn a_wrench_acts_through_the_jacobian() {
    let mut free = Bench::new(arm(""));
    let mut random = Random(2);
    for axes in ["", ", axes: world", ", axes: link"] {
        let effect = format!("  - push: {{ type: wrench, at: grip{axes} }}\n");
        let mut pushed = Bench::new(arm(&effect));
        let names: Vec<&str> = pushed
            .system
            .scene
            .layout
            .inputs
            .iter()
            .map(|i| i.name.as_str())
            .collect();
        assert_eq!(
            names,
            [
                "push_mx", "push_my", "push_mz", "push_fx", "push_fy", "push_fz"
            ]
        );
        for _ in 0..3 {
            anywhere(&mut random, &mut pushed, &mut free);
            let w: [Dd; 6] = std::array::from_fn(|_| Dd::from_f64(10.0 * random.signed()));
            pushed.at.u = w.to_vec();
            let pose = site("grip", Method::Pose, &pushed.at);
            let world = if axes.contains("link") {
                std::array::from_fn(|i| {
                    let (row, part) = (3 * (i % 3), 3 * (i / 3));
                    (0..3).fold(Dd::ZERO, |sum, k| sum + pose[row + k] * w[part + k])
                })
            } else {
                w
            };
            let jacobian = site("grip", Method::Jacobian, &pushed.at);
            let [with, without] = [
                pushed.value(SceneFunction::Inverse),
                free.value(SceneFunction::Inverse),
            ];
            for j in 0..6 {
                let effort = (0..6).fold(Dd::ZERO, |sum, i| sum + jacobian[6 * i + j] * world[i]);
                agree("τ", without[j] - with[j], effort, 10.0, EXACT);
            }
            let velocity = site("grip", Method::Velocity, &pushed.at);
            let power = (0..6).fold(Dd::ZERO, |sum, i| sum + velocity[i] * world[i]);
            agree("power", pushed.power("push")[0], power, 10.0, EXACT);
        }
    }
}

/// Only the selected components are inputs, in the usual order; the others are zero.
#[test]
fn a_wrench_has_the_components_asked_for() {
    let mut some = Bench::new(arm(
        "  - push: { type: wrench, at: forearm, components: [fz, mx] }\n",
    ));
    let mut all = Bench::new(arm("  - push: { type: wrench, at: forearm }\n"));
    let names: Vec<&str> = some
        .system
        .scene
        .layout
        .inputs
        .iter()
        .map(|i| i.name.as_str())
        .collect();
    assert_eq!(names, ["push_mx", "push_fz"]);
    anywhere(&mut Random(4), &mut some, &mut all);
    for bench in [&mut some, &mut all] {
        bench.give("push_fz", 12.0);
        bench.give("push_mx", -3.0);
    }
    let [some, all] = [
        some.value(SceneFunction::Derivative),
        all.value(SceneFunction::Derivative),
    ];
    for (some, all) in some.iter().zip(&all) {
        agree("v̇", *some, *all, 1.0, EXACT);
    }
}

#[test]
fn drag_opposes_the_motion_of_its_place() {
    let effect = "  - water: { type: drag, at: wrist_2, linear: 3, quadratic: 2, angular: 0.4 }\n";
    let (mut wet, mut dry) = (Bench::new(arm(effect)), Bench::new(arm("")));
    let mut random = Random(9);
    for _ in 0..5 {
        anywhere(&mut random, &mut wet, &mut dry);
        let velocity = site("wrist_2", Method::Velocity, &wet.at);
        let jacobian = site("wrist_2", Method::Jacobian, &wet.at);
        let square = |v: &[Dd]| v.iter().fold(Dd::ZERO, |sum, &x| sum + x * x);
        let speed = square(&velocity[3..]).sqrt();
        let factor = dd("3") + dd("2") * speed;
        let wrench: Vec<Dd> = (0..6)
            .map(|i| -velocity[i] * if i < 3 { dd("0.4") } else { factor })
            .collect();
        let [with, without] = [
            wet.value(SceneFunction::Inverse),
            dry.value(SceneFunction::Inverse),
        ];
        for j in 0..6 {
            let effort = (0..6).fold(Dd::ZERO, |sum, i| sum + jacobian[6 * i + j] * wrench[i]);
            agree("τ", without[j] - with[j], effort, 10.0, EXACT);
        }
        let [supplied, stored, lost] = wet.power("water");
        let expected = factor * square(&velocity[3..]) + dd("0.4") * square(&velocity[..3]);
        agree("lost", lost, expected, 0.0, EXACT);
        assert!(lost.to_f64() >= 0.0);
        assert_eq!((supplied, stored), (Dd::ZERO, Dd::ZERO));
    }
    // Without motion there is no drag.
    wet.at.v.fill(Dd::ZERO);
    dry.at.v.fill(Dd::ZERO);
    let [with, without] = [
        wet.value(SceneFunction::Inverse),
        dry.value(SceneFunction::Inverse),
    ];
    for (with, without) in with.iter().zip(&without) {
        agree("at rest", *with, *without, 10.0, 1e-28);
    }
}

/// A part as an effect at the grip, and the same as a link of the mechanism.
const PART: &str = "  - part: { type: payload, at: grip, mass: 1.5 kg, com: [10 mm, 0, 40 mm], inertia: { xx: 0.002, yy: 0.002, zz: 0.0008, xy: 0.0001 } }\n";

fn with_a_link() -> SceneEquations {
    let link = format!(
        "  - name: piece
    parent: wrist_3
    joint: {{ type: fixed, origin: {GRIP} }}
    mass: 1.5
    com: [0.01, 0, 0.04]
    inertia: {{ xx: 0.002, yy: 0.002, zz: 0.0008, xy: 0.0001 }}

frames:"
    );
    let text = "scene: 1\nmechanism: ur5.yaml\neffects: [gravity, inertia, velocity_products]\n";
    scene(text, &ur5().replace("frames:", &link))
}

#[test]
fn a_payload_is_a_link() {
    let (effect, link) = (arm(PART), with_a_link());
    for role in [SceneFunction::Derivative, SceneFunction::Inverse] {
        let [one, other] = [&effect, &link].map(|s| s.function(role).operations());
        assert_eq!(one, other, "{role:?}");
    }
    let (mut effect, mut link) = (Bench::new(effect), Bench::new(link));
    let mut random = Random(6);
    for _ in 0..5 {
        anywhere(&mut random, &mut effect, &mut link);
        for role in [
            SceneFunction::Derivative,
            SceneFunction::Inverse,
            SceneFunction::Energy,
            SceneFunction::Power,
        ] {
            let [one, other] = [effect.value(role), link.value(role)];
            for (one, other) in one.iter().zip(&other) {
                agree(role.name(), *one, *other, 1.0, EXACT);
            }
        }
    }
}

/// With the mass at 0 a point mass is detached: the arm moves as without it.
#[test]
fn a_payload_is_let_go() {
    let part = "  - part: { type: payload, at: grip, mass: { parameter: m, value: 2 kg }, com: [0, { parameter: y, value: 30 mm }, 0] }\n";
    let (mut loaded, mut free) = (Bench::new(arm(part)), Bench::new(arm("")));
    let fixed = "  - part: { type: payload, at: grip, mass: 2 kg, com: [0, 30 mm, 0] }\n";
    let mut fixed = Bench::new(arm(fixed));
    let names: Vec<(&str, &str, &str)> = loaded
        .system
        .scene
        .parameters
        .iter()
        .map(|p| (p.name.as_str(), p.meaning.as_str(), p.unit))
        .collect();
    assert_eq!(
        names,
        [("m", "mass of `part`", "kg"), ("y", "com.y of `part`", "m")]
    );
    let mut random = Random(8);
    for _ in 0..5 {
        anywhere(&mut random, &mut loaded, &mut free);
        (fixed.at.q, fixed.at.v) = (free.at.q.clone(), free.at.v.clone());
        for (mass, other) in [(2.0, &mut fixed), (0.0, &mut free)] {
            loaded.set("m", mass);
            let [one, other] = [
                loaded.value(SceneFunction::Derivative),
                other.value(SceneFunction::Derivative),
            ];
            for (one, other) in one.iter().zip(&other) {
                agree("v̇", *one, *other, 1.0, 1e-22);
            }
        }
    }
}
