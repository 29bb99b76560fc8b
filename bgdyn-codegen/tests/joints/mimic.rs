//! Joints that mimic others against the same file without `mimic`; leads.

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::robot::{Robot, State, WAYS, golden_text};
use super::same_motion::{Mapped, same};
use super::specs;

/// Follower, leader, ratio, offset, as the file has them.
type Relation = (&'static str, &'static str, Dd, Dd);

fn number(text: &str) -> Dd {
    text.parse().expect("a number")
}

/// The text without its `mimic` keys.
fn without_mimic(text: &str) -> String {
    let mut parts = text.split(", mimic: {");
    let mut plain = parts.next().expect("a text").to_owned();
    for part in parts {
        plain += part.split_once('}').expect("the end of a mimic").1;
    }
    plain
}

/// The value of a joint as factor and offset of its last leader.
fn resolved<'a>(name: &'a str, relations: &'a [Relation]) -> (&'a str, Dd, Dd) {
    match relations.iter().find(|r| r.0 == name) {
        None => (name, Dd::ONE, Dd::ZERO),
        Some((_, leader, ratio, offset)) => {
            let (last, factor, shift) = resolved(leader, relations);
            (last, *ratio * factor, *ratio * shift + *offset)
        }
    }
}

/// M = GᵀM_full G, and everything else.
fn check(text: &str, relations: &[Relation], places: &[&str], name: &str) {
    let (one, other) = (Robot::read(text), Robot::read(&without_mimic(text)));
    let (own, all) = (one.mechanism.joint_names(), other.mechanism.joint_names());
    assert_eq!(own.len() + relations.len(), all.len(), "{name}");
    let map = |s: &State<Dd>| {
        let mut q = Vec::new();
        let mut g = Vec::new();
        for joint in &all {
            let (leader, factor, shift) = resolved(joint, relations);
            let j = own.iter().position(|n| n == leader).expect("a leader");
            q.push(factor * s.q[j] + shift);
            let mut row = vec![Dd::ZERO; own.len()];
            row[j] = factor;
            g.push(row);
        }
        Mapped {
            q,
            g,
            gamma: vec![Dd::ZERO; all.len()],
        }
    };
    same((&one, &other), map, true, places, name);
}

#[test]
fn the_gripper_is_the_one_without_mimic_reduced() {
    let relations = [
        ("grip_right", "grip", Dd::ONE, Dd::ZERO),
        ("pad_turn", "grip", number("-12.5"), number("0.2")),
        ("curl_middle", "curl", number("0.8"), number("-0.1")),
        ("curl_tip", "curl_middle", number("1.5"), number("0.05")),
        ("feed", "swing", number("5"), Dd::ZERO),
    ];
    let places = ["pad", "tip", "screw", "finger_right"];
    check(
        &golden_text("mimic_gripper.yaml"),
        &relations,
        &places,
        "mimic_gripper",
    );
}

#[test]
fn followers_inboard_of_leaders_and_across_branches() {
    let degrees = Dd::PI / Dd::from_f64(180.0);
    let relations = [
        (
            "bend_third",
            "bend_second",
            number("-1.5"),
            number("20") * degrees,
        ),
        ("bend_second", "bend", number("0.8"), number("-0.1")),
        ("rise", "bend", number("0.03"), number("-0.02")),
        ("drill", "push", number("-12"), number("0.4")),
        ("ride", "spin", number("-0.0005"), number("0.003")),
    ];
    check(
        specs::LOOPS,
        &relations,
        &["whirl", "rider", "third", "worm"],
        "loops",
    );
}

/// A follower of a follower of a joint whose own mass is nothing.
#[test]
fn a_leader_without_mass_has_its_followers_inertia() {
    let text = "format: 1\nname: dummy\nlinks:\n  - name: knob\n    joint: { name: turn, type: revolute }\n  \
                - name: wheel\n    joint: { name: follow, type: revolute, mimic: { joint: turn, ratio: -3 } }\n    \
                inertia: { xx: 0.1, yy: 0.1, zz: 0.2 }\n";
    let robot = Robot::read(text);
    for way in WAYS {
        let s = State {
            q: vec![0.3],
            v: vec![2.0],
            a: vec![1.0],
            u: vec![3.6],
        };
        for (method, expected) in [
            (Method::MassMatrix, 1.8),
            (Method::ForwardDynamics, 2.0),
            (Method::KineticEnergy, 3.6),
        ] {
            let found = s.value(&robot.function(way, method));
            let off: f64 = found[0] - expected;
            assert!(off.abs() < 1e-15, "{way:?}, {method:?}: {found:?}");
        }
    }
}

/// A nut with this lead.
fn nut(lead: &str) -> Robot {
    Robot::read(&format!(
        "format: 1\nname: spindle\ngravity: [0, 0, 0]\nlinks:\n  - name: nut\n    joint: {{ name: feed, type: helical, \
         lead: {lead} }}\n    mass: 2\n    inertia: {{ xx: 0.1, yy: 0.1, zz: 0.003 }}\n"
    ))
}

#[test]
fn a_lead_is_the_travel_for_a_turn() {
    let at = |q: f64| State {
        q: vec![q],
        v: vec![1.0],
        a: vec![1.0],
        u: vec![1.0],
    };
    for (lead, travel) in [
        ("6.283185307179586476925286766559 mm", 1e-3),
        ("1 mm/rad", 1e-3),
        ("5 mm", 5e-3 / std::f64::consts::TAU),
        ("5 mm/turn", 5e-3 / std::f64::consts::TAU),
        ("0.25", 0.25 / std::f64::consts::TAU),
        ("-0.01 m/turn", -0.01 / std::f64::consts::TAU),
        ("-0.02 m/rad", -0.02),
    ] {
        let robot = nut(lead);
        let site = robot.site("nut");
        for way in WAYS {
            let [pose, _, jacobian, _] = Method::of_site(site).map(|m| robot.function(way, m));
            let near = |x: f64, y: f64| {
                assert!(
                    (x - y).abs() <= 4.0 * f64::EPSILON * y.abs(),
                    "{lead}, {way:?}: {x} not {y}"
                );
            };
            near(at(1.0).value(&pose)[11], travel);
            near(at(-40.0).value(&pose)[11], -40.0 * travel);
            // Right-handed: about +z by the angle itself.
            near(at(1.0).value(&pose)[3], 1.0_f64.sin());
            assert_eq!(at(0.7).value(&jacobian)[2], 1.0);
            near(at(0.7).value(&jacobian)[5], travel);
            let mass = at(0.7).value(&robot.function(way, Method::MassMatrix));
            near(mass[0], 0.003 + 2.0 * travel * travel);
        }
    }
}
