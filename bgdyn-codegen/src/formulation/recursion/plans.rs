//! Finds the cheapest plans of the recursion for each method, once per mechanism.

use std::collections::HashMap;

use super::expressions::outputs;
use super::geometry::Geometry;
use super::plan::{MomentaPlan, Plan};
use super::plan_search::{BestPlan, Tried};
use super::{centroidal, derivatives, plan_search};
use crate::bond_graph::Multibody;
use crate::expr::{self, Builder, Cost, NeededNodes, factored_cost};
use crate::formulation::Prepared;
use crate::method::Method;

/// Largest number of bodies of a small mechanism, for which the best plans of the search are factored
/// before one is chosen. For larger mechanisms this takes too much time for its savings: on arms of six
/// and seven axes 16 of 8,000 operations, for twice the time of expansion.
const SMALL: usize = 4;

/// Returns the cheapest plans found for a method of joints; `None` for methods derived from others.
pub(super) fn best_plans(prepared: &Prepared<'_>, method: Method) -> Option<BestPlan> {
    match method {
        Method::ForwardDynamicsDerivatives => None,
        method if method.placed_site().is_some() => None,
        _ => Some(cheapest_plans(prepared, method)),
    }
}

/// Returns the cheapest plans found, the chosen one first.
pub(super) fn cheapest_plans(prepared: &Prepared<'_>, method: Method) -> BestPlan {
    if let Some(best) = prepared.plans.borrow().get(&method) {
        return best.clone();
    }
    let best = match method {
        // Their graphs are too large for a whole search: it starts from the plan of a similar smaller
        // method.
        Method::CoriolisMatrix => plans_from(prepared, Method::MassMatrix, method),
        Method::InverseDynamicsDerivatives => plans_from(prepared, Method::CoriolisMatrix, method),
        Method::Centroidal(of) => {
            let (graph, geometry) = (prepared.graph, prepared.geometry_of(method));
            let search = |momenta| search_plans(prepared, method, momenta);
            let cost = |plan: &Plan| cost(graph, geometry, method, plan);
            centroidal::plans((of, geometry), search, cost)
        }
        _ => search_plans(prepared, method, MomentaPlan::default()),
    };
    let mut known = prepared.plans.borrow_mut();
    known.insert(method, best.clone());
    best
}

/// Returns the plans of a method with partial derivatives, starting from the cheapest plan of another one.
fn plans_from(prepared: &Prepared<'_>, other: Method, method: Method) -> BestPlan {
    let graph = prepared.graph;
    let geometry = prepared.geometry_of(method);
    let start = cheapest_plans(prepared, other);
    let cost = |plan: &Plan| cost(graph, geometry, method, plan);
    let after = |plan: &Plan| cost_after_factoring(graph, geometry, method, plan);
    let mut best = plan_search::refined(geometry, start.taken(), cost);
    let plan = derivatives::choose_partials(geometry, best.taken().clone(), cost);
    let plan = derivatives::choose_length_unit(geometry, plan, cost, after);
    let found = cost(&plan);
    best.take(plan, found);
    best
}

/// Returns the plans of a whole search; the first one costs least after factoring. Plans with almost equal
/// costs before factoring can differ after it. The rotation of a tip's axes to its centre of mass has an
/// effect only there: it saves operations and costs a sum of angles.
fn search_plans(prepared: &Prepared<'_>, method: Method, momenta: MomentaPlan) -> BestPlan {
    let graph = prepared.graph;
    let geometry = prepared.geometry_of(method);
    let mut best = plan_search::search(geometry, momenta, |plan| {
        cost(graph, geometry, method, plan)
    });
    let small = geometry.bodies.len() <= SMALL;
    let kept = if small { best.plans.len() } else { 1 };
    let mut candidates: Vec<Tried> = best.plans.drain(..kept).collect();
    for k in 0..candidates.len() {
        let plan = candidates[k].plan.unturned();
        if candidates.iter().all(|other| other.plan != plan) {
            let cost = cost(graph, geometry, method, &plan);
            candidates.push(Tried { plan, cost });
        }
    }
    if candidates.len() > 1 {
        // Many plans give the same expressions: these are factored once.
        let mut costs: HashMap<NeededNodes, usize> = HashMap::new();
        candidates.sort_by_cached_key(|tried| {
            let (graph, outputs) = outputs(Builder::silent(), graph, geometry, method, &tried.plan);
            let needed = NeededNodes::new(&graph, &outputs);
            let cost = || factored_cost(graph, outputs).weighted();
            *costs.entry(needed).or_insert_with(cost)
        });
    }
    best.plans.splice(..0, candidates);
    best
}

/// Returns the cost of the method's expressions under a plan, before factoring.
pub(super) fn cost(graph: &Multibody, geometry: &Geometry, method: Method, plan: &Plan) -> Cost {
    let (graph, outputs) = outputs(Builder::silent(), graph, geometry, method, plan);
    expr::cost(&graph, &outputs).unfinished()
}

/// Returns the same after factoring.
fn cost_after_factoring(
    graph: &Multibody,
    geometry: &Geometry,
    method: Method,
    plan: &Plan,
) -> Cost {
    let (graph, outputs) = outputs(Builder::silent(), graph, geometry, method, plan);
    factored_cost(graph, outputs)
}
