//! Checks derivatives along directions against the literal efforts in dual numbers.

use bgdyn_runtime::Dd;

use super::compare::{SizedLaw, dot, largest, minus, times};
use super::dual::{constants, rates, with_rates};
use super::literal_values::{LiteralValues, State};
use crate::expr::{Builder, Expr, Inputs, Leaf, evaluate};
use crate::formulation::rates_along;
use crate::method::{Directional, Method};
use crate::random::Random;

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
        Directional::InverseAdjoint
        | Directional::ForwardAdjoint
        | Directional::InverseCurvature => at.x = factors,
    }
    at
}

/// Returns the law of a method; `found` is its result at the [`extended`] state.
pub(super) fn law(
    literal: &LiteralValues<'_>,
    of: Directional,
    (state, found): (&State, &[Dd]),
) -> Option<SizedLaw> {
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
        Directional::InverseCurvature => second_law(literal, (state, found), factors),
    })
}

/// A direction of positions along the velocities, of velocities and of accelerations.
type FullDirection = [Vec<Dd>; 3];

/// Returns the law of second derivatives: along two directions.
fn second_law(
    literal: &LiteralValues<'_>,
    (state, found): (&State, &[Dd]),
    factors: &[Dd],
) -> SizedLaw {
    let n = state.at.v.len();
    let [dq, dv, da, _] = directions(n);
    let mut random = Random(41);
    let [eq, ev, ea] = [(); 3].map(|()| {
        let number = |_| Dd::from_f64(2.0 * random.signed());
        (0..n).map(number).collect::<Vec<Dd>>()
    });
    let matrices: Vec<&[Dd]> = found.chunks(n * n).collect();
    let form = |m: usize, x: &[Dd], y: &[Dd]| dot(x, &times(matrices[m], y));
    // In order: first along d, then along e.
    let both = form(0, &dq, &eq)
        + form(1, &dq, &ev)
        + form(1, &eq, &dv)
        + form(2, &dv, &ev)
        + form(3, &da, &eq)
        + form(3, &ea, &dq);
    let expected = second_rates(literal, &state.at, &[dq, dv, da], &[eq, ev, ea]);
    let size = largest(&state.efforts).max(largest(found));
    let text = "second derivative of l·P along two directions";
    (text, vec![both], vec![dot(factors, &expected)], size)
}

/// Returns the derivative along `second` of the derivative of P along `first`.
fn second_rates(
    literal: &LiteralValues<'_>,
    at: &Inputs<Dd>,
    first: &FullDirection,
    second: &FullDirection,
) -> Vec<Dd> {
    let graph = literal.prepared.graph;
    let moved = with_rates(&at.q, &graph.rates_along(&at.q, &second[0]));
    // q̇ = N(q) dq changes along the second direction as well.
    let rates_of_q = {
        let b = Builder::new();
        let leaves: Vec<Expr<'_>> = (0..at.v.len()).map(|j| b.leaf(Leaf::State(j))).collect();
        let outputs = rates_along(&b, graph, &leaves);
        let inputs = Inputs {
            q: moved.clone(),
            x: constants(&first[0]),
            parameters: constants(&at.parameters),
            ..Inputs::default()
        };
        b.with_graph(|g| evaluate(g, &outputs, &inputs, &mut None))
    };
    let twice = |x: &[Dd], k: usize| with_rates(&with_rates(x, &second[k]), &constants(&first[k]));
    let inputs = Inputs {
        q: with_rates(&moved, &rates_of_q),
        v: twice(&at.v, 1),
        a: twice(&at.a, 2),
        parameters: constants(&constants(&at.parameters)),
        ..Inputs::default()
    };
    rates(&rates(&literal.inverse.evaluate(inputs).0))
}
