//! Which forward dynamics: M with its factors, or articulated bodies.
//!
//! Where each body has a fair share of the inertia that its joint moves, the ways are tried in
//! sampled states, and the cheapest one that meets the bars wins. Where a share is next to nothing
//! (a massless link, a heavy load on a light one), a pivot is a small rest of large terms, or of
//! nothing at all: articulated bodies with their own inertia keep its digits, and no sample of
//! states could show that another way always does.

use std::cmp::Ordering;

use super::articulated::Articulated;
use super::bars::{Bars, Standing};
use super::geometry::{Geometry, geometry};
use super::plan::SEARCHED;
use super::share::{FAIR, own_shares};
use super::{cheapest_plan, with_plan};
use crate::bond_graph::BondGraph;
use crate::formulation::Formulation;
use crate::function::Function;
use crate::method::Method;

const METHOD: Method = Method::ForwardDynamics;

/// A way, and how it stands to the bars.
type Judged = (Standing, Function);

/// The ways to forward dynamics that keep their digits and are worth a look, the cheapest first;
/// where none does, the one that loses least.
pub(in crate::formulation) fn forward_dynamics(graph: &BondGraph) -> Vec<Function> {
    let geometry = geometry(graph);
    let bars = Bars::new(graph, &geometry);
    let judged = |way: Function| (bars.standing(&way), way);
    let bodies = |way: Articulated| way.function(graph, METHOD).map(judged);
    let shares = own_shares(graph, &geometry);
    if let Some(j) = shares.iter().position(|&share| share < FAIR) {
        let mut found = best(bodies(Articulated::Own).into_iter().collect());
        for way in &mut found {
            let link = &geometry.bodies[j].name;
            way.formulation += &format!("; {link} has next to no inertia of its own");
        }
        return found;
    }
    let mut tried: Vec<Judged> = cheap(graph, &geometry).into_iter().map(judged).collect();
    for way in [Articulated::Base, Articulated::Own] {
        let known = |(_, f): &Judged| f.formulation.split(':').next() == Some(way.name());
        let done = |judged: &Judged| judged.0.meets() || known(judged);
        if !tried.iter().any(done) {
            tried.extend(bodies(way));
        }
    }
    best(tried)
}

/// Those that meet the bars, the cheapest first; where there are none, the one that comes nearest.
/// Each says what is wrong with those that do not.
fn best(mut tried: Vec<Judged>) -> Vec<Function> {
    tried.sort_by_key(|(_, way)| way.operations().total());
    let wrong: String = tried
        .iter()
        .filter(|(standing, _)| !standing.meets())
        .map(|(standing, way)| {
            let name = way.formulation.split(':').next();
            format!("; {}: {standing}", name.unwrap_or_default())
        })
        .collect();
    if !tried.iter().any(|(standing, _)| standing.meets()) {
        tried.sort_by(|(x, _), (y, _)| x.partial_cmp(y).unwrap_or(Ordering::Equal));
        tried.truncate(1);
    } else {
        tried.retain(|(standing, _)| standing.meets());
    }
    let told = |(_, mut way): Judged| {
        way.formulation += &wrong;
        way
    };
    tried.into_iter().map(told).collect()
}

/// The ways that cost least, as far as they are worth a search.
fn cheap(graph: &BondGraph, geometry: &Geometry) -> Vec<Function> {
    if geometry.bodies.len() > SEARCHED {
        let found = Articulated::Base.function(graph, METHOD);
        let least = elimination(&geometry.parents());
        if found.iter().any(|f| f.operations().total() < least) {
            return found.into_iter().collect();
        }
    }
    // The plan that suits one suits the other but for a few operations: it tells whether a search
    // for the other's own is worth its time.
    let plan = cheapest_plan(graph, geometry, METHOD);
    let mut found = vec![with_plan(graph, geometry, METHOD, &plan)];
    if Articulated::Base.cost(graph, geometry, &plan) < found[0].operations().total() {
        found.extend(Articulated::Base.function(graph, METHOD));
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
