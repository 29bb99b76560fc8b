//! The results of operational space from Λ⁻¹, M⁻¹ Jᵀ, and the acceleration of the frame without efforts; those of contacts
//! likewise, with their Jacobian in place of that of a frame.

use bgdyn_runtime::TASKS;

use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Expr};
use crate::formulation::solve;
use crate::function::{Function, in_triangle};
use crate::method::{ContactMethod, Method, Operational, TASK_DIRECTIONS};

/// Returns the method with the Jacobian J of a method: a row for each direction of its task.
pub(super) fn jacobian_of(method: Method) -> Option<Method> {
    match method {
        Method::Operational(of) => of.site().map(Method::Jacobian),
        Method::Contact(of) if of.is_dynamic() => {
            let jacobian = ContactMethod::Jacobian(of.contacts());
            Some(Method::Contact(jacobian))
        }
        _ => None,
    }
}

/// Returns the method with J̇ v, if this one contains it.
pub(super) fn rate_of(method: Method) -> Option<Method> {
    match method {
        Method::Operational(Operational::Bias(site)) => Some(Method::JacobianDotV(site)),
        _ => None,
    }
}

/// What the results are made of; each is called for if it is needed.
pub(super) struct Task<'a, 'g> {
    /// Λ⁻¹ = J M⁻¹ Jᵀ, its lower triangle row by row.
    pub(super) inverse: Vec<Expr<'g>>,
    /// The columns of M⁻¹ Jᵀ.
    pub(super) columns: &'a dyn Fn() -> Option<Vec<Vec<Expr<'g>>>>,
    /// J q̈ + J̇ v without efforts.
    pub(super) acceleration: &'a dyn Fn() -> Option<Vec<Expr<'g>>>,
}

impl<'g> Task<'_, 'g> {
    /// Returns the lower triangle of Λ⁻¹: products of the rows of J and the columns of M⁻¹ Jᵀ, or of those of Y and D⁻¹ Yᵀ.
    pub(super) fn inverse(
        b: &'g Builder,
        rows: &[&[Expr<'g>]],
        columns: &[Vec<Expr<'g>>],
    ) -> Vec<Expr<'g>> {
        let triangle = (0..rows.len()).flat_map(|i| (0..=i).map(move |j| (i, j)));
        triangle
            .map(|(i, j)| dot(b, rows[i], &columns[j]))
            .collect()
    }
}

/// Returns the results, after as many numbers as there are velocities that are finite exactly if they are.
pub(super) fn results<'g>(
    b: &'g Builder,
    graph: &BondGraph,
    method: Method,
    task: &Task<'_, 'g>,
) -> Option<Vec<Expr<'g>>> {
    match method {
        Method::Operational(of) => of_frame(b, graph, of, task),
        Method::Contact(of) => of_contacts(b, graph, of, task),
        _ => None,
    }
}

/// Returns the results of a method of contacts.
fn of_contacts<'g>(
    b: &'g Builder,
    graph: &BondGraph,
    of: ContactMethod,
    task: &Task<'_, 'g>,
) -> Option<Vec<Expr<'g>>> {
    let n = graph.coordinates.len();
    match of {
        ContactMethod::Delassus(_) => {
            let mut all = finite_with(b, n, trace(b, &task.inverse));
            all.extend(&task.inverse);
            Some(all)
        }
        ContactMethod::Response(_) => {
            let columns = (task.columns)()?;
            let row = |i: usize| columns.iter().map(move |column| column[i]);
            let sums = (0..n).map(|i| row(i).fold(b.zero(), |sum, x| sum + x));
            Some(sums.chain((0..n).flat_map(row)).collect())
        }
        _ => None,
    }
}

/// Returns the results of a method of operational space.
fn of_frame<'g>(
    b: &'g Builder,
    graph: &BondGraph,
    of: Operational,
    task: &Task<'_, 'g>,
) -> Option<Vec<Expr<'g>>> {
    let directions = TASK_DIRECTIONS.len();
    let loops = graph.closed.as_deref();
    let loops = loops.map_or(0, |closed| closed.closure.loops.len());
    let first = TASKS + graph.coordinates.len() + loops;
    let pivots: Vec<usize> = (first..first + directions).collect();
    let rows = || -> Vec<Vec<Expr<'g>>> {
        let row = |i: usize| (0..=i).map(|j| task.inverse[in_triangle(i, j)]).collect();
        (0..directions).map(row).collect()
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
            let all = 0..graph.coordinates.len();
            let all = all.flat_map(|i| (0..directions).map(move |r| (i, r)));
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
    let mut all = finite_with(b, graph.coordinates.len(), trace);
    all.extend(entries);
    Some(all)
}

/// Returns as many numbers as there are velocities, which are finite exactly if this one is.
fn finite_with<'g>(b: &'g Builder, n: usize, number: Expr<'g>) -> Vec<Expr<'g>> {
    let mut all = vec![b.zero(); n];
    if let Some(one) = all.first_mut() {
        *one = number;
    }
    all
}

/// Returns the sum of the diagonal of a matrix, from its lower triangle.
fn trace<'g>(b: &'g Builder, triangle: &[Expr<'g>]) -> Expr<'g> {
    let diagonal = (0..).map(|i| in_triangle(i, i));
    let diagonal = diagonal.take_while(|&k| k < triangle.len());
    diagonal.fold(b.zero(), |sum, k| sum + triangle[k])
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
