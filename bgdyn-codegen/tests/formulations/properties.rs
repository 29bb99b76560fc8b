//! Tests properties of the functions with the evaluator, over mechanisms and states that shrink when they
//! fail: all laws of `common::laws`, and additional ones.

#[path = "../common/strategy.rs"]
mod strategy;

use crate::common::laws::{self, Case, EXACT};
use crate::common::random::{Draft, Joint, Link};
use crate::common::rng::Rng;
use crate::common::values::{Direction, derivative, dot};
use crate::common::{Robot, State, assert_close, full, natural_size};
use bgdyn_codegen::bond_graph::SiteId;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection::function;
use bgdyn_runtime::Dd;
use proptest::prelude::*;
use strategy::{Machine, machine};

impl Case {
    fn of(machine: &Machine) -> Self {
        Case::new("shrunk", machine.draft.clone(), |robot| {
            machine.state(robot)
        })
    }

    fn close(&self, law: &str, x: &[Dd], y: &[Dd], size: f64) {
        assert_close(x, y, EXACT * size, self.place(law));
    }
}

/// A method of a mechanism in a state.
fn value(robot: &Robot, method: Method, state: &State) -> Vec<Dd> {
    let function = function(&robot.mechanism, method, &Options::default());
    state.value(&function.expect("every method"))
}

/// The same machine under another gravity.
fn under(draft: &Draft, gravity: [f64; 3]) -> Robot {
    let draft = Draft {
        gravity: Some(gravity),
        ..draft.clone()
    };
    Robot::read(&draft.yaml(), None)
}

/// Returns the whole world rotated about x by a quarter turn, including gravity: y becomes z, and z
/// becomes −y.
fn turned(draft: &Draft) -> Robot {
    let [x, y, z] = draft.gravity.unwrap_or([0.0, 0.0, -9.81]);
    let mut turned = Draft {
        gravity: Some([x, -z, y]),
        ..draft.clone()
    };
    for link in turned.links.iter_mut().filter(|l| l.parent.is_none()) {
        link.parent = Some("turned".into());
    }
    let rpy = ["90 deg", "0", "0"].map(String::from);
    turned.links.push(Link {
        name: "turned".into(),
        parent: None,
        joint: Joint {
            kind: "fixed",
            axis: [0.0; 3],
            xyz: [0.0; 3],
            rpy,
        },
        body: String::new(),
    });
    Robot::read(&turned.yaml(), None)
}

/// Returns the scale of the derivative of `size` along a motion.
fn speed(state: &State) -> f64 {
    1.0 + crate::common::sum_abs(&state.v)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 48,
        failure_persistence: None,
        max_shrink_iters: 400,
        ..ProptestConfig::default()
    })]

    #[test]
    fn laws_of_mechanics(machine in machine(4)) {
        laws::all(&Case::of(&machine), &mut Rng::new(1));
    }

    /// Two gravities superpose; the world may be rotated; velocities enter as squares.
    #[test]
    fn forces_superpose(machine in machine(5)) {
        let draft = &machine.draft;
        let robot = Robot::read(&draft.yaml(), None);
        let state = machine.state(&robot);
        let place = |law: &str| format!("{law}\n{}{state:?}", draft.yaml());
        let size = natural_size(&robot, &state, Method::InverseDynamics);

        let (one, other) = ([1.0, -2.0, 4.0], [0.5, 8.0, -0.25]);
        let both = std::array::from_fn(|c| one[c] + other[c]);
        let weight = |g: [f64; 3]| value(&under(draft, g), Method::Gravity, &state);
        let sum: Vec<Dd> = weight(one).into_iter().zip(weight(other)).map(|(x, y)| x + y).collect();
        let heavy = natural_size(&under(draft, [9.0; 3]), &state, Method::Gravity);
        assert_close(&weight(both), &sum, EXACT * heavy, || place("gravities add up"));

        let efforts = value(&robot, Method::InverseDynamics, &state);
        let there = value(&turned(draft), Method::InverseDynamics, &state);
        assert_close(&there, &efforts, EXACT * size, || place("the world turned"));

        let moving = |scale: f64| {
            let mut faster = state.clone();
            faster.v.iter_mut().for_each(|v| *v *= scale);
            let bias = value(&robot, Method::Bias, &faster);
            let weight = value(&robot, Method::Gravity, &state);
            bias.into_iter().zip(weight).map(|(b, g)| b - g).collect::<Vec<Dd>>()
        };
        let four: Vec<Dd> = moving(1.0).into_iter().map(|x| x * Dd::from_f64(4.0)).collect();
        assert_close(&moving(2.0), &four, 4.0 * EXACT * size, || place("bias at 2 v"));
        assert_close(&moving(-1.0), &moving(1.0), EXACT * size, || place("bias at −v"));
    }

    /// J v is the rate of the pose, J̇ v that of J v; Ṁ − 2C is skew. Without a difference quotient.
    #[test]
    fn rates_are_derivatives(machine in machine(4)) {
        let case = Case::of(&machine);
        let (n, state) = (case.state.q.len(), &case.state);
        let along = Direction { q: Some(&state.v), ..Direction::default() };
        let rate = |method| case.recursion.derivative(method, state, &along);

        for site in (0..case.robot.graph.sites.len()).map(SiteId) {
            let of = |method| value(&case.robot, method, state);
            let size = |method| case.size(method) * speed(state);
            let (pose, velocity) = (of(Method::Pose(site)), of(Method::Velocity(site)));
            let jacobian = of(Method::Jacobian(site));
            let product: Vec<Dd> = jacobian.chunks(n).map(|row| dot(row, &state.v)).collect();
            case.close("J v = velocity", &product, &velocity, size(Method::Velocity(site)));
            let turning = rate_of(&case, Method::Pose(site), &along);
            let spin = |i: usize, j: usize| {
                (0..3).fold(Dd::ZERO, |sum, k| sum + turning[3 * i + k] * pose[3 * j + k])
            };
            let moved = [spin(2, 1), spin(0, 2), spin(1, 0), turning[9], turning[10], turning[11]];
            case.close("rate of the pose", &moved, &velocity, size(Method::Velocity(site)));
            let bias = of(Method::JacobianDotV(site));
            let grown = rate_of(&case, Method::Velocity(site), &along);
            case.close("rate of J v", &bias, &grown, size(Method::JacobianDotV(site)));
        }

        let coriolis = value(&case.robot, Method::CoriolisMatrix, state);
        let growth = full(&rate(Method::MassMatrix), n);
        let skew = |i: usize, j: usize| growth[i][j] - Dd::from_f64(2.0) * coriolis[n * i + j];
        let size = case.size(Method::CoriolisMatrix);
        for (i, j) in (0..n).flat_map(|i| (0..=i).map(move |j| (i, j))) {
            case.close("Ṁ − 2C is skew", &[skew(i, j)], &[-skew(j, i)], 4.0 * size);
        }
    }
}

/// A site's method differentiated along a motion.
fn rate_of(case: &Case, method: Method, along: &Direction<'_>) -> Vec<Dd> {
    let function = case.robot.whole("recursion", method);
    derivative(&function, &case.state, along)
}
