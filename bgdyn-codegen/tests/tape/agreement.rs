//! Compares prepared functions with the evaluator, bit by bit.

use std::collections::BTreeSet;

use bgdyn_codegen::engine::{CallArguments, Callable, Status};
use bgdyn_codegen::expr::{Graph, Inputs, Leaf, Node, NodeId, reachable};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::{Dd, Scalar};

use super::common::rng::Rng;

/// Number of states of each function in `f64`.
const STATES: usize = 16;

/// The kinds of nodes.
pub const KINDS: [&str; 20] = [
    "Constant", "Leaf", "Add", "Mul", "Div", "MulAdd", "Sqrt", "Angle", "Sin", "Cos", "Exp", "Ln",
    "Tanh", "Abs", "Min", "Max", "Sign", "Less", "Select", "Pivot",
];

/// What was compared.
#[derive(Debug, Default)]
pub struct Seen {
    pub functions: usize,
    pub calls: usize,
    /// Calls with a refused pivot; calls with finite results only, refused or not.
    pub refused: usize,
    pub finite: usize,
    /// Functions in several blocks, with inner products, with loops over columns.
    pub cut: usize,
    pub products: usize,
    pub looped: usize,
    /// Kinds of nodes that results need.
    pub kinds: BTreeSet<String>,
}

/// Compares a prepared function with the evaluator at [`states`].
pub fn agree(
    prepared: &dyn Callable,
    name: &str,
    function: &Function,
    scene: Option<&SceneEquations>,
    seen: &mut Seen,
) {
    seen.note(function);
    for (k, at) in states(function, scene).enumerate() {
        let (wanted, refused) = function.evaluate(at.clone());
        let (found, status) = prepared.value(&CallArguments::from(&at));
        let what = || format!("{name}, state {k}: {at:?}");
        same(&found, &wanted, &|x| x.to_bits(), what);
        assert_eq!(status, Status::of(refused, &wanted), "{}", what());
        seen.calls += 1;
        seen.refused += usize::from(refused.is_some());
        seen.finite += usize::from(wanted.iter().all(|x| x.is_finite()));
    }
}

/// Returns the arguments of the calls of a function; states of scenes are near the scene's start.
pub fn states(
    function: &Function,
    scene: Option<&SceneEquations>,
) -> impl Iterator<Item = Inputs<f64>> {
    let mut rng = Rng::new(23);
    (0..STATES).map(move |k| state(function, scene, &mut rng, k))
}

#[expect(
    clippy::eq_op,
    reason = "only a NaN differs from itself, in every scalar"
)]
fn is_nan<T: Scalar>(x: T) -> bool {
    x != x
}

/// Compares results bit by bit; the bits of a NaN do not matter.
pub fn same<T: Scalar, B: PartialEq>(
    found: &[T],
    wanted: &[T],
    bits: &dyn Fn(T) -> B,
    what: impl Fn() -> String,
) {
    assert_eq!(found.len(), wanted.len(), "{}", what());
    for (i, (&x, &y)) in found.iter().zip(wanted).enumerate() {
        let both_nan = is_nan(x) && is_nan(y);
        assert!(
            bits(x) == bits(y) || both_nan,
            "{}: result {i} is {x:?} and not {y:?}",
            what()
        );
    }
}

/// Returns the arguments of one call: usual numbers, or with something that hurts.
fn state(
    function: &Function,
    scene: Option<&SceneEquations>,
    rng: &mut Rng,
    k: usize,
) -> Inputs<f64> {
    let mut at = match scene {
        Some(system) => near_start(system, rng),
        None => anywhere(function, rng),
    };
    let hurt: &[f64] = match k {
        // Angles and rates of this size; a state with some zeros; states with one bad number.
        4 | 5 => {
            at.q.iter_mut().for_each(|q| *q += rng.within(1e6));
            &[]
        }
        6 => &[0.0, -0.0, 0.0, -0.0, 0.0],
        7 | 8 => &[f64::NAN],
        9 | 10 => &[f64::INFINITY],
        11 | 12 => &[f64::NEG_INFINITY],
        13 => &[1e300, -1e-310],
        _ => &[],
    };
    for &bad in hurt {
        let mut arrays = [
            &mut at.q,
            &mut at.v,
            &mut at.a,
            &mut at.x,
            &mut at.u,
            &mut at.modes,
            &mut at.parameters,
        ];
        let all: usize = arrays.iter().map(|array| array.len()).sum();
        if all > 0 {
            let mut i = rng.below(all);
            for array in &mut arrays {
                match i.checked_sub(array.len()) {
                    Some(later) => i = later,
                    None => {
                        array[i] = bad;
                        break;
                    }
                }
            }
        }
    }
    at
}

/// Returns random arguments, as many as the function reads.
fn anywhere(function: &Function, rng: &mut Rng) -> Inputs<f64> {
    let mut at = Inputs::default();
    for i in 0..function.graph.len() {
        let Node::Leaf(leaf) = function.graph.node(NodeId::at(i)) else {
            continue;
        };
        let (array, i) = match *leaf {
            Leaf::Position(i) => (&mut at.q, i),
            Leaf::Velocity(i) => (&mut at.v, i),
            Leaf::Acceleration(i) => (&mut at.a, i),
            Leaf::State(i) => (&mut at.x, i),
            Leaf::Input(i) => (&mut at.u, i),
            Leaf::Mode(i) => (&mut at.modes, i),
            Leaf::Parameter(i) => (&mut at.parameters, i),
            Leaf::Time => {
                at.t = Some(rng.within(3.0));
                continue;
            }
            Leaf::BlockResult { .. } => continue,
        };
        while array.len() <= i {
            array.push(rng.within(3.0));
        }
    }
    at.parameters.iter_mut().for_each(|p| *p = p.abs());
    at
}

/// Returns random arguments near the start of a scene.
fn near_start(system: &SceneEquations, rng: &mut Rng) -> Inputs<f64> {
    let layout = &system.scene.layout;
    let start = &system.initial;
    let mut around = |numbers: &[Dd], size: f64| -> Vec<f64> {
        let one = |x: &Dd| {
            let x = x.to_f64();
            // Volumes of fluid have a scale of their own.
            x + rng.within(if x == 0.0 { size } else { 0.05 * x.abs() })
        };
        numbers.iter().map(one).collect()
    };
    let zeros = |n: usize| vec![Dd::ZERO; n];
    let parameters: Vec<Dd> = system.scene.parameters.iter().map(|p| p.default).collect();
    let mut at = Inputs {
        q: around(&start.q, 0.3),
        v: around(&start.v, 1.0),
        a: around(&zeros(layout.nv()), 3.0),
        x: around(&start.x, 1e-3),
        u: around(&zeros(layout.inputs.len()), 2.0),
        modes: around(&zeros(start.modes.len()), 1.5),
        parameters: around(&parameters, 0.1),
        t: None,
        passed: vec![],
    };
    at.modes.iter_mut().for_each(|mode| *mode = mode.round());
    at.t = Some(rng.within(2.0));
    at
}

impl Seen {
    /// Fails if no result needed a node of one of these kinds.
    pub fn assert_has(&self, kinds: &[&str]) {
        let missing = kinds.iter().filter(|&&kind| !self.kinds.contains(kind));
        let missing: Vec<_> = missing.collect();
        assert!(missing.is_empty(), "no function with {missing:?}");
    }

    /// Adds what another part of the test compared.
    #[allow(dead_code, reason = "one of the tests has parts")]
    pub fn add(&mut self, other: Seen) {
        self.functions += other.functions;
        self.calls += other.calls;
        self.refused += other.refused;
        self.finite += other.finite;
        self.cut += other.cut;
        self.products += other.products;
        self.looped += other.looped;
        self.kinds.extend(other.kinds);
    }

    fn note(&mut self, function: &Function) {
        self.functions += 1;
        self.cut += usize::from(function.blocks.len() > 1);
        let products = |block: &bgdyn_codegen::function::Block| !block.products.is_empty();
        self.products += usize::from(function.blocks.iter().any(products));
        for block in &function.blocks {
            self.kinds(&function.graph, &block.outputs);
        }
        for columns in function.loops.iter().flat_map(|loops| &loops.groups) {
            self.looped += 1;
            self.kinds(&columns.graph, &columns.outputs);
        }
    }

    fn kinds(&mut self, graph: &Graph, outputs: &[bgdyn_codegen::expr::Signed]) {
        let needed = reachable(graph, outputs);
        for i in (0..graph.len()).filter(|&i| needed[i]) {
            let shown = format!("{:?}", graph.node(NodeId::at(i)));
            let kind = shown.split('(').next().unwrap_or_default();
            self.kinds.insert(kind.to_owned());
        }
    }
}
