//! The recursion in link axes with base parameters, the common-axis trick, sliding origins and
//! groups of parallel axes: equation (6) summed over the bodies beyond each joint.
//!
//! Its free choices are a [`Plan`]; the plan is searched for by counting, in a bounded number of
//! steps, method by method.

mod beyond;
mod composite;
mod frames;
mod geometry;
mod inertia;
mod inverse;
mod kinematics;
mod mass;
mod plan;
mod slopes;

use bgdyn_runtime::Dd;

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
        let best = match method {
            Method::InverseDynamicsDerivatives
            | Method::ForwardDynamicsDerivatives
            | Method::CoriolisMatrix
                if std::env::var("FULL").is_err() =>
            {
                self.plan_for_derivatives(graph, &geometry, cost)
            }
            _ => plan::search(&geometry, cost),
        };
        let (made, outputs) = outputs(graph, &geometry, method, &best);
        let name = format!("{}: {}", self.name(), plan::describe(&geometry, &best));
        Some(Function::flat(graph, method, name, made, outputs))
    }
}

impl Recursion {
    /// The plan of the inverse dynamics or of the mass matrix, whichever is cheaper: they are small graphs; a search by
    /// the derivatives' own graph takes too long.
    fn plan_for_derivatives(
        &self,
        graph: &BondGraph,
        geometry: &Geometry,
        cost: impl Fn(&Plan) -> usize,
    ) -> Plan {
        let by = |method| {
            plan::search(geometry, |plan| {
                let (graph, outputs) = outputs(graph, geometry, method, plan);
                count(&graph, &outputs).total()
            })
        };
        let plans = [by(Method::InverseDynamics), by(Method::MassMatrix)];
            eprintln!("plans {} {}", cost(&plans[0]), cost(&plans[1]));
        }
        let [first, second] = plans;
        if cost(&second) < cost(&first) {
            second
        } else {
            first
        }
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
            Method::InverseDynamicsDerivatives => {
                let slopes = slopes::slopes(&b, &frames, &inverse::motions(&b, &frames, x.active));
                let rows = slopes.by_position.into_iter().chain(slopes.by_rate);
                rows.flatten().collect()
            }
            Method::CoriolisMatrix => {
                // The bias is quadratic in v with Christoffel's symbols: C = ½ ∂bias/∂v.
                let slopes = slopes::slopes(&b, &frames, &inverse::motions(&b, &frames, false));
                let rows = slopes.by_rate.into_iter().flatten();
                rows.map(|e| e * Dd::from_f64(0.5)).collect()
            }
            Method::ForwardDynamicsDerivatives => {
                let factor = solve::Factor::new(&b, mass::mass_matrix(&b, &frames));
                let drive = x.tau.iter().zip(efforts());
                let accelerations = factor.solve(drive.map(|(&tau, h)| tau - h).collect());
                let driven = Arguments {
                    a: accelerations.clone(),
                    ..x
                };
                let frames = Frames::new(&b, graph, geometry, plan, &driven);
                let moving = inverse::motions(&b, &frames, driven.active);
                let slopes = slopes::slopes(&b, &frames, &moving);
                factor
                    .accelerations_and_slopes(accelerations, &[slopes.by_position, slopes.by_rate])
            }
            Method::KineticEnergy => vec![mass::kinetic_energy(&b, &frames)],
            Method::PotentialEnergy => vec![mass::potential_energy(&b, &frames)],
            other => unreachable!("{other:?} is no method of the recursion"),
        };
        outputs.into_iter().map(|e| e.expr).collect()
    };
    (b.into_graph(), outputs)
}
