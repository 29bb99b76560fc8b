//! Which forward dynamics: M with its factors, or articulated bodies.
//!
//! Any elimination of M is safe while each body has a fair share of the inertia that its joint
//! moves: a pivot is no less than that share, so the elimination cannot lose more digits than the
//! share is small. That is so for arms and for chains of like links, and it is seen from the spec:
//! no state has to be tried. Among the candidates the cheapest wins. Where a share is next to
//! nothing (a massless link, a heavy load on a light one), the pivot is a small rest of large
//! terms, or of nothing at all: articulated bodies with their own inertia keep its digits.

use super::articulated::Articulated;
use super::geometry::geometry;
use super::plan::SEARCHED;
use super::share::{FAIR, own_shares};
use super::{cheapest_plan, with_plan};
use crate::bond_graph::BondGraph;
use crate::formulation::Formulation;
use crate::function::Function;
use crate::method::Method;

const METHOD: Method = Method::ForwardDynamics;

/// The forward dynamics: the cheapest of those that keep their digits.
pub(in crate::formulation) fn forward_dynamics(graph: &BondGraph) -> Option<Function> {
    let geometry = geometry(graph);
    let shares = own_shares(graph, &geometry);
    if let Some(j) = (0..shares.len()).find(|&j| shares[j] < FAIR) {
        let function = Articulated::Own.function(graph, METHOD)?;
        let joint = &geometry.bodies[j].name;
        let reason = format!("{joint} has next to no inertia of its own");
        let formulation = format!("{}; {reason}", function.formulation);
        return Some(Function {
            formulation,
            ..function
        });
    }
    let bodies = || Articulated::Base.function(graph, METHOD);
    if geometry.bodies.len() > SEARCHED {
        let bodies = bodies()?;
        if elimination(&geometry.parents()) > bodies.operations().total() {
            return Some(bodies);
        }
    }
    // The plan that suits one suits the other but for a few operations: it tells whether a search
    // for the other's own is worth its time.
    let plan = cheapest_plan(graph, &geometry, METHOD);
    let factors = with_plan(graph, &geometry, METHOD, &plan);
    let most = factors.operations().total();
    if Articulated::Base.cost(graph, &geometry, &plan) > most {
        return Some(factors);
    }
    let bodies = bodies()?;
    let less = bodies.operations().total() < most;
    Some(if less { bodies } else { factors })
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
