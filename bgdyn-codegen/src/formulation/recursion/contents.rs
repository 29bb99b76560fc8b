//! Finds the links that the numbers of each body are sums of, for readers of the output.

use std::rc::Rc;

use bgdyn_runtime::Dd;

use super::base_parameter_cache::Contents;
use super::base_parameters::regroup;
use super::geometry::Geometry;
use super::inertia::BodyInertia;
use super::plan::Plan;
use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr};
use crate::mechanism::LinkId;

/// The share of a number below which a link's part is a rounding error.
const LEAST: f64 = 1e-12;

/// Returns the contents of each body's numbers. They are cached with these; numbers with run-time parameters are not.
pub(super) fn contents(graph: &Multibody, geometry: &Geometry, plan: &Plan) -> Rc<[Contents]> {
    let known = geometry.regrouped.find(&plan.slides, plan.base_parameters);
    match known {
        Some(known) => Rc::clone(
            known
                .contents
                .get_or_init(|| find_contents(graph, geometry, plan)),
        ),
        None => find_contents(graph, geometry, plan),
    }
}

/// Finds the contents. The inertia is linear in that of the links: a link's part is what remains where all others have
/// none.
fn find_contents(graph: &Multibody, geometry: &Geometry, plan: &Plan) -> Rc<[Contents]> {
    let links = geometry.bodies.iter().flat_map(|body| &body.links);
    let parts: Vec<(LinkId, Vec<[f64; 11]>)> = links
        .map(|&(link, _)| (link, parts_of(link, graph, geometry, plan)))
        .collect();
    let number = |body: usize, k: usize| {
        let total: f64 = parts.iter().map(|(_, all)| all[body][k]).sum();
        let counts = parts.iter().filter(|(_, all)| all[body][k] > LEAST * total);
        let mut links: Vec<LinkId> = counts.map(|(link, _)| *link).collect();
        links.sort();
        links
    };
    let bodies = 0..geometry.bodies.len();
    bodies
        .map(|body| std::array::from_fn(|k| number(body, k)))
        .collect()
}

/// Returns the magnitudes of a link's part of each body's numbers; 1 where it depends on a run-time parameter.
fn parts_of(link: LinkId, graph: &Multibody, geometry: &Geometry, plan: &Plan) -> Vec<[f64; 11]> {
    let b = Builder::silent();
    let bodies = regroup(&b, graph, geometry, plan, |other| other == link).bodies;
    let size = |x: Expr<'_>| x.as_constant().map_or(1.0, |x: Dd| x.to_f64().abs());
    let of = |inertia: BodyInertia<'_>| inertia.entries().map(size);
    bodies.iter().map(|parts| of(parts.sum())).collect()
}
