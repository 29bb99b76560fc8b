//! The recursion in link axes with base parameters, the common-axis trick, sliding origins and
//! groups of parallel axes: equation (6) summed over the bodies beyond each joint.
//!
//! Its free choices are a [`Plan`]; the plan is searched for by counting, in a bounded number of
//! steps, method by method.

mod articulated;
mod base;
mod forward;
mod frames;
mod geometry;
mod inertia;
mod inverse;
mod kinematics;
mod mass;
mod plan;
mod share;

use super::{Arguments, Formulation, solve};
use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Expr, Graph, count};
use crate::function::Function;
use crate::method::Method;
pub(super) use articulated::Articulated;
pub(super) use forward::forward_dynamics;
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
        let best = cheapest_plan(graph, &geometry, method);
        Some(with_plan(graph, &geometry, method, &best))
    }
}

fn cheapest_plan(graph: &BondGraph, geometry: &Geometry, method: Method) -> Plan {
    plan::search(geometry, |plan| {
        let (graph, outputs) = outputs(graph, geometry, method, plan);
        count(&graph, &outputs).total()
    })
}

fn with_plan(graph: &BondGraph, geometry: &Geometry, method: Method, plan: &Plan) -> Function {
    let (made, outputs) = outputs(graph, geometry, method, plan);
    let name = format!("{}: {}", Recursion.name(), plan::describe(geometry, plan));
    Function::flat(graph, method, name, made, outputs)
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
        let efforts = || inverse::efforts(&b, &frames, plan, x.active);
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
        outputs.into_iter().map(|e| e.expr()).collect()
    };
    (b.into_graph(), outputs)
}
