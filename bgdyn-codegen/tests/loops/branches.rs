//! Positions at which branches meet: no start is reached over one, no range leads over one, and none is a start.

use bgdyn_codegen::mechanism::closure::{ClosedRange, Closure, RangeEnd};
use bgdyn_codegen::refusal::Refusal;
use bgdyn_codegen::system::SceneEquations;

use super::findings::{found, refused_text};
use super::robot::Robot;

/// A four-bar with these sides and a pin with these keys.
fn four_bar([crank, coupler, rocker, ground]: [f64; 4], more: &str) -> String {
    format!(
        "format: 1
name: linkage
links:
  - {{ name: crank, joint: {{ name: cr, type: continuous, axis: z }}, mass: 1 }}
  - {{ name: coupler, parent: crank, joint: {{ name: co, type: continuous, axis: z, origin: {{ xyz: [{crank}, 0, 0] }} }}, mass: 1 }}
  - {{ name: rocker, joint: {{ name: ro, type: continuous, axis: z, origin: {{ xyz: [{ground}, 0, 0] }} }}, mass: 1 }}
loops:
  - {{ name: pin, type: hinge, a: {{ link: coupler, origin: {{ xyz: [{coupler}, 0, 0] }} }}, b: {{ link: rocker, origin: {{ xyz: [{rocker}, 0, 0] }} }}{more} }}
"
    )
}

/// A parallelogram or antiparallelogram.
fn equal_sides(more: &str) -> String {
    four_bar([0.2, 0.4, 0.2, 0.4], more)
}

/// A slider-crank whose rod is as long as its crank: where the slider is over the pivot, the rod may lie on the crank and
/// turn with it.
const EQUAL_CRANK: &str = "format: 1
name: linkage
links:
  - { name: crank, joint: { name: cr, type: continuous, axis: z }, mass: 1 }
  - { name: rod, parent: crank, joint: { name: ro, type: continuous, axis: z, origin: { xyz: [0.1, 0, 0] } }, mass: 1 }
  - { name: slider, joint: { name: sl, type: prismatic, axis: x }, mass: 1 }
loops:
  - { name: pin, type: hinge, a: { link: rod, origin: { xyz: [0.1, 0, 0] } }, b: { link: slider }, near: { cr: 0.5, ro: -1, sl: 0.15 } }
";

fn start(text: &str, initial: &str) -> Result<SceneEquations, Refusal> {
    let scene = format!(
        "scene: 1\nmechanism: linkage.yaml\neffects: [inertia]\ninitial: {{ {initial} }}\n"
    );
    let own = text.to_owned();
    bgdyn_codegen::read_scene(&scene, "scene", |_| Ok(own.clone())).map(|(system, _)| system)
}

/// Returns the position of a joint at the start.
fn at(system: &SceneEquations, name: &str) -> f64 {
    let mut all = system.scene.layout.positions.iter();
    let p = all.position(|p| p.name == name).expect("a position");
    system.initial.q[p].to_f64()
}

/// Asserts that a start is refused with this rule, and returns what is shown.
fn refused_start(text: &str, initial: &str, rule: &str) -> String {
    let Err(Refusal::Spec(faults)) = start(text, initial) else {
        panic!("{initial}: not refused, or not for the start");
    };
    let shown = faults.render("scene", text);
    assert_eq!(faults.0.len(), 1, "{initial}: {shown}");
    assert_eq!(faults.0[0].rule, rule, "{initial}: {shown}");
    shown
}

#[test]
fn no_start_is_reached_over_a_meeting_of_branches() {
    let crossed = equal_sides(", branch: crossed");
    for given in ["cr: 0.1", "cr: 0.5", "cr: 1", "cr: 2", "cr: 3", "cr: 50"] {
        let shown = refused_start(&crossed, given, "other-branch");
        assert!(shown.contains("meet, at `cr` "), "{shown}");
    }
    // Where the slider is over the pivot the crank stands at a right angle.
    let shown = refused_start(EQUAL_CRANK, "cr: 2.5", "other-branch");
    assert!(shown.contains("`cr` 1.5708 rad"), "{shown}");
    // On this side of it the rod mirrors the crank, up to a hundredth of a degree from it.
    for crank in [1.0_f64, 1.5, 1.5706, -1.5706] {
        let system = start(EQUAL_CRANK, &format!("cr: {crank}")).expect("a start");
        assert!((at(&system, "ro") + 2.0 * crank).abs() < 1e-12);
        assert!((at(&system, "sl") - 0.2 * crank.cos()).abs() < 1e-14);
    }
    for crank in [-0.01_f64, -1.0, -2.0, -3.1] {
        let system = start(&crossed, &format!("cr: {crank}")).expect("a start");
        let [co, ro] = ["co", "ro"].map(|name| at(&system, name));
        // On the parallel branch the rocker turns with the crank.
        assert!((ro - crank).sin().abs() > 1e-3, "{crank}: {co}, {ro}");
    }
}

/// Sides that almost make a parallelogram: branches come close, and do not meet.
#[test]
fn branches_that_almost_meet_are_passed() {
    for (off, given) in [(1e-3, "cr: 4"), (1e-6, "cr: 4"), (1e-6, "cr: -9")] {
        let text = four_bar(
            [0.2, 0.4, 0.2 + off, 0.4],
            ", near: { cr: 1, ro: 1, co: -1 }",
        );
        let system = start(&text, given).unwrap_or_else(|e| panic!("{off}, {given}: {e:?}"));
        let cr = at(&system, "cr");
        assert!((given[4..].parse::<f64>().expect("a number") - cr).abs() < 1e-15);
    }
}

fn ranges(text: &str) -> Vec<ClosedRange> {
    let robot = Robot::read(text);
    let closure: &Closure = robot.mechanism.closure().expect("loops");
    let turns = [true, true, false];
    closure.ranges(&[[None; 2]; 3], &turns)
}

#[test]
fn ranges_end_where_branches_meet() {
    let (right, half) = (0.5 * std::f64::consts::PI, std::f64::consts::PI);
    let crossed = equal_sides(", branch: crossed");
    for (text, ends) in [
        (crossed.as_str(), [-half, 0.0]),
        (EQUAL_CRANK, [-right, right]),
    ] {
        let [range] = ranges(text).try_into().expect("one range");
        assert_eq!(range.why, [RangeEnd::BranchesMeet; 2], "{range:?}");
        for (found, end) in range.ends.iter().zip(ends) {
            assert!((found - end).abs() < 1e-6, "{range:?}");
        }
    }
    // A rocker-crank turns, and reaches no further than its rods.
    let [range] = ranges(&four_bar([0.3, 0.4, 0.12, 0.35], ""))
        .try_into()
        .expect("one range");
    assert_eq!(range.why, [RangeEnd::Reach; 2], "{range:?}");
}

#[test]
fn a_start_at_which_branches_meet_is_refused() {
    let words = [
        "`pin`",
        "meet",
        "`branch: parallel`",
        "`branch: crossed`",
        "near",
    ];
    refused_text(&equal_sides(""), "singular-start", "loops[0]", &words);
    let near = equal_sides(", near: { cr: 1, ro: 1, co: -1 }");
    assert_eq!(found(&near).0, []);
    let over = EQUAL_CRANK.replace("cr: 0.5, ro: -1, sl: 0.15", "cr: 90 deg, ro: 180 deg");
    refused_text(
        &over,
        "singular-start",
        "loops[0]",
        &["`pin`", "meet", "near"],
    );
}

#[test]
fn positions_near_another_branch_contradict_it() {
    let sides = [0.12, 0.4, 0.3, 0.35];
    let text = four_bar(sides, ", branch: left, near: { cr: 1, ro: -1.5, co: -2 }");
    let words = [
        "`pin`",
        "`left`",
        "`right`",
        "`cr` 1",
        "`ro` -1.5",
        "`co` -2",
    ];
    refused_text(&text, "branch-contradicts-near", "loops[0].branch", &words);
    let text = equal_sides(", branch: crossed, near: { cr: 1, ro: 1, co: -1 }");
    let words = ["`crossed`", "`parallel`"];
    refused_text(&text, "branch-contradicts-near", "loops[0].branch", &words);
    // On the branch; and positions that leave it open.
    for near in ["cr: 1, ro: 1.5, co: 1", "cr: 1", "cr: -1"] {
        let text = four_bar(sides, &format!(", branch: left, near: {{ {near} }}"));
        assert_eq!(found(&text).0, [], "{near}");
    }
}

/// Gaps are distances between places, whatever the axes of rows.
#[test]
fn loops_that_do_not_close_miss_by_a_distance() {
    let too_far = four_bar([0.12, 0.4, 0.3, 2.0], "");
    refused_text(
        &too_far,
        "loop-not-assembled",
        "loops[0]",
        &["`pin` misses by 1.18 m"],
    );
    let too_short = four_bar([0.12, 0.05, 0.05, 0.35], "");
    refused_text(
        &too_short,
        "loop-not-assembled",
        "loops[0]",
        &["`pin` misses by 0.13 m"],
    );
    let slider = EQUAL_CRANK.replace(
        "origin: { xyz: [0.1, 0, 0] } }, b",
        "origin: { xyz: [0.3, 0, 0] } }, b",
    );
    let shown = refused_start(&slider, "sl: 5", "open-start");
    assert!(shown.contains("misses by 4.6"), "{shown}");
    assert!(shown.contains("nearest that closes is `sl` 0.4"), "{shown}");
}

/// What no row reads stays where the file has it, also where the search for a closed position begins at random ones.
#[test]
fn joints_that_no_row_reads_do_not_move() {
    let text = "format: 1
name: linkage
links:
  - { name: cart, joint: { name: base, type: planar }, mass: 1, inertia: { xx: 0.1, yy: 0.1, zz: 0.1 } }
  - { name: arm, parent: cart, joint: { name: ar, type: continuous, axis: z, origin: { xyz: [0, 0, 0.1] } }, mass: 1 }
  - { name: cp, parent: arm, joint: { name: cc, type: continuous, axis: z, origin: { xyz: [0.12, 0, 0] } }, mass: 1 }
  - { name: rk, parent: cart, joint: { name: rr, type: continuous, axis: z, origin: { xyz: [0.35, 0, 0.1] } }, mass: 1 }
constraints:
  k: { type: knife_edge, at: cart, direction: y }
loops:
  - { name: pin, type: distance, a: { link: cp, origin: { xyz: [0.4, 0, 0] } }, b: { link: rk, origin: { xyz: [0.3, 0, 0] } }, length: 0.3 }
";
    let system = start(text, "").expect("a start");
    let positions = &system.scene.layout.positions;
    for p in positions.iter().filter(|p| p.name.starts_with("base_")) {
        assert_eq!(at(&system, &p.name), 0.0, "{}", p.name);
    }
}

/// A rod on two balls, between a crank and a rocker with a skew axis.
const FREE_ROD: &str = "format: 1
name: linkage
links:
  - { name: crank, joint: { name: cr, type: continuous, axis: z }, mass: 1 }
  - { name: rod, joint: { name: free, type: floating }, mass: 1, inertia: { xx: 0.001, yy: 0.01, zz: 0.01 } }
  - { name: rocker, joint: { name: ro, type: continuous, axis: [0.3, 0.1, 1], origin: { xyz: [0.35, 0, 0.05] } }, mass: 1 }
loops:
  - { name: l1, type: point, a: { link: crank, origin: { xyz: [0.1, 0, 0] } }, b: { link: rod } }
  - { name: l2, type: point, a: { link: rod, origin: { xyz: [0.35, 0, 0] } }, b: { link: rocker, origin: { xyz: [0.3, 0, 0] } } }
";

/// The rod's end is on the circle of the crank.
#[test]
fn places_of_free_links_are_reached_by_joints_that_are_not_given() {
    for x in [0.05_f64, 0.09, -0.02] {
        let system = start(FREE_ROD, &format!("free_x: {x}")).expect("a start");
        let [found, y, crank] = ["free_x", "free_y", "cr"].map(|name| at(&system, name));
        assert!((found - x).abs() < 1e-12, "{x}: {found}");
        assert!((found.hypot(y) - 0.1).abs() < 1e-12);
        assert!((0.1 * crank.cos() - x).abs() < 1e-12);
    }
    // Out of reach, and against a crank that is given.
    for given in ["free_x: 0.2", "cr: 1, free_x: 0"] {
        let shown = refused_start(FREE_ROD, given, "contradicting-start");
        assert!(shown.contains("`free_x` is 0"), "{shown}");
    }
    let turned = "free: { rpy: [0, 80 deg, 0] }";
    let shown = refused_start(FREE_ROD, turned, "contradicting-start");
    assert!(shown.contains("orientation of `free`"), "{shown}");
    assert!(!shown.contains("free_q"), "{shown}");
}

#[test]
fn joints_that_follow_have_no_start() {
    let parallel = equal_sides(", branch: parallel");
    for given in ["ro: 1", "ro_rate: 1"] {
        let shown = refused_start(&parallel, given, "initial-of-follower");
        assert!(shown.contains("the joint `ro` follows `cr`"), "{shown}");
    }
}
