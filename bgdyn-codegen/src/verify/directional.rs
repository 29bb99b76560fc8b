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
    let [.., third, factors] = directions(at.v.len());
    let mut at = with_directions(at.clone());
    match of {
        Directional::InverseAlong => at.u = third,
        Directional::ForwardAlong => at.a = third,
        Directional::InverseAdjoint
        | Directional::ForwardAdjoint
        | Directional::InverseCurvature => at.x = factors,
        Directional::InverseSecond => {}
    }
    at
}

/// Returns the state with any directions.
pub(super) fn with_directions(at: Inputs<Dd>) -> Inputs<Dd> {
    let [first, modes, ..] = directions(at.v.len());
    Inputs {
        x: first,
        modes,
        ..at
    }
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
        Directional::InverseCurvature => {
            let text = "second derivative of l·P along two directions";
            let along = second_rates(literal, &state.at, n);
            let expected = vec![dot(factors, &along)];
            (
                text,
                vec![form(found, n)],
                expected,
                size.max(largest(found)),
            )
        }
        Directional::InverseSecond => {
            let text = "second derivatives of P along two directions";
            let expected = second_rates(literal, &state.at, n);
            let of_effort = |i: usize| {
                let matrix =
                    |list: usize| &found[(list * n + i) * n * n..(list * n + i + 1) * n * n];
                form(&[0, 1, 2, 3].map(matrix).concat(), n)
            };
            let all = (0..n).map(of_effort).collect();
            (text, all, expected, size.max(largest(found)))
        }
    })
}

/// A direction of positions along the velocities, of velocities and of accelerations.
type FullDirection = [Vec<Dd>; 3];

/// Returns the two directions of second derivatives: the first and the second one of the differentiation.
fn two_directions(n: usize) -> [FullDirection; 2] {
    let [dq, dv, da, _] = directions(n);
    let mut random = Random(41);
    let second = [(); 3].map(|()| {
        let number = |_| Dd::from_f64(2.0 * random.signed());
        (0..n).map(number).collect::<Vec<Dd>>()
    });
    [[dq, dv, da], second]
}

/// Returns the second derivative along both directions, from the matrices by q and q, by q and v, by v and v, by a and q.
fn form(found: &[Dd], n: usize) -> Dd {
    let [[dq, dv, da], [eq, ev, ea]] = two_directions(n);
    let product = |m: usize, x: &[Dd], y: &[Dd]| {
        let matrix = &found[m * n * n..(m + 1) * n * n];
        dot(x, &times(matrix, y))
    };
    // In order: first along d, then along e.
    product(0, &dq, &eq)
        + product(1, &dq, &ev)
        + product(1, &eq, &dv)
        + product(2, &dv, &ev)
        + product(3, &da, &eq)
        + product(3, &ea, &dq)
}

/// Returns the derivative along the second direction of the derivative of P along the first one.
fn second_rates(literal: &LiteralValues<'_>, at: &Inputs<Dd>, n: usize) -> Vec<Dd> {
    let [first, second] = &two_directions(n);
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
