//! How many digits a function loses: its value in `f64` against its value in double-double, at
//! sampled states.

use std::f64::consts::PI;

use bgdyn_runtime::Dd;

use crate::bond_graph::BondGraph;
use crate::expr::Inputs;
use crate::function::Function;
use crate::mechanism::Motion;

/// States tried.
const STATES: u64 = 24;

/// The worst error of a function in `f64`, in units of the rounding (2⁻⁵²) of the largest component
/// of its result: 1 is as good as rounding the exact result, 1,000 is three digits lost. Positions
/// anywhere within a turn, or a metre; velocities, accelerations and efforts of a few units;
/// run-time parameters as the spec has them. States in which a pivot is refused do not count;
/// nothing where that is every one.
pub fn loss(function: &Function, graph: &BondGraph) -> Option<f64> {
    let errors = (0..STATES).filter_map(|seed| error(function, &state(graph, seed)));
    errors.reduce(f64::max)
}

fn error(function: &Function, state: &Inputs<Dd>) -> Option<f64> {
    let (exact, refused) = function.evaluate(state.clone());
    let (rounded, refused_too) = function.evaluate(rounded(state));
    if refused.is_some() || refused_too.is_some() {
        return None;
    }
    let size = exact.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
    let off = exact.iter().zip(&rounded);
    let off = off.map(|(x, &y)| (*x - Dd::from_f64(y)).to_f64().abs());
    let off = off.fold(0.0, f64::max);
    Some(if off == 0.0 {
        0.0
    } else {
        off / size / f64::EPSILON
    })
}

/// The same numbers in `f64`, which holds them exactly.
fn rounded(state: &Inputs<Dd>) -> Inputs<f64> {
    let all = |x: &[Dd]| x.iter().map(|x| x.to_f64()).collect();
    Inputs {
        q: all(&state.q),
        v: all(&state.v),
        a: all(&state.a),
        u: all(&state.u),
        parameters: all(&state.parameters),
        ..Inputs::default()
    }
}

fn state(graph: &BondGraph, seed: u64) -> Inputs<Dd> {
    let mut random = Random(seed);
    let n = graph.coordinates.len();
    let mut all = |size: &dyn Fn(usize) -> f64| -> Vec<Dd> {
        let mut within = |j: usize| Dd::from_f64((2.0 * random.unit() - 1.0) * size(j));
        (0..n).map(&mut within).collect()
    };
    let turn = |j: usize| match graph.coordinates[j].motion {
        Motion::Rotation => PI,
        Motion::Translation | Motion::None => 1.0,
    };
    Inputs {
        q: all(&turn),
        v: all(&|_| 2.0),
        a: all(&|_| 5.0),
        u: all(&|_| 10.0),
        parameters: graph
            .parameters
            .iter()
            .map(|p| Dd::from_f64(p.default.to_f64()))
            .collect(),
        ..Inputs::default()
    }
}

/// SplitMix64: the same numbers on every machine.
struct Random(u64);

impl Random {
    /// In [0, 1).
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}
