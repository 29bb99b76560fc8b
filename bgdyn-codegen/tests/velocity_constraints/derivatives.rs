//! Derivatives with wheels, balls and knife edges against differences in double-double, where positions move along a
//! velocity of the open tree and close; the linearised bicycle against the benchmark.

use std::sync::Arc;

use bgdyn_codegen::bond_graph::build;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::Dd;

use super::files::spec;
use super::random_mechanisms::{Text, Touch};
use super::robot::{Robot, State, close, largest};
use super::spatial_references::{Square, assert_equations_of_the_benchmark};

const STEP: f64 = 1e-8;

/// Extrapolated central differences have the error STEP⁴, and the errors 1e-27 / STEP of positions that close.
const ALLOWED: f64 = 1e-15;

/// The state with its position moved along velocity k of the open tree, and closed.
fn moved(robot: &Robot, state: &State<Dd>, k: usize, step: Dd) -> State<Dd> {
    let closure = robot.mechanism.closure().expect("constraints");
    let graph = build(&robot.mechanism);
    let tree = &graph.closed.as_ref().expect("constraints").tree;
    let mut unit = vec![Dd::ZERO; tree.coordinates.len()];
    unit[k] = step;
    let rates = tree.multibody.position_rates(&state.q, &unit).into_iter();
    let mut q: Vec<Dd> = state.q.iter().zip(rates).map(|(&q, dq)| q + dq).collect();
    assert!(closure.close(&mut q), "the position closes");
    State { q, ..state.clone() }
}

/// Returns the derivative of a function's results by central differences D(h) = (x(+h) − x(−h)) / 2h, extrapolated:
/// (4 D(h) − D(2h)) / 3 (Richardson).
fn difference(function: &Function, at: impl Fn(Dd) -> State<Dd>) -> Vec<Dd> {
    let central = |h: f64| -> Vec<Dd> {
        let h = Dd::from_f64(h);
        let [ahead, behind] = [h, -h].map(|h| -> Vec<Dd> { at(h).value(function) });
        let pairs = ahead.iter().zip(&behind);
        pairs.map(|(&x, &y)| (x - y) / (h + h)).collect()
    };
    let [four, three] = [4.0, 3.0].map(Dd::from_f64);
    let near = central(STEP).into_iter().zip(central(2.0 * STEP));
    near.map(|(x, y)| (four * x - y) / three).collect()
}

/// Returns the columns of a matrix, row by row with this width.
fn columns(matrix: &[Dd], width: usize) -> Vec<Vec<Dd>> {
    let column = |k: usize| matrix.iter().skip(k).step_by(width).copied().collect();
    (0..width).map(column).collect()
}

/// Compares all columns of both methods at two closed positions.
fn compare(text: &str, what: &str) {
    let robot = Robot::read(text);
    let closure = robot.mechanism.closure().expect("constraints");
    let (n, nt) = (robot.nv(), closure.positions.len());
    let inverse = robot.function(None, Method::InverseDynamics);
    let forward = robot.function(None, Method::ForwardDynamics);
    for k in 0..2 {
        let mut state = robot.state(k as u64);
        state.q.clone_from(&closure.samples[3 * k + 1]);
        let found: Vec<Dd> = state.value(&robot.function(None, Method::InverseDerivativesByTree));
        assert_eq!(found.len(), n * nt + n * n, "{what}");
        let (by_q, by_v) = found.split_at(n * nt);
        compare_columns((&robot, &inverse), &state, (by_q, by_v), what);
        let found: Vec<Dd> = state.value(&robot.function(None, Method::ForwardDerivativesByTree));
        assert_eq!(found.len(), n + n * nt + 2 * n * n, "{what}");
        let (by_q, others) = found[n..].split_at(n * nt);
        compare_columns((&robot, &forward), &state, (by_q, &others[..n * n]), what);
        for (j, column) in columns(&others[n * n..], n).iter().enumerate() {
            let pushed = |h: Dd| {
                let mut state = state.clone();
                state.u[j] += h;
                state
            };
            let expected = difference(&forward, pushed);
            let what = format!("{what}: by effort {j}");
            close(column, &expected, ALLOWED, largest(&expected), &what);
        }
    }
}

fn compare_columns(
    (robot, function): (&Robot, &Arc<Function>),
    state: &State<Dd>,
    (by_q, by_v): (&[Dd], &[Dd]),
    what: &str,
) {
    let (n, nt) = (robot.nv(), by_q.len() / robot.nv());
    let size = largest(&state.value(function)).max(largest(by_q));
    for (k, column) in columns(by_q, nt).iter().enumerate() {
        let expected = difference(function, |h| moved(robot, state, k, h));
        let what = format!("{what}: {} along {k}", function.name());
        close(column, &expected, ALLOWED, size, &what);
    }
    for (j, column) in columns(by_v, n).iter().enumerate() {
        let faster = |h: Dd| {
            let mut state = state.clone();
            state.v[j] += h;
            state
        };
        let what = format!("{what}: {} by velocity {j}", function.name());
        close(column, &difference(function, faster), ALLOWED, size, &what);
    }
}

#[test]
fn derivatives_of_the_specs_are_those_of_differences() {
    let names = ["chaplygin_sleigh", "differential_drive", "snakeboard"];
    for name in names
        .into_iter()
        .chain(["rolling_disc", "rattleback", "whipple_bicycle"])
    {
        compare(&spec(name), name);
    }
}

#[test]
fn derivatives_of_random_wheels_are_those_of_differences() {
    let cases = [
        ("type: floating", Touch::Wheel),
        ("type: prismatic, axis: [1, -2, 3]", Touch::Tyre),
        ("type: spherical", Touch::Edge),
        ("type: floating", Touch::Ball),
        ("type: planar", Touch::Ellipsoid),
    ];
    for (seed, (root, touch)) in cases.into_iter().enumerate() {
        let mut random = Random(2900 + seed as u64);
        let links = if root.contains("prismatic") { 5 } else { 3 };
        let mut text = Text::new(&mut random, root, links);
        text.touch(&mut random, links - 1, touch);
        compare(&text.constrained(), &format!("{touch:?}, {root}"));
    }
    let mut random = Random(2950);
    let mut text = Text::new(&mut random, "type: floating", 2);
    text.touch(&mut random, 0, Touch::LongitudinalTyre);
    text.wheel(&mut random, 2, Touch::Lateral);
    compare(&text.constrained(), "two wheels");
}

/// About upright, with height and pitch that follow from lean and steer.
#[test]
fn the_bicycle_has_the_linear_equations_of_the_benchmark() {
    let robot = Robot::read(&spec("whipple_bicycle"));
    let derivatives = robot.function(None, Method::ForwardDerivativesByTree);
    let closure = robot.mechanism.closure().expect("wheels");
    let nt = closure.positions.len();
    assert_equations_of_the_benchmark(|speed| {
        let spin = Dd::from_f64(speed) / "0.3".parse().expect("a number");
        let state = State {
            q: closure.start.clone(),
            v: vec![Dd::ZERO, spin, Dd::ZERO],
            a: vec![],
            u: vec![Dd::ZERO; 3],
        };
        let found: Vec<Dd> = state.value(&derivatives);
        // Velocities of the open tree: ground x, y, turn, height, lean, pitch, rear spin, steer, front spin.
        let by_q = |i: usize, j: usize| found[3 + i * nt + j];
        let by_v = |i: usize, j: usize| found[3 + 3 * nt + 3 * i + j];
        let position: Square = [0, 2].map(|i| [4, 7].map(|j| by_q(i, j)));
        let velocity: Square = [0, 2].map(|i| [0, 2].map(|j| by_v(i, j)));
        [position, velocity]
    });
}
