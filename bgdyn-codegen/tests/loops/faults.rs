//! Faults of loops: each with its place, its rule and the numbers seen.

use super::findings::{found, refused_text};
use super::references::spec;

/// A four-bar without its loop; the coupler is 0.4 m long, the rocker 0.3 m, the ground 0.35 m, the crank 0.12 m.
const LINKS: &str = "format: 1
name: linkage
links:
  - { name: crank, joint: { name: q1, type: continuous, axis: z }, mass: 1 }
  - { name: coupler, parent: crank, joint: { name: q2, type: continuous, axis: z, origin: { xyz: [0.12, 0, 0] } }, mass: 1 }
  - { name: rocker, joint: { name: q3, type: continuous, axis: z, origin: { xyz: [0.35, 0, 0] } }, mass: 1 }
  - { name: ball, parent: coupler, joint: { name: ball_joint, type: spherical }, mass: 1, inertia: { xx: 1, yy: 1, zz: 1 } }
frames:
  - { name: tip, link: rocker, origin: { xyz: [0.3, 0, 0] } }
";

const HINGE: &str = "{ name: pin, type: hinge, a: { link: coupler, origin: { xyz: [0.4, 0, 0] } }, b: { frame: tip } }";

/// Asserts exactly one fault of a file with these loops, and further keys.
fn refused(loops: &str, more: &str, rule: &str, path: &str, words: &[&str]) {
    let text = format!("{LINKS}loops:\n  - {loops}\n{more}");
    refused_text(&text, rule, path, words);
}

/// The hinge with one part of its text replaced.
fn changed(from: &str, to: &str, rule: &str, path: &str, words: &[&str]) {
    assert!(HINGE.contains(from), "{from}");
    let path = format!("loops[0]{path}");
    refused(&HINGE.replace(from, to), "", rule, &path, words);
}

#[test]
fn the_linkage_itself_has_no_faults() {
    let text = format!("{LINKS}loops:\n  - {HINGE}\n");
    assert_eq!(found(&text).0, []);
}

#[test]
fn names_and_types() {
    changed("pin", "q1", "repeated-name", ".name", &["`q1`"]);
    changed("pin", "9pin", "name", ".name", &["9pin"]);
    changed(
        "type: hinge",
        "type: hing",
        "unknown-loop-type",
        ".type",
        &["`hing`", "`hinge`"],
    );
    changed("type: hinge, ", "", "missing-key", "", &["`hinge`"]);
    changed(
        "frame: tip",
        "frame: top",
        "unknown-frame",
        ".b.frame",
        &["`top`", "`tip`"],
    );
    changed(
        "link: coupler",
        "link: copler",
        "unknown-link",
        ".a.link",
        &["`copler`", "`coupler`"],
    );
    changed(
        "{ frame: tip }",
        "{ origin: { xyz: [0, 0, 0] } }",
        "missing-key",
        ".b",
        &["`link`", "`frame`"],
    );
    changed(
        "frame: tip",
        "frame: tip, link: rocker",
        "place-twice",
        ".b.link",
        &["`frame`"],
    );
    changed(
        "frame: tip",
        "link: coupler",
        "closes-nothing",
        "",
        &["`pin`", "one link"],
    );
    refused(
        HINGE,
        "constraints:\n  rates: { type: linear, row: { q1: 1, q2: -2 } }\n",
        "loop-through-joint",
        "loops[0]",
        &["`pin`", "`q2`", "continuous", "`linear`"],
    );
}

#[test]
fn keys_of_types() {
    changed(
        "type: hinge",
        "type: distance",
        "missing-key",
        "",
        &["`length`"],
    );
    changed(
        "type: hinge",
        "type: distance, length: 0",
        "length-not-positive",
        ".length",
        &["0"],
    );
    changed(
        "type: hinge",
        "type: hinge, length: 1",
        "unused-key",
        ".length",
        &["`hinge`", "`distance`"],
    );
    changed(
        "type: hinge",
        "type: point, axis: z",
        "unused-key",
        ".axis",
        &["`point`", "`hinge`"],
    );
    changed(
        "type: hinge",
        "type: hinge, branch: up",
        "unknown-branch",
        ".branch",
        &["`up`", "`left`"],
    );
    changed(
        "type: hinge",
        "type: hinge, near: { q4: 1 }",
        "unknown-name",
        ".near.q4",
        &["`q4`", "`q1`"],
    );
}

/// `near` has the unit of the joint.
#[test]
fn positions_to_start_from_have_units() {
    changed(
        "type: hinge",
        "type: hinge, near: { q1: 3 cm }",
        "unit-misfit",
        ".near.q1",
        &["3 cm"],
    );
}

/// A link on the world has no joint from which to look.
#[test]
fn a_branch_needs_two_moving_links() {
    let slider = "{ name: pin, type: hinge, branch: left, a: { link: coupler, origin: { xyz: [0.4, 0, 0] } }, b: { link: world, origin: { xyz: [0.2, 0.3, 0] } } }";
    refused(
        slider,
        "",
        "branch-of-spatial-loop",
        "loops[0].branch",
        &["near"],
    );
}

/// A constant gap of rounded numbers, below 1e-14 m or within the `tolerance`: the row is left out.
#[test]
fn rows_that_are_off_by_rounding_hold() {
    let with = |off: &str, hinge: &str| {
        let hinge = hinge.replace("0.4, 0, 0]", &format!("0.4, 0, {off}]"));
        format!("{LINKS}loops:\n  - {hinge}\n")
    };
    let tolerant = HINGE.replace("type: hinge", "type: hinge, tolerance: 1e-6 m");
    for text in [
        with("1e-15", HINGE),
        with("1e-12", &tolerant),
        with("-1e-7", &tolerant),
    ] {
        let faults = found(&text);
        assert!(
            faults.0.is_empty(),
            "{}",
            faults.render("linkage.yaml", &text)
        );
    }
    for text in [with("1e-12", HINGE), with("-2e-6", &tolerant)] {
        let faults = found(&text);
        let shown = faults.render("linkage.yaml", &text);
        assert!(
            shown.contains("[loop-never-closes]") && shown.contains("`tolerance`"),
            "{shown}"
        );
    }
}

#[test]
fn loops_that_cannot_close() {
    changed(
        "xyz: [0.4, 0, 0]",
        "xyz: [0.4, 0, 0.01]",
        "loop-never-closes",
        "",
        &["`pin`", "`z`", "0.01 m"],
    );
    changed(
        "xyz: [0.4, 0, 0]",
        "xyz: [1, 0, 0]",
        "loop-not-assembled",
        "",
        &["`pin` misses by 0.23 m"],
    );
    // Twice the crank of 0.12 m cannot be 1e-7 m longer than it is.
    let text = LINKS
        .replace("[0.12, 0, 0]", "[0.0499999, 0, 0]")
        .replace("xyz: [0.3, 0, 0]", "xyz: [0.25, 0, 0]");
    let hinge = HINGE.replace("0.4, 0, 0", "0.05, 0, 0");
    let text = format!("{text}loops:\n  - {hinge}\n");
    let faults = found(&text);
    let shown = faults.render("linkage.yaml", &text);
    assert_eq!(faults.0.len(), 1, "{shown}");
    assert_eq!(faults.0[0].rule, "loop-closes-to-rounding", "{shown}");
    assert!(shown.contains("1e-7") || shown.contains("e-8"), "{shown}");
}

/// The coupler ends to the left of the line from q2 to q3, or to the right: both exist; not for a tip on the line.
#[test]
fn each_branch_is_found() {
    for branch in ["left", "right"] {
        let text = format!(
            "{LINKS}loops:\n  - {}\n",
            HINGE.replace("type: hinge", &format!("type: hinge, branch: {branch}"))
        );
        assert_eq!(found(&text).0, [], "{branch}");
    }
}

#[test]
fn rows_that_follow_from_others() {
    let again = format!("{HINGE}\n  - {}", HINGE.replace("pin", "pin_again"));
    refused_all(&again, "dependent-row", &["`pin_again`", "1 · `pin x`"]);
}

fn refused_all(loops: &str, rule: &str, words: &[&str]) {
    let text = format!("{LINKS}loops:\n  - {loops}\n");
    let faults = found(&text);
    let shown = faults.render("linkage.yaml", &text);
    assert!(!faults.0.is_empty(), "no fault");
    assert!(faults.0.iter().all(|fault| fault.rule == rule), "{shown}");
    for word in words {
        assert!(shown.contains(word), "no {word:?} in {shown}");
    }
}

#[test]
fn independent_joints() {
    refused(
        HINGE,
        "independent: [q1, q2]\n",
        "too-many-independents",
        "loops",
        &["`q1`, `q2`", "leave 1"],
    );
    refused(
        HINGE,
        "independent: [q5]\n",
        "unknown-name",
        "independent[0]",
        &["`q5`"],
    );
}

/// A triangle of three hinges moves no more.
#[test]
fn nothing_left_to_move() {
    let links = LINKS
        .lines()
        .filter(|line| !line.contains("ball"))
        .collect::<Vec<_>>()
        .join("\n");
    let rod = "{ name: rod, type: distance, length: 0.41, a: { link: crank, origin: { xyz: [0.1, 0, 0] } }, b: { frame: tip } }";
    let text = format!("{links}\nloops:\n  - {HINGE}\n  - {rod}\n");
    let faults = found(&text);
    let shown = faults.render("linkage.yaml", &text);
    assert_eq!(faults.0.len(), 1, "{shown}");
    assert_eq!(faults.0[0].rule, "nothing-left-to-move", "{shown}");
    assert!(shown.contains("3 rows for 3 velocities"), "{shown}");
}

#[test]
fn actuated_joints() {
    let listed = |list: &str, rule: &str, path: &str, words: &[&str]| {
        refused(HINGE, &format!("actuated: {list}\n"), rule, path, words);
    };
    listed(
        "[q1, q9]",
        "unknown-name",
        "actuated[1]",
        &["`q9`", "did you mean"],
    );
    listed(
        "[elbow_of_the_arm]",
        "unknown-name",
        "actuated[0]",
        &["`q1`, `q2`, `q3`"],
    );
    listed("[q1, q1]", "actuated-twice", "actuated[1]", &["`q1`"]);
    listed("[]", "actuated-empty", "actuated", &["leave the key out"]);
    // The ball moves in three directions, and the linkage in one: the linkage has two drives.
    listed(
        "[q1, q3, ball_joint_rx, ball_joint_ry]",
        "actuated-do-not-determine",
        "actuated",
        &["`q1`, `q3`", "3 of 4", "follow", "reduced_inverse_dynamics"],
    );
    let without = format!("{LINKS}actuated: [q1]\n");
    let parallel = spec("parallel_rods") + "actuated: [rod0_angle]\n";
    for text in [without, parallel] {
        let words = ["leave it out", "`branch: parallel`"];
        refused_text(&text, "actuated-without-loops", "actuated", &words);
    }
    let fixed = LINKS.replace(
        "frames:",
        "  - { name: cap, parent: rocker, joint: { name: cap_joint, type: fixed }, mass: 1 }
  - { name: wheel, joint: { name: wheel_joint, type: continuous, axis: z, mimic: { joint: q1, ratio: 2 } }, mass: 1 }
frames:",
    );
    let text = |list: &str| format!("{fixed}loops:\n  - {HINGE}\nactuated: {list}\n");
    refused_text(
        &text("[cap_joint]"),
        "actuated-without-motion",
        "actuated[0]",
        &["`cap_joint`", "does not move"],
    );
    refused_text(
        &text("[wheel_joint]"),
        "actuated-follower",
        "actuated[0]",
        &["`wheel_joint`", "`q1`"],
    );
}

/// A hinge where a joint is already; with `redundant: allow` it may stand beside another loop.
#[test]
fn loops_that_always_hold_are_refused() {
    let again = "{ name: again, type: hinge, axis: z, redundant: allow, a: { link: crank, origin: { xyz: [0.3, 0, 0] } }, \
                 b: { link: rod } }";
    let links = "format: 1
name: twice
links:
  - { name: crank, joint: { name: q1, type: continuous, axis: z }, mass: 1, inertia: { xx: 1, yy: 1, zz: 1 } }
  - { name: rod, parent: crank, joint: { name: q2, type: continuous, axis: z, origin: { xyz: [0.3, 0, 0] } }, mass: 1, inertia: { xx: 1, yy: 1, zz: 1 } }
  - { name: slider, joint: { name: q3, type: prismatic, axis: x }, mass: 1, inertia: { xx: 1, yy: 1, zz: 1 } }
loops:
";
    let pin = "{ name: pin, type: hinge, axis: z, a: { link: rod, origin: { xyz: [0.5, 0, 0] } }, b: { link: slider } }";
    let words = ["`again`", "constrains nothing", "`tilt x`"];
    let with = |loops: &[&str]| {
        let list: String = loops.iter().map(|one| format!("  - {one}\n")).collect();
        format!("{links}{list}")
    };
    refused_text(&with(&[again]), "closes-nothing", "loops[0]", &words);
    let unsaid = again.replace("redundant: allow, ", "");
    refused_text(&with(&[pin, &unsaid]), "closes-nothing", "loops[1]", &words);
    assert_eq!(found(&with(&[pin, again])).0, []);
}

/// The rate of a rod's row is one of lengths, relative to the rod's own: it has no size from which one is a rounding
/// error.
#[test]
fn rods_may_be_short() {
    let rod = HINGE.replace("type: hinge", "type: distance, length: 1e-12");
    let text = format!("{LINKS}loops:\n  - {rod}\n");
    assert_eq!(found(&text).0, []);
}
