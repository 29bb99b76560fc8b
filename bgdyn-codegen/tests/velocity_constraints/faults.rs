//! Faults of wheels, balls, knife edges and planes: each with its place, its rule and the numbers seen.

use super::findings::{found, refused_text};

const LINKS: &str = "format: 1
name: cart
links:
  - { name: body, joint: { name: base, type: planar }, mass: 1, inertia: { xx: 1, yy: 1, zz: 1 } }
  - { name: wheel, parent: body, joint: { name: spin, type: continuous, axis: y, origin: { xyz: [0, 0.2, 0.1] } }, mass: 1, inertia: { xx: 1, yy: 1, zz: 1 } }
  - { name: ground, mass: 1 }
frames:
  - { name: blade, link: body, origin: { xyz: [0.3, 0, 0] } }
planes:
  floor: { normal: z }
";

const EDGE: &str = "edge: { type: knife_edge, at: blade, direction: y }";
const WHEEL: &str =
    "rim: { type: rolling, link: wheel, axis: y, radius: 100 mm, on: floor, rows: [longitudinal] }";

/// Asserts exactly one fault of a file with these constraints, and further keys.
fn refused(constraints: &[&str], more: &str, rule: &str, path: &str, words: &[&str]) {
    let list: String = constraints.iter().map(|one| format!("  {one}\n")).collect();
    refused_text(
        &format!("{LINKS}constraints:\n{list}{more}"),
        rule,
        path,
        words,
    );
}

/// A constraint with one part of its text replaced.
fn changed(one: &str, (from, to): (&str, &str), rule: &str, key: &str, words: &[&str]) {
    assert!(one.contains(from), "{from}");
    let name = one.split(':').next().expect("a name");
    let path = format!("constraints.{name}{key}");
    refused(&[&one.replace(from, to)], "", rule, &path, words);
}

#[test]
fn the_cart_itself_has_no_faults() {
    let text = format!("{LINKS}constraints:\n  {EDGE}\n  {WHEEL}\n");
    assert_eq!(found(&text).0, []);
}

#[test]
fn places_and_planes_need_known_names() {
    changed(
        EDGE,
        ("at: blade", "at: blde"),
        "unknown-place",
        ".at",
        &["`blde`", "`blade`"],
    );
    changed(
        WHEEL,
        ("link: wheel", "link: weel"),
        "unknown-place",
        ".link",
        &["`weel`", "`wheel`"],
    );
    changed(
        WHEEL,
        ("on: floor", "on: flor"),
        "unknown-plane",
        ".on",
        &["`flor`", "`floor`"],
    );
    changed(
        WHEEL,
        ("link: wheel", "link: ground"),
        "contact-moves-nothing",
        "",
        &["`rim`"],
    );
}

/// The cart never moves along z: the edge would take no velocity.
#[test]
fn constraints_that_always_hold_are_refused() {
    changed(
        EDGE,
        ("direction: y", "direction: z"),
        "contact-moves-nothing",
        "",
        &["`edge`", "constrains nothing", "row `slip`"],
    );
}

/// The axle is across the wheel's joint: the wheel is upright, and touches, at two angles of the joint only.
#[test]
fn wheels_that_touch_at_single_positions_are_refused() {
    let across = WHEEL.replace("axis: y", "axis: z");
    let path = "constraints.rim";
    let words = ["`rim`", "single positions"];
    refused(&[&across], "", "loop-at-single-position", path, &words);
}

#[test]
fn radii_are_positive_lengths() {
    let radius = |text: &'static str| ("100 mm", text);
    changed(
        WHEEL,
        radius("0"),
        "radius-not-positive",
        ".radius",
        &["`rim`", "0 m"],
    );
    changed(
        WHEEL,
        radius("-20 mm"),
        "radius-not-positive",
        ".radius",
        &["-0.02 m", "`knife_edge`"],
    );
    changed(WHEEL, radius("1 rad"), "unit-misfit", ".radius", &["1 rad"]);
    let parameter = radius("{ parameter: r, value: 0.1 }");
    changed(
        WHEEL,
        parameter,
        "parameter-not-possible",
        ".radius",
        &["`rim`"],
    );
    changed(
        WHEEL,
        (", radius: 100 mm", ""),
        "missing-key",
        "",
        &["`radius`"],
    );
}

#[test]
fn sizes_are_those_of_one_shape() {
    const BALL: &str = ", axis: y, radius: 100 mm, on: floor, rows: [longitudinal]";
    let ellipsoid = |keys: &'static str| (BALL, keys);
    changed(
        WHEEL,
        ellipsoid(", radii: [1, 2, 0], on: floor"),
        "radius-not-positive",
        ".radii[2]",
        &["half-axis", "`rim`", "0 m"],
    );
    changed(
        WHEEL,
        ellipsoid(", radii: [1, 2, 3 rad], on: floor"),
        "unit-misfit",
        ".radii[2]",
        &["3 rad"],
    );
    changed(
        WHEEL,
        ellipsoid(", radii: [1, 2, 3], radius: 1, on: floor"),
        "unused-key",
        ".radius",
        &["`radius`", "`radii`"],
    );
    changed(
        WHEEL,
        ellipsoid(", radii: [1, 2, 3], axis: y, on: floor"),
        "unused-key",
        ".axis",
        &["`axis`", "`radii`"],
    );
    changed(
        WHEEL,
        ellipsoid(", radius: 1, crown_radius: 0.1, on: floor"),
        "unused-key",
        ".crown_radius",
        &["`axis`"],
    );
    changed(
        WHEEL,
        ("radius: 100 mm", "radius: 100 mm, crown_radius: -1 mm"),
        "radius-not-positive",
        ".crown_radius",
        &["crown radius", "-0.001 m"],
    );
}

#[test]
fn directions_are_axes() {
    let direction = |text: &'static str| ("direction: y", text);
    changed(
        EDGE,
        direction("direction: q"),
        "unknown-axis",
        ".direction",
        &["`q`"],
    );
    changed(
        EDGE,
        direction("direction: [0, 0, 0]"),
        "zero-axis",
        ".direction",
        &[],
    );
    changed(
        EDGE,
        (", direction: y", ""),
        "missing-key",
        "",
        &["`direction`"],
    );
    changed(
        WHEEL,
        ("link: wheel, axis: y", "link: body, axis: z"),
        "wheel-lies-flat",
        "",
        &["`rim`", "`axis`"],
    );
}

#[test]
fn rows_are_those_of_wheels() {
    let rows = |text: &'static str| ("rows: [longitudinal]", text);
    changed(
        WHEEL,
        rows("rows: [sideways]"),
        "unknown-row",
        ".rows[0]",
        &["`sideways`", "`lateral`"],
    );
    changed(WHEEL, rows("rows: []"), "no-rows", ".rows", &["`lateral`"]);
    changed(WHEEL, ("axis: y, ", ""), "unused-key", ".rows", &["`axis`"]);
}

#[test]
fn a_wheel_that_cannot_touch_says_how_far_it_is() {
    changed(
        WHEEL,
        ("100 mm", "80 mm"),
        "wheel-never-touches",
        "",
        &["`rim`", "0.02 m above", "0.08 m"],
    );
    changed(
        WHEEL,
        ("100 mm", "120 mm"),
        "wheel-never-touches",
        "",
        &["0.02 m below", "`offset`"],
    );
}

#[test]
fn rows_that_follow_from_others_name_them() {
    let both = WHEEL.replace(", rows: [longitudinal]", "");
    let edge = EDGE.replace("at: blade", "at: body");
    refused(
        &[&edge, &both],
        "",
        "dependent-row",
        "constraints.rim",
        &["`lateral`", "1 · `edge slip`", "`rows: [longitudinal]`"],
    );
}

#[test]
fn something_is_left_to_move() {
    let along = EDGE
        .replace("edge", "along")
        .replace("direction: y", "direction: x");
    let along = along.replace("knife_along", "knife_edge");
    let other = "other: { type: knife_edge, at: body, direction: y }";
    refused(
        &[EDGE, &along, other, WHEEL],
        "",
        "nothing-left-to-move",
        "constraints",
        &["4 rows", "4 velocities"],
    );
}

#[test]
fn independent_velocities_determine_the_others() {
    refused(
        &[EDGE],
        "independent: [base_y, base_turn]\n",
        "independents-do-not-determine",
        "constraints",
        &["`base_y`", "`base_turn`"],
    );
    refused(
        &[EDGE, WHEEL],
        "independent: [base_x, base_turn, spin]\n",
        "too-many-independents",
        "constraints",
        &["3 joints", "2"],
    );
    refused(
        &[EDGE],
        "independent: [base_w]\n",
        "unknown-name",
        "independent[0]",
        &["`base_w`"],
    );
}

#[test]
fn planes_have_a_link_a_normal_and_an_offset() {
    for (plane, rule, key) in [
        ("{ normal: [0, 0, 0] }", "zero-axis", ".normal"),
        ("{ offset: 3 rad }", "unit-misfit", ".offset"),
        ("{ link: flor }", "unknown-link", ".link"),
        ("{ depth: 1 }", "unknown-key", ""),
    ] {
        let text = format!("{LINKS}  low: {plane}\nconstraints:\n  {EDGE}\n");
        refused_text(&text, rule, &format!("planes.low{key}"), &[]);
    }
}

#[test]
fn all_mistakes_of_a_plane_are_reported_once() {
    let text = format!(
        "{}\nconstraints:\n  {WHEEL}\n",
        LINKS.replace("normal: z", "link: flor, normal: [0, 0, 0]")
    );
    let reported = found(&text).0;
    let mut rules: Vec<_> = reported
        .iter()
        .map(|fault| (fault.rule, fault.path.as_str()))
        .collect();
    rules.sort_unstable();
    assert_eq!(
        rules,
        [
            ("unknown-link", "planes.floor.link"),
            ("zero-axis", "planes.floor.normal"),
        ]
    );
}

/// A bicycle that cannot be steered leans and rolls: no position at which it lies flat is taken for one of its motion.
#[test]
fn a_bicycle_without_steering_leans_and_rolls() {
    let text = "format: 1
name: tandem
links:
  - { name: base, joint: { name: ground, type: planar } }
  - { name: rise, parent: base, joint: { name: height, type: prismatic, axis: z } }
  - { name: roll, parent: rise, joint: { name: lean, type: continuous, axis: x } }
  - { name: frame, parent: roll, joint: { name: pitch, type: continuous, axis: y }, mass: 80, inertia: { xx: 9, yy: 11, zz: 3 } }
  - { name: rear_wheel, parent: frame, joint: { name: rear_spin, type: continuous, axis: y }, mass: 2, inertia: { xx: 0.06, yy: 0.12, zz: 0.06 } }
  - { name: front_wheel, parent: frame, joint: { name: front_spin, type: continuous, axis: y, origin: { xyz: [1.02, 0, 0.05] } }, mass: 3, inertia: { xx: 0.14, yy: 0.28, zz: 0.14 } }
constraints:
  rear: { type: rolling, link: rear_wheel, axis: y, radius: 300 mm }
  front: { type: rolling, link: front_wheel, axis: y, radius: 350 mm }
independent: [lean, rear_spin]
";
    assert_eq!(found(text).0, []);
}
