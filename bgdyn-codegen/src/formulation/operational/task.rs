//! The results of operational space from Λ⁻¹, M⁻¹ Jᵀ, and the acceleration of the frame without efforts.

use bgdyn_runtime::TASKS;

use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Expr};
use crate::formulation::solve;
use crate::function::{Function, in_triangle};
use crate::method::{Operational, TASK_DIRECTIONS};

/// The number of rows of a task.
pub(super) const ROWS: usize = TASK_DIRECTIONS.len();

/// What the results are made of; each is called for if it is needed.
pub(super) struct Task<'a, 'g> {
    /// Λ⁻¹, its lower triangle row by row.
    pub(super) inverse: Vec<Expr<'g>>,
    /// The columns of M⁻¹ Jᵀ.
    pub(super) columns: &'a dyn Fn() -> Option<Vec<Vec<Expr<'g>>>>,
    /// J q̈ + J̇ v without efforts.
    pub(super) acceleration: &'a dyn Fn() -> Option<Vec<Expr<'g>>>,
}

/// Returns the results, after as many numbers as there are velocities that are finite exactly if they are.
pub(super) fn results<'g>(
    b: &'g Builder,
    graph: &BondGraph,
    of: Operational,
    task: &Task<'_, 'g>,
) -> Option<Vec<Expr<'g>>> {
    let loops = graph.closed.as_deref();
    let loops = loops.map_or(0, |closed| closed.closure.loops.len());
    let first = TASKS + graph.coordinates.len() + loops;
    let pivots: Vec<usize> = (first..first + ROWS).collect();
    let rows = || -> Vec<Vec<Expr<'g>>> {
        let row = |i: usize| (0..=i).map(|j| task.inverse[in_triangle(i, j)]).collect();
        (0..ROWS).map(row).collect()
    };
    let (trace, entries) = match of {
        Operational::InverseMassMatrix => return None,
        Operational::InverseInertia(_) => (trace(b, &task.inverse), task.inverse.clone()),
        Operational::Inertia(_) => {
            let inertia = solve::inverse(b, rows(), &pivots);
            (trace(b, &inertia), inertia)
        }
        Operational::ConsistentInverse(_) => {
            let inertia = solve::inverse(b, rows(), &pivots);
            let columns = (task.columns)()?;
            let entry = |i: usize, r: usize| {
                let terms = columns.iter().enumerate();
                terms.fold(b.zero(), |sum, (s, column)| {
                    sum + column[i] * inertia[in_triangle(r.max(s), r.min(s))]
                })
            };
            let all = (0..graph.coordinates.len()).flat_map(|i| (0..ROWS).map(move |r| (i, r)));
            let entries = all.map(|(i, r)| entry(i, r)).collect();
            (trace(b, &inertia), entries)
        }
        Operational::Bias(_) => {
            // Λ⁻¹ μ = −(J q̈ + J̇ v)
            let side = (task.acceleration)()?.into_iter().map(|x| -x).collect();
            let found = solve::ltdl_of(b, rows(), side, &pivots);
            let sum = found.iter().fold(b.zero(), |sum, &x| sum + x);
            (sum, found)
        }
    };
    let mut all = vec![b.zero(); graph.coordinates.len()];
    if let Some(one) = all.first_mut() {
        *one = trace;
    }
    all.extend(entries);
    Some(all)
}

/// Returns the sum of the diagonal of a matrix, from its lower triangle.
fn trace<'g>(b: &'g Builder, triangle: &[Expr<'g>]) -> Expr<'g> {
    (0..ROWS).fold(b.zero(), |sum, i| sum + triangle[in_triangle(i, i)])
}

/// Copies the results of a function.
pub(super) fn copied<'g>(b: &'g Builder, from: &Function) -> Vec<Expr<'g>> {
    let results = &from.blocks[0].outputs;
    let all = b.with_graph(|g| crate::expr::copy_into(g, &from.graph, results, |_, _| None));
    all.into_iter().map(|e| b.expr(e)).collect()
}

/// Returns the scalar product.
pub(super) fn dot<'g>(b: &'g Builder, x: &[Expr<'g>], y: &[Expr<'g>]) -> Expr<'g> {
    x.iter().zip(y).fold(b.zero(), |sum, (&x, &y)| sum + x * y)
}
