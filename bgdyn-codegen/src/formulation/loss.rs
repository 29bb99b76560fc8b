//! How many digits a function loses: its value in `f64` against its value in double-double, at
//! sampled states.

use bgdyn_runtime::Dd;

use super::{aligned_states, generic_states};
use crate::bond_graph::BondGraph;
use crate::expr::Inputs;
use crate::function::Function;

/// Digits lost at the states tried. To refuse a state that has an answer is worse than any error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Loss {
    /// States that have an answer in double-double and none in `f64`.
    pub refused: usize,
    /// The worst error in the others, in units of the rounding (2⁻⁵²) of the largest component of
    /// the result: 1 is as good as rounding the exact result, 1,000 is three digits lost.
    pub roundings: f64,
}

impl Loss {
    /// The order of harm, where errors that agree to a tenth of a rounding are equal.
    pub(crate) fn harm(self) -> (usize, u64) {
        // Beyond the range of u64 the cast gives its largest number.
        (self.refused, (10.0 * self.roundings).ceil() as u64)
    }
}

/// The digits that a function loses. Generic states (positions anywhere within a turn, or a metre;
/// velocities, accelerations and efforts of a few units, some a thousand times as large); for
/// functions that invert the mass matrix also states near aligned axes. Run-time parameters as the
/// spec has them. States without an answer in double-double do not count; nothing where that is
/// every one.
pub fn loss(function: &Function, graph: &BondGraph) -> Option<Loss> {
    loss_at(function, &answers(std::slice::from_ref(function), graph))
}

/// A state, and a method's result there in double-double.
pub(crate) type Answer = (Inputs<f64>, Vec<Dd>);

/// The states in which any of these ways to one method has an answer in double-double.
pub(crate) fn answers(ways: &[Function], graph: &BondGraph) -> Vec<Answer> {
    let mut states = generic_states(graph);
    if ways.iter().any(|way| way.shape().checked()) {
        states.extend(aligned_states(graph));
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

/// The digits that a function loses at these states; nothing where there are none.
pub(crate) fn loss_at(function: &Function, answers: &[Answer]) -> Option<Loss> {
    let mut worst = Loss::default();
    for (state, exact) in answers {
        match function.evaluate(state.clone()) {
            (_, Some(_)) => worst.refused += 1,
            (found, None) => worst.roundings = worst.roundings.max(roundings(&found, exact)),
        }
    }
    (!answers.is_empty()).then_some(worst)
}

/// The largest error over the largest component, in units of 2⁻⁵².
fn roundings(found: &[f64], exact: &[Dd]) -> f64 {
    let size = exact.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
    let off = exact.iter().zip(found);
    let off = off.map(|(x, &y)| (*x - Dd::from_f64(y)).to_f64().abs());
    // A NaN counts as the largest of all.
    let off = off.fold(0.0, |most, x: f64| if x <= most { most } else { x });
    match off {
        0.0 => 0.0,
        off if off.is_finite() => off / size / f64::EPSILON,
        _ => f64::INFINITY,
    }
}

/// The same numbers in double-double.
pub(crate) fn in_double_double(state: &Inputs<f64>) -> Inputs<Dd> {
    let all = |x: &[f64]| x.iter().map(|&x| Dd::from_f64(x)).collect();
    Inputs {
        q: all(&state.q),
        v: all(&state.v),
        a: all(&state.a),
        u: all(&state.u),
        parameters: all(&state.parameters),
        ..Inputs::default()
    }
}
