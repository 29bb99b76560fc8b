//! The recursion in link axes with base parameters, the common-axis trick, sliding origins and
//! groups of parallel axes: equation (6) summed over the bodies beyond each joint.
//!
//! Its free choices are a [`Plan`]; the plan is searched for by counting, in a bounded number of
//! steps, method by method.

mod articulated;
mod base;
mod beyond;
mod composite;
mod forward;
mod frames;
mod geometry;
mod inertia;
mod inverse;
mod kinematics;
mod mass;
mod motion;
mod plan;
mod share;
mod slopes;
mod unit;
mod view;

use super::{Arguments, Formulation, solve};
use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Expr, Graph, count, factored_cost};
use crate::function::Function;
use crate::method::Method;
pub(super) use articulated::Articulated;
pub(super) use forward::forward_dynamics;
use frames::{Frames, Plan};
use geometry::Geometry;

/// Plans of small mechanisms, the cheapest ones before factoring, of which the cheapest one after
/// it is taken. For larger ones it would take more time than it saves operations: on arms of six
/// and seven axes 16 of 8,000, for twice the time of expansion.
const FACTORED: usize = 4;

/// Bodies up to which a mechanism is small.
const SMALL: usize = 4;

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
        let cost = |plan: &Plan| cost(graph, &geometry, method, plan);
        let best = match method {
            // Their graphs are too large for a whole search: it starts from the plan of a small
            // method that they resemble.
            Method::CoriolisMatrix | Method::InverseDynamicsDerivatives => {
                let start = cheapest_plan(graph, &geometry, Method::MassMatrix);
                let plan = plan::refined(&geometry, start, cost);
                let plan = view::chosen(&geometry, plan, cost);
                view::measured(&geometry, plan, cost, |plan| {
                    factored(graph, &geometry, method, plan)
                })
            }
            Method::ForwardDynamicsDerivatives => return None,
            _ => cheapest_plan(graph, &geometry, method),
        };
        Some(with_plan(graph, &geometry, method, &best))
    }
}

/// The plan that costs least after factoring. Plans that cost about the same before it differ in
/// what it makes of them.
fn cheapest_plan(graph: &BondGraph, geometry: &Geometry, method: Method) -> Plan {
    let cost = |plan: &Plan| cost(graph, geometry, method, plan);
    let small = geometry.bodies.len() <= SMALL;
    let plans = plan::search(geometry, if small { FACTORED } else { 1 }, cost);
    let after = |plan: &Plan| factored(graph, geometry, method, plan);
    let mut plans = plans.into_iter();
    match plans.len() {
        1 => plans.next(),
        _ => plans.min_by_key(after),
    }
    .expect("there is a plan to start from")
}

fn cost(graph: &BondGraph, geometry: &Geometry, method: Method, plan: &Plan) -> usize {
    let (graph, outputs) = outputs(Builder::silent(), graph, geometry, method, plan);
    count(&graph, &outputs).total()
}

/// The same after factoring.
fn factored(graph: &BondGraph, geometry: &Geometry, method: Method, plan: &Plan) -> usize {
    let (graph, outputs) = outputs(Builder::silent(), graph, geometry, method, plan);
    factored_cost(graph, outputs).total()
}

fn with_plan(graph: &BondGraph, geometry: &Geometry, method: Method, plan: &Plan) -> Function {
    let (made, outputs) = outputs(Builder::new(), graph, geometry, method, plan);
    let name = format!("{}: {}", Recursion.name(), plan::describe(geometry, plan));
    Function::flat(graph, method, name, made, outputs)
}

/// The method's expressions under a plan.
fn outputs(
    b: Builder,
    graph: &BondGraph,
    geometry: &Geometry,
    method: Method,
    plan: &Plan,
) -> (Graph, Vec<Expr>) {
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
            Method::InverseDynamicsDerivatives => {
                let slopes = slopes::slopes(&b, &frames, &plan.views, x.active);
                let rows = slopes.by_position.into_iter().chain(slopes.by_rate);
                rows.flatten().collect()
            }
            Method::CoriolisMatrix => {
                let rows = slopes::coriolis_matrix(&b, &frames, &plan.views);
                rows.into_iter().flatten().collect()
            }
            Method::KineticEnergy => vec![mass::kinetic_energy(&b, &frames)],
            Method::PotentialEnergy => vec![mass::potential_energy(&b, &frames)],
            other => unreachable!("{other:?} is no method of the recursion"),
        };
        outputs.into_iter().map(|e| e.expr()).collect()
    };
    (b.into_graph(), outputs)
}
