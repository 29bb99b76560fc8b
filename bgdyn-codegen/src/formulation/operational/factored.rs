//! Operational space, and the Delassus matrix of contacts, from the factors M = Lᵀ D L.
//!
//! Y = J L⁻¹ costs half of M⁻¹ Jᵀ, and Λ⁻¹ = Y D⁻¹ Yᵀ. It has the digits of forward dynamics by the same factors, and is
//! offered where that keeps enough. The factors keep the zeros of branches, and so do the rows of Y: those of contacts on
//! different branches meet in the columns of the joints that carry both.

use super::task::{Task, copied, dot, jacobian_of, rate_of, results};
use crate::expr::{Builder, Expr};
use crate::formulation::solve::PivotFactor;
use crate::formulation::{Formulation, Prepared};
use crate::function::{Function, in_triangle};
use crate::method::Method;
use crate::passes::cheapest;

/// Operational space from the factors of the mass matrix.
pub(in crate::formulation) struct Factored;

impl Formulation for Factored {
    fn name(&self) -> &'static str {
        "factored"
    }

    fn summary(&self) -> &'static str {
        "operational space: M = Lᵀ D L, Y = J L⁻¹, Λ⁻¹ = Y D⁻¹ Yᵀ"
    }

    fn combines(&self) -> bool {
        true
    }

    fn reads(&self, method: Method) -> Vec<Method> {
        let Some(jacobian) = jacobian_of(method) else {
            return Vec::new();
        };
        let mut all = vec![Method::ForwardDynamics, Method::MassMatrix, jacobian];
        all.extend(
            rate_of(method)
                .into_iter()
                .flat_map(|rate| [Method::Bias, rate]),
        );
        all
    }

    /// Only forward dynamics checks the pivots of loops.
    fn serves_loops(&self) -> bool {
        false
    }

    /// `None` where forward dynamics by these factors does not meet the error bounds.
    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let forward = prepared.candidates(Method::ForwardDynamics);
        let mut accepted = forward.accepted.iter();
        accepted.find(|candidate| candidate.factors_mass)?;
        let mass = prepared.candidates(Method::MassMatrix);
        let mass = mass.accepted.iter();
        cheapest(mass.filter_map(|mass| from(prepared, method, &mass.plain)))
    }
}

/// Returns the function from one of the mass matrix.
fn from(prepared: &Prepared<'_>, method: Method, mass: &Function) -> Option<Function> {
    let graph = prepared.graph;
    let n = graph.coordinates.len();
    let read = |method| prepared.function(method);
    let (jacobian, bias) = (read(jacobian_of(method)?)?, read(Method::Bias));
    let b = Builder::new();
    let outputs = {
        let triangle = copied(&b, mass);
        let row = |i: usize| (0..=i).map(|j| triangle[in_triangle(i, j)]).collect();
        let coordinates: Vec<usize> = (0..n).collect();
        let factor = PivotFactor::of(&b, (0..n).map(row).collect(), &coordinates);
        let jacobian = copied(&b, &jacobian);
        let rows: Vec<Vec<Expr<'_>>> = jacobian
            .chunks(n.max(1))
            .map(|row| factor.inwards(row.to_vec()))
            .collect();
        let scaled: Vec<Vec<Expr<'_>>> = rows.iter().map(|row| factor.scaled(row)).collect();
        let slices: Vec<&[Expr<'_>]> = rows.iter().map(Vec::as_slice).collect();
        let task = Task {
            inverse: Task::inverse(&b, &slices, &scaled),
            columns: &|| {
                Some(
                    rows.iter()
                        .map(|row| factor.outwards(row.clone()))
                        .collect(),
                )
            },
            // −Y D⁻¹ L⁻ᵀ h + J̇ v
            acceleration: &|| {
                let forces = factor.inwards(copied(&b, bias.as_deref()?));
                let own = copied(&b, &*read(rate_of(method)?)?);
                let rows = scaled.iter().zip(own);
                Some(rows.map(|(row, own)| own - dot(&b, row, &forces)).collect())
            },
        };
        let outputs = results(&b, graph, method, &task)?;
        outputs.into_iter().map(Expr::signed).collect()
    };
    let name = format!("{}; factored", mass.formulation);
    Some(Function::flat(graph, method, name, b.into_graph(), outputs))
}
