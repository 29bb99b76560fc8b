//! The literal sum of a mechanism with loops: Sᵀ (6), with B by differentiating the conditions.
//!
//! The conditions c(q) are those of the poses of both places in fixed axes; B = ∂c/∂q and Ḃ q̇ are their
//! derivatives. Rows on velocities are those of [`RelativePoses::slip`]. Nothing is shared with the chains of the
//! generated code but the elimination.

use std::rc::Rc;

use super::relative_poses::RelativePoses;
use super::sum::LiteralSum;
use crate::bond_graph::{ClosedTree, Multibody};
use crate::expr::{Builder, Expr, Tangent};
use crate::formulation::arguments::Arguments;
use crate::formulation::joint_motion::{along, tangents, unit_tangents};
use crate::formulation::loop_methods::{LoopMotion, compose};
use crate::formulation::loop_rows::{LoopForm, LoopRows};
use crate::formulation::velocity_map::VelocityMap;
use crate::formulation::{Formulation, Prepared};
use crate::mechanism::closure::RowKind;
use crate::method::Method;

/// Returns the expressions of a method; `literal` computes those of the open tree.
pub(super) fn outputs<'g>(
    literal: &dyn Formulation,
    b: &'g Builder,
    (graph, closed): (&Multibody, &ClosedTree),
    method: Method,
) -> Option<Vec<Expr<'g>>> {
    let own = if method.of_tree() {
        &closed.tree
    } else {
        graph
    };
    let x = Arguments::new(b, own, method);
    let places = RelativePoses::new(b, closed, &x.q);
    let closure = &closed.closure;
    let tangent = |j: usize| Tangent::new(along(unit_tangents(b, &closed.tree, j)));
    let mut rates = vec![vec![b.zero(); closed.tree.coordinates.len()]; closure.rows.len()];
    for j in 0..closed.tree.coordinates.len() {
        let mut along_j = tangent(j);
        let mut rate_of = |e: Expr<'g>| {
            let e = e.signed();
            b.expr(b.with_graph(|g| along_j.of(g, e)))
        };
        for (rates, row) in rates.iter_mut().zip(&closure.rows) {
            rates[j] = match (row.kind.has_positions(), row.kind) {
                (false, RowKind::Contact(kind)) => places.slip(row.closes, kind, &mut rate_of),
                _ => rate_of(places.condition(row)),
            };
        }
    }
    let bias = |v: &[Expr<'g>]| {
        let mut rate = Tangent::new(along(tangents(b, &closed.tree, v)));
        let mut of_row = |row: &Vec<Expr<'g>>| {
            let terms = row.iter().zip(v);
            terms.fold(b.zero(), |sum, (e, v)| {
                let e = e.signed();
                sum + b.expr(b.with_graph(|g| rate.of(g, e))) * *v
            })
        };
        rates.iter().map(&mut of_row).collect::<Vec<_>>()
    };
    let rows = LoopRows {
        rates: rates.clone(),
    };
    let form = LoopForm {
        of_plane: true,
        ..LoopForm::default()
    };
    let rows = (rows, form);
    let map = VelocityMap::new(b, &closed.closure, rows, None);
    let motion = LoopMotion::new(map, (&x, method), bias);
    let prepared = Prepared::new(&closed.tree);
    let read = |method: Method| literal.function(&prepared, method).map(Rc::new);
    let rows = closure.rows.iter();
    let conditions: Vec<Expr<'g>> = rows.map(|row| places.condition(row)).collect();
    let mut outputs = compose(b, closed, method, (&x, &motion), (&read, &conditions))?;
    if !method.has_loads() {
        return Some(outputs);
    }
    let lambda = outputs.split_off(outputs.len() - closure.rows.len());
    if !method.loads_joints() {
        outputs.extend(places.reactions(&lambda));
        return Some(outputs);
    }
    let accelerations = motion.accelerations(&x.a);
    let of_tree = Arguments {
        q: x.q.clone(),
        v: motion.velocities().to_vec(),
        a: accelerations,
        ..Arguments::new(b, &closed.tree, method)
    };
    let sum = LiteralSum::new(b, &closed.tree, &x.q);
    Some(sum.joint_loads(&of_tree, &places.loads(&lambda)))
}
