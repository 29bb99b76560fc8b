//! The body and axes in which each joint's derivatives are expressed, chosen by counting operations.
//!
//! What each choice saves at the most, of the operations of C or ∂τ/∂q, ∂τ/∂v, over `specs/`,
//! `tests/outside` and four arms with random bodies (58 functions, 2026):
//!
//! | left out | more operations, at the most | in all |
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

/// How often all choices are gone through.
const ROUNDS: usize = 1;

/// Operations in all of the plans that are compared after factoring: more of small functions, none
/// beside the cheapest of large ones.
const FACTORED: usize = 4_500;

/// How much more than the cheapest a plan may cost before factoring, to be tried: one part in so
/// many.
const NEAR: usize = 32;

/// A length that is no unit, as a part of the largest one.
const SMALL: f64 = 1e-4;

/// The plan with the views that cost least: one choice at a time from the tips to the base, kept
/// where it costs less.
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
    // Joints gone through since the last change: after a whole turn nothing is new.
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

/// The plan with the unit of length that costs least `after` factoring, among those that cost about
/// the same before it: units differ in which numbers become one, and in what meets then.
pub(in crate::formulation::recursion) fn choose_length_unit(
    geometry: &Geometry,
    plan: Plan,
    cost: impl Fn(&Plan) -> Cost,
    after: impl Fn(&Plan) -> Cost,
) -> Plan {
    let found = cost(&plan);
    // How many plans the budget allows; a choice between two would seldom save anything.
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

/// The distances between the origins of joined bodies along the axes, each once; none so small
/// that other lengths would become huge.
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

/// What there is to choose for joint j.
fn changes(geometry: &Geometry, plan: &Plan, j: usize) -> Vec<PartialsChange> {
    let mut changes: Vec<PartialsChange> = vec![
        |view| view.seen_from = SeenFrom::Before,
        |view| view.seen_from = SeenFrom::After,
        |view| view.seen_from = SeenFrom::Own,
    ];
    let parallel = |k: usize| plan.grouped && geometry.bodies[k].parallel();
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
