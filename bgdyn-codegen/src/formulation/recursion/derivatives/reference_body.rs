//! Chooses the body and axes in which each joint's derivatives are expressed, by counting operations.
//!
//! The largest saving of each choice, of the operations of C or ∂τ/∂q, ∂τ/∂v, over `specs/`,
//! `tests/outside` and four arms with random bodies (58 functions, 2026):
//!
//! | without | largest increase of operations | total increase |
//! |---|---|---|
//! | [`PartialsPlan::seen_from`] | 4.3 % (`crane`: 268 for 257) | 0.4 % |
//! | [`PartialsPlan::reuse_neighbour`] | 3.4 % (`palletiser`: 397 for 384) | 0.5 % |
//! | [`PartialsPlan::keep_body_axes`] | 2.4 % (`rx90`: 1263 for 1233) | 0.7 % |
//! | [`choose_length_unit`] | 3.7 % (`torso`: 1015 for 979) | 0.4 % |

use bgdyn_runtime::Dd;

use crate::expr::Cost;
use crate::formulation::recursion::geometry::Geometry;
use crate::formulation::recursion::plan::{PartialsPlan, Plan, SeenFrom, origin_offset};
use crate::formulation::recursion::plan_search::SEARCHED;

/// Number of passes over all choices.
const ROUNDS: usize = 1;

/// Total number of operations of the plans that are compared after factoring: several plans of small
/// functions, only the cheapest plan of large ones.
const FACTORED: usize = 4_500;

/// Plans are compared after factoring if their cost before it exceeds the least by at most one part in
/// this number.
const NEAR: usize = 32;

/// Lengths below this fraction of the largest one are not used as units.
const SMALL: f64 = 1e-4;

/// Returns the plan with the cheapest choices: one choice at a time from the tips to the base, accepted if
/// it costs less.
pub(in crate::formulation::recursion) fn choose_partials(
    geometry: &Geometry,
    start: Plan,
    cost: impl Fn(&Plan) -> Cost,
) -> Plan {
    let (mut plan, n) = (start, geometry.bodies.len());
    if n > SEARCHED {
        return plan;
    }
    let mut least = cost(&plan).weighted();
    // Number of joints since the last change: after a whole pass without a change the search ends.
    let mut unchanged = 0;
    for j in std::iter::repeat_n((0..n).rev(), ROUNDS).flatten() {
        unchanged += 1;
        for change in changes(geometry, &plan, j) {
            let mut tried = plan.clone();
            change(&mut tried.views[j]);
            if tried == plan {
                continue;
            }
            let c = cost(&tried).weighted();
            if c < least {
                (least, plan) = (c, tried);
                unchanged = 0;
            }
        }
        if unchanged >= n {
            break;
        }
    }
    plan
}

/// Returns the plan with the unit of length that costs least `after` factoring, among those that cost
/// about the same before it. The unit determines which numbers become 1, and which terms are then equal.
pub(in crate::formulation::recursion) fn choose_length_unit(
    geometry: &Geometry,
    plan: Plan,
    cost: impl Fn(&Plan) -> Cost,
    after: impl Fn(&Plan) -> Cost,
) -> Plan {
    let found = cost(&plan);
    // The number of plans that the budget permits; a choice between two would rarely save anything.
    let others = FACTORED / found.operations.total().max(1);
    if others < 3 {
        return plan;
    }
    let least = found.weighted();
    let with = |unit| Plan {
        unit,
        ..plan.clone()
    };
    let lengths = lengths(geometry, &plan).into_iter().map(with);
    let mut near: Vec<(usize, Plan)> = lengths
        .map(|other| (cost(&other).weighted(), other))
        .filter(|(weight, _)| *weight <= least + least / NEAR)
        .collect();
    near.sort_by_key(|(weight, _)| *weight);
    let near = near.into_iter().map(|(_, other)| other).take(others - 1);
    let plans = std::iter::once(plan.clone()).chain(near);
    plans
        .min_by_key(|plan| after(plan).weighted())
        .expect("there is one")
}

/// Returns the distances along the axes between the origins of connected bodies, each once; without very
/// small ones, for which other lengths would become huge.
fn lengths(geometry: &Geometry, plan: &Plan) -> Vec<Dd> {
    let offsets = (0..geometry.bodies.len()).map(|j| origin_offset(geometry, plan, j));
    let all: Vec<Dd> = offsets.flat_map(|offset| offset.0.map(Dd::abs)).collect();
    let largest = all.iter().fold(0.0, |m: f64, x| m.max(x.hi()));
    let mut lengths: Vec<Dd> = Vec::new();
    for length in all {
        let wanted = length.hi() > SMALL * largest && length != plan.unit;
        if wanted && !lengths.contains(&length) {
            lengths.push(length);
        }
    }
    lengths
}

type PartialsChange = fn(&mut PartialsPlan);

/// Returns the possible changes for joint j.
fn changes(geometry: &Geometry, plan: &Plan, j: usize) -> Vec<PartialsChange> {
    let mut changes: Vec<PartialsChange> = vec![
        |view| view.seen_from = SeenFrom::Before,
        |view| view.seen_from = SeenFrom::After,
        |view| view.seen_from = SeenFrom::Own,
    ];
    let parallel = |k: usize| plan.grouped && geometry.bodies[k].parallel;
    let followed =
        (0..geometry.bodies.len()).any(|k| geometry.bodies[k].parent == Some(j) && parallel(k));
    if followed {
        changes.push(|view| view.reuse_neighbour = true);
    }
    if parallel(j) {
        changes.push(|view| view.keep_body_axes = true);
    }
    changes
}
