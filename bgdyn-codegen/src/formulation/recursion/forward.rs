//! Which forward dynamics: M with its factors, or articulated bodies.
//!
//! Any elimination of M is safe while each body has a fair share of the inertia that its joint
//! moves: a pivot is no less than that share, so the elimination cannot lose more digits than the
//! share is small. That is so for arms and for chains of like links, and it is seen from the spec:
//! no state has to be tried. Among the candidates the cheapest wins. Where a share is next to
//! nothing (a massless link, a heavy load on a light one), the pivot is a small rest of large
//! terms, or of nothing at all: articulated bodies with their own inertia keep its digits.

use super::articulated::Articulated;
use super::plan::SEARCHED;
use super::share::{FAIR, own_shares};
use super::{cheapest_plans, with_plan};
use crate::formulation::{Formulation, Search};
use crate::function::Function;
use crate::method::Method;

const METHOD: Method = Method::ForwardDynamics;

/// The ways to forward dynamics that keep their digits and are worth a look, the cheapest first.
pub(in crate::formulation) fn forward_dynamics(search: &Search<'_>) -> Vec<Function> {
    let graph = search.graph;
    let geometry = search.recursion.geometry(graph);
    let shares = own_shares(graph, geometry);
    let bodies = |way: Articulated| way.function(search, METHOD).into_iter().collect::<Vec<_>>();
    if let Some(j) = shares.iter().position(|&share| share < FAIR) {
        let mut found = bodies(Articulated::Own);
        for function in &mut found {
            let link = &geometry.bodies[j].name;
            function.formulation += &format!("; {link} has next to no inertia of its own");
        }
        return found;
    }
    if geometry.bodies.len() > SEARCHED {
        let found = bodies(Articulated::Base);
        let least = elimination(&geometry.parents());
        if found.iter().any(|f| f.operations().total() < least) {
            return found;
        }
    }
    // The plan that suits one suits the other but for a few operations: it tells whether a search
    // for the other's own is worth its time.
    let best = cheapest_plans(search, METHOD);
    let mut found = vec![with_plan(graph, geometry, METHOD, &best)];
    let bodies_cost = Articulated::Base.cost(graph, geometry, best.taken());
    if bodies_cost.weighted() < found[0].cost().weighted() {
        found.extend(bodies(Articulated::Base));
        found.sort_by_key(|f| f.cost().weighted());
    }
    found
}

/// Operations that the elimination of M takes alone: each joint's row is taken from those of the
/// joints that carry it.
fn elimination(parents: &[Option<usize>]) -> usize {
    let mut depths: Vec<usize> = Vec::new();
    for parent in parents {
        depths.push(parent.map_or(0, |p| depths[p] + 1));
    }
    depths.iter().map(|d| d * (d + 1)).sum()
}
