//! Tests axes with rounding noise, without snapping (`snap: 0`): off their exact directions by rounding or
//! a little more, exactly or almost parallel and opposite to each other. Every formulation equals the
//! literal sum in double-double.

use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{Robot, State, assert_close, natural_size};
use bgdyn_codegen::formulation::{Prepared, by_name};
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

const METHODS: [Method; 6] = [
    Method::InverseDynamics,
    Method::Gravity,
    Method::MassMatrix,
    Method::KineticEnergy,
    Method::PotentialEnergy,
    Method::Bias,
];

/// The largest difference due to regrouping in double-double, relative to an upper bound of all terms:
/// components of a direction below 1e-26 count as zero, and a common normal of two almost parallel axes is
/// up to four times as far away as their joints.
const CLOSE: f64 = 1e-24;

/// Three links, the axes of the first two as given.
fn pair(first: [f64; 3], second: [f64; 3]) -> String {
    format!(
        "\
format: 1
name: pair
snap: 0
links:
  - name: upper
    joint: {{ name: shoulder, type: revolute, axis: {first:?} }}
    mass: 2
    com: [0.2, 0, 0]
    inertia: {{ xx: 0.01, yy: 0.05, zz: 0.05 }}
  - name: fore
    parent: upper
    joint: {{ name: elbow, type: revolute, axis: {second:?}, origin: {{ xyz: [0.4, 0.1, 0.2] }} }}
    mass: 1
    com: [0.15, 0, 0.02]
    inertia: {{ xx: 0.005, yy: 0.02, zz: 0.02 }}
  - name: hand
    parent: fore
    joint: {{ name: wrist, type: revolute, axis: y, origin: {{ xyz: [0.3, 0, 0] }} }}
    mass: 0.5
    com: [0.05, 0, 0.02]
    inertia: {{ xx: 0.001, yy: 0.002, zz: 0.002 }}
"
    )
}

/// One joint: no other axis determines the direction of x of its body.
fn alone(kind: &str, axis: [f64; 3]) -> String {
    format!(
        "\
format: 1
name: alone
snap: 0
gravity: [2, 3, -9]
links:
  - name: post
    joint: {{ name: only, type: {kind}, axis: {axis:?} }}
    mass: 2
    com: [0.2, 0.1, 0.3]
    inertia: {{ xx: 0.02, yy: 0.05, zz: 0.06, xy: 0.002, xz: 0.003, yz: 0.004 }}
"
    )
}

/// The same with a second joint at the same origin, its axis as given. If the two axes are one line, the
/// direction of x is as free as with one joint.
fn stacked(first: [f64; 3], second: [f64; 3]) -> String {
    let text = alone("revolute", first);
    format!(
        "{text}  - name: top
    parent: post
    joint: {{ name: second, type: revolute, axis: {second:?} }}
    mass: 1
    com: [0.15, -0.05, 0.1]
    inertia: {{ xx: 0.005, yy: 0.02, zz: 0.02, xz: 0.001 }}
"
    )
}

/// Compares every formulation with the literal sum; forward dynamics as the inverse.
fn equals_the_literal_sum(text: &str) {
    let robot = Robot::read(text, None);
    let prepared = Prepared::new(robot.graph);
    let by = |name: &str, method: Method| {
        let way = by_name(name).expect("a formulation");
        way.function(&prepared, method)
    };
    let mut rng = Rng::new(11);
    let states: Vec<State> = (0..3)
        .map(|_| State::random(&mut rng, &robot.motions()))
        .collect();
    for method in METHODS {
        let literal = by("literal", method).expect("the literal sum");
        for name in ["recursion", "recursion_own", "common_axes"] {
            let Some(way) = by(name, method) else {
                continue;
            };
            for state in &states {
                let (found, wanted) = (state.value::<Dd>(&way), state.value::<Dd>(&literal));
                let allowed = CLOSE * natural_size(&robot, state, method);
                let what = || format!("{name}, {method:?}\n{text}");
                assert_close(&found, &wanted, allowed, what);
            }
        }
    }
    let inverse = by("literal", Method::InverseDynamics).expect("the literal sum");
    for name in [
        "recursion",
        "recursion_own",
        "articulated",
        "articulated_base",
    ] {
        let way = by(name, Method::ForwardDynamics).expect("forward dynamics");
        for state in &states {
            let (found, singular) = way.evaluate(state.inputs::<Dd>());
            if singular.is_some() {
                continue;
            }
            let mut undone = state.inputs::<Dd>();
            let largest = found.iter().map(|a| a.to_f64().abs()).fold(1.0, f64::max);
            let size = natural_size(&robot, state, Method::InverseDynamics) * largest;
            undone.a = found;
            let (efforts, _) = inverse.evaluate(undone);
            let wanted: Vec<Dd> = state.tau.iter().map(|&u| Dd::from_f64(u)).collect();
            let what = || format!("{name}, forward dynamics undone\n{text}");
            assert_close(&efforts, &wanted, 1e3 * CLOSE * size, what);
        }
    }
}

/// Deviations by the rounding of a quarter turn (6.1e-17), smaller and larger ones, up to and beyond that
/// at which an axis is no longer 1 to the last digit of a double-double. (Up to 1e-14 its largest
/// component is exactly 1.)
const OFF: [f64; 11] = [
    1e-20,
    1e-17,
    6.123233995736766e-17,
    1e-16,
    1e-15,
    1e-14,
    3e-14,
    1e-13,
    1.4e-13,
    1e-11,
    1e-7,
];

#[test]
fn opposite_and_parallel_axes_off_the_coordinate_axes() {
    for (k, off) in OFF.into_iter().enumerate() {
        let axis = |first: f64, sign: f64| {
            let mut axis = [0.0; 3];
            (axis[k % 3], axis[(k + 1) % 3]) = (sign, first);
            axis
        };
        for (first, sign) in [(-off, -1.0), (off, -1.0), (off, 1.0), (0.0, -1.0)] {
            equals_the_literal_sum(&pair(axis(off, 1.0), axis(first, sign)));
        }
    }
}

/// Axes whose common normal does not determine x of the first body: there is no other axis, or it is the
/// same line. Then x follows from the noisy axis alone, and must be perpendicular to it.
#[test]
fn noisy_axes_without_a_common_normal() {
    for (k, off) in OFF.into_iter().enumerate() {
        let axis = |sign: f64, first: f64, second: f64| {
            let mut axis = [0.0; 3];
            (axis[k % 3], axis[(k + 1) % 3], axis[(k + 2) % 3]) = (sign, first, second);
            axis
        };
        equals_the_literal_sum(&alone("revolute", axis(1.0, off, 0.0)));
        equals_the_literal_sum(&alone("revolute", axis(-1.0, 0.0, off)));
        equals_the_literal_sum(&alone("prismatic", axis(1.0, -off, off)));
        let first = axis(1.0, off, -off);
        let opposite = first.map(|x| -x);
        for second in [first, opposite, axis(-1.0, off, -off), axis(1.0, 0.0, 0.0)] {
            equals_the_literal_sum(&stacked(first, second));
        }
    }
}

/// Random mechanisms whose axes all have such noise.
#[test]
fn random_mechanisms_with_noisy_axes() {
    let mut tried = 0;
    for seed in 0..200 {
        let draft = Draft::random(&mut Rng::new(31_000 + seed), 5);
        if draft.exact && tried < 12 {
            tried += 1;
            equals_the_literal_sum(&draft.yaml());
        }
    }
    assert_eq!(tried, 12, "mechanisms with `snap: 0`");
}
