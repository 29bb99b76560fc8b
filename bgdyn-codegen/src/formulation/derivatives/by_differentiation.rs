//! Formulations of methods that are derivatives of others.

use bgdyn_runtime::Dd;

use super::differentiate::{finish, position_derivatives, reopen};
use super::forward_dynamics::ForwardDerivatives;
use crate::bond_graph::Multibody;
use crate::expr::{Expr, Leaf, Signed};
use crate::formulation::slopes::derivatives;
use crate::formulation::{Formulation, Offer, Prepared};
use crate::function::Function;
use crate::method::Method;
use crate::passes::cheapest;

/// Largest number of velocities for which differentiated expressions may cost less than composite bodies.
const MAX_DIFFERENTIATED_COORDINATES: usize = 4;

/// Derivatives of inverse dynamics, by differentiating its expressions.
pub(in crate::formulation) struct Differentiated;

impl Formulation for Differentiated {
    fn name(&self) -> &'static str {
        "differentiated"
    }

    fn summary(&self) -> &'static str {
        "derivatives of the expressions of inverse dynamics and of the bias"
    }

    fn combines(&self) -> bool {
        true
    }

    fn offer(&self, prepared: &Prepared<'_>, method: Method) -> Offer {
        // Half the derivative of the bias is C only for joints with q̇ = v.
        if method == Method::CoriolisMatrix && !prepared.graph.plain() {
            return Offer::Never;
        }
        match prepared.graph.coordinates.len() <= MAX_DIFFERENTIATED_COORDINATES {
            true => Offer::Candidate,
            false => Offer::Reserve,
        }
    }

    fn reads(&self, method: Method) -> Vec<Method> {
        match method {
            Method::CoriolisMatrix => vec![Method::Bias],
            method if method.differentiates_inverse() => vec![Method::InverseDynamics],
            _ => Vec::new(),
        }
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let graph = prepared.graph;
        let n = graph.coordinates.len();
        let from = prepared.function(*self.reads(method).first()?)?;
        let (b, x) = reopen(&from);
        let outputs = if method == Method::CoriolisMatrix {
            // The bias is quadratic in v with Christoffel symbols: C = ½ ∂bias/∂v.
            let half = |e: Expr<'_>| (e * Dd::from_f64(0.5)).signed();
            let columns = derivatives(&b, &x, n, Leaf::Velocity);
            rows(&columns)
                .into_iter()
                .map(|e| half(b.expr(e)))
                .collect()
        } else {
            let mut outputs = rows(&position_derivatives(&b, &x, graph));
            outputs.extend(rows(&derivatives(&b, &x, n, Leaf::Velocity)));
            outputs
        };
        Some(finish(graph, method, &from, b, outputs))
    }
}

/// Derivatives of forward dynamics: ∂q̈/∂x = −M⁻¹ ∂τ/∂x at τ = inverse dynamics(q, v, q̈), and
/// ∂q̈/∂τ = M⁻¹.
pub(in crate::formulation) struct ForwardDynamicsDerivatives;

impl Formulation for ForwardDynamicsDerivatives {
    fn name(&self) -> &'static str {
        "solved"
    }

    fn summary(&self) -> &'static str {
        "derivatives of forward dynamics from those of inverse dynamics"
    }

    fn combines(&self) -> bool {
        true
    }

    fn reads(&self, method: Method) -> Vec<Method> {
        match method {
            Method::ForwardDynamicsDerivatives => {
                vec![Method::InverseDynamicsDerivatives, Method::ForwardDynamics]
            }
            Method::ForwardDerivativesByTree => {
                vec![Method::InverseDerivativesByTree, Method::ForwardDynamics]
            }
            _ => Vec::new(),
        }
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let efforts = prepared.function(*self.reads(method).first()?)?;
        let forward = prepared.candidates(Method::ForwardDynamics);
        let forward = forward.accepted.iter().chain(&forward.borderline);
        cheapest(
            forward.map(|forward| {
                forward_derivatives(prepared.graph, method, &efforts, &forward.plain)
            }),
        )
    }
}

/// Forward dynamics is linear in τ: its derivative along dτ is M⁻¹ dτ, by any formulation that is accurate
/// and cheap. Similar columns run in a loop if that needs no additional operation.
fn forward_derivatives(
    graph: &Multibody,
    method: Method,
    efforts: &Function,
    forward: &Function,
) -> Function {
    let columns = ForwardDerivatives::new(graph, efforts, forward);
    let groups = columns.alike();
    let written_out = columns.clone().function(graph, method, forward, &[]);
    if groups.is_empty() {
        return written_out;
    }
    let looped = columns.function(graph, method, forward, &groups);
    match looped.operations().total() <= written_out.operations().total() {
        true => looped,
        false => written_out,
    }
}

/// Returns the matrix with these columns, row by row.
fn rows(columns: &[Vec<Signed>]) -> Vec<Signed> {
    let rows = columns.first().map_or(0, Vec::len);
    (0..rows)
        .flat_map(|i| columns.iter().map(move |c| c[i]))
        .collect()
}
