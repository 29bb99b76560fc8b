//! First derivatives of the dynamics from composite bodies: equal to the literal sum
//! differentiated, in double-double, on random mechanisms; and their operation counts. The long
//! run:
//!
//! ```sh
//! cargo test --release -p bgdyn-codegen --test formulations derivatives_vs_literal -- --ignored
//! ```

use crate::common::parameters::{parametrised, values};
use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{Robot, State, assert_close, golden, natural_effort, sum_abs};
use bgdyn_codegen::expr::{Graph, Leaf, Tangent, evaluate};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

/// Tolerance of double-double results, relative to their natural size.
const EXACT: f64 = 1e-26;

/// ∂f/∂leaf_j by forward differentiation of the function's graph, row by row.
fn differentiated(function: &Function, state: &State, leaf: fn(usize) -> Leaf) -> Vec<Dd> {
    let n = state.q.len();
    let columns: Vec<Vec<Dd>> = (0..n)
        .map(|j| {
            let mut graph = function.graph.clone();
            let one = |g: &mut Graph, l| (l == leaf(j)).then(|| g.constant(Dd::ONE));
            let mut tangent = Tangent::new(one);
            let outputs: Vec<_> = function.blocks[0]
                .outputs
                .iter()
                .map(|&e| tangent.of(&mut graph, e))
                .collect();
            evaluate(&graph, &outputs, &state.inputs(), &mut None)
        })
        .collect();
    (0..n)
        .flat_map(|i| columns.iter().map(move |c| c[i]))
        .collect()
}

/// The recursion's own result for a method, whether or not it is the cheapest.
fn structured(robot: &Robot, method: Method, state: &State) -> Vec<Dd> {
    state.value(&robot.whole("recursion", method))
}

fn equal_to_literal(robot: &Robot, state: &State, what: &str) {
    let literal = robot.whole("literal", Method::InverseDynamics);
    let by_position = differentiated(&literal, state, Leaf::Position);
    let by_rate = differentiated(&literal, state, Leaf::Velocity);
    let size = EXACT * natural_effort(robot, state) * (1.0 + sum_abs(&state.v));
    let slopes = structured(robot, Method::InverseDynamicsDerivatives, state);
    let n = state.q.len();
    for (name, found, expected) in [
        ("∂τ/∂q", &slopes[..n * n], &by_position),
        ("∂τ/∂v", &slopes[n * n..], &by_rate),
    ] {
        assert_close(found, expected, size, || format!("{name}\n{what}"));
    }
    let half: Vec<Dd> = by_rate.iter().map(|&x| x * Dd::from_f64(0.5)).collect();
    let coriolis = structured(robot, Method::CoriolisMatrix, state);
    assert_close(&coriolis, &half, size, || format!("C\n{what}"));
}

fn check(seeds: std::ops::Range<u64>, most: usize, with_parameters: bool) {
    for seed in seeds {
        let mut rng = Rng::new(77_000 + seed);
        let mut draft = Draft::random(&mut rng, most);
        if with_parameters {
            draft = parametrised(&draft, &mut rng);
        }
        let text = draft.yaml();
        let robot = Robot::read(&text, None);
        let mut state = State::random(&mut rng, &robot.motions());
        state.parameters = values(&robot.mechanism, &mut rng);
        equal_to_literal(&robot, &state, &format!("seed {seed}\n{text}{state:?}"));
    }
}

#[test]
fn derivatives_are_the_literal_sums() {
    check(0..120, 3, false);
    check(500..560, 7, false);
    check(900..940, 5, true);
    // A joint's axis is 5e-17 rad off a quarter turn.
    check(2627..2628, 6, false);
}

#[test]
#[ignore = "long: 2,000 mechanisms, part of .ci/long"]
fn derivatives_of_two_thousand_mechanisms() {
    check(2_000..3_500, 6, false);
    check(3_500..4_000, 6, true);
}

/// Checks M ∂q̈/∂x = −∂τ/∂x, M ∂q̈/∂τ = 1, at the accelerations that the method computes; returns whether
/// M is regular.
fn undoes_the_inverse(robot: &Robot, forward: &Function, mut state: State, what: &str) -> bool {
    let n = state.q.len();
    let (found, refused) = forward.evaluate(state.inputs::<Dd>());
    let mass = crate::common::full(&structured(robot, Method::MassMatrix, &state), n);
    if refused.is_some() {
        return false;
    }
    let (accelerations, squares) = found.split_at(n);
    state.a = accelerations.iter().map(|a| a.to_f64()).collect();
    let slopes = {
        let mut inputs = state.inputs::<Dd>();
        inputs.a = accelerations.to_vec();
        let inverse = robot.whole("recursion", Method::InverseDynamicsDerivatives);
        inverse.evaluate(inputs).0
    };
    let identity = (0..n * n).map(|k| if k % (n + 1) == 0 { -Dd::ONE } else { Dd::ZERO });
    let expected: Vec<Dd> = slopes.iter().copied().chain(identity).collect();
    let product: Vec<Dd> = squares
        .chunks(n * n)
        .flat_map(|square| {
            let mass = &mass;
            (0..n * n).map(move |e| {
                let (i, j) = (e / n, e % n);
                (0..n).fold(Dd::ZERO, |sum, k| sum - mass[i][k] * square[k * n + j])
            })
        })
        .collect();
    let largest = |x: &[Dd]| x.iter().fold(1.0, |m: f64, x| m.max(x.abs().to_f64()));
    let inertia = mass.iter().flatten().copied().collect::<Vec<_>>();
    let size = 1e-24 * largest(&inertia) * largest(squares);
    assert_close(&product, &expected, size, || what.to_string());
    true
}

#[test]
fn forward_derivatives_undo_the_inverse() {
    let mut regular = 0;
    for seed in 0..60 {
        let mut rng = Rng::new(88_000 + seed);
        let text = Draft::random(&mut rng, 5).yaml();
        let robot = Robot::read(&text, None);
        let forward = robot.chosen(Method::ForwardDynamicsDerivatives);
        let (state, what) = (
            State::random(&mut rng, &robot.motions()),
            format!("seed {seed}\n{text}"),
        );
        regular += usize::from(undoes_the_inverse(&robot, &forward, state, &what));
    }
    assert!(regular > 30, "{regular}");
}

/// Also if columns run in a loop: before the last passes, and as emitted.
#[test]
fn columns_in_loops_undo_the_inverse() {
    for (name, columns) in [("scara_rrpr", 0), ("panda_gen", 12), ("chain8", 15)] {
        let robot = golden::robot(name);
        let method = Method::ForwardDynamicsDerivatives;
        let emitted =
            bgdyn_codegen::selection::function(&robot.mechanism, method, &Default::default());
        let emitted = emitted.expect("every method is known");
        for forward in [&robot.chosen(method), &emitted] {
            let groups = forward.loops.iter().flat_map(|loops| &loops.groups);
            let looped: usize = groups.map(|group| group.own.len()).sum();
            assert_eq!(looped, columns, "{name}");
            let state = State::random(&mut Rng::new(88_000), &robot.motions());
            assert!(undoes_the_inverse(&robot, forward, state, name));
        }
    }
}

/// Multiplications and additions of the chosen functions: upper bounds that no change may increase.
#[test]
fn counts_stay() {
    let bounds = [
        ("scara_rrpr", [84, 240, 33]),
        ("stanford_gen", [1167, 2440, 522]),
        ("puma_gen", [1360, 2692, 627]),
        ("puma_arm", [877, 1861, 378]),
        ("ur5_gen", [1089, 2380, 458]),
        ("panda_gen", [2047, 4087, 998]),
        ("iiwa_gen", [1830, 3844, 852]),
    ];
    let methods = [
        Method::InverseDynamicsDerivatives,
        Method::ForwardDynamicsDerivatives,
        Method::CoriolisMatrix,
    ];
    for (name, bounds) in bounds {
        let robot = golden::robot(name);
        for (method, bound) in methods.into_iter().zip(bounds) {
            let count = robot.function("recursion", method).operations();
            let total = count.mul + count.add;
            assert!(total <= bound, "{name}, {method:?}: {total}, not {bound}");
        }
    }
}
