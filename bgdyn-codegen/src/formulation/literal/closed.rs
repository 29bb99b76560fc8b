//! The literal sum of a mechanism with loops: Sᵀ (6), with B by differentiating the conditions.
//!
//! The conditions c(q) are those of the poses of both places in fixed axes; B = ∂c/∂q and Ḃ q̇ are their
//! derivatives. Nothing is shared with the chains of the generated code but the elimination.

use std::rc::Rc;

use bgdyn_runtime::Dd;

use crate::bond_graph::{ClosedTree, Multibody};
use crate::expr::{Builder, Expr, Tangent};
use crate::formulation::arguments::Arguments;
use crate::formulation::joint_motion::{along, tangents, unit_tangents};
use crate::formulation::loop_methods::{LoopMotion, compose};
use crate::formulation::loop_rows::{LoopForm, LoopRows};
use crate::formulation::placement::Placement;
use crate::formulation::velocity_map::VelocityMap;
use crate::formulation::{Formulation, Prepared};
use crate::math::{Mat3, Vec3};
use crate::mechanism::closure::RelativePlace;
use crate::mechanism::{LinkId, Pose};
use crate::method::Method;

/// Returns the expressions of a method; `literal` computes those of the open tree.
pub(super) fn outputs<'g>(
    literal: &dyn Formulation,
    b: &'g Builder,
    (graph, closed): (&Multibody, &ClosedTree),
    method: Method,
) -> Option<Vec<Expr<'g>>> {
    let x = Arguments::new(b, graph, method);
    let conditions = conditions(b, closed, &x.q);
    let mut rates = vec![vec![b.zero(); closed.tree.coordinates.len()]; conditions.len()];
    for j in 0..closed.tree.coordinates.len() {
        let mut along_j = Tangent::new(along(unit_tangents(b, &closed.tree, j)));
        for (row, condition) in rates.iter_mut().zip(&conditions) {
            let condition = condition.signed();
            row[j] = b.expr(b.with_graph(|g| along_j.of(g, condition)));
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
    let rows = (rows, LoopForm::default());
    let motion = LoopMotion::new(VelocityMap::new(b, &closed.closure, rows, None), &x, bias);
    let prepared = Prepared::new(&closed.tree);
    let read = |method: Method| literal.function(&prepared, method).map(Rc::new);
    compose(b, closed, method, (&x, &motion), (&read, &conditions))
}

/// Returns c(q), row by row.
fn conditions<'g>(b: &'g Builder, closed: &ClosedTree, q: &[Expr<'g>]) -> Vec<Expr<'g>> {
    let placement = Placement::new(b, &closed.tree, q);
    let place = |link: Option<LinkId>, pose: Pose| {
        let rotation = pose.rotation.map(|x| b.constant(x));
        let origin = b.vector(pose.translation);
        match link {
            None => (rotation, origin),
            Some(LinkId(i)) => (
                placement.rotations[i] * rotation,
                placement.point(i, origin),
            ),
        }
    };
    let closure = &closed.closure;
    let condition = |row: &crate::mechanism::closure::LoopRow| {
        let one = &closure.loops[row.closes];
        let a: (Mat3<Expr<'g>>, Vec3<Expr<'g>>) = place(one.links[0], one.chain.start);
        let other = place(one.links[1], one.chain.end);
        let relative = RelativePlace {
            rotation: a.0.transpose() * other.0,
            position: a.0.transpose() * (other.1 - a.1),
            columns: Vec::new(),
        };
        row.kind
            .residual(&relative, one.length, |x: Dd| b.constant(x))
    };
    closure.rows.iter().map(condition).collect()
}
