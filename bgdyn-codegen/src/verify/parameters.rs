//! Checks derivatives of the accelerations by parameters: M ∂q̈/∂p = −∂P/∂p at constant q̈.

use bgdyn_runtime::Dd;

use super::compare::{SizedLaw, largest, times};
use super::dual::{constants, rates, with_rates};
use super::literal_values::{LiteralValues, State};
use crate::expr::Inputs;
use crate::method::{Method, PARAMETERS_PER_BODY, ParameterDerivatives};
use crate::random::Random;

/// Returns the law of a method; `found` is its result. None where the literal mass matrix is singular.
pub(super) fn law(
    literal: &LiteralValues<'_>,
    of: ParameterDerivatives,
    (state, found): (&State, &[Dd]),
) -> Option<SizedLaw> {
    let n = state.at.v.len();
    let forward = literal.form(Method::ForwardDynamics)?;
    let (accelerations, refused) = forward.evaluate(state.at.clone());
    if refused.is_some() {
        return None;
    }
    let at = Inputs {
        a: accelerations,
        ..state.at.clone()
    };
    let mut random = Random(43);
    let mut numbers = |count: usize| -> Vec<Dd> {
        let number = |_| Dd::from_f64(random.signed());
        (0..count).map(number).collect()
    };
    let (text, change, efforts) = match of {
        ParameterDerivatives::Base => {
            let bodies = literal.prepared.graph.moving_links().len();
            let parameters = numbers(PARAMETERS_PER_BODY * bodies);
            let (base, efforts) = literal.regressors()?.by_any(&at, parameters);
            ("M ∂q̈/∂π_b K π = −Y(q, v, q̈) π", base, efforts)
        }
        ParameterDerivatives::RunTime(count) => {
            let change = numbers(count);
            let inputs = Inputs {
                q: constants(&at.q),
                v: constants(&at.v),
                a: constants(&at.a),
                parameters: with_rates(&at.parameters, &change),
                ..Inputs::default()
            };
            let efforts = rates(&literal.inverse.evaluate(inputs).0);
            ("M ∂q̈/∂p dp = −∂P/∂p dp at q̈", change, efforts)
        }
    };
    let moved = times(&found[n..], &change);
    let driven = state.inertial(literal, &moved);
    let minus: Vec<Dd> = efforts.iter().map(|&e| -e).collect();
    let size = largest(&state.efforts).max(largest(&minus));
    Some((text, driven, minus, size))
}
