//! Derivatives of the dynamics along one direction, and adjoints, by differentiation of expressions.
//!
//! | method | computed as |
//! |---|---|
//! | inverse dynamics along (dq, dv, da) | one forward pass over its expressions |
//! | forward dynamics along (dq, dv, dτ) | M⁻¹ (dτ − dP(q, v, q̈; dq, dv)) |
//! | adjoint of inverse dynamics | one backward pass over l·τ |
//! | adjoint of forward dynamics | μ = M⁻¹ l, then that of inverse dynamics at q̈ with −μ |
//! | second derivatives of l·τ | forward passes over the adjoint of inverse dynamics |
//! | second derivatives of all efforts | `second.rs` |
//!
//! Positions move along the tangent: q̇ = N(q) dq.

use bgdyn_runtime::Dd;

use super::differentiate::{
    finish, pairs_with_cheapest, position_derivatives, position_tangents, rates_along, reopen,
};
use super::second;
use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Expr, Graph, Leaf, Signed, Tangent, adjoints, copy_into};
use crate::formulation::slopes::{along_efforts, derivatives};
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
            Method::Directional(Directional::InverseSecond) => second::READS.to_vec(),
            Method::Directional(_) => vec![Method::InverseDynamics],
            _ => Vec::new(),
        }
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let Method::Directional(of) = method else {
            return None;
        };
        if of == Directional::InverseSecond {
            return second::function(prepared);
        }
        let graph = prepared.graph;
        let inverse = prepared.candidates(Method::InverseDynamics);
        let inverse = inverse.accepted.iter().map(|candidate| &candidate.plain);
        if !of.is_forward() {
            return cheapest(inverse.map(|from| of_inverse(graph, of, from)));
        }
        let inverse: Vec<&Function> = inverse.collect();
        let forward = prepared.candidates(Method::ForwardDynamics);
        let forward = forward.accepted.iter().chain(&forward.borderline);
        let forward: Vec<&Function> = forward.map(|candidate| &candidate.plain).collect();
        let pairs = pairs_with_cheapest(&inverse, &forward).into_iter();
        cheapest(pairs.map(|pair| of_forward(graph, of, pair)))
    }
}

/// The leaf of a component of da.
type AlongA = fn(usize) -> Leaf;

/// Returns a method of inverse dynamics from its expressions.
fn of_inverse(graph: &BondGraph, of: Directional, from: &Function) -> Function {
    let (b, efforts) = reopen(from);
    let outputs = match of {
        Directional::InverseAlong => {
            let rates = rates_along(&b, graph, &first_direction(&b, graph));
            along(&b, &efforts, &rates, Some(Leaf::Input))
        }
        Directional::InverseAdjoint => {
            let l = signed(&first_direction(&b, graph));
            adjoint(&b, graph, (&efforts, &l)).concat()
        }
        Directional::InverseCurvature => {
            let l = signed(&first_direction(&b, graph));
            let gradient = adjoint(&b, graph, (&efforts, &l));
            curvature(&b, graph, &gradient)
        }
        Directional::ForwardAlong | Directional::ForwardAdjoint | Directional::InverseSecond => {
            unreachable!("they are not made of inverse dynamics alone")
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
            let rates = rates_along(&b, graph, &first_direction(&b, graph));
            let moved = at_accelerations(&along(&b, &efforts, &rates, None));
            let drive: Vec<Signed> = moved
                .iter()
                .enumerate()
                .map(|(j, &e)| (b.leaf(Leaf::Acceleration(j)) - b.expr(e)).signed())
                .collect();
            along_efforts(&b, &accelerations, &drive)
        }
        Directional::ForwardAdjoint => {
            let l = signed(&first_direction(&b, graph));
            let solved = along_efforts(&b, &accelerations, &l);
            let minus: Vec<Signed> = solved.iter().map(|&e| (-b.expr(e)).signed()).collect();
            let [by_q, by_v, _] = adjoint(&b, graph, (&efforts, &minus));
            // The result is finite if q̈ and M⁻¹ l are.
            let both = accelerations.iter().zip(&solved);
            let both = both.map(|(&x, &y)| (b.expr(x) + b.expr(y)).signed());
            let mut outputs: Vec<Signed> = both.collect();
            outputs.extend(at_accelerations(&[by_q, by_v].concat()));
            outputs.extend(solved);
            outputs
        }
        _ => unreachable!("they are methods of inverse dynamics"),
    };
    finish(graph, Method::Directional(of), forward, b, outputs)
}

/// Returns the leaves of the first direction, which are the factors of an adjoint as well.
fn first_direction<'g>(b: &'g Builder, graph: &BondGraph) -> Vec<Expr<'g>> {
    let n = graph.coordinates.len();
    (0..n).map(|j| b.leaf(Leaf::State(j))).collect()
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

/// Returns the second derivatives of l·τ from its gradient: by q and q, by q and v, by v and v, by a and q.
fn curvature(b: &Builder, graph: &BondGraph, [by_q, by_v, by_a]: &[Vec<Signed>; 3]) -> Vec<Signed> {
    let n = graph.coordinates.len();
    let along_q = |x: &[Signed]| position_derivatives(b, x, graph);
    let along_v = |x: &[Signed]| derivatives(b, x, n, Leaf::Velocity);
    let (qq, vq, vv, aq) = (along_q(by_q), along_q(by_v), along_v(by_v), along_q(by_a));
    let pairs = || (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    // Column j of a matrix is its derivative along v_j. Derivatives by coordinates commute; of two equal entries the one
    // along the outer joint has fewer operations.
    let tree = graph.closed.as_ref().map_or(graph, |closed| &closed.tree);
    let commutes = tree.rates_are_velocities();
    let outer = |m: &[Vec<Signed>], (i, j): (usize, usize)| m[i.max(j)][i.min(j)];
    let by_positions = pairs().map(|(i, j)| match commutes {
        true => outer(&qq, (i, j)),
        false => qq[j][i],
    });
    let by_both = pairs().map(|(i, j)| vq[i][j]);
    let by_velocities = pairs().map(|at| outer(&vv, at));
    let by_acceleration = pairs().map(|(i, j)| aq[j][i]);
    by_positions
        .chain(by_both)
        .chain(by_velocities)
        .chain(by_acceleration)
        .collect()
}

fn signed(all: &[Expr<'_>]) -> Vec<Signed> {
    all.iter().map(|e| e.signed()).collect()
}
