//! The recursion in link axes with base parameters, the common-axis trick, sliding origins and
//! groups of parallel axes: equation (6) summed over the bodies beyond each joint.
//!
//! Its free choices are a [`Plan`]; the plan is searched for by counting, in a bounded number of
//! steps, method by method.

mod flow;
mod frames;
mod geometry;
mod inertia;
mod inverse;
mod kinematics;
mod mass;
mod plan;
mod slopes;

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
            count(&graph, &outputs).total()
        };
        let best = plan::search(&geometry, cost);
        if std::env::var("SHOW").is_ok() { eprintln!("{best:?}"); }
        let (made, outputs) = outputs(graph, &geometry, method, &best);
        if std::env::var("SHOW").is_ok() && method == Method::InverseDynamicsDerivatives {
            let needed = crate::expr::reachable(&made, &outputs);
            let mut counts: std::collections::BTreeMap<String, usize> = Default::default();
            for i in 0..made.len() {
                let id = crate::expr::NodeId(i as u32);
                if needed[i] && matches!(made.node(id), crate::expr::Node::Add(..) | crate::expr::Node::Mul(..)) {
                    *counts.entry(made.section(id).unwrap_or("").to_string()).or_default() += 1;
                }
            }
            for (k, v) in counts { eprintln!("{v:5} {k}"); }
        }
        let name = format!("{}: {}", self.name(), plan::describe(&geometry, &best));
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
            Method::InverseDynamicsDerivatives => {
                let moving = inverse::motions(&b, &frames, true);
                let wrenches =
                    inverse::wrenches(&b, &frames, &moving, &plan.in_basis, plan.short_moment);
                let slopes = slopes::slopes(&b, &frames, &moving, &wrenches);
                let squares = slopes.by_position.into_iter().chain(slopes.by_rate);
                squares.flatten().collect()
            }
            other => unreachable!("{other:?} is no method of the recursion"),
        };
        outputs.into_iter().map(|e| e.expr).collect()
    };
    (b.into_graph(), outputs)
}
