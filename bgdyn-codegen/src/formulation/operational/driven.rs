//! Operational space, and the Delassus matrix of contacts, from forward dynamics: q̈ = M⁻¹ (τ − h) is linear in τ, so that its derivative along the efforts
//! Jᵀ e_r is a column of M⁻¹ Jᵀ.
//!
//! Any formulation of forward dynamics that keeps its digits does; one by articulated bodies where own inertias are small.

use bgdyn_runtime::Dd;

use super::task::{Task, copied, dot, jacobian_of, rate_of, results};
use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Expr, Graph, Leaf, Signed, copy_into};
use crate::formulation::slopes::{along_efforts, derivatives};
use crate::formulation::{Formulation, Offer, Prepared};
use crate::function::Function;
use crate::method::{Method, Operational};
use crate::passes::cheapest;

/// The only method without a task.
const INVERSE: Method = Method::Operational(Operational::InverseMassMatrix);

/// Operational space from forward dynamics.
pub(in crate::formulation) struct ByDrives;

impl Formulation for ByDrives {
    fn name(&self) -> &'static str {
        "driven"
    }

    fn summary(&self) -> &'static str {
        "operational space: forward dynamics under the efforts of each row of the task"
    }

    fn combines(&self) -> bool {
        true
    }

    fn reads(&self, method: Method) -> Vec<Method> {
        let jacobian = jacobian_of(method);
        if jacobian.is_none() && method != INVERSE {
            return Vec::new();
        }
        let all = [Method::ForwardDynamics].into_iter();
        all.chain(jacobian).chain(rate_of(method)).collect()
    }

    /// There are many contacts: the derivatives along their efforts are a long function, and the factors cost less.
    fn offer(&self, _: &Prepared<'_>, method: Method) -> Offer {
        match method {
            Method::Contact(_) => Offer::Reserve,
            _ => Offer::Candidate,
        }
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let forward = prepared.candidates(Method::ForwardDynamics);
        let forward = forward.accepted.iter().chain(&forward.borderline);
        cheapest(forward.filter_map(|forward| from(prepared, method, &forward.plain)))
    }
}

/// Returns the function from one of forward dynamics.
fn from(prepared: &Prepared<'_>, method: Method, forward: &Function) -> Option<Function> {
    let graph = prepared.graph;
    let b = Builder::new();
    let accelerations: Vec<Signed> = copied(&b, forward).into_iter().map(Expr::signed).collect();
    let outputs = match jacobian_of(method) {
        None => inverse_mass_matrix(&b, &accelerations),
        Some(jacobian) => {
            let jacobian = copied(&b, &*prepared.function(jacobian)?);
            let bias = rate_of(method).and_then(|rate| prepared.function(rate));
            let of_task = OfForward {
                b: &b,
                graph,
                forward,
                accelerations: &accelerations,
                jacobian: &jacobian,
            };
            of_task.outputs(method, bias.as_deref())?
        }
    };
    let name = format!("{}; driven", forward.formulation);
    let made = Function::flat(graph, method, name, b.into_graph(), outputs);
    Some(Function {
        ordered: forward.ordered,
        ..made
    })
}

/// Returns the diagonal of M⁻¹, and its lower triangle row by row.
fn inverse_mass_matrix(b: &Builder, accelerations: &[Signed]) -> Vec<Signed> {
    let n = accelerations.len();
    let columns = derivatives(b, accelerations, n, Leaf::Input);
    let diagonal = (0..n).map(|i| columns[i][i]);
    // Of two equal entries, the one nearer to the base needs fewer operations.
    let entries = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
    let entries = entries.map(|(i, j)| columns[i][j]);
    diagonal.chain(entries).collect()
}

/// A task, with forward dynamics and the Jacobian in one graph.
struct OfForward<'a, 'g> {
    b: &'g Builder,
    graph: &'a BondGraph,
    forward: &'a Function,
    accelerations: &'a [Signed],
    jacobian: &'a [Expr<'g>],
}

impl<'g> OfForward<'_, 'g> {
    fn outputs(&self, method: Method, bias: Option<&Function>) -> Option<Vec<Signed>> {
        let b = self.b;
        let directions = jacobian_of(method)?.shape().len(1);
        let rows: Vec<&[Expr<'g>]> = (0..directions).map(|r| self.row(r)).collect();
        let columns: Vec<Vec<Expr<'g>>> = rows.iter().map(|row| self.column(row)).collect();
        let task = Task {
            inverse: Task::inverse(b, &rows, &columns),
            columns: &|| Some(columns.clone()),
            acceleration: &|| Some(self.acceleration(bias?)),
        };
        let outputs = results(b, self.graph, method, &task)?;
        Some(outputs.into_iter().map(Expr::signed).collect())
    }

    /// Returns a row of J.
    fn row(&self, r: usize) -> &[Expr<'g>] {
        let n = self.accelerations.len();
        &self.jacobian[r * n..(r + 1) * n]
    }

    /// Returns the column of M⁻¹ Jᵀ of a row of J.
    fn column(&self, row: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let drive: Vec<Signed> = row.iter().map(|x| x.signed()).collect();
        let found = along_efforts(self.b, self.accelerations, &drive);
        found.into_iter().map(|e| self.b.expr(e)).collect()
    }

    /// Returns J q̈ + J̇ v where the efforts are zero.
    fn acceleration(&self, bias: &Function) -> Vec<Expr<'g>> {
        let b = self.b;
        let none = |g: &mut Graph, leaf| match leaf {
            Leaf::Input(_) => Some(g.constant(Dd::ZERO)),
            _ => None,
        };
        let results = &self.forward.blocks[0].outputs;
        let free = b.with_graph(|g| copy_into(g, &self.forward.graph, results, none));
        let free: Vec<Expr<'g>> = free.into_iter().map(|e| b.expr(e)).collect();
        let bias = copied(b, bias);
        let rows = bias.into_iter().enumerate();
        rows.map(|(r, bias)| dot(b, self.row(r), &free) + bias)
            .collect()
    }
}
