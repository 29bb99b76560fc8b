//! Checks that singular mass matrices are refused with the name of a joint, in every state and scalar;
//! solvable massless links are solved to the last digits.

use crate::common::hard::{cases, links_of, list, sliders_of};
use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{Robot, State};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use bgdyn_runtime::{Dd, Scalar};
use serde_json::Value;

/// The default function, and its alternatives. The literal sum is the reference in double-double; its
/// accuracy in `f64` is not guaranteed.
const FORMULATIONS: [&str; 5] = [
    CHOSEN,
    "recursion",
    "recursion_own",
    "articulated",
    "articulated_base",
];
const CHOSEN: &str = "";

fn forward(robot: &Robot, formulation: &str) -> Function {
    match formulation {
        CHOSEN => robot.chosen(Method::ForwardDynamics),
        name => robot.whole(name, Method::ForwardDynamics),
    }
}

fn robot(links: &str) -> Robot {
    Robot::read(&format!("format: 1\nname: singular\nlinks:\n{links}"), None)
}

/// Name of the joint that is refused.
fn refused<T: Scalar<Refused = Option<usize>>>(
    robot: &Robot,
    f: &Function,
    s: &State,
) -> Option<String> {
    let (_, refused) = f.evaluate(s.inputs::<T>());
    refused.map(|j| robot.joints()[j].clone())
}

fn always_refuses(links: &str, joint: &str) {
    let robot = robot(links);
    let mut rng = Rng::new(7);
    for formulation in FORMULATIONS {
        let f = forward(&robot, formulation);
        for _ in 0..40 {
            let s = State::random(&mut rng, &robot.motions());
            let place = || format!("{formulation}\n{links}{s:?}");
            let rough = refused::<f64>(&robot, &f, &s);
            assert_eq!(rough.as_deref(), Some(joint), "f64, {}", place());
            let fine = refused::<Dd>(&robot, &f, &s);
            assert_eq!(fine.as_deref(), Some(joint), "double-double, {}", place());
        }
    }
}

const ARM: &str = "
  - name: arm
    joint: { name: first, type: revolute, axis: z }
    mass: 1
    com: [1, 0, 0]
";

#[test]
fn nothing_to_accelerate() {
    for last in [
        "type: revolute, axis: z, origin: { xyz: [1, 0, 0] } }",
        "type: revolute, axis: z, origin: { xyz: [1, 0, 0] } }\n    mass: 2",
        "type: prismatic, axis: x, origin: { xyz: [1, 0, 0] } }\n    inertia: { zz: 0.5, xx: 0.5 }",
        "type: revolute, axis: [0.6, 0.3, -0.2], origin: { rpy: [0.1, 0.2, 0.3] } }",
    ] {
        let links =
            format!("{ARM}  - name: last\n    parent: arm\n    joint: {{ name: second, {last}\n");
        always_refuses(&links, "second");
    }
}

/// Two joints on one axis with nothing between them: M is singular for any outboard bodies.
#[test]
fn two_joints_on_one_axis() {
    let body = "mass: 1\n    inertia: { xx: 1, yy: 1, zz: 1 }";
    let skew = "mass: 1.3\n    com: [0.1, 0.2, 0.3]\n    inertia: { xx: 1, yy: 1.1, zz: 1.2 }";
    for (axis, step, body) in [
        ("z", "[0, 0, 0]", body),
        ("z", "[0, 0, 0.3]", skew),
        ("[0.6, 0.8, 0]", "[0.3, 0.4, 0]", skew),
        ("[0.708, -0.786, -0.694]", "[0.177, -0.1965, -0.1735]", skew),
    ] {
        let links = format!(
            "
  - name: inner
    joint: {{ name: first, type: revolute, axis: {axis} }}
  - name: outer
    parent: inner
    joint: {{ name: second, type: revolute, axis: {axis}, origin: {{ xyz: {step} }} }}
    {body}
"
        );
        always_refuses(&links, "first");
    }
}

/// A massless link between perpendicular axes has the inertia of the bodies outboard of it.
#[test]
fn massless_middle_of_a_gimbal() {
    let robot = robot(
        "
  - name: ring
    joint: { name: yaw, type: revolute, axis: z }
  - name: rotor
    parent: ring
    joint: { name: pitch, type: revolute, axis: x }
    mass: 1
    inertia: { xx: 1, yy: 2, zz: 3 }
",
    );
    for formulation in FORMULATIONS {
        let f = forward(&robot, formulation);
        for angle in [0.0, 1e-8, 0.3, 1.5] {
            let s = State {
                q: vec![0.25, angle],
                v: vec![0.0, 0.0],
                a: vec![0.0, 0.0],
                tau: vec![1.0, 1.0],
                parameters: vec![],
            };
            let found: Vec<f64> = s.value(&f);
            let exact: Vec<Dd> = s.value(&f);
            // M = diag(3 cos² + 2 sin², 1)
            let (sin, cos) = f64::sin_cos(angle);
            let expected = [1.0 / (3.0 * cos * cos + 2.0 * sin * sin), 1.0];
            for k in 0..2 {
                let off = (Dd::from_f64(found[k]) - exact[k]).abs().to_f64();
                assert!(
                    off <= 16.0 * f64::EPSILON,
                    "{formulation}, {angle}: {found:?}"
                );
                assert!(
                    (found[k] - expected[k]).abs() < 1e-15,
                    "{formulation}, {angle}: {found:?}"
                );
            }
        }
    }
}

/// A middle link with almost no inertia: exact subtractions are folded, a tiny correct pivot is accepted.
#[test]
fn tiny_inertia_between_two_joints() {
    for exponent in [20, 40, 50, 60, 90] {
        let tiny = 2.0_f64.powi(-exponent);
        let robot = robot(&format!(
            "
  - name: inner
    joint: {{ name: first, type: revolute, axis: z }}
    inertia: {{ xx: {tiny:?}, zz: {tiny:?} }}
  - name: outer
    parent: inner
    joint: {{ name: second, type: revolute, axis: z }}
    mass: 1
    inertia: {{ xx: 1, yy: 1, zz: 1 }}
"
        ));
        let s = State {
            q: vec![0.25, 0.5],
            v: vec![0.0; 2],
            a: vec![0.0; 2],
            tau: vec![1.5, 1.0],
            parameters: vec![],
        };
        for formulation in FORMULATIONS {
            let f = forward(&robot, formulation);
            let found: Vec<f64> = s.value(&f);
            // M = [[1 + ε, 1], [1, 1]]: q̈₁ = 0.5 / ε, q̈₂ = 1 − q̈₁
            let expected = [0.5 / tiny, 1.0 - 0.5 / tiny];
            for k in 0..2 {
                let off = (found[k] - expected[k]).abs();
                let bar = 16.0 * f64::EPSILON * expected[k].abs();
                assert!(off <= bar, "2^-{exponent}, {formulation}: {found:?}");
            }
        }
    }
}

/// A massless link inserted before a random joint, on the same axis: singular in every state, with varying
/// entries of M.
#[test]
fn two_joints_on_one_axis_of_random_mechanisms() {
    let (mut tried, mut passed) = (0, Vec::new());
    for seed in 0..1500 {
        let mut rng = Rng::new(seed);
        let mut draft = Draft::random(&mut rng, 4);
        let k = rng.below(draft.links.len());
        let joint = &draft.links[k].joint;
        if !["revolute", "continuous"].contains(&joint.kind) || draft.links[k].body.is_empty() {
            continue;
        }
        let mut front = draft.links[k].clone();
        front.name = "link_99".into();
        front.body.clear();
        let link = &mut draft.links[k];
        link.parent = Some(front.name.clone());
        link.joint.rpy = [(); 3].map(|()| "0".into());
        // A noisy axis times a number is rounded: a joint there would be beside the axis.
        let round = |x: f64| (x * 1000.0).round() / 1000.0 == x;
        let smooth = front.joint.axis.into_iter().all(round);
        let step = *rng.pick(&[0.0, 0.25]) * f64::from(u8::from(smooth));
        link.joint.xyz = front.joint.axis.map(|x| x * step);
        draft.links.insert(k, front);
        let robot = Robot::read(&draft.yaml(), None);
        let function = forward(&robot, CHOSEN);
        for _ in 0..5 {
            let s = State::random(&mut rng, &robot.motions());
            let (found, refused) = function.evaluate(s.inputs::<f64>());
            tried += 1;
            if refused.is_none() {
                passed.push((seed, found));
            }
        }
    }
    assert!(tried > 4000);
    assert!(passed.is_empty(), "{} of {tried}: {passed:?}", passed.len());
}

fn solves(what: &str, robot: &Robot, case: &Value) {
    let zero = || vec![0.0; robot.nv()];
    let given = |key: &str| case.get(key).map_or_else(zero, list);
    let s = State {
        q: given("q"),
        v: given("qd"),
        a: zero(),
        tau: given("tau"),
        parameters: Vec::new(),
    };
    let found: Vec<f64> = s.value(&forward(robot, CHOSEN));
    for (x, expected) in found.iter().zip(list(&case["qdd"])) {
        let bar = 16.0 * f64::EPSILON * expected.abs();
        assert!((x - expected).abs() <= bar, "{what}: {found:?}");
    }
}

/// Exact results: the joint in the error, or the accelerations.
#[test]
fn exact_answers() {
    let mut kinds = [0; 3];
    for case in cases("singular_mass_matrix") {
        let id = case["id"].as_str().expect("a name");
        let expected = case["expect_forward"].as_str().expect("an expectation");
        if let Some(items) = case["items"].as_array() {
            for item in items {
                let text = sliders_of(item);
                solves(id, &robot(&text), item);
                kinds[0] += 1;
            }
            continue;
        }
        let links = links_of(case["bodies"].as_array().expect("bodies"));
        match expected.strip_prefix("error naming joint ") {
            Some(rest) => {
                always_refuses(&links, rest.split(' ').next().expect("a joint"));
                kinds[1] += 1;
            }
            None => {
                solves(id, &robot(&format!("{links}gravity: [0, 0, 0]\n")), &case);
                kinds[2] += 1;
            }
        }
    }
    assert_eq!(kinds, [4, 4, 6]);
}
