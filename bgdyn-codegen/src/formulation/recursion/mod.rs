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
use crate::expr::{Builder, Expr, Graph, count, factored};
use crate::function::Function;
use crate::method::Method;
use frames::{Frames, Plan};
use geometry::Geometry;

/// Plans, the cheapest ones before factoring, of which the cheapest one after it is taken.
const FACTORED: usize = 4;

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
            count(&graph, &outputs).total()
        };
        // Plans that cost about the same differ in what factoring makes of them.
        let after = |plan: &Plan| {
            let (made, outputs) = outputs(graph, &geometry, method, plan);
            let (made, outputs) = factored(made, outputs);
            count(&made, &outputs).total()
        };
        let plans = plan::search(&geometry, FACTORED, cost);
        let best = plans.iter().min_by_key(|plan| after(plan))?;
        let (made, outputs) = outputs(graph, &geometry, method, best);
        let name = format!("{}: {}", self.name(), plan::describe(&geometry, best));
        Some(Function::flat(graph, method, name, made, outputs))
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
