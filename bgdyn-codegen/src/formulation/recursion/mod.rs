//! The recursion in link axes with base parameters, the common-axis trick, sliding origins and groups of
//! parallel axes: equation (6) summed over the bodies beyond each joint.
//!
//! | file | computes |
//! |---|---|
//! | `geometry.rs` | a frame for every moving body: z along its joint's axis, x along the common normal with the next axis |
//! | `frames.rs` | these frames as expressions, for one [`Plan`] (`plan.rs`) |
//! | `base_parameters.rs` | base parameters: inertia moved inwards, known parts always, run-time parameters as the plan says |
//! | `motion.rs` | velocities and accelerations, outwards |
//! | `inverse_dynamics.rs` | forces, moments and efforts, inwards |
//! | `mass_matrix.rs` | the mass matrix, from the momenta of composite bodies |
//! | `derivatives/` | first derivatives and the Coriolis matrix, from composite bodies |
//! | `kinematics.rs` | poses, velocities and Jacobians of sites |
//! | `plan_search.rs` | the cheapest plan, by counting: one choice at a time, in a bounded number of steps |
//!
//! A plan says where origins slide, which length is the unit, which parallel joints share a basis, whose
//! inertia is turned instead of the vectors, how far run-time parameters move inwards, and which point
//! masses keep a force of their own. In small mechanisms the four cheapest plans are factored before one is
//! chosen.

mod articulated;
mod base_parameter_cache;
mod base_parameters;
mod choose_forward_dynamics;
mod common_axes;
mod derivatives;
mod frames;
pub(super) mod geometry;
mod inertia;
mod inverse_dynamics;
mod kinematics;
mod mass_matrix;
mod motion;
mod names;
mod plan;
mod plan_search;
mod rotors;
mod standard_parameters;

use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;

use super::{Arguments, Formulation, Search, solve};
use crate::bond_graph::BondGraph;
use crate::expr::{self, Builder, Cost, Expr, Graph, factored_cost};
use crate::function::Function;
use crate::method::Method;
pub(super) use articulated::Articulated;
pub(super) use choose_forward_dynamics::{ForwardCandidate, ForwardCandidates, forward_dynamics};
pub(super) use common_axes::CommonAxes;
use frames::Frames;
use geometry::Geometry;
use plan::Plan;
use plan_search::{Best, Tried};
pub(super) use standard_parameters::OwnInertia;

/// Bodies up to which a mechanism is small: the plans that its search keeps are factored before
/// one is taken. For larger ones it would take more time than it saves operations: on arms of six
/// and seven axes 16 of 8,000, for twice the time of expansion.
const SMALL: usize = 4;

/// What was found for one mechanism so far: where its frames are, and the plan of each method.
#[derive(Default)]
pub(super) struct Found {
    geometry: OnceCell<Geometry>,
    plans: RefCell<BTreeMap<Method, Best>>,
}

impl Found {
    fn geometry(&self, graph: &BondGraph) -> &Geometry {
        self.geometry.get_or_init(|| geometry::geometry(graph))
    }
}

/// The recursion.
pub(super) struct Recursion;

impl Formulation for Recursion {
    fn name(&self) -> &'static str {
        "recursion"
    }

    fn summary(&self) -> &'static str {
        "link axes, base parameters, common-axis trick, sliding origins, groups of parallel axes"
    }

    fn function(&self, search: &Search<'_>, method: Method) -> Option<Function> {
        let graph = search.graph;
        let geometry = search.recursion.geometry(graph);
        if let Some(site) = method.site() {
            return Some(kinematics::function(graph, geometry, method, site));
        }
        let best = best_plans(search, method)?;
        Some(with_plan(graph, geometry, method, &best))
    }
}

/// The cheapest plans found for a method of joints; nothing for what is derived from other methods.
fn best_plans(search: &Search<'_>, method: Method) -> Option<Best> {
    match method {
        Method::ForwardDynamicsDerivatives => None,
        method if method.site().is_some() => None,
        _ => Some(cheapest_plans(search, method)),
    }
}

/// The cheapest plans found, the one to be taken first.
fn cheapest_plans(search: &Search<'_>, method: Method) -> Best {
    if let Some(best) = search.recursion.plans.borrow().get(&method) {
        return best.clone();
    }
    let best = match method {
        // Their graphs are too large for a whole search: it starts from the plan of a smaller
        // method that they resemble.
        Method::CoriolisMatrix => viewed_from(search, Method::MassMatrix, method),
        Method::InverseDynamicsDerivatives => viewed_from(search, Method::CoriolisMatrix, method),
        _ => searched(search, method),
    };
    let mut known = search.recursion.plans.borrow_mut();
    known.insert(method, best.clone());
    best
}

/// The plans of a method that has views to choose, from the cheapest plan of another one on.
fn viewed_from(search: &Search<'_>, other: Method, method: Method) -> Best {
    let graph = search.graph;
    let geometry = search.recursion.geometry(graph);
    let start = cheapest_plans(search, other);
    let cost = |plan: &Plan| cost(graph, geometry, method, plan);
    let after = |plan: &Plan| factored(graph, geometry, method, plan);
    let mut best = plan_search::refined(geometry, start.taken(), cost);
    let plan = derivatives::choose_partials(geometry, best.taken().clone(), cost);
    let plan = derivatives::choose_length_unit(geometry, plan, cost, after);
    let found = cost(&plan);
    best.take(plan, found);
    best
}

/// The plans that a whole search finds; the first one costs least after factoring. Plans that cost
/// about the same before it differ in what it makes of them. Whether a tip's axes are turned at its
/// centre of mass shows only there: it saves operations and costs a sum of angles.
fn searched(search: &Search<'_>, method: Method) -> Best {
    let graph = search.graph;
    let geometry = search.recursion.geometry(graph);
    let mut best = plan_search::search(geometry, |plan| cost(graph, geometry, method, plan));
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
        let after = |tried: &Tried| factored(graph, geometry, method, &tried.plan).weighted();
        candidates.sort_by_cached_key(after);
    }
    best.plans.splice(..0, candidates);
    best
}

fn cost(graph: &BondGraph, geometry: &Geometry, method: Method, plan: &Plan) -> Cost {
    let (graph, outputs) = outputs(Builder::silent(), graph, geometry, method, plan);
    expr::cost(&graph, &outputs).unfinished()
}

/// The same after factoring.
fn factored(graph: &BondGraph, geometry: &Geometry, method: Method, plan: &Plan) -> Cost {
    let (graph, outputs) = outputs(Builder::silent(), graph, geometry, method, plan);
    factored_cost(graph, outputs)
}

/// The function under the plan that is taken.
fn with_plan(graph: &BondGraph, geometry: &Geometry, method: Method, best: &Best) -> Function {
    let plan = best.taken();
    let (made, outputs) = outputs(Builder::new(), graph, geometry, method, plan);
    let name = format!(
        "{}: {}",
        Recursion.name(),
        plan_search::describe(geometry, plan)
    );
    let plans = best.considered(geometry);
    Function {
        plans,
        ..Function::flat(graph, method, name, made, outputs)
    }
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
        let efforts = || inverse_dynamics::efforts(&b, &frames, plan, x.active);
        let outputs = match method {
            Method::InverseDynamics | Method::Bias | Method::Gravity => efforts(),
            Method::MassMatrix => mass_matrix::mass_matrix(&b, &frames)
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
                solve::ltdl(&b, mass_matrix::mass_matrix(&b, &frames), drive)
            }
            Method::InverseDynamicsDerivatives => {
                let derivatives =
                    derivatives::effort_derivatives(&b, &frames, &plan.views, x.active);
                let rows = derivatives
                    .by_position
                    .into_iter()
                    .chain(derivatives.by_rate);
                rows.flatten().collect()
            }
            Method::CoriolisMatrix => {
                let rows = derivatives::coriolis_matrix(&b, &frames, &plan.views);
                rows.into_iter().flatten().collect()
            }
            Method::KineticEnergy => vec![mass_matrix::kinetic_energy(&b, &frames)],
            Method::PotentialEnergy => vec![mass_matrix::potential_energy(&b, &frames)],
            other => unreachable!("{other:?} is no method of the recursion"),
        };
        outputs.into_iter().map(|e| e.expr()).collect()
    };
    (b.into_graph(), outputs)
}

/// The lower triangle of M, row by row, and h, in one graph.
pub(super) fn mass_and_bias(graph: &BondGraph, geometry: &Geometry) -> (Graph, Vec<Expr>) {
    let (b, plan) = (Builder::silent(), &Plan::of_kinematics(geometry, true));
    let outputs: Vec<Expr> = {
        let x = Arguments::new(&b, graph, Method::ForwardDynamics);
        let frames = Frames::new(&b, graph, geometry, plan, &x);
        let rows = mass_matrix::mass_matrix(&b, &frames).into_iter().flatten();
        let bias = inverse_dynamics::efforts(&b, &frames, plan, x.active);
        rows.chain(bias).map(|e| e.expr()).collect()
    };
    (b.into_graph(), outputs)
}
