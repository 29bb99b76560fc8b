//! Tests the notations of a tensor: entries, products, about the origin, a solid.

use bgdyn_codegen::mechanism::Value;
use bgdyn_runtime::Dd;

use super::{dd, link, rules, sound};

/// Returns the tensor of a link with a mass of 3 kg and these keys: xx, yy, zz, xy, xz, yz.
fn of(keys: &str) -> [Dd; 6] {
    let mechanism = sound(&link(&format!("mass: 3, {keys}")));
    let entries = mechanism.links()[0].inertial.inertia.entries;
    entries.map(|entry| match entry {
        Value::Fixed(number) => number,
        Value::Parameter(_) => panic!("no parameter was written"),
    })
}

/// The tensor of a solid of 3 kg.
fn solid(keys: &str) -> [Dd; 6] {
    of(&format!("inertia: {{ {keys} }}"))
}

fn close(found: [Dd; 6], wanted: [Dd; 6]) {
    for (a, b) in found.into_iter().zip(wanted) {
        assert!((a - b).abs() < dd("1e-30"), "{found:?}, not {wanted:?}");
    }
}

fn diagonal(moments: [&str; 3]) -> [Dd; 6] {
    let [x, y, z] = moments.map(dd);
    [x, y, z, Dd::ZERO, Dd::ZERO, Dd::ZERO]
}

/// m (b² + c²)/12; m r²/2 and m (3 r² + l²)/12; 2/5 m r²; m l²/12.
#[test]
fn solids_have_the_tensors_of_the_handbook() {
    close(
        solid("solid: box, size: [0.2, 0.4, 600 mm]"),
        diagonal(["0.13", "0.1", "0.05"]),
    );
    close(
        solid("solid: cylinder, radius: 0.2, length: 0.6"),
        diagonal(["0.12", "0.12", "0.06"]),
    );
    close(
        solid("solid: cylinder, radius: 0.2, length: 0.6, axis: y"),
        diagonal(["0.12", "0.06", "0.12"]),
    );
    close(
        solid("solid: sphere, radius: 0.5"),
        diagonal(["0.3", "0.3", "0.3"]),
    );
    close(
        solid("solid: rod, length: 0.6, axis: -x"),
        diagonal(["0", "0.09", "0.09"]),
    );
}

/// A hollow solid is the full one minus the hole, each with its part of the mass.
#[test]
fn hollow_solids_are_what_the_hole_leaves() {
    let share = |inner: &str, power: i32| {
        let ratio = dd(inner) / dd("0.2");
        (0..power).fold(Dd::ONE, |x, _| x * ratio)
    };
    for (keys, power) in [("solid: cylinder, length: 0.6", 2), ("solid: sphere", 3)] {
        let hollow = solid(&format!("{keys}, radius: 0.2, inner_radius: 0.1"));
        let (full, hole) = (
            solid(&format!("{keys}, radius: 0.2")),
            solid(&format!("{keys}, radius: 0.1")),
        );
        let hole_share = share("0.1", power);
        let rest = Dd::ONE - hole_share;
        close(
            hollow,
            std::array::from_fn(|k| (full[k] - hole[k] * hole_share) / rest),
        );
        close(
            solid(&format!("{keys}, radius: 0.2, inner_radius: 0")),
            full,
        );
    }
}

/// An inclined axis is the axis x rotated by the same angle.
#[test]
fn a_slanted_axis_is_a_turned_one() {
    let slanted = solid("solid: cylinder, radius: 0.2, length: 0.6, axis: [3, 4, 0]");
    let (about, across) = (dd("0.06"), dd("0.12"));
    let (c, s) = (dd("0.6"), dd("0.8"));
    let entry = |ci: Dd, cj: Dd, same: bool| {
        let turned = (about - across) * ci * cj;
        if same { across + turned } else { turned }
    };
    let wanted = [
        entry(c, c, true),
        entry(s, s, true),
        across,
        entry(c, s, false),
        Dd::ZERO,
        Dd::ZERO,
    ];
    close(slanted, wanted);
    let turned = solid("solid: box, size: [0.2, 0.4, 0.6], rpy: [0, 0, 90 deg]");
    close(turned, diagonal(["0.1", "0.13", "0.05"]));
}

#[test]
fn products_are_minus_the_entries() {
    let entries = of("inertia: { xx: 1, yy: 2, zz: 2.5, xy: 0.1, yz: -0.2 }");
    let products = of("inertia: { xx: 1, yy: 2, zz: 2.5, products: { xy: -0.1, yz: 0.2 } }");
    assert_eq!(entries, products);
}

/// The parallel axis theorem: J about the origin is J about the centre and m (c·c 1 − c cᵀ).
#[test]
fn a_tensor_about_the_origin_is_shifted() {
    let com = "com: [0.1, -0.2, 0.3]";
    let centre = of(&format!(
        "{com}, inertia: {{ xx: 1, yy: 2, zz: 2.5, xz: 0.1 }}"
    ));
    let about = "xx: 1.39, yy: 2.3, zz: 2.65, xy: 0.06, xz: 0.01, yz: 0.18, about: origin";
    close(of(&format!("{com}, inertia: {{ {about} }}")), centre);
    let plain = "xx: 1, yy: 2, zz: 2.5, xz: 0.1";
    assert_eq!(
        of(&format!("inertia: {{ {plain}, about: origin }}")),
        of(&format!("inertia: {{ {plain}, about: com }}"))
    );
    // First rotated, then shifted: an upright box beside the origin.
    let turned =
        of("com: [1, 0, 0], inertia: { xx: 1, yy: 5, zz: 6, rpy: [90 deg, 0, 0], about: origin }");
    close(turned, diagonal(["1", "3", "2"]));
}

#[test]
fn slips_are_all_told_at_once() {
    let several =
        link("mass: 1, inertia: { solid: rod, radius: 0, axis: [0, 0, 0], xx: 1, about: com }");
    assert_eq!(rules(&several), ["two-tensors", "two-tensors"]);
    let rod = link("mass: 1, inertia: { solid: rod, radius: 1, axis: [0, 0, 0] }");
    assert_eq!(
        rules(&rod),
        ["missing-dimension", "misplaced-dimension", "zero-axis"]
    );
    let loose = link("mass: 1, inertia: { size: [1, 1, 1], axis: x, length: 1 }");
    assert_eq!(rules(&loose), ["misplaced-dimension"; 3]);
    let flat = link("mass: 1, inertia: { solid: box, size: [0.1, 0.2, 0] }");
    assert!(rules(&flat).is_empty(), "a plate is a box");
}

#[test]
fn tensors_are_turned_into_link_axes() {
    assert_eq!(
        solid("xx: 1, yy: 2, zz: 2.5, yz: 0.1"),
        ["1", "2", "2.5", "0", "0", "0.1"].map(dd)
    );
    let turned = solid("xx: 1, yy: 2, zz: 2.5, yz: 0.1, rpy: [0, 0, 90 deg]");
    assert_eq!(turned, ["2", "1", "2.5", "0", "-0.1", "0"].map(dd));
    let round = solid("xx: 2, yy: 2, zz: 2, rpy: [0.3, 0.4, 0.5]");
    assert_eq!((round[0], round[1]), (round[1], round[2]));
    assert_eq!(round[3..], [Dd::ZERO; 3]);
    let slanted = solid("xx: 1, yy: 2, zz: 2.5, rpy: [0, 0, 45 deg]");
    assert!(
        (slanted[3] - dd("-0.5")).to_f64().abs() < 1e-30,
        "xy = (xx − yy)/2"
    );
    assert_eq!(slanted[4..], [Dd::ZERO; 2]);
    let close = solid("xx: 1, yy: 1.00000000000000001, zz: 1");
    assert_ne!(close[0], close[1], "given numbers stay as written");
}

#[test]
fn tensors_of_no_body_are_refused() {
    let rule = |keys: &str| rules(&link(keys));
    assert_eq!(
        rule("inertia: { xx: 1, yy: 1, zz: 2 }"),
        [""; 0],
        "a flat body"
    );
    assert_eq!(
        rule("inertia: { xx: 1, yy: 1, zz: 2.000000001 }"),
        [""; 0],
        "within 1e-9"
    );
    assert_eq!(
        rule("inertia: { xx: 1, yy: 1, zz: 2.00000001 }"),
        ["triangle-inequality"]
    );
    assert_eq!(rule("inertia: { zz: 1 }, nonphysical: allow"), [""; 0]);
    assert_eq!(
        rule("inertia: { zz: 1, xy: 0.1 }, nonphysical: allow"),
        ["not-semidefinite"]
    );
    assert_eq!(
        rule("inertia: { xx: -1, yy: -1, zz: -1 }"),
        ["not-semidefinite"]
    );
    assert_eq!(
        rule("inertia: { xx: 1, yy: 1, zz: 1, xy: 1 }"),
        ["triangle-inequality"]
    );
    assert_eq!(
        rule("inertia: { xx: 1e-90, yy: 1e-90, zz: 9e-90 }"),
        ["triangle-inequality"]
    );
    assert_eq!(
        rule("inertia: { xx: 1e90, yy: 1e90, zz: 9e90 }"),
        ["triangle-inequality"]
    );
    assert_eq!(
        rule("mass: 0, inertia: { xx: 1, yy: 1, zz: 1 }"),
        [""; 0],
        "lumped"
    );
    assert_eq!(
        rule("inertia: { xx: 1, yy: x, zz: 9 }"),
        ["wrong-type"],
        "no second fault"
    );
}
