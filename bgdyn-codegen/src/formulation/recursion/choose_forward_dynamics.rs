//! Chooses which forward dynamics is generated:
//! M = Lᵀ D L after the bias (`recursion`), articulated bodies over
//! base parameters (`articulated_base`), or articulated bodies with each body's own inertia
//! (`articulated`).
//!
//! 1. A joint's pivot is no less than the inertia of its own body. Where that is less than 1e-7 of the
//!    inertia it moves (a massless link, a heavy load on a light link; [`super::inertia_ratio`]), `articulated` is
//!    generated at any cost: no sample of states could show that another way keeps the pivot's digits.
//! 2. Otherwise each way is tried in sampled states (`conditioning/sample_states.rs`): generic ones, fast ones,
//!    large efforts, and states with neighbouring common normals in line or across. `reference_solution.rs` solves
//!    M q̈ = τ − h there in double-double.
//! 3. `error_bounds.rs` compares each way in `f64` with these answers: backward error joint by joint, forward error
//!    by the condition number, the round trip through the efforts, and at most three digits lost beyond what
//!    rounding the arguments costs. The exact answer for arguments that round to the same numbers counts as
//!    right.
//! 4. The cheapest way that meets the bars wins; if none does, the nearest one. A way that exceeds them by
//!    less than a bit, in at most one state of twenty, loses no digit in this sense: it wins unless another
//!    way costs at most 5 % more.
//! 5. The generated function is judged again after factoring. If it then comes near the bars or exceeds
//!    them, its operations keep their order.
//!
//! The condition number is no bound where the efforts almost balance the bias: rounding one argument then
//! moves q̈ by more. `tests/common/bars.rs` measures that before it allows anything.

use std::cmp::Ordering;

use super::articulated::Articulated;
use super::inertia_ratio::{MIN_INERTIA_RATIO, own_inertia_ratios};
use super::plan_search::SEARCHED;
use super::{cheapest_plans, with_plan};
use crate::formulation::conditioning::error_bounds::{BoundReport, ErrorBounds, PRICE, cost};
use crate::formulation::{Formulation, Search};
use crate::function::Function;
use crate::method::Method;

const METHOD: Method = Method::ForwardDynamics;

/// A candidate for forward dynamics.
pub(in crate::formulation) struct ForwardCandidate {
    /// As its formulation writes it: other functions are made of it.
    pub plain: Function,
    /// As it is generated.
    pub generated: Function,
}

/// A way, and how it stands to the bars.
type CheckedCandidate = (BoundReport, ForwardCandidate);

/// The candidates for forward dynamics.
pub(in crate::formulation) struct ForwardCandidates {
    /// Those that keep their digits and are worth a look, the cheapest first; where none does, the
    /// one that loses least.
    pub accepted: Vec<ForwardCandidate>,
    /// Those that miss the bars by a digit at most: derivatives may rest on them.
    pub borderline: Vec<ForwardCandidate>,
}

/// The ways to forward dynamics.
pub(in crate::formulation) fn forward_dynamics(search: &Search<'_>) -> ForwardCandidates {
    let graph = search.graph;
    let geometry = search.recursion.geometry(graph);
    let bounds = ErrorBounds::new(graph, geometry);
    let judged = |plain: Function| {
        let (report, generated) = bounds.check(&plain);
        (report, ForwardCandidate { plain, generated })
    };
    let bodies = |way: Articulated| way.function(search, METHOD).map(judged);
    let ratios = own_inertia_ratios(graph, geometry);
    if let Some(j) = ratios.iter().position(|&ratio| ratio < MIN_INERTIA_RATIO) {
        let mut found = best(bodies(Articulated::Own).into_iter().collect());
        for way in &mut found.accepted {
            let link = &geometry.bodies[j].name;
            way.generated.formulation += &format!("; {link} has next to no inertia of its own");
        }
        // Articulated bodies know no rotors that turn with their carriers.
        if !found.accepted.is_empty() {
            return found;
        }
    }
    let mut tried: Vec<CheckedCandidate> = cheap(search).into_iter().map(judged).collect();
    for way in [Articulated::Base, Articulated::Own] {
        let known =
            |(_, f): &CheckedCandidate| f.plain.formulation.split(':').next() == Some(way.name());
        let done = |judged: &CheckedCandidate| judged.0.holds() || known(judged);
        if !tried.iter().any(done) {
            tried.extend(bodies(way));
        }
    }
    best(tried)
}

/// Those that meet the bars, the cheapest first; where there are none, the one that comes nearest. But
/// where one that costs less loses no digit, and they cost more than [`PRICE`] times as much, that one.
/// Each says what is wrong with those that do not meet them.
fn best(mut tried: Vec<CheckedCandidate>) -> ForwardCandidates {
    tried.sort_by_key(|(_, way)| way.generated.cost().weighted());
    let wrong: String = tried
        .iter()
        .filter(|(report, _)| !report.holds())
        .map(|(report, way)| {
            let name = way.plain.formulation.split(':').next();
            format!("; {}: {report}", name.unwrap_or_default())
        })
        .collect();
    let (mut accepted, mut borderline): (Vec<CheckedCandidate>, Vec<CheckedCandidate>) =
        tried.into_iter().partition(|(report, _)| report.holds());
    if let Some(k) = spared(&accepted, &borderline) {
        let (report, mut way) = borderline.remove(k);
        way.generated.formulation += "; no digit is lost";
        accepted.insert(0, (report, way));
    }
    if accepted.is_empty() {
        borderline.sort_by(|(x, _), (y, _)| x.partial_cmp(y).unwrap_or(Ordering::Equal));
        accepted.extend((!borderline.is_empty()).then(|| borderline.remove(0)));
    }
    borderline.retain(|(report, _)| report.within_a_digit());
    let explained = |(_, mut way): CheckedCandidate| {
        way.generated.formulation += &wrong;
        way
    };
    ForwardCandidates {
        accepted: accepted.into_iter().map(explained).collect(),
        borderline: borderline.into_iter().map(|(_, way)| way).collect(),
    }
}

/// Of the ways that miss the bars and lose no digit the cheapest, where it is to be taken: those that
/// meet them cost too much for what they keep, or there are none.
fn spared(accepted: &[CheckedCandidate], borderline: &[CheckedCandidate]) -> Option<usize> {
    let of = |(_, way): &CheckedCandidate| cost(&way.generated);
    let k = borderline
        .iter()
        .position(|(report, _)| report.almost_holds())?;
    let least = accepted.iter().map(of).fold(f64::INFINITY, f64::min);
    (least > PRICE * of(&borderline[k])).then_some(k)
}

/// The ways that cost least, as far as they are worth a search.
fn cheap(search: &Search<'_>) -> Vec<Function> {
    let graph = search.graph;
    let geometry = search.recursion.geometry(graph);
    if geometry.bodies.len() > SEARCHED {
        let found = Articulated::Base.function(search, METHOD);
        let least = elimination(&geometry.parents());
        if found.iter().any(|f| f.operations().total() < least) {
            return found.into_iter().collect();
        }
    }
    // The plan that suits one suits the other but for a few operations: it tells whether a search
    // for the other's own is worth its time.
    let best = cheapest_plans(search, METHOD);
    let mut found = vec![with_plan(graph, geometry, METHOD, &best)];
    let bodies_cost = Articulated::Base.cost(graph, geometry, best.taken());
    if bodies_cost.weighted() < found[0].cost().weighted() {
        found.extend(Articulated::Base.function(search, METHOD));
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
