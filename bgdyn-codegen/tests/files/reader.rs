//! Tests the parser alone: the conversion of YAML's scalars, and positions.

use bgdyn_codegen::format::{Spec, parse};
use bgdyn_runtime::Dd;

/// The mass of a link written as `text`, or the message of the one fault.
fn mass(text: &str) -> Result<Dd, String> {
    let (spec, faults) = parse(&format!("format: 1\nlinks:\n- name: a\n  mass: {text}\n"));
    if let Some(fault) = faults.0.first() {
        return Err(format!("{}: {}", fault.rule, fault.message));
    }
    let links = spec
        .as_ref()
        .and_then(|spec| spec.links.value())
        .expect("links");
    Ok(links[0].mass.value().expect("a mass").value)
}

fn dd(text: &str) -> Dd {
    text.parse().expect("a decimal")
}

#[test]
fn numbers_are_decimals() {
    for text in [
        "0.1",
        "1",
        "-3",
        "+2.5",
        ".5",
        "1.",
        "1e3",
        "1.5E-7",
        "3.14159265358979323846264338",
    ] {
        assert_eq!(mass(text), Ok(dd(text)), "{text}");
    }
    assert_ne!(
        mass("0.1"),
        Ok(Dd::from_f64(0.1)),
        "the decimal, not the nearest f64"
    );
    assert_eq!(mass("0"), Ok(Dd::ZERO));
    assert_eq!(mass("-0.0e5"), Ok(Dd::ZERO));
}

#[test]
fn units_shift_the_decimal_point() {
    assert_eq!(mass("250 g"), Ok(dd("0.25")));
    assert_eq!(mass("0.1 g"), Ok(dd("1e-4")));
    assert_eq!(mass("1.5e2 g"), Ok(dd("0.15")));
    assert_eq!(mass("\"3 kg\""), Ok(dd("3")));
    assert_eq!(mass("3kg"), Ok(dd("3")));
}

#[test]
fn what_is_no_number_is_refused() {
    for text in [
        "1_000", "007", "0x10", "0o7", "\"1\"", "1,5", "yes", "true", "~", "1 2", "1e", "--1",
        "e5", ".",
    ] {
        let message = mass(text).expect_err(text);
        assert!(
            message.starts_with("wrong-type") || message.starts_with("unknown-unit"),
            "{text}: {message}"
        );
    }
    for text in [".nan", ".inf", "-.Inf", "nan", "inf kg", "-Infinity"] {
        assert!(
            mass(text).expect_err(text).starts_with("non-finite"),
            "{text}"
        );
    }
    for text in [
        "1e400",
        "1e-400",
        "1e99999999999",
        "1e-99999999999",
        "1e101 kg",
    ] {
        assert!(
            mass(text).expect_err(text).starts_with("out-of-range"),
            "{text}"
        );
    }
}

fn rpy(text: &str) -> Vec<Dd> {
    let (spec, faults) = parse(&format!(
        "format: 1\nlinks: [{{ name: a, joint: {{ type: fixed, origin: {{ rpy: [{text}] }} }} }}]"
    ));
    assert_eq!(faults.0, []);
    let spec = spec.expect("a spec");
    let links = spec.links.value().expect("links");
    let origin = links[0]
        .joint
        .value()
        .and_then(|j| j.origin.value())
        .expect("an origin");
    origin
        .rpy
        .value()
        .expect("angles")
        .iter()
        .map(|angle| angle.value.value)
        .collect()
}

#[test]
fn degrees_are_exact_where_they_can_be() {
    let half = Dd::PI / Dd::from_f64(2.0);
    assert_eq!(rpy("90 deg, -90 deg, 180 deg"), [half, -half, Dd::PI]);
    assert_eq!(
        rpy("90°, 45.0 deg, 1.5 rad"),
        [half, half / Dd::from_f64(2.0), dd("1.5")]
    );
}

#[test]
fn every_unit_is_known_in_its_place() {
    let text = "
format: 1
gravity: [0, 0, -9.81 m/s^2]
snap: 0.001 deg
links:
  - name: a
    joint:
      name: turn
      type: revolute
      origin: { xyz: [5 mm, 3 cm, 0.4 m], rpy: [1.5 rad, 0, 0] }
      limits: { lower: -1 rad, upper: 90 deg, velocity: 10 deg/s, effort: 40 N*m }
    inertia: { xx: 3 kg*m^2, yy: 2 kg*mm^2, zz: 7 g*mm^2, xy: 1 kg·cm², xz: 4 g*cm^2 }
  - name: b
    joint:
      name: slide
      type: prismatic
      limits: { lower: -1 mm, upper: 2 cm, velocity: 0.3 m/s, effort: 12 N }
    mass: 3 kg
";
    let (spec, faults) = parse(text);
    assert_eq!(faults.0, []);
    let links = spec.expect("a spec").links;
    let a = &links.value().expect("links")[0];
    let entries = a.inertia.value().expect("a tensor").entries.each_ref();
    let values: Vec<Option<Dd>> = entries.map(|e| e.value().map(|n| n.value)).to_vec();
    let wanted = [
        Some("3"),
        Some("2e-6"),
        Some("7e-9"),
        Some("1e-4"),
        Some("4e-7"),
        None,
    ];
    assert_eq!(values, wanted.map(|text| text.map(dd)));
}

fn place(spec: &Spec, link: usize) -> (String, String) {
    let link = &spec.links.value().expect("links")[link];
    let mass = link.mass.given().expect("a mass");
    (
        mass.location.position.to_string(),
        mass.location.path.clone(),
    )
}

#[test]
fn places_count_characters_from_one() {
    let text = "format: 1\r\nlinks:\r\n  - { label: \"größer\", name: a, mass: 1 }\r\n  - name: b\r\n    mass: 2\r\n";
    let (spec, faults) = parse(text);
    assert_eq!(faults.0, []);
    let spec = spec.expect("a spec");
    assert_eq!(
        place(&spec, 0),
        ("3:39".to_owned(), "links[0].mass".to_owned())
    );
    assert_eq!(
        place(&spec, 1),
        ("5:11".to_owned(), "links[1].mass".to_owned())
    );
}

#[test]
fn an_alias_stands_for_its_anchor() {
    let text = "format: 1\nlinks:\n  - { name: a, mass: &m 2 kg }\n  - { name: b, mass: *m }\n";
    let (spec, faults) = parse(text);
    assert_eq!(faults.0, []);
    assert_eq!(
        place(&spec.expect("a spec"), 1),
        ("3:22".to_owned(), "links[1].mass".to_owned())
    );
}

#[test]
fn aliases_cannot_blow_up() {
    let mut text = String::from("format: 1\na0: &a0 [x]\n");
    for i in 1..40 {
        text += &format!("a{i}: &a{i} [*a{p}, *a{p}]\n", p = i - 1);
    }
    let (_, faults) = parse(&text);
    assert!(faults.any_fault());
    let mut chain = String::from("format: 1\nlinks:\n- &a0 [x]\n");
    for i in 1..20_000 {
        chain += &format!("- &a{i} [*a{}]\n", i - 1);
    }
    assert_eq!(parse(&chain).1.0[0].rule, "too-deep");
}

#[test]
fn half_a_spec_is_marked() {
    let (spec, faults) = parse("format: 1\nlinks: [{ name: a, mass: x }, 5]\n");
    assert_eq!(faults.count(), 2);
    let spec = spec.expect("a spec");
    assert!(!spec.complete);
    assert!(
        bgdyn_codegen::machine::check(&spec, Some("arm"), &[], &bgdyn_codegen::effect::kinds())
            .0
            .is_none()
    );
}
