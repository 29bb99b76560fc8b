//! `branch: parallel` and `branch: crossed`: what is refused, and which joints are independent.

use bgdyn_codegen::method::Method;

use super::findings::{found, refused_text};
use super::references::spec;
use super::robot::{Robot, largest};

/// A four-bar with these sides: its pin is on coupler and rocker.
fn linkage(sides: [&str; 4], more: &str) -> String {
    let [crank, coupler, rocker, ground] = sides;
    let joint = |name: &str, at: &str| {
        format!(
            "joint: {{ name: {name}, type: continuous, axis: z, origin: {{ xyz: [{at}, 0, 0] }} }}, mass: 1"
        )
    };
    let [q1, q2, q3] = [("q1", "0"), ("q2", crank), ("q3", ground)].map(|(n, at)| joint(n, at));
    format!(
        "format: 1
name: linkage
links:
  - {{ name: crank, {q1} }}
  - {{ name: coupler, parent: crank, {q2} }}
  - {{ name: rocker, {q3} }}
loops:
  - {{ name: pin, type: hinge, a: {{ link: coupler, origin: {{ xyz: [{coupler}, 0, 0] }} }}, b: {{ link: rocker, origin: {{ xyz: [{rocker}, 0, 0] }} }}, {more} }}
"
    )
}

const EQUAL: [&str; 4] = ["0.12", "0.35", "0.12", "0.35"];

#[test]
fn loops_that_are_no_parallelograms_are_refused_with_their_sides() {
    for (branch, sides) in [
        ("parallel", ["0.12", "0.4", "0.3", "0.35"]),
        // A kite: equal sides are neighbours.
        ("parallel", ["0.12", "0.12", "0.35", "0.35"]),
        ("crossed", ["0.12", "0.4", "0.3", "0.35"]),
    ] {
        let text = linkage(sides, &format!("branch: {branch}"));
        let mut words = sides.to_vec();
        words.extend(["`pin`", branch]);
        refused_text(&text, "not-a-parallelogram", "loops[0].branch", &words);
    }
    // 1e-12 m too long: a fault with the difference, and the way out.
    let text = linkage(
        ["0.12", "0.350000000001", "0.12", "0.35"],
        "branch: parallel",
    );
    let words = ["1e-12 m", "rounded", "`branch: left`"];
    refused_text(&text, "not-a-parallelogram", "loops[0].branch", &words);
    // 1e-20 of the lengths is a rounding error of double-double.
    let text = linkage(
        ["0.12", "0.35000000000000000000001", "0.12", "0.35"],
        "branch: parallel",
    );
    assert_eq!(found(&text).0, []);
}

#[test]
fn parallel_loops_need_pins_of_revolute_joints_with_parallel_axes() {
    let text = linkage(EQUAL, "branch: parallel");
    assert_eq!(found(&text).0, []);
    for (from, to, words) in [
        ("type: hinge", "type: weld", ["`weld`", "`type: hinge`"]),
        (
            "name: q3, type: continuous",
            "name: q3, type: prismatic",
            ["`q3`", "prismatic"],
        ),
        (
            "axis: z, origin: { xyz: [0.12",
            "axis: x, origin: { xyz: [0.12",
            ["axes", "parallel"],
        ),
        (
            "branch: parallel",
            "axis: x, branch: parallel",
            ["axes", "`axis`"],
        ),
        (
            "branch: parallel",
            "axis: z, branch: parallel }\n  - { name: other, type: universal, a: { link: rocker }, b: { link: coupler }, branch: parallel",
            ["`other`", "`universal`"],
        ),
    ] {
        assert!(text.contains(from), "{from}");
        let changed = text.replace(from, to);
        let path = if to.contains("other") {
            "loops[1].branch"
        } else {
            "loops[0].branch"
        };
        refused_text(&changed, "not-a-parallelogram", path, &words);
    }
    // The coupler's pin is 10 mm above the rocker's.
    let lifted = text.replace("xyz: [0.35, 0, 0] } }, b:", "xyz: [0.35, 0, 0.01] } }, b:");
    let words = ["`pin`", "`z`", "0.01 m"];
    refused_text(&lifted, "loop-never-closes", "loops[0].branch", &words);
}

#[test]
fn keys_that_contradict_the_parallel_branch_are_refused() {
    for (key, value) in [
        ("near", "{ q1: 1 }"),
        ("redundant", "allow"),
        ("tolerance", "1e-6 m"),
    ] {
        let text = linkage(EQUAL, &format!("branch: parallel, {key}: {value}"));
        let words = ["`branch: parallel`", key];
        refused_text(&text, "unused-key", &format!("loops[0].{key}"), &words);
    }
    // Two independent joints, and a row beside the loop.
    let two = linkage(EQUAL, "branch: parallel") + "independent: [q1, q3]\n";
    let words = ["the loop `pin`", "`q1`", "`q3`"];
    refused_text(&two, "too-many-independents", "loops[0]", &words);
    let gear = "constraints:\n  teeth: { type: gear, joints: { q1: 1, q3: -1 } }\n";
    let twice = linkage(EQUAL, "branch: parallel") + gear;
    let words = ["`teeth`", "`pin`", "follows from others"];
    refused_text(&twice, "dependent-row", "constraints.teeth", &words);
    let against = twice.replace("q3: -1", "q3: 1");
    let words = ["the loop `pin`", "no motion"];
    let faults = found(&against);
    let shown = faults.render("loop.yaml", &against);
    assert!(
        words
            .iter()
            .all(|word| shown.contains(word) || shown.contains("together leave")),
        "{shown}"
    );
}

/// Each joint of a parallelogram can be the one that the others follow.
#[test]
fn any_joint_of_a_parallelogram_can_be_independent() {
    for name in ["q1", "q2", "q3"] {
        let text = linkage(EQUAL, "branch: parallel") + &format!("independent: [{name}]\n");
        let robot = Robot::read(&text);
        assert_eq!(robot.mechanism.joint_names(), [name]);
    }
}

/// The other branch of a parallelogram: its pins close, and the coupler turns.
#[test]
fn crossed_parallelograms_close_with_dependent_joints() {
    let text = linkage(EQUAL, "branch: crossed") + "independent: [q1]\n";
    let robot = Robot::read(&text);
    let closure = robot.mechanism.closure().expect("loops");
    let [crank, coupler, rocker] = [0, 1, 2].map(|j| closure.start[j].to_f64());
    let turned = (crank + coupler).rem_euclid(std::f64::consts::TAU);
    assert!(
        turned > 0.01 && turned < std::f64::consts::TAU - 0.01,
        "{turned}"
    );
    assert!((crank - rocker).rem_euclid(std::f64::consts::TAU) > 0.01);
    let (open, _) = closure.values(&closure.rows, &closure.start);
    assert!(largest(&open) < 1e-25);
    let rhombus = linkage(["0.2"; 4], "branch: crossed");
    let words = ["`pin`", "0.2, 0.2, 0.2 and 0.2 m", "`branch: parallel`"];
    refused_text(&rhombus, "crossed-rhombus", "loops[0].branch", &words);
}

/// Methods that return efforts of loops have none of these.
#[test]
fn efforts_of_parallel_loops_are_refused_by_name() {
    let robot = Robot::read(&spec("parallel_rods"));
    for name in [
        "multipliers",
        "reactions",
        "constraint_residual",
        "joint_reactions",
    ] {
        let message = Method::named(&robot.graph, name).expect_err(name);
        for word in [name, "`pin1`", "`branch: parallel`", "`branch: left`"] {
            assert!(message.contains(word), "{message}");
        }
    }
    let other = Method::named(&robot.graph, "reaction").expect_err("reaction");
    assert!(!other.contains("`pin1`"), "{other}");
}
