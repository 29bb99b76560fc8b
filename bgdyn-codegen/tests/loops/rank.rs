//! Rows that follow from others: which are left out, and that what is left moves as with multipliers for all rows.

use bgdyn_codegen::fault::Severity;
use bgdyn_codegen::mechanism::closure::Closure;

use super::drawn::{
    ACROSS, NORMAL, at, connect, four_bar, link, on, spherical, turning, vector, xyz,
};
use super::findings::{found, refused_text};
use super::multipliers::compare;
use super::random_loops::Text;
use super::references::spec;
use super::robot::Robot;

/// Returns the numbers of rows that are kept, hold everywhere, follow everywhere, and follow where closed.
fn counts(text: &Text) -> [usize; 4] {
    let robot = Robot::read(&text.closed());
    let closure: &Closure = robot.mechanism.closure().expect("loops");
    let always = closure.following.iter().filter(|one| one.always).count();
    let closed = closure.following.len() - always;
    [closure.rows.len(), closure.dropped.len(), always, closed]
}

/// Asserts which rows are left, and compares with multipliers.
fn moves(text: &Text, expected: [usize; 4], what: &str) {
    assert_eq!(counts(text), expected, "{what}");
    compare(text, what);
}

/// The rows of a planar loop fall by structure for every type, whatever the direction of its plane.
#[test]
fn planar_loops_keep_the_rows_of_the_plane() {
    for root in ["fixed", "floating"] {
        for (kind, axis, rows) in [
            ("hinge", NORMAL, [2, 3, 0, 0]),
            ("point", NORMAL, [2, 1, 0, 0]),
            ("slider", ACROSS[0], [2, 3, 0, 0]),
        ] {
            let mut text = four_bar(root, [0.12, 0.35]);
            let ends = [at(0.4, 0.0), at(0.3, 0.0)].map(xyz);
            connect(
                &mut text,
                kind,
                [("coupler", &ends[0]), ("rocker", &ends[1])],
                (axis, ""),
            );
            moves(&text, rows, &format!("{kind}, {root}"));
        }
    }
}

/// A coupler cut in two, and a rod between pins.
#[test]
fn planar_welds_and_rods_keep_the_rows_of_the_plane() {
    let mut text = four_bar("spherical", [0.12, 0.35]);
    link(
        &mut text,
        ("half", "rocker"),
        &turning(NORMAL, at(0.3, 0.0)),
    );
    let ends = [at(0.2, 0.0), at(-0.2, 0.0)].map(xyz);
    connect(
        &mut text,
        "weld",
        [("coupler", &ends[0]), ("half", &ends[1])],
        (NORMAL, ""),
    );
    moves(&text, [3, 3, 0, 0], "weld");
    let mut text = four_bar("fixed", [0.12, 0.35]);
    let ends = [at(0.1, 0.05), at(0.3, 0.0)].map(xyz);
    let rod = "    length: 0.4\n";
    connect(
        &mut text,
        "distance",
        [("coupler", &ends[0]), ("rocker", &ends[1])],
        (NORMAL, rod),
    );
    moves(&text, [1, 0, 0, 0], "rod");
}

/// All axes go through one point, the places of the hinge do not: they slide there along its axis.
#[test]
fn spherical_loops_keep_two_rows() {
    for root in ["fixed", "floating"] {
        let text = spherical(root, 0.25);
        moves(&text, [2, 3, 0, 0], root);
    }
}

/// A hinge does not slide along its axis: places that are not as far from the centre never meet.
#[test]
fn hinges_of_spherical_loops_do_not_slide() {
    let text = spec("spherical_four_bar");
    assert_eq!(found(&text).0, []);
    let text = text.replace("-20 cm", "-21 cm");
    let words = ["`pin` misses by 0.0"];
    refused_text(&text, "loop-not-assembled", "loops[0]", &words);
}

/// Slides only: nothing turns; in a plane the third row of the place falls, along one line the first two.
#[test]
fn loops_of_slides_keep_the_rows_of_places() {
    let slide = |axis: [f64; 3]| format!("type: prismatic, axis: {}", vector(axis));
    let mut text = on("floating");
    link(&mut text, ("x", "body_0"), &slide(ACROSS[0]));
    link(&mut text, ("y", "x"), &slide(ACROSS[1]));
    link(&mut text, ("wedge", "body_0"), &slide(at(0.6, 0.8)));
    let ends = [xyz(at(0.1, 0.2)), xyz(at(0.1, 0.2))];
    connect(
        &mut text,
        "weld",
        [("y", &ends[0]), ("wedge", &ends[1])],
        (NORMAL, ""),
    );
    moves(&text, [2, 4, 0, 0], "plane");
    let mut text = on("fixed");
    link(&mut text, ("first", "body_0"), &slide(NORMAL));
    link(&mut text, ("second", "first"), &slide(NORMAL));
    link(&mut text, ("third", "body_0"), &slide(NORMAL));
    let end = xyz(at(0.1, 0.2));
    connect(
        &mut text,
        "point",
        [("second", &end), ("third", &end)],
        (NORMAL, ""),
    );
    moves(&text, [1, 2, 0, 0], "line");
}

/// A parallelogram whose coupler a third rod holds too moves by its equal lengths only.
fn parallelogram(third: f64) -> Text {
    let mut text = four_bar("fixed", [0.25, 0.35]);
    link(
        &mut text,
        ("middle", "body_0"),
        &turning(NORMAL, at(0.15, 0.0)),
    );
    let near =
        "    near: { crank_joint: 1, coupler_joint: -1, rocker_joint: 1, middle_joint: 1 }\n";
    let ends = [at(0.35, 0.0), at(0.25, 0.0)].map(xyz);
    connect(
        &mut text,
        "hinge",
        [("coupler", &ends[0]), ("rocker", &ends[1])],
        (NORMAL, near),
    );
    let ends = [at(0.15, 0.0), at(third, 0.0)].map(xyz);
    connect(
        &mut text,
        "hinge",
        [("coupler", &ends[0]), ("middle", &ends[1])],
        (NORMAL, ""),
    );
    text
}

#[test]
fn a_third_rod_of_a_parallelogram_is_paradoxical() {
    let text = parallelogram(0.25);
    moves(&text, [3, 6, 0, 1], "third rod");
    warned(
        &text.closed(),
        "loop_",
        &["4 velocities less 4 rows would leave 0", "1 move"],
    );
    // Shorter by a millimetre it locks: four rows for four velocities.
    let locked = found(&parallelogram(0.249).closed());
    assert!(locked.any_fault());
    assert_eq!(locked.0[0].rule, "nothing-left-to-move");
}

/// A parallelogram of rods of 1 m, and a third rod that is too long.
fn third_rod(off: f64, [near, more]: [&str; 2]) -> String {
    let joint = |name: &str, at: &str| {
        format!(
            "joint: {{ name: {name}, type: continuous, axis: z, origin: {{ xyz: {at} }} }}, mass: 1"
        )
    };
    let [q0, qc, q1, q2] = [
        ("q0", "[0, 0, 0]"),
        ("qc", "[0, 1, 0]"),
        ("q1", "[1, 0, 0]"),
        ("q2", "[0.5, 0.2, 0]"),
    ]
    .map(|(name, at)| joint(name, at));
    let third = 1.0 + off;
    format!(
        "format: 1
name: rods
links:
  - {{ name: r0, {q0} }}
  - {{ name: cp, parent: r0, {qc} }}
  - {{ name: r1, {q1} }}
  - {{ name: r2, {q2} }}
loops:
  - {{ name: p1, type: hinge, a: {{ link: cp, origin: {{ xyz: [1, 0, 0] }} }}, b: {{ link: r1, origin: {{ xyz: [0, 1, 0] }} }}{near} }}
  - {{ name: p2, type: hinge, a: {{ link: cp, origin: {{ xyz: [0.5, 0.2, 0] }} }}, b: {{ link: r2, origin: {{ xyz: [0, {third}, 0] }} }}{more} }}
"
    )
}

/// A third rod that is too long by the rounding of a drawing closes, and holds the parallelogram: the message names
/// rounding, and the tolerance that it proposes lets all move.
#[test]
fn rounded_third_rods_are_named_as_such() {
    let upright = ", branch: left";
    let leaning = ", near: { q0: 0.6, q1: 0.6, qc: -0.6, q2: 0.6 }";
    for near in [upright, leaning] {
        for off in [1e-10, 1e-6, 1e-5] {
            let refused = |more: &str, rule: &str, words: &[&str]| {
                refused_text(&third_rod(off, [near, more]), rule, "loops[1]", words);
            };
            let words = ["`p2`", "rounded", "`tolerance: "];
            refused("", "loop-closes-to-rounding", &words);
            let narrow = format!(", tolerance: {}", 1e-2 * off);
            refused(&narrow, "tolerance-exceeded", &["`p2`", "its `tolerance`"]);
            let text = third_rod(off, [near, &format!(", tolerance: {}", 1e1 * off)]);
            warned(&text, "p2", &["4 velocities less 4 rows", "1 move"]);
        }
    }
    // Longer by a millimetre it holds them.
    let text = third_rod(1e-3, [upright, ""]);
    let words = ["4 rows for 4 velocities"];
    refused_text(&text, "nothing-left-to-move", "loops", &words);
    let words = ["`last_hinge`", "rounded"];
    let text = rounded(".01", "");
    refused_text(&text, "loop-closes-to-rounding", "loops[0]", &words);
}

/// Asserts exactly one finding, the warning of a paradoxical loop.
fn warned(text: &str, name: &str, words: &[&str]) {
    let findings = found(text);
    let shown = findings.render("loop.yaml", text);
    assert_eq!(findings.0.len(), 1, "{shown}");
    assert_eq!(findings.0[0].severity, Severity::Warning, "{shown}");
    assert_eq!(findings.0[0].rule, "paradoxical-loop", "{shown}");
    for word in [name].iter().chain(words) {
        assert!(shown.contains(word), "no {word:?} in {shown}");
    }
}

/// Bricard's six hinges with the lengths of `specs/loops`, on a base.
fn bricard(root: &str) -> Text {
    let mut text = on(root);
    let lengths = ["0", "0.24", "0.23", "0.26", "0.28"];
    for (k, length) in lengths.iter().enumerate() {
        let angle = [0, 90, -90][if k == 0 { 0 } else { 1 + (k + 1) % 2 }];
        let (name, parent) = (format!("body_{}", k + 1), format!("body_{k}"));
        let joint = format!(
            "type: continuous, origin: {{ xyz: [{length}, 0, 0], rpy: [{angle} deg, 0, 0] }}"
        );
        link(&mut text, (&name, &parent), &joint);
    }
    let near = "    near: { body_1_joint: 1, body_2_joint: 1, body_3_joint: -1, body_4_joint: 1.5, body_5_joint: -1 }\n";
    let ends = ["0.31", "-0.3"].map(|x| format!("{{ xyz: [{x}, 0, 0], rpy: [90 deg, 0, 0] }}"));
    let z = [0.0, 0.0, 1.0];
    connect(
        &mut text,
        "hinge",
        [("body_5", &ends[0]), ("body_0", &ends[1])],
        (z, near),
    );
    text
}

#[test]
fn bricards_loop_moves_as_with_multipliers() {
    for root in ["fixed", "floating"] {
        moves(&bricard(root), [4, 0, 0, 1], root);
    }
    let words = [
        "`last_hinge`",
        "5 velocities less 5 rows would leave 0",
        "1 move",
    ];
    warned(&spec("bricard"), "`last_hinge tilt", &words);
}

/// Bricard's spec with one length off.
fn rounded(by: &str, more: &str) -> String {
    let length = format!("31{by} cm, 0, 0");
    let text = spec("bricard").replace("31 cm, 0, 0", &length);
    assert!(text.contains(&length));
    text.replace("type: hinge", &format!("type: hinge\n    {more}"))
}

#[test]
fn rounded_lengths_are_named_as_such() {
    let words = [
        "`last_hinge`",
        "e-1",
        "would move if it closed",
        "`tolerance: 1e-8 m`",
    ];
    // 1e-9 m
    refused_text(
        &rounded(".0000001", ""),
        "loop-closes-to-rounding",
        "loops[0]",
        &words,
    );
    // Longer by a millimetre it closes, and stands still.
    let words = ["5 rows for 5 velocities"];
    refused_text(&rounded(".1", ""), "nothing-left-to-move", "loops", &words);
    let words = ["`last_hinge` misses by", " m"];
    refused_text(&rounded("0", ""), "loop-not-assembled", "loops[0]", &words);
}

/// With the tolerance that the message proposes, the other rows close exactly, and the rest stays within it.
#[test]
fn rounded_lengths_move_within_their_tolerance() {
    let text = rounded(".0000001", "tolerance: 1e-8 m");
    warned(&text, "`last_hinge tilt", &["1 move"]);
    let robot = Robot::read(&text);
    let closure = robot.mechanism.closure().expect("loops");
    for q in &closure.samples {
        let (kept, _) = closure.values(&closure.rows, q);
        let left: Vec<_> = closure.following.iter().map(|one| one.row).collect();
        let (open, _) = closure.values(&left, q);
        assert!(kept.iter().all(|x| x.to_f64().abs() < 1e-25));
        let open = open[0].to_f64().abs();
        assert!(open > 1e-14 && open < 1e-8, "{open:e}");
    }
    let words = ["1e-11 m", "e-9 m"];
    let text = rounded(".0000001", "tolerance: 1e-11 m");
    refused_text(&text, "tolerance-exceeded", "loops[0]", &words);
    let text = rounded("", "tolerance: 1 cm");
    refused_text(
        &text,
        "tolerance-out-of-range",
        "loops[0].tolerance",
        &["1 cm", "1 mm"],
    );
}

/// A pin that is written twice: refused with the combination, or left out.
#[test]
fn rows_that_follow_everywhere_need_a_word() {
    let twice = |more: &str| {
        let mut text = four_bar("fixed", [0.12, 0.35]);
        let ends = [at(0.4, 0.0), at(0.3, 0.0)].map(xyz);
        for more in ["", more] {
            connect(
                &mut text,
                "hinge",
                [("coupler", &ends[0]), ("rocker", &ends[1])],
                (NORMAL, more),
            );
        }
        text
    };
    let findings = found(&twice("").closed());
    let shown = findings.render("loop.yaml", &twice("").closed());
    assert_eq!(findings.0.len(), 2, "{shown}");
    for word in [
        "dependent-row",
        "`loop_1`",
        "1 · `loop_0 x`",
        "redundant: allow",
    ] {
        assert!(shown.contains(word), "no {word:?} in {shown}");
    }
    let text = twice("    redundant: allow\n");
    assert_eq!(found(&text.closed()).0, []);
    moves(&text, [2, 6, 2, 0], "twice");
    let text = twice("    redundant: yes\n").closed();
    refused_text(
        &text,
        "redundant-word",
        "loops[1].redundant",
        &["`yes`", "allow"],
    );
}

/// A second pin, 10 µm beside the first: open within its own tolerance, not within that of the other loop.
#[test]
fn a_tolerance_is_that_of_its_loop() {
    let pins = |first: &str, second: &str| {
        let mut text = four_bar("fixed", [0.12, 0.35]);
        for (more, pin) in [(first, 0.3), (second, 0.300_01)] {
            let ends = [at(0.4, 0.0), at(pin, 0.0)].map(xyz);
            let pins = [("coupler", ends[0].as_str()), ("rocker", ends[1].as_str())];
            connect(&mut text, "hinge", pins, (NORMAL, more));
        }
        text
    };
    let (wide, narrow) = (
        "    redundant: allow\n    tolerance: 1e-4 m\n",
        "    redundant: allow\n",
    );
    let text = pins("", wide);
    assert_eq!(found(&text.closed()).0, []);
    assert_eq!(counts(&text), [2, 6, 2, 0]);
    let robot = Robot::read(&text.closed());
    let closure = robot.mechanism.closure().expect("loops");
    assert!(
        closure.rows.iter().all(|row| row.closes == 0),
        "the first pin is closed"
    );
    let text = pins("    tolerance: 1e-4 m\n", narrow).closed();
    refused_text(&text, "loop-at-single-position", "loops[1]", &["`loop_1`"]);
}

/// Crank and rocker that reach each other in one position only.
#[test]
fn loops_that_close_at_single_positions_are_refused() {
    let mut text = four_bar("fixed", [0.12, 0.35]);
    let ends = [at(0.13, 0.0), at(-0.1, 0.0)].map(xyz);
    connect(
        &mut text,
        "hinge",
        [("coupler", &ends[0]), ("rocker", &ends[1])],
        (NORMAL, ""),
    );
    refused_text(
        &text.closed(),
        "loop-at-single-position",
        "loops[0]",
        &["`loop_0`", "single positions"],
    );
}
