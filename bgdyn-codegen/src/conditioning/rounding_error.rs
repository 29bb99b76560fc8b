//! Measures the rounding error of a function: its value in `f64` against double-double, at sampled states.

use bgdyn_runtime::Dd;

use super::sample_states::{near_singular, random};
use super::tree_states::{add_further_arguments, of_method, rounded, takes_others};
use crate::bond_graph::BondGraph;
use crate::expr::Inputs;
use crate::function::Function;

/// The largest error at the sampled states. A failure in a state with a result is worse than any error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RoundingError {
    /// Number of states with a result in double-double and none in `f64`.
    pub failures: usize,
    /// The largest error in the other states, in units of the rounding (2⁻⁵²) of the largest component of
    /// the result: 1 is the error of rounding the exact result, 1,000 is three digits lost.
    pub ulps: f64,
}

impl RoundingError {
    /// Returns a key for sorting, the best first; errors that agree to a tenth of an ulp are equal.
    pub(crate) fn rank(self) -> (usize, u64) {
        // Beyond the range of u64 the cast returns its largest number.
        (self.failures, (10.0 * self.ulps).ceil() as u64)
    }
}

/// Returns the error of a function in generic states (positions anywhere within a turn, or a metre;
/// velocities, accelerations and efforts of a few units, some a thousand times as large); for functions
/// that invert the mass matrix also in states near aligned axes. Run-time parameters have the values of
/// the spec. States without a result in double-double are ignored; `None` if there are no others.
pub fn rounding_error(function: &Function, graph: &BondGraph) -> Option<RoundingError> {
    rounding_error_at(
        function,
        &exact_results(std::slice::from_ref(function), graph),
    )
}

/// A state, and a method's result there in double-double.
pub(crate) type ExactResult = (Inputs<f64>, Vec<Dd>);

/// Returns the states in which any of these functions for one method has a result in double-double.
pub(crate) fn exact_results(ways: &[Function], graph: &BondGraph) -> Vec<ExactResult> {
    let mut states = random(graph);
    if ways.iter().any(|way| way.shape().checked()) {
        states.extend(near_singular(graph));
    }
    if let Some(first) = ways.first() {
        for (state, seed) in states.iter_mut().zip(1..) {
            add_further_arguments(graph, first.method, state, seed);
        }
    }
    let of_tree = ways.iter().find(|way| takes_others(way.method));
    if let Some(way) = of_tree {
        let with_tree = |state| rounded(&of_method(graph, way.method, &in_double_double(&state)));
        states = states.into_iter().map(with_tree).collect();
    }
    let answered = states.into_iter().filter_map(|state| {
        let exact = ways.iter().find_map(|way| {
            let (exact, refused) = way.evaluate(in_double_double(&state));
            refused.is_none().then_some(exact)
        });
        Some((state, exact?))
    });
    answered.collect()
}

/// Returns the error of a function at these states; `None` if there are none.
pub(crate) fn rounding_error_at(
    function: &Function,
    answers: &[ExactResult],
) -> Option<RoundingError> {
    let mut worst = RoundingError::default();
    for (state, exact) in answers {
        match function.evaluate(state.clone()) {
            (_, Some(_)) => worst.failures += 1,
            (found, None) => worst.ulps = worst.ulps.max(error_in_ulps(&found, exact)),
        }
    }
    (!answers.is_empty()).then_some(worst)
}

/// Returns the largest error over the largest component, in units of 2⁻⁵².
fn error_in_ulps(found: &[f64], exact: &[Dd]) -> f64 {
    let size = exact.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
    let off = exact.iter().zip(found);
    let off = off.map(|(x, &y)| (*x - Dd::from_f64(y)).to_f64().abs());
    // A NaN counts as the largest error.
    let off = off.fold(0.0, |most, x: f64| if x <= most { most } else { x });
    match off {
        0.0 => 0.0,
        off if off.is_finite() => off / size / f64::EPSILON,
        _ => f64::INFINITY,
    }
}

/// Converts the numbers to double-double.
pub(crate) fn in_double_double(state: &Inputs<f64>) -> Inputs<Dd> {
    let all = |x: &[f64]| x.iter().map(|&x| Dd::from_f64(x)).collect();
    Inputs {
        q: all(&state.q),
        v: all(&state.v),
        a: all(&state.a),
        u: all(&state.u),
        x: all(&state.x),
        modes: all(&state.modes),
        parameters: all(&state.parameters),
        ..Inputs::default()
    }
}
