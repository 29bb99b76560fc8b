//! Checks derivatives along directions against the literal efforts in dual numbers.

use bgdyn_runtime::Dd;

use super::compare::{dot, largest, minus};
use super::literal_values::{LiteralValues, State};
use crate::expr::Inputs;
use crate::method::{Directional, Method};
use crate::random::Random;

/// A law, its two sides, and the size of their terms.
pub(super) type DirectionalLaw = (&'static str, Vec<Dd>, Vec<Dd>, f64);

/// Returns any directions dq, dv and a third one, and the factors l of an adjoint.
fn directions(n: usize) -> [Vec<Dd>; 4] {
    let mut random = Random(37);
    [(); 4].map(|()| {
        let number = |_| Dd::from_f64(2.0 * random.signed());
        (0..n).map(number).collect()
    })
}

/// Returns the state with directions, as a method reads them.
pub(super) fn extended(of: Directional, at: &Inputs<Dd>) -> Inputs<Dd> {
    let [first, modes, third, factors] = directions(at.v.len());
    let mut at = Inputs {
        x: first,
        modes,
        ..at.clone()
    };
    match of {
        Directional::InverseAlong => at.u = third,
        Directional::ForwardAlong => at.a = third,
        Directional::InverseAdjoint | Directional::ForwardAdjoint => at.x = factors,
    }
    at
}

/// Returns the law of a method; `found` is its result at the [`extended`] state.
pub(super) fn law(
    literal: &LiteralValues<'_>,
    of: Directional,
    (state, found): (&State, &[Dd]),
) -> Option<DirectionalLaw> {
    let at = &state.at;
    let n = at.v.len();
    let all = directions(n);
    let [first, second, third, factors] = all.each_ref().map(|x| &x[..]);
    let along_all = |found: &[Dd]| vec![dot(found, &all[..3].concat())];
    let rates = literal.prepared.graph.rates_along(&at.q, first);
    let efforts_along = |a: (&[Dd], &[Dd])| literal.effort_rates(at, &rates, second, a);
    let accelerations = |u: &[Dd]| {
        let inputs = Inputs {
            u: u.to_vec(),
            ..at.clone()
        };
        Some(literal.form(Method::ForwardDynamics)?.evaluate(inputs).0)
    };
    let forward = || {
        let solution = accelerations(&at.u)?;
        let moved = efforts_along((&solution, &state.zero()));
        let along = accelerations(&minus(third, &moved))?;
        Some(minus(&along, &accelerations(&state.zero())?))
    };
    let size = largest(&state.efforts);
    Some(match of {
        Directional::InverseAlong => {
            let text = "dτ = ∂P/∂q dq + ∂P/∂v dv + ∂P/∂a da";
            (text, found.to_vec(), efforts_along((&at.a, third)), size)
        }
        Directional::ForwardAlong => {
            let text = "dq̈ = M⁻¹ (dτ − ∂P/∂q dq − ∂P/∂v dv) at q̈";
            (text, found.to_vec(), forward()?, 0.0)
        }
        Directional::InverseAdjoint => {
            let expected = dot(factors, &efforts_along((&at.a, third)));
            let text = "(∂P/∂q)ᵀ l · dq + (∂P/∂v)ᵀ l · dv + (M l) · da = l · dτ";
            let size = size.max(largest(found));
            (text, along_all(found), vec![expected], size)
        }
        Directional::ForwardAdjoint => {
            let along = forward()?;
            let found = &found[n..];
            let text = "(∂q̈/∂q)ᵀ l · dq + (∂q̈/∂v)ᵀ l · dv + (M⁻¹ l) · dτ = l · dq̈";
            let size = largest(found).max(largest(&along));
            (text, along_all(found), vec![dot(factors, &along)], size)
        }
    })
}
