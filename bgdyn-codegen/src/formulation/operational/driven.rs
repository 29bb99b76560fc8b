//! Operational space from forward dynamics: q̈ = M⁻¹ (τ − h) is linear in τ, so that its derivative along the efforts
//! Jᵀ e_r is a column of M⁻¹ Jᵀ.
//!
//! Any formulation of forward dynamics that keeps its digits does; one by articulated bodies where own inertias are small.

use bgdyn_runtime::Dd;

use super::task::{ROWS, Task, copied, dot, results};
use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Expr, Graph, Leaf, Signed, copy_into};
use crate::formulation::slopes::{along_efforts, derivatives};
use crate::formulation::{Formulation, Prepared};
use crate::function::Function;
use crate::method::{Method, Operational};
use crate::passes::cheapest;

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
        let mut all = vec![Method::ForwardDynamics];
        let Method::Operational(of) = method else {
            return Vec::new();
        };
        all.extend(of.site().map(Method::Jacobian));
        if let Operational::Bias(site) = of {
            all.push(Method::JacobianDotV(site));
        }
        all
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let Method::Operational(of) = method else {
            return None;
        };
        let forward = prepared.candidates(Method::ForwardDynamics);
        let forward = forward.accepted.iter().chain(&forward.borderline);
        cheapest(forward.filter_map(|forward| from(prepared, of, &forward.plain)))
    }
}

/// Returns the function from one of forward dynamics.
fn from(prepared: &Prepared<'_>, of: Operational, forward: &Function) -> Option<Function> {
    let graph = prepared.graph;
    let b = Builder::new();
    let accelerations: Vec<Signed> = copied(&b, forward).into_iter().map(Expr::signed).collect();
    let outputs = match of.site() {
        None => inverse_mass_matrix(&b, &accelerations),
        Some(site) => {
            let jacobian = copied(&b, &*prepared.function(Method::Jacobian(site))?);
            let bias = prepared.function(Method::JacobianDotV(site));
            let of_task = OfForward {
                b: &b,
                graph,
                forward,
                accelerations: &accelerations,
                jacobian: &jacobian,
            };
            of_task.outputs(of, bias.as_deref())?
        }
    };
    let method = Method::Operational(of);
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
    fn outputs(&self, of: Operational, bias: Option<&Function>) -> Option<Vec<Signed>> {
        let b = self.b;
        let columns: Vec<Vec<Expr<'g>>> = (0..ROWS).map(|r| self.column(r)).collect();
        let triangle = (0..ROWS).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let inverse = triangle
            .map(|(i, j)| dot(b, self.row(i), &columns[j]))
            .collect();
        let task = Task {
            inverse,
            columns: &|| Some(columns.clone()),
            acceleration: &|| Some(self.acceleration(bias?)),
        };
        let outputs = results(b, self.graph, of, &task)?;
        Some(outputs.into_iter().map(Expr::signed).collect())
    }

    /// Returns a row of J.
    fn row(&self, r: usize) -> &[Expr<'g>] {
        let n = self.accelerations.len();
        &self.jacobian[r * n..(r + 1) * n]
    }

    /// Returns a column of M⁻¹ Jᵀ.
    fn column(&self, r: usize) -> Vec<Expr<'g>> {
        let drive: Vec<Signed> = self.row(r).iter().map(|x| x.signed()).collect();
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
