//! Derivatives of the dynamics along one direction, and adjoints, by differentiation of expressions.
//!
//! | method | computed as |
//! |---|---|
//! | inverse dynamics along (dq, dv, da) | one forward pass over its expressions |
//! | forward dynamics along (dq, dv, dτ) | M⁻¹ (dτ − dP(q, v, q̈; dq, dv)) |
//! | adjoint of inverse dynamics | one backward pass over l·τ |
//! | adjoint of forward dynamics | μ = M⁻¹ l, then that of inverse dynamics at q̈ with −μ |
//!
//! Positions move along the tangent: q̇ = N(q) dq.

use bgdyn_runtime::Dd;

use super::differentiate::{finish, position_tangents, reopen};
use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Expr, Graph, Leaf, Signed, Tangent, adjoints, copy_into};
use crate::formulation::slopes::along_efforts;
use crate::formulation::{Formulation, Prepared};
use crate::function::Function;
use crate::method::{Directional, Method};
use crate::passes::cheapest;

/// Derivatives along directions, and adjoints.
pub(in crate::formulation) struct AlongDirections;

impl Formulation for AlongDirections {
    fn name(&self) -> &'static str {
        "along_directions"
    }

    fn summary(&self) -> &'static str {
        "derivatives along one direction and adjoints, by one pass over the expressions of the dynamics"
    }

    fn combines(&self) -> bool {
        true
    }

    fn reads(&self, method: Method) -> Vec<Method> {
        match method {
            Method::Directional(of) if of.is_forward() => {
                vec![Method::InverseDynamics, Method::ForwardDynamics]
            }
            Method::Directional(_) => vec![Method::InverseDynamics],
            _ => Vec::new(),
        }
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let Method::Directional(of) = method else {
            return None;
        };
        let graph = prepared.graph;
        let inverse = prepared.candidates(Method::InverseDynamics);
        let inverse = inverse.accepted.iter().map(|candidate| &candidate.plain);
        if !of.is_forward() {
            return cheapest(inverse.map(|from| of_inverse(graph, of, from)));
        }
        let forward = prepared.candidates(Method::ForwardDynamics);
        let forward = forward.accepted.iter().chain(&forward.borderline);
        let inverse: Vec<&Function> = inverse.collect();
        cheapest(forward.flat_map(|forward| {
            let pairs = inverse.iter();
            pairs.map(move |inverse| of_forward(graph, of, (inverse, &forward.plain)))
        }))
    }
}

/// The leaf of a component of da.
type AlongA = fn(usize) -> Leaf;

/// Returns a method of inverse dynamics from its expressions.
fn of_inverse(graph: &BondGraph, of: Directional, from: &Function) -> Function {
    let (b, efforts) = reopen(from);
    let n = graph.coordinates.len();
    let outputs = match of {
        Directional::InverseAlong => {
            let rates = rates_along(&b, graph);
            along(&b, &efforts, &rates, Some(Leaf::Input))
        }
        _ => {
            let l = (0..n)
                .map(|j| b.leaf(Leaf::State(j)).signed())
                .collect::<Vec<_>>();
            adjoint(&b, graph, (&efforts, &l)).concat()
        }
    };
    finish(graph, Method::Directional(of), from, b, outputs)
}

/// Returns a method of forward dynamics from the expressions of both.
fn of_forward(
    graph: &BondGraph,
    of: Directional,
    (inverse, forward): (&Function, &Function),
) -> Function {
    let n = graph.coordinates.len();
    let (b, accelerations) = reopen(forward);
    // The efforts of inverse dynamics at the accelerations; these are independent of the direction.
    let efforts =
        b.with_graph(|g| copy_into(g, &inverse.graph, &inverse.blocks[0].outputs, |_, _| None));
    let at_accelerations = |results: &[Signed]| -> Vec<Signed> {
        let placed = |_: &mut Graph, leaf: Leaf| match leaf {
            Leaf::Acceleration(j) => Some(accelerations[j]),
            _ => None,
        };
        let copy = b.with_graph(|g| g.clone());
        b.with_graph(|g| copy_into(g, &copy, results, placed))
    };
    let outputs = match of {
        Directional::ForwardAlong => {
            let rates = rates_along(&b, graph);
            let moved = at_accelerations(&along(&b, &efforts, &rates, None));
            let drive: Vec<Signed> = moved
                .iter()
                .enumerate()
                .map(|(j, &e)| (b.leaf(Leaf::Acceleration(j)) - b.expr(e)).signed())
                .collect();
            along_efforts(&b, &accelerations, &drive)
        }
        _ => {
            let l: Vec<Signed> = (0..n).map(|j| b.leaf(Leaf::State(j)).signed()).collect();
            let solved = along_efforts(&b, &accelerations, &l);
            let minus: Vec<Signed> = solved.iter().map(|&e| (-b.expr(e)).signed()).collect();
            let [by_q, by_v, _] = adjoint(&b, graph, (&efforts, &minus));
            let mut outputs = accelerations.clone();
            outputs.extend(at_accelerations(&by_q));
            outputs.extend(at_accelerations(&by_v));
            outputs.extend(solved);
            outputs
        }
    };
    finish(graph, Method::Directional(of), forward, b, outputs)
}

/// Returns the rates of the positions for the velocities dq of the arguments.
fn rates_along(b: &Builder, graph: &BondGraph) -> Vec<Signed> {
    let tangents = position_tangents(b, graph);
    let rate = |p: usize| {
        let terms = tangents.iter().enumerate();
        let sum = terms.fold(b.zero(), |sum: Expr<'_>, (j, tangent)| {
            sum + b.expr(tangent[p]) * b.leaf(Leaf::State(j))
        });
        sum.signed()
    };
    (0..graph.positions.len()).map(rate).collect()
}

/// Returns the derivatives of efforts along the arguments dq and dv, and along da if there is a leaf for it.
fn along(b: &Builder, results: &[Signed], rates: &[Signed], da: Option<AlongA>) -> Vec<Signed> {
    let mut tangent = Tangent::new(|g: &mut Graph, leaf| match (leaf, da) {
        (Leaf::Position(p), _) => Some(rates[p]),
        (Leaf::Velocity(j), _) => Some(g.leaf(Leaf::Mode(j))),
        (Leaf::Acceleration(j), Some(leaf)) => Some(g.leaf(leaf(j))),
        _ => None,
    });
    let all = results.iter();
    all.map(|&e| b.with_graph(|g| tangent.of(g, e))).collect()
}

/// Returns the derivatives of Σ factor · result by positions along the tangent, by velocities, and by accelerations.
fn adjoint(
    b: &Builder,
    graph: &BondGraph,
    (results, factors): (&[Signed], &[Signed]),
) -> [Vec<Signed>; 3] {
    let n = graph.coordinates.len();
    let pairs: Vec<(Signed, Signed)> = results
        .iter()
        .copied()
        .zip(factors.iter().copied())
        .collect();
    let found = b.with_graph(|g| adjoints(g, &pairs));
    let zero = b.constant(Dd::ZERO).signed();
    let of = |leaf: Leaf| found.get(&leaf).copied().unwrap_or(zero);
    let by_velocity = |tangent: &Vec<Signed>| {
        let terms = tangent.iter().enumerate();
        let sum = terms.fold(b.zero(), |sum: Expr<'_>, (p, &rate)| {
            sum + b.expr(rate) * b.expr(of(Leaf::Position(p)))
        });
        sum.signed()
    };
    [
        position_tangents(b, graph)
            .iter()
            .map(by_velocity)
            .collect(),
        (0..n).map(|j| of(Leaf::Velocity(j))).collect(),
        (0..n).map(|j| of(Leaf::Acceleration(j))).collect(),
    ]
}
