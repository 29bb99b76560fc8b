//! Functions in the twist of each link that can be the base, on random vehicles, against elimination on the open tree.

use std::collections::BTreeSet;

use bgdyn_codegen::choice::Choice;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::Scalar;

use super::random_mechanisms::{Text, Touch};
use super::robot::{Robot, State, close, dd, largest};

const METHODS: [Method; 6] = [
    Method::InverseDynamics,
    Method::Bias,
    Method::Gravity,
    Method::MassMatrix,
    Method::ForwardDynamics,
    Method::KineticEnergy,
];

/// Joints of links without mass before the first body, all axes in general position: two further bases.
const ANGLES: [&str; 4] = [
    "type: planar, origin: { rpy: [0.2, -0.3, 0.4] }",
    "type: prismatic, axis: [0.1, 0.3, 1]",
    "type: continuous, axis: [1, 0.2, -0.1], origin: { xyz: [0.1, -0.2, 0.05] }",
    "type: continuous, axis: [0.3, 1, 0.2], origin: { xyz: [0.03, 0.04, 0], rpy: [0, 0.3, 0] }",
];

/// The same with axes along those of links: the base's axes are those of the file.
const SQUARE: [&str; 4] = [
    "type: planar",
    "type: prismatic, axis: z",
    "type: continuous, axis: x",
    "type: continuous, axis: y",
];

fn rounded<T: Scalar<Refused = Option<usize>> + Into<f64>>(
    state: &State<f64>,
    function: &Function,
) -> Vec<f64> {
    let all = |x: &[f64]| x.iter().map(|&x| T::from_f64(x)).collect();
    let state: State<T> = State {
        q: all(&state.q),
        v: all(&state.v),
        a: all(&state.a),
        u: all(&state.u),
    };
    let values = state.value(function);
    values.into_iter().map(Into::into).collect()
}

/// Compares the functions of all bases; there must be as many.
fn compare(text: &str, bases: usize, what: &str) {
    let robot = Robot::read(text);
    let closure = robot.mechanism.closure().expect("constraints").clone();
    let choice = Choice::new(&robot.graph, None);
    for method in METHODS {
        let all = choice.compared(method);
        let usual = all
            .iter()
            .find(|f| f.formulation.contains("loops eliminated"));
        let usual = usual.unwrap_or_else(|| panic!("{what}: {method:?} is not eliminated"));
        let own: Vec<&Function> = all
            .iter()
            .filter(|f| f.formulation.contains("twist of"))
            .collect();
        // Forward dynamics that loses digits is not compared.
        let found: BTreeSet<&str> = own.iter().map(|f| f.formulation.as_str()).collect();
        if method != Method::ForwardDynamics {
            assert_eq!(found.len(), bases, "{what}: {method:?}: {found:?}");
        }
        for k in 0..4 {
            let mut state = robot.state(k as u64);
            state.q.clone_from(&closure.samples[k + 1]);
            let wanted = state.value(usual);
            for function in &own {
                let what = format!("{what}, {method:?}, {}, state {k}", function.formulation);
                close(&state.value(function), &wanted, 1e-21, 0.0, &what);
                let state = state.rounded();
                let digits = rounded::<f64>(&state, function);
                close(&dd(&digits), &wanted, 1e-9, largest(&wanted), &what);
                if method == Method::MassMatrix {
                    let digits = rounded::<f32>(&state, function);
                    close(&dd(&digits), &wanted, 1e-3, largest(&wanted), &what);
                }
            }
        }
    }
}

/// One wheel, ball or knife edge beside a leaning wheel on its own link.
#[test]
fn vehicles_move_in_the_twist_of_every_base() {
    let independent = [
        "[base_0_turn, base_2, base_3, j1, spin_0]",
        "[base_2, j1, spin_0]",
    ];
    let others = [
        None,
        Some(Touch::Wheel),
        Some(Touch::Edge),
        Some(Touch::Longitudinal),
    ];
    for (seed, chain) in [ANGLES, SQUARE].into_iter().enumerate() {
        for (k, other) in others.into_iter().enumerate() {
            let mut random = Random(1200 + 10 * seed as u64 + k as u64);
            let mut text = Text::new(&mut random, "type: fixed", 1);
            text.wheel(&mut random, 0, Touch::Wheel);
            let mut free = independent[0].to_owned();
            match other {
                Some(Touch::Wheel) => {
                    text.wheel(&mut random, 1, Touch::Wheel);
                    free = independent[1].to_owned();
                }
                Some(touch) => {
                    text.touch(&mut random, 1, touch);
                    // With its height a wheel that may slip along its axle has two rows.
                    free = match touch {
                        Touch::Longitudinal => independent[1].to_owned(),
                        _ => free.replace("base_0_turn, ", ""),
                    };
                }
                None => {}
            }
            let text = format!(
                "{}independent: {free}\n",
                text.on_chain(&chain).constrained()
            );
            compare(&text, 3, &format!("chain {seed}, {other:?}"));
        }
    }
}

/// Bodies on a floating joint, whose velocities are the twist already.
#[test]
fn floating_vehicles_move_in_the_twist_of_their_base() {
    for (k, touch) in [Touch::Ball, Touch::Ellipsoid, Touch::Edge, Touch::Wheel]
        .into_iter()
        .enumerate()
    {
        let mut random = Random(1300 + k as u64);
        let mut text = Text::new(&mut random, "type: floating", 2);
        text.touch(&mut random, 0, touch);
        text.wheel(&mut random, 1, Touch::Tyre);
        compare(&text.constrained(), 1, &format!("floating, {touch:?}"));
    }
}
