//! The rate of the mass matrix along the velocities: Ṁ = C + Cᵀ, or M differentiated along v.

use super::differentiate::{finish, rates_along, reopen};
use crate::bond_graph::BondGraph;
use crate::expr::{Expr, Leaf, Signed, Tangent};
use crate::formulation::joint_motion::along;
use crate::formulation::{Formulation, Prepared};
use crate::function::{Function, in_triangle};
use crate::method::Method;
use crate::passes::cheapest_after_factoring;

/// The rate of the mass matrix.
pub(in crate::formulation) struct MassMatrixRate;

impl Formulation for MassMatrixRate {
    fn name(&self) -> &'static str {
        "mass_matrix_rate"
    }

    fn summary(&self) -> &'static str {
        "the mass matrix differentiated along v, or the sum of the Coriolis matrix and its transpose"
    }

    fn combines(&self) -> bool {
        true
    }

    fn reads(&self, method: Method) -> Vec<Method> {
        match method {
            Method::MassMatrixRate => vec![Method::MassMatrix, Method::CoriolisMatrix],
            _ => Vec::new(),
        }
    }

    fn function(&self, prepared: &Prepared<'_>, _: Method) -> Option<Function> {
        let masses = prepared.candidates(Method::MassMatrix);
        let masses = masses.accepted.iter();
        let rates = masses.flat_map(|mass| [&mass.plain, &mass.generated]);
        let rates = rates.map(|mass| differentiated(prepared.graph, mass));
        let coriolis = prepared.candidates(Method::CoriolisMatrix);
        let sums = coriolis
            .accepted
            .iter()
            .filter(|_| is_symmetric_part(prepared.graph));
        let sums = sums.map(|candidate| symmetric_part(prepared.graph, &candidate.plain));
        cheapest_after_factoring(rates.chain(sums))
    }
}

/// Returns whether C + Cᵀ needs nothing that cancels: C without velocity products is zero, and that of a turning base
/// has a skew part.
fn is_symmetric_part(graph: &BondGraph) -> bool {
    graph.velocity_products && graph.base.is_none()
}

/// Returns C + Cᵀ, the lower triangle.
fn symmetric_part(graph: &BondGraph, coriolis: &Function) -> Function {
    let n = graph.coordinates.len();
    let (b, entries) = reopen(coriolis);
    let entry = |i: usize, j: usize| b.expr(entries[i * n + j]);
    let mut outputs: Vec<Signed> = Vec::new();
    for i in 0..n {
        for j in 0..=i {
            debug_assert_eq!(outputs.len(), in_triangle(i, j));
            outputs.push((entry(i, j) + entry(j, i)).signed());
        }
    }
    let formulation = format!("{}; C + Cᵀ", coriolis.formulation);
    Function {
        formulation,
        ..finish(graph, Method::MassMatrixRate, coriolis, b, outputs)
    }
}

/// Returns the derivative of M along v, the lower triangle.
fn differentiated(graph: &BondGraph, mass: &Function) -> Function {
    let (b, entries) = reopen(mass);
    let v: Vec<Expr<'_>> = (0..graph.coordinates.len())
        .map(|j| b.leaf(Leaf::Velocity(j)))
        .collect();
    let rates = rates_along(&b, graph, &v);
    let mut tangent = Tangent::new(along(rates));
    let outputs = entries
        .iter()
        .map(|&e| b.with_graph(|g| tangent.of(g, e)))
        .collect();
    finish(graph, Method::MassMatrixRate, mass, b, outputs)
}
