//! `base: given`: a mechanism on a base whose motion is given, against the same mechanism on a floating link,
//! and against closed forms.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::refusal::Refusal;
use bgdyn_codegen::selection;
use bgdyn_codegen::verify::{check_model, explain};
use bgdyn_runtime::Dd;

use super::robot::{Robot, State, Way, close, cross, dot, full, largest, scale, times, turned};
use super::specs;

const WAYS: [Way; 4] = [None, Some("recursion"), Some("subspaces"), Some("literal")];
const EXACT: f64 = 1e-25;
/// Positions and velocities of the floating link.
const NQ: usize = 7;
const NV: usize = 6;

/// Returns the mechanism with `base: given`.
fn given(text: &str) -> String {
    text.replacen("format: 1\n", "format: 1\nbase: given\n", 1)
}

/// Returns the mechanism whose links on the base are carried by a floating link without mass.
fn floating(text: &str) -> String {
    let (head, links) = text.split_once("links:\n").expect("links");
    let carried = links.split("  - name: ").map(|block| {
        let own = block.contains("    joint:") || block.contains("    mass:");
        match block.split_once('\n') {
            Some((name, rest)) if own && !block.contains("    parent:") => {
                format!("{name}\n    parent: carrier\n{rest}")
            }
            _ => block.to_owned(),
        }
    });
    let carried: Vec<String> = carried.collect();
    format!(
        "{head}links:\n  - name: carrier\n    joint: {{ name: sky, type: floating }}\n{}",
        carried.join("  - name: ")
    )
}

/// A state of both mechanisms.
struct Both {
    floating: Inputs<Dd>,
    given: Inputs<Dd>,
}

fn both(floating: &Robot, given: &Robot, seed: u64) -> Both {
    let mut random = Random(seed);
    let mut some = |n: usize, size: f64| -> Vec<Dd> {
        (0..n)
            .map(|_| Dd::from_f64(size * random.signed()))
            .collect()
    };
    let n = floating.nv();
    let mut q = some(floating.mechanism.nq(), 2.5);
    let (v, a, u) = (some(n, 2.0), some(n, 3.0), some(n, 20.0));
    for at in floating.quaternions() {
        scale(&mut q[at..at + 4], |length| Dd::ONE / length);
    }
    // Rᵀ g, by the rotation with the conjugate quaternion.
    let conjugate = [-q[3], -q[4], -q[5], q[6]];
    let gravity = turned(&conjugate, &floating.mechanism.gravity().0);
    let carried = cross(&v[3..6], &v[..3]);
    let force: Vec<Dd> = (0..3).map(|k| a[k] + carried[k] - gravity[k]).collect();
    let parameters = [&v[3..6], &a[3..6], &force].concat();
    assert_eq!(given.mechanism.parameters().len(), parameters.len());
    Both {
        given: inputs([&q[NQ..], &v[NV..], &a[NV..], &u[NV..]], parameters),
        floating: inputs([&q, &v, &a, &u], vec![]),
    }
}

fn inputs([q, v, a, u]: [&[Dd]; 4], parameters: Vec<Dd>) -> Inputs<Dd> {
    Inputs {
        q: q.to_vec(),
        v: v.to_vec(),
        a: a.to_vec(),
        u: u.to_vec(),
        parameters,
        ..Inputs::default()
    }
}

fn of_state(state: &State<Dd>, parameters: Vec<Dd>) -> Inputs<Dd> {
    let State { q, v, a, u } = state;
    inputs([q, v, a, u], parameters)
}

fn value(robot: &Robot, way: Way, method: Method, at: &Inputs<Dd>) -> Vec<Dd> {
    let (value, refused) = robot.function(way, method).evaluate(at.clone());
    assert_eq!(refused, None, "{method:?}: a pivot is refused");
    value
}

/// The mechanisms of the other tests but the largest.
fn texts() -> Vec<(&'static str, String)> {
    let mut all = specs::all();
    all.retain(|(name, _)| *name != "anymal_floating");
    all
}

fn pairs() -> Vec<(&'static str, Robot, Robot)> {
    let all = texts().into_iter();
    all.map(|(name, text)| {
        (
            name,
            Robot::read(&floating(&text)),
            Robot::read(&given(&text)),
        )
    })
    .collect()
}

#[test]
fn efforts_are_those_on_a_floating_link() {
    for (name, other, own) in pairs() {
        for way in WAYS {
            for seed in [5, 6] {
                let what = format!("{name}, {way:?}, seed {seed}");
                let s = both(&other, &own, seed);
                let efforts = value(
                    &other,
                    Some("literal"),
                    Method::InverseDynamics,
                    &s.floating,
                );
                let found = value(&own, way, Method::InverseDynamics, &s.given);
                close(&found, &efforts[NV..], EXACT, 0.0, &what);
                // FD: the accelerations need these efforts on the floating link as well.
                let a = value(&own, way, Method::ForwardDynamics, &s.given);
                let moved = Inputs {
                    a: [&s.floating.a[..NV], &a].concat(),
                    ..s.floating.clone()
                };
                let needed = value(&other, Some("literal"), Method::InverseDynamics, &moved);
                close(&needed[NV..], &s.given.u, 1e-20, largest(&efforts), &what);
            }
        }
    }
}

#[test]
fn mass_matrix_and_poses_are_relative_to_the_base() {
    for (name, other, own) in pairs() {
        let s = both(&other, &own, 8);
        let whole = full(
            &value(&other, Some("literal"), Method::MassMatrix, &s.floating),
            other.nv(),
        );
        let part: Vec<Dd> = whole[NV..]
            .iter()
            .flat_map(|row| row[NV..].to_vec())
            .collect();
        for way in WAYS {
            let found = value(&own, way, Method::MassMatrix, &s.given);
            let found = full(&found, own.nv()).concat();
            close(&found, &part, EXACT, 0.0, &format!("{name}, {way:?}"));
        }
        // The same mechanism on a fixed base has these poses, velocities and energies.
        let fixed = specs::all().into_iter().find(|(n, _)| *n == name);
        let fixed = Robot::read(&fixed.expect("the same list").1);
        let still = Inputs {
            parameters: vec![],
            ..s.given.clone()
        };
        let tip = own.graph.sites.len() - 1;
        let site = bgdyn_codegen::bond_graph::SiteId(tip);
        let same_site = bgdyn_codegen::bond_graph::SiteId(fixed.graph.sites.len() - 1);
        assert_eq!(
            own.graph.sites[tip].name,
            fixed.graph.sites[same_site.0].name
        );
        let pairs = [
            (Method::Pose(site), Method::Pose(same_site)),
            (Method::Velocity(site), Method::Velocity(same_site)),
            (Method::Jacobian(site), Method::Jacobian(same_site)),
            (Method::JacobianDotV(site), Method::JacobianDotV(same_site)),
            (Method::KineticEnergy, Method::KineticEnergy),
            (Method::PotentialEnergy, Method::PotentialEnergy),
        ];
        for (method, same) in pairs {
            let found = value(&own, None, method, &s.given);
            let expected = value(&fixed, None, same, &still);
            close(
                &found,
                &expected,
                EXACT,
                1.0,
                &format!("{name}, {method:?}"),
            );
        }
    }
}

/// At rest, with the default motion, it is the mechanism on a fixed base.
#[test]
fn a_base_at_rest_is_a_fixed_base() {
    for (name, text) in texts() {
        let (fixed, own) = (Robot::read(&text), Robot::read(&given(&text)));
        let state = own.state(12);
        let parameters = own.mechanism.parameters().iter();
        let at = |parameters: Vec<Dd>| of_state(&state, parameters);
        let defaults: Vec<Dd> = parameters.map(|p| p.default).collect();
        for method in [
            Method::InverseDynamics,
            Method::Bias,
            Method::Gravity,
            Method::CoriolisMatrix,
            Method::InverseDynamicsDerivatives,
        ] {
            let found = value(&own, None, method, &at(defaults.clone()));
            let expected = value(&fixed, None, method, &at(vec![]));
            close(
                &found,
                &expected,
                EXACT,
                1.0,
                &format!("{name}, {method:?}"),
            );
        }
    }
}

/// bias = C v + gravity on a turning base; C without the part of the relative motion is skew.
#[test]
fn the_coriolis_matrix_of_a_turning_base_is_skew_beside_that_of_a_fixed_one() {
    for (name, other, own) in pairs() {
        for way in [None, Some("literal")] {
            let what = format!("{name}, {way:?}");
            let s = both(&other, &own, 9);
            let n = own.nv();
            let rows =
                |matrix: &[Dd]| -> Vec<Vec<Dd>> { matrix.chunks(n).map(<[Dd]>::to_vec).collect() };
            let whole = value(&own, way, Method::CoriolisMatrix, &s.given);
            let bias = value(&own, way, Method::Bias, &s.given);
            let gravity = value(&own, way, Method::Gravity, &s.given);
            let product = times(&rows(&whole), &s.given.v);
            let sum: Vec<Dd> = product.iter().zip(&gravity).map(|(&x, &y)| x + y).collect();
            close(&sum, &bias, EXACT, largest(&product), &what);
            let still = Inputs {
                parameters: vec![Dd::ZERO; 9],
                ..s.given.clone()
            };
            let alone = value(&own, way, Method::CoriolisMatrix, &still);
            let size = largest(&whole);
            let mut turning = 0.0_f64;
            for (j, k) in (0..n).flat_map(|j| (0..n).map(move |k| (j, k))) {
                let rest = |j: usize, k: usize| whole[j * n + k] - alone[j * n + k];
                let off = (rest(j, k) + rest(k, j)).to_f64().abs();
                assert!(off <= EXACT * size, "{what}: {j}, {k}: {off:e}");
                turning = turning.max(rest(j, k).to_f64().abs());
            }
            assert!(n == 1 || turning > 1e-6 * size, "{what}: {turning:e}");
        }
    }
}

/// The generator's own check accepts all of them, with derivatives.
#[test]
fn every_mechanism_on_a_moving_base_is_accepted() {
    let weighed = "format: 1\nname: moved\nlinks:\n  - name: a\n    joint: { name: swing, type: revolute, axis: [1, 2, 0], origin: { xyz: [0.4, 0.1, 0.2] } }\n    mass: { parameter: payload, value: 2 }\n    com: [0.1, 0.2, { parameter: height, value: 0.3 }]\n    inertia: { xx: 0.1, yy: 0.12, zz: 0.09 }\n  - name: b\n    parent: a\n    joint: { name: sway, type: prismatic, axis: [0, 1, 1], origin: { xyz: [0.2, 0, 0.1] } }\n    mass: 0.7\n    com: [0, 0.1, 0]\n";
    let mut all = texts();
    all.push(("parameters", weighed.into()));
    for (name, text) in all {
        let options = Options {
            derivatives: true,
            ..Options::default()
        };
        let mechanism = Robot::read(&given(&text)).mechanism;
        let model = selection::model(mechanism, &options).expect("a model");
        let found = check_model(&model);
        assert!(found.is_empty(), "{name}: {}", explain(&found));
    }
}

/// A pendulum about y at a distance r from the axis of a turntable:
/// τ = m l² q̈ + m g l sin q − m ω² (r + l sin q) l cos q, with the bob at (r + l sin q, 0, −l cos q).
#[test]
fn a_pendulum_on_a_turntable() {
    let (r, l, m, g) = (0.75, 0.5, 2.0, 9.8125);
    let text = format!(
        "format: 1\nname: moved\nbase: given\ngravity: [0, 0, -{g}]\nlinks:\n  - name: bob\n    joint: {{ name: swing, type: revolute, axis: -y, origin: {{ xyz: [{r}, 0, 2] }} }}\n    mass: {m}\n    com: [0, 0, -{l}]\n"
    );
    let robot = Robot::read(&text);
    for (q, v, a, omega, spin, f) in [
        (0.5, 1.5, -2.0, 3.0, 0.0, 0.0),
        (-1.25, 0.0, 0.0, -2.0, 4.0, 1.5),
        (2.0, -3.0, 1.0, 0.0, 0.0, -2.0),
    ] {
        let dd = |x: &[f64]| x.iter().map(|&x| Dd::from_f64(x)).collect::<Vec<_>>();
        let at = Inputs {
            q: dd(&[q]),
            v: dd(&[v]),
            a: dd(&[a]),
            // The turntable turns about z, and is pushed along x.
            parameters: dd(&[0.0, 0.0, omega, 0.0, 0.0, spin, f, 0.0, g]),
            ..Inputs::default()
        };
        let (sin, cos) = Dd::from_f64(q).sin_cos();
        let of = |x: f64| Dd::from_f64(x);
        // Acceleration of the bob along the direction in which it swings, e = (cos q, 0, sin q).
        let outward = of(f) - of(omega * omega) * (of(r) + of(l) * sin);
        let along = of(l) * of(a) + outward * cos + of(g) * sin;
        let expected = of(m * l) * along;
        for way in WAYS {
            let found = value(&robot, way, Method::InverseDynamics, &at);
            close(
                &found,
                &[expected],
                EXACT,
                1.0,
                &format!("{way:?}, q = {q}"),
            );
        }
    }
}

/// A body on a ball joint on a turning base feels M = J ω̇ + ω × J ω of its absolute motion.
#[test]
fn a_ball_on_a_turning_base_obeys_euler() {
    let text = "format: 1\nname: moved\nbase: given\ngravity: [0, 0, 0]\nlinks:\n  - name: body\n    joint: { name: ball, type: spherical }\n    mass: 1\n    inertia: { xx: 0.5, yy: 0.75, zz: 1 }\n";
    let robot = Robot::read(text);
    let mut state = robot.state(3);
    state.u = vec![Dd::ZERO; 3];
    let base: Vec<Dd> = [0.3, -1.1, 0.7, 2.0, 0.4, -0.9, 0.0, 0.0, 0.0]
        .map(Dd::from_f64)
        .to_vec();
    let conjugate = [-state.q[0], -state.q[1], -state.q[2], state.q[3]];
    let own = |v: &[Dd]| turned(&conjugate, v);
    let (carried, change) = (own(&base[..3]), own(&base[3..6]));
    let omega: Vec<Dd> = (0..3).map(|k| carried[k] + state.v[k]).collect();
    // The base's angular velocity, seen from the body, turns with −ω relative.
    let seen = cross(&carried, &state.v);
    let rate: Vec<Dd> = (0..3).map(|k| change[k] + seen[k] + state.a[k]).collect();
    let inertia = [0.5, 0.75, 1.0].map(Dd::from_f64);
    let momentum: Vec<Dd> = (0..3).map(|k| inertia[k] * omega[k]).collect();
    let gyroscopic = cross(&omega, &momentum);
    let expected: Vec<Dd> = (0..3)
        .map(|k| inertia[k] * rate[k] + gyroscopic[k])
        .collect();
    let at = of_state(&state, base);
    for way in WAYS {
        let found = value(&robot, way, Method::InverseDynamics, &at);
        close(&found, &expected, EXACT, 1.0, &format!("{way:?}"));
        assert!(dot(&found, &found).to_f64() > 0.1);
    }
}

/// A scene computes the motion of its mechanism.
#[test]
fn a_scene_refuses_a_base_whose_motion_is_given() {
    let mechanism = given(specs::ZOO);
    let scene = "scene: 1\nmechanism: zoo.yaml\neffects: [inertia, gravity]\n";
    let found = bgdyn_codegen::read_scene(scene, "zoo_run", |_| Ok(mechanism.clone()));
    let Err(Refusal::Spec(faults)) = found else {
        panic!("accepted");
    };
    let rules: Vec<&str> = faults.0.iter().map(|fault| fault.rule).collect();
    assert_eq!(rules, ["moving-base"]);
    assert_eq!(faults.0[0].position.line, 2);
}
