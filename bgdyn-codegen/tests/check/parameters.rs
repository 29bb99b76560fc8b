//! Tests run-time parameters: their valid positions, their results, and refused ones.

use bgdyn_codegen::mechanism::{ParameterId, Pose, Value};
use bgdyn_runtime::Dd;

use super::{dd, joint, link, rules, sound};

const PAYLOAD: &str = "\
format: 1
links:
  - name: arm
    joint: { name: shoulder, type: revolute }
    mass: 2
  - name: left
    parent: arm
    mass: { parameter: finger, value: 40 g }
  - name: part
    parent: arm
    mass: { parameter: payload, value: 1.5 kg }
    com: [{ parameter: reach, value: 30 mm }, 0, 1 mm]
    inertia:
      xx: { parameter: spin, value: 2 g*cm^2 }
      yy: { parameter: spin, value: 2e-7 }
      zz: 1e-7
      rpy: [30 deg, 0, 0]
  - name: right
    parent: arm
    mass: { parameter: finger, value: 0.04 }
";

#[test]
fn parameters_have_name_meaning_default_and_unit() {
    let arm = sound(PAYLOAD);
    let shown: Vec<String> = arm
        .parameters()
        .iter()
        .map(|p| format!("{} = {}: {p}", p.name, p.default.to_f64()))
        .collect();
    let wanted = [
        "finger = 0.04: mass of link `left` and mass of link `right`, kg",
        "payload = 1.5: mass of link `part`, kg",
        "reach = 0.03: x of the centre of mass of link `part`, m",
        "spin = 0.0000002: entry xx of the inertia tensor of link `part` and entry yy of the \
         inertia tensor of link `part`, kg*m^2",
    ];
    assert_eq!(shown, wanted);
    assert_eq!(arm.parameters()[0].default, dd("0.04"), "the decimal");
}

#[test]
fn values_refer_to_their_parameter() {
    let arm = sound(PAYLOAD);
    let [_, left, part, right] = arm.links() else {
        panic!("four links");
    };
    let parameter = |p| Value::Parameter(ParameterId(p));
    assert_eq!(left.inertial.mass, parameter(0));
    assert_eq!(right.inertial.mass, parameter(0));
    let (zero, millimetre) = (Value::Fixed(Dd::ZERO), Value::Fixed(dd("1e-3")));
    assert_eq!(part.inertial.com.0, [parameter(2), zero, millimetre]);
    let tensor = part.inertial.inertia;
    assert_eq!(
        tensor.entries[..3],
        [parameter(3), parameter(3), Value::Fixed(dd("1e-7"))]
    );
    // Entries with a parameter cannot be rotated at generation time.
    assert_ne!(tensor.axes, Pose::IDENTITY.rotation);
    assert_eq!(left.inertial.inertia.axes, Pose::IDENTITY.rotation);
}

#[test]
fn a_parameter_stands_only_where_inertia_is_told() {
    let p = "{ parameter: p, value: 0.5 }";
    let misplaced = |text: &str| assert_eq!(rules(text), ["misplaced-parameter"], "{text}");
    misplaced(&format!("format: {p}\nlinks: [{{ name: a }}]\n"));
    misplaced(&format!("format: 1\nsnap: {p}\nlinks: [{{ name: a }}]\n"));
    misplaced(&format!(
        "format: 1\ngravity: [0, 0, {p}]\nlinks: [{{ name: a }}]\n"
    ));
    misplaced(&format!(
        "format: 1\ngravity: {p}\nlinks: [{{ name: a }}]\n"
    ));
    misplaced(&link(&format!("label: {p}")));
    misplaced(&link(&format!("com: {p}")));
    misplaced(&link(&format!("inertia: {p}")));
    misplaced(&link(&format!("inertia: {{ zz: 0, rpy: [0, 0, {p}] }}")));
    misplaced(&joint(&format!("axis: [0, 0, {p}]")));
    misplaced(&joint(&format!("axis: {p}")));
    misplaced(&joint(&format!("origin: {p}")));
    misplaced(&joint(&format!("origin: {{ xyz: [{p}, 0, 0] }}")));
    misplaced(&joint(&format!("limits: {{ lower: {p} }}")));
    for text in [
        "mass: 1",
        "com: [1, 0, 0]",
        "inertia: { xx: 1, yy: 1, zz: 1 }",
    ] {
        sound(&link(&text.replace('1', "{ parameter: p, value: 1 }")));
    }
}

#[test]
fn what_a_parameter_must_be() {
    let mass = |text: &str| rules(&link(&format!("mass: {{ {text} }}")));
    assert_eq!(mass("parameter: p, value: 1 kg"), [""; 0]);
    assert_eq!(mass("parameter: p"), ["missing-key"]);
    assert_eq!(mass("value: 1"), ["missing-key"]);
    assert_eq!(mass("parameter: p, value: 1, unit: kg"), ["unknown-key"]);
    assert_eq!(mass("parameter: p, value: 1 mm"), ["unit-misfit"]);
    assert_eq!(mass("parameter: p, value: .nan"), ["non-finite"]);
    assert_eq!(mass("parameter: p, value: -1"), ["negative-mass"]);
    assert_eq!(mass("parameter: 7, value: 1"), ["wrong-type"]);
    assert_eq!(
        mass("parameter: p, value: { parameter: q, value: 1 }"),
        ["misplaced-parameter"]
    );
    for name in ["Payload", "pay load", "1st", "self", "fn", "_"] {
        assert_eq!(
            mass(&format!("parameter: \"{name}\", value: 1")),
            ["name"],
            "{name}"
        );
    }
    for name in ["gravity", "mass_matrix", "forward_dynamics_derivatives"] {
        assert_eq!(
            mass(&format!("parameter: {name}, value: 1")),
            ["reserved-name"],
            "{name}"
        );
    }
}

#[test]
fn one_name_is_one_number() {
    let two = |com: &str| {
        let mass = "mass: { parameter: p, value: 0.5 kg }";
        rules(&link(&format!("{mass}, com: [{com}, 0, 0]")))
    };
    assert_eq!(two("{ parameter: p, value: 0.5 }"), ["parameter-conflict"]);
    assert_eq!(two("{ parameter: r, value: 0.5 }"), [""; 0]);
    let twice = |y: &str| {
        let x = "{ parameter: p, value: 0.5 m }";
        rules(&link(&format!(
            "com: [{x}, {{ parameter: p, value: {y} }}, 0]"
        )))
    };
    assert_eq!(twice("500 mm"), [""; 0]);
    assert_eq!(twice("0.5000001"), ["parameter-conflict"]);
}

#[test]
fn defaults_obey_the_rules_for_bodies() {
    let tensor = |zz: &str, rest: &str| {
        let zz = format!("{{ parameter: p, value: {zz} }}");
        rules(&link(&format!(
            "inertia: {{ xx: 1, yy: 1, zz: {zz} }}{rest}"
        )))
    };
    assert_eq!(tensor("2", ""), [""; 0]);
    assert_eq!(tensor("2.1", ""), ["triangle-inequality"]);
    assert_eq!(tensor("2.1", ", nonphysical: allow"), [""; 0]);
    assert_eq!(tensor("-1", ", nonphysical: allow"), ["not-semidefinite"]);
}
