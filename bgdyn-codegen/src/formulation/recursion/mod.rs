//! The recursion in link axes with base parameters, the common-axis trick, sliding origins and
//! groups of parallel axes: equation (6) summed over the bodies beyond each joint.
//!
//! Its free choices are a [`Plan`]; the plan is searched for by counting, in a bounded number of
//! steps, method by method.

mod frames;
mod geometry;
mod inertia;
mod inverse;
mod kinematics;
mod mass;
mod plan;

use super::{Arguments, Formulation, solve};
use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Expr, Graph, count};
use crate::function::Function;
use crate::method::Method;
use frames::{Frames, Plan};
use geometry::Geometry;

/// The recursion.
pub(super) struct Recursion;

impl Formulation for Recursion {
    fn name(&self) -> &'static str {
        "recursion"
    }

    fn summary(&self) -> &'static str {
        "link axes, base parameters, common-axis trick, sliding origins, groups of parallel axes"
    }

    fn function(&self, graph: &BondGraph, method: Method) -> Option<Function> {
        let geometry = geometry::geometry(graph);
        if let Some(site) = method.site() {
            return Some(kinematics::function(graph, &geometry, method, site));
        }
        let cost = |plan: &Plan| {
            let (graph, outputs) = outputs(graph, &geometry, method, plan);
            if std::env::var("FULL").is_ok() {
                let (graph, outputs) = crate::expr::factored(graph, outputs);
                return count(&graph, &outputs).total();
            }
            count(&graph, &outputs).total()
        };
        let most = std::env::var("PLANS").map_or(4, |s| s.parse().unwrap());
        let function = |plan: &Plan| {
            let (made, outputs) = outputs(graph, &geometry, method, plan);
            let name = format!("{}: {}", self.name(), plan::describe(&geometry, plan));
            Function::flat(graph, method, name, made, outputs)
        };
        let plans = plan::search(&geometry, most, cost);
        plans
            .iter()
            .map(|p| function(p))
            .min_by_key(|f| f.clone().factored().operations().total())
    }
}

/// The method's expressions under a plan.
fn outputs(
    graph: &BondGraph,
    geometry: &Geometry,
    method: Method,
    plan: &Plan,
) -> (Graph, Vec<Expr>) {
    let b = Builder::new();
    let outputs: Vec<Expr> = {
        let x = Arguments::new(&b, graph, method);
        let frames = Frames::new(&b, graph, geometry, plan, &x);
        let efforts = || inverse::efforts(&b, &frames, &plan.in_basis, plan.short_moment, x.active);
        let outputs = match method {
            Method::InverseDynamics | Method::Bias | Method::Gravity => efforts(),
            Method::MassMatrix => mass::mass_matrix(&b, &frames)
                .into_iter()
                .flatten()
                .collect(),
            Method::ForwardDynamics => {
                let drive = x
                    .tau
                    .iter()
                    .zip(efforts())
                    .map(|(&tau, h)| tau - h)
                    .collect();
                solve::ltdl(&b, mass::mass_matrix(&b, &frames), drive)
            }
            Method::KineticEnergy => vec![mass::kinetic_energy(&b, &frames)],
            Method::PotentialEnergy => vec![mass::potential_energy(&b, &frames)],
            other => unreachable!("{other:?} is no method of the recursion"),
        };
        outputs.into_iter().map(|e| e.expr).collect()
    };
    (b.into_graph(), outputs)
}
