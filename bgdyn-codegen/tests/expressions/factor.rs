//! Factoring changes no value and never adds an operation: on random graphs, and on every function
//! of random mechanisms.

use crate::common::laws::NOISY;
use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{Robot, State, golden, largest, natural_effort};
use bgdyn_codegen::expr::{Graph, Inputs, Leaf, Node, Operations, Signed, count, evaluate, factor};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use bgdyn_runtime::{Dd, Scalar};
use proptest::prelude::*;

/// Relative to the sum of the sizes of all terms in a value.
const EXACT: f64 = 1e-28;
/// Relative to a value, for each rounding: a hundred roundings of a double-double.
const ROUNDING: f64 = 1e-30;

/// A random graph over five arguments, and for each output the sum of the sizes of all its terms.
struct Program {
    graph: Graph,
    outputs: Vec<Signed>,
    sizes: Vec<f64>,
    arguments: Vec<f64>,
}

fn minus(e: Signed, negative: bool) -> Signed {
    Signed {
        negative: e.negative ^ negative,
        ..e
    }
}

impl Program {
    fn random(rng: &mut Rng, steps: usize) -> Self {
        let mut g = Graph::default();
        let arguments: Vec<f64> = (0..5).map(|_| rng.within(2.0)).collect();
        let mut made: Vec<(Signed, f64)> = Vec::new();
        for (k, x) in arguments.iter().enumerate() {
            made.push((g.leaf(Leaf::Position(k)), x.abs()));
        }
        for x in [0.5, 2.0, -3.0, 1.0, 0.1] {
            made.push((g.constant(Dd::from_f64(x)), x.abs()));
        }
        for _ in 0..steps {
            let (a, s) = *rng.pick(&made);
            let (b, t) = *rng.pick(&made);
            let b = minus(b, rng.chance(0.5));
            let new = match rng.below(12) {
                0..=4 => (g.add(a, b), s + t),
                // Low degrees, so that numbers are not too large.
                5..=9 if s * t < 1e6 => (g.mul(a, b), s * t),
                10 => {
                    let (sin, cos) = (g.sin(a), g.cos(a));
                    made.push((sin, 1.0 + s));
                    (cos, 1.0 + s)
                }
                // A bounded divisor: 1 + x².
                _ if s < 1e2 => {
                    let (one, square) = (g.constant(Dd::ONE), g.mul(a, a));
                    let divisor = g.add(one, square);
                    (g.div(b, divisor), t * (1.0 + s * s))
                }
                _ => (a, s),
            };
            made.push(new);
        }
        let some = (0..1 + rng.below(5)).map(|_| made[made.len() - 1 - rng.below(steps)]);
        let (outputs, sizes) = some.unzip();
        Program {
            graph: g,
            outputs,
            sizes,
            arguments,
        }
    }

    fn values(&self, graph: &Graph, outputs: &[Signed]) -> Vec<Dd> {
        let inputs = Inputs {
            q: self.arguments.iter().map(|&x| Dd::from_f64(x)).collect(),
            ..Inputs::default()
        };
        evaluate(graph, outputs, &inputs, &mut None)
    }
}

fn never_more(before: Operations, after: Operations) -> bool {
    after.mul + after.add <= before.mul + before.add
        && after.div <= before.div
        && after.sqrt <= before.sqrt
        && after.sincos <= before.sincos
        && after.other <= before.other
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn random_graphs_keep_their_values(seed in any::<u64>(), steps in 1_usize..120) {
        let program = Program::random(&mut Rng::new(seed), steps);
        let before = count(&program.graph, &program.outputs);
        let expected = program.values(&program.graph, &program.outputs);
        let (graph, outputs) = factor(program.graph.clone(), program.outputs.clone());
        let after = count(&graph, &outputs);
        prop_assert!(never_more(before, after), "{before:?} became {after:?}");
        let values = program.values(&graph, &outputs);
        for ((x, y), size) in values.iter().zip(&expected).zip(&program.sizes) {
            let off = (*x - *y).abs().to_f64();
            prop_assert!(off <= EXACT * size, "{x:?} for {y:?}, of size {size:e}");
        }
        let again = factor(program.graph.clone(), program.outputs.clone());
        prop_assert_eq!(again.1, outputs, "the same every time");
    }
}

/// Returns the scale of a function's values: the largest one and the natural effort. A solution with the
/// mass matrix loses digits, `lost` of them in units of the last; its derivatives twice. Other methods
/// agree to `exact`.
fn tolerance(method: Method, values: &[Dd], effort: f64, (lost, exact): (f64, f64)) -> f64 {
    let values: Vec<f64> = values.iter().map(|x| x.to_f64()).collect();
    let size = largest(&values).max(effort).max(1.0);
    let relative = match method {
        Method::ForwardDynamics => (ROUNDING * lost).max(1e-20),
        Method::ForwardDynamicsDerivatives => (ROUNDING * lost * lost).max(1e-20),
        _ => exact,
    };
    relative * size
}

/// Returns the growth of rounding errors in the factorisation M = Lᵀ D L: the largest M_jj/D_j.
fn growth(robot: &Robot, state: &State) -> f64 {
    let values: Vec<Dd> = state.value(&robot.function("literal", Method::MassMatrix));
    let n = robot.graph.coordinates.len();
    let at = |i: usize, j: usize| values[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
    let mut m: Vec<Vec<Dd>> = (0..n).map(|i| (0..n).map(|j| at(i, j)).collect()).collect();
    let mut grown: f64 = 1.0;
    for k in (0..n).rev() {
        let pivot = m[k][k];
        grown = grown.max((at(k, k) / pivot).to_f64().abs());
        for i in 0..k {
            for j in 0..k {
                let taken = m[i][k] * m[k][j] / pivot;
                m[i][j] -= taken;
            }
        }
    }
    grown
}

/// Compares two functions of one method at one state, which must agree to `exact`. `growth` is evaluated
/// only if needed.
fn compare(
    f: &Function,
    g: &Function,
    state: &State,
    (effort, exact, growth): (f64, f64, &dyn Fn() -> f64),
    what: &str,
) {
    // Pivots that are refused in `f64` may have no correct digits in double-double either.
    let refused = |f: &Function| f.evaluate::<f64>(state.inputs()).1.is_some();
    if refused(f) || refused(g) {
        return;
    }
    let (x, _): (Vec<Dd>, _) = f.evaluate(state.inputs());
    let (y, _): (Vec<Dd>, _) = g.evaluate(state.inputs());
    let tolerance = |lost| tolerance(f.method, &y, effort, (lost, exact));
    let off = |(x, y): (&Dd, &Dd)| (*x - *y).abs().to_f64();
    let worst = x.iter().zip(&y).map(off).fold(0.0, f64::max);
    let tolerance = match worst <= tolerance(1.0) {
        true => tolerance(1.0),
        false => tolerance(growth()),
    };
    for (k, (x, y)) in x.iter().zip(&y).enumerate() {
        let off = (*x - *y).abs().to_f64();
        assert!(
            off <= tolerance,
            "{what}: {}, entry {k}: {x:?} for {y:?}, allowed {tolerance:e}",
            f.name
        );
    }
}

/// Compares the function without factoring, in one block, and with it.
fn mechanism(seed: u64, most: usize) {
    let mut rng = Rng::new(seed);
    let draft = Draft::random(&mut rng, most);
    let text = draft.yaml();
    let robot = Robot::read(&text, None);
    let state = State::random(&mut rng, &robot.motions());
    let effort = natural_effort(&robot, &state);
    let growth = || growth(&robot, &state);
    // As in `common/laws.rs`: axes without snapping have components that formulations round differently.
    let formulations = if draft.exact { NOISY } else { EXACT };
    for method in Method::possible(&robot.graph.sites) {
        let what = format!("seed {seed}\n{text}{state:?}\nseed {seed}");
        if Method::OF_TRAIT.contains(&method) {
            let whole = robot.whole("recursion", method);
            let outputs = whole.blocks[0].outputs.clone();
            let before = whole.operations();
            let (graph, outputs) = factor(whole.graph.clone(), outputs);
            assert!(never_more(before, count(&graph, &outputs)), "{what}");
            let title = String::new();
            let again = Function::flat(robot.graph, method, title, graph, outputs);
            let refused = |f: &Function| f.evaluate::<f64>(state.inputs()).1;
            assert_eq!(refused(&again), refused(&whole), "{what}: refused pivots");
            compare(
                &again,
                &whole,
                &state,
                (effort, EXACT, &growth),
                &format!("{what}, against the unfactored one"),
            );
        }
        let chosen = robot.emitted(method);
        let literal = robot.function("literal", method);
        compare(
            &chosen,
            &literal,
            &state,
            (effort, formulations, &growth),
            &format!("{what}, against the literal sum"),
        );
    }
}

#[test]
fn functions_of_random_mechanisms_keep_their_values() {
    for seed in 0..25 {
        mechanism(seed, 4);
    }
    // A massless link between two axes that are parallel to within 9e-8.
    mechanism(1298, 6);
    // An axis off by 1e-13 and no snapping: potential energies differ by 1.3e-28 of the natural effort.
    mechanism(2296, 6);
}

/// The long run: `cargo test --release -p bgdyn-codegen --test expressions factor -- --ignored`.
#[test]
#[ignore = "long: 2,000 mechanisms, part of .ci/long"]
fn functions_of_many_random_mechanisms_keep_their_values() {
    for seed in 1000..3000 {
        mechanism(seed, 6);
    }
}

/// ‖x‖ of double-double numbers.
fn norm(x: &[Dd]) -> f64 {
    x.iter()
        .map(|x| x.to_f64() * x.to_f64())
        .sum::<f64>()
        .sqrt()
}

/// Inverse dynamics of one robot, before and after factoring, with its natural size.
struct Rounding {
    before: Function,
    after: Function,
    bias: Function,
    gravity: Function,
}

impl Rounding {
    fn new(robot: &Robot) -> Self {
        let whole = |method| robot.whole("recursion", method);
        Rounding {
            before: whole(Method::InverseDynamics),
            after: robot.function("recursion", Method::InverseDynamics),
            bias: whole(Method::Bias),
            gravity: whole(Method::Gravity),
        }
    }

    /// Returns errors in `T`, in eps of ‖M a‖ + ‖c‖ + ‖g‖: before and after.
    fn errors<T: Scalar<Refused = Option<usize>>>(
        &self,
        state: &State,
        eps: f64,
        widened: fn(T) -> f64,
    ) -> [f64; 2] {
        let value = |f: &Function| state.value::<Dd>(f);
        let less =
            |x: &[Dd], y: &[Dd]| -> Vec<Dd> { x.iter().zip(y).map(|(x, y)| *x - *y).collect() };
        let (exact, bias, gravity) = (value(&self.before), value(&self.bias), value(&self.gravity));
        let size = norm(&less(&exact, &bias)) + norm(&less(&bias, &gravity)) + norm(&gravity);
        [&self.before, &self.after].map(|f| {
            let rounded = state.value::<T>(f).into_iter().map(widened);
            let rounded: Vec<Dd> = rounded.map(Dd::from_f64).collect();
            norm(&less(&rounded, &exact)) / (eps * size)
        })
    }
}

/// Inverse dynamics of every golden robot is accurate to 32 eps; on average factoring loses nothing.
#[test]
fn rounding_errors_stay_as_they_are() {
    const STATES: u32 = 20;
    // Sums of the robots' mean errors.
    let mut total = [[0.0; 2]; 2];
    for name in golden::names() {
        let robot = golden::robot(&name);
        let rounding = Rounding::new(&robot);
        let mut rng = Rng::new(7);
        let (mut mean, mut worst) = ([[0.0; 2]; 2], [[0.0_f64; 2]; 2]);
        for _ in 0..STATES {
            let mut state = State::random(&mut rng, &robot.motions());
            let arguments = [&mut state.q, &mut state.v, &mut state.a];
            for x in arguments.into_iter().flatten() {
                *x = f64::from(*x as f32);
            }
            let errors = [
                rounding.errors::<f64>(&state, f64::EPSILON, |x| x),
                rounding.errors::<f32>(&state, f64::from(f32::EPSILON), f64::from),
            ];
            for (k, i) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                mean[k][i] += errors[k][i] / f64::from(STATES);
                worst[k][i] = worst[k][i].max(errors[k][i]);
            }
        }
        println!("{name:14} f64, f32 before and after: mean {mean:.2?}, worst {worst:.2?}");
        assert!(worst[0][1] <= 32.0, "{name}: {worst:?} eps");
        assert!(
            robot.nv() > 8 || worst[1][1] <= 32.0,
            "{name}: {worst:?} eps"
        );
        for (total, mean) in total.iter_mut().flatten().zip(mean.iter().flatten()) {
            *total += mean;
        }
    }
    println!("sums of means {total:.2?}");
    for [before, after] in total {
        assert!(after <= 1.1 * before, "{total:?}");
    }
}

/// A pivot's magnitude bounds the terms subtracted in its value: factoring changes neither.
#[test]
fn pivots_keep_what_they_compare() {
    let mut g = Graph::default();
    let [a, b, c] = [0, 1, 2].map(|k| g.leaf(Leaf::Position(k)));
    // a + (b − c), less (b − c) (a + c)
    let difference = g.add(b, minus(c, true));
    let magnitude = g.add(a, difference);
    let sum = g.add(a, c);
    let product = g.mul(difference, sum);
    let value = g.add(magnitude, minus(product, true));
    let pivot = g.pivot(value, magnitude, 0);
    let (graph, outputs) = factor(g, vec![pivot]);
    let Node::Pivot(value, magnitude, 0) = *graph.node(outputs[0].node) else {
        panic!("no pivot");
    };
    let Node::Add(x, y) = *graph.node(value.node) else {
        panic!("no difference");
    };
    assert!(x == magnitude.node || y.node == magnitude.node);
}
