//! Tests small mechanisms on which a formulation was once wrong: recursion = literal, and as accurate in
//! `f64` as its terms permit.

use crate::common::rng::Rng;
use crate::common::{Robot, State, assert_close, natural_effort};
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

fn formulations_agree(links: &str) {
    let text = format!("format: 1\nname: regression\nlinks:\n{links}");
    let robot = Robot::read(&text, None);
    let literal = robot.whole("literal", Method::InverseDynamics);
    let recursion = robot.whole("recursion", Method::InverseDynamics);
    let mut rng = Rng::new(1);
    for _ in 0..20 {
        let s = State::random(&mut rng, &robot.motions());
        let exact: Vec<Dd> = s.value(&literal);
        let place = || format!("{}\n{text}{s:?}", recursion.formulation);
        let size = natural_effort(&robot, &s);
        assert_close(&s.value::<Dd>(&recursion), &exact, 1e-29 * size, place);
        let rounded: Vec<f64> = s.value(&recursion);
        let rounded: Vec<Dd> = rounded.into_iter().map(Dd::from_f64).collect();
        assert_close(&rounded, &exact, 1e-15 * size, place);
    }
}

/// The distance along a common axis in general position is rounding, not a direction.
#[test]
fn two_joints_on_one_skew_axis() {
    formulations_agree(
        "
  - name: inner
    joint: { name: first, type: revolute, axis: [0.708, -0.786, -0.694] }
    mass: 1.5
    com: [0.1, -0.2, 0.2]
  - name: outer
    parent: inner
    joint:
      name: second
      type: revolute
      axis: [0.708, -0.786, -0.694]
      origin: { xyz: [0.177, -0.1965, -0.1735] }
    mass: 1
    com: [0, 0.125, 0]
    inertia: { xx: 1.6, yy: 1.5, zz: 1.7 }
",
    );
}

/// Half a turn between a translation's basis and its axes must not be ignored.
#[test]
fn translation_with_a_phase_of_half_a_turn() {
    formulations_agree(
        "
  - name: column
    joint: { name: turn, type: revolute }
  - name: slider
    parent: column
    joint: { name: slide, type: prismatic, axis: [0.6, 0.3, 0] }
  - name: swing
    parent: slider
    joint: { name: swing, type: revolute, axis: y, origin: { rpy: [-90 deg, 180 deg, 0] } }
  - name: hand
    parent: swing
    joint: { name: grip, type: revolute, origin: { xyz: [0, 0, -0.4] } }
    mass: 1
",
    );
}

/// A quarter turn with four digits: axes that meet 1e5 m away count as parallel.
#[test]
fn nearly_parallel_axes() {
    for tilt in ["1.5708", "1.570796", "1.57079632"] {
        formulations_agree(&format!(
            "
  - name: base
    joint: {{ name: first, type: revolute, axis: x }}
    mass: 1
    com: [0.1, 0.2, 0.3]
  - name: upper
    parent: base
    joint: {{ name: second, type: revolute, axis: z, origin: {{ xyz: [0.1, 0.3, 0.2] }} }}
    mass: 2
    com: [0.3, 0.1, 0.2]
    inertia: {{ xx: 0.1, yy: 0.2, zz: 0.15, xy: 0.01 }}
  - name: fore
    parent: upper
    joint:
      name: third
      type: revolute
      axis: [0.6, 0.3, -0.7]
      origin: {{ xyz: [0.3, 0.2, 0.1], rpy: [{tilt}, 0, 0] }}
    mass: 2
    com: [0.3, 0.1, 0.2]
    inertia: {{ xx: 0.1, yy: 0.2, zz: 0.15, xz: 0.01 }}
  - name: hand
    parent: fore
    joint:
      name: fourth
      type: revolute
      axis: [0.6, -0.7, -0.3]
      origin: {{ xyz: [0.3, -0.4, 0.5], rpy: [-{tilt}, 0, 0] }}
    mass: 1
    com: [0.1, 0.1, 0.2]
  - name: tip
    parent: hand
    joint:
      name: fifth
      type: revolute
      axis: [0.6, -0.7, -0.3]
      origin: {{ xyz: [0.2, 0.1, 0.3], rpy: [0.0000037, 0, 0] }}
    mass: 1
    com: [0.1, 0.1, 0.2]
"
        ));
    }
}

/// A struct `T` would hide the type parameter `T` of its own methods.
#[test]
fn a_name_that_hides_the_type_parameter_is_refused() {
    let text = "format: 1\nlinks: [{ name: a, mass: 1 }]\n";
    let (mechanism, faults) = bgdyn_codegen::read(text, Some("t"));
    assert!(mechanism.is_none());
    assert_eq!(faults.0[0].rule, "name");
    assert!(bgdyn_codegen::read(text, Some("t1")).0.is_some());
}
