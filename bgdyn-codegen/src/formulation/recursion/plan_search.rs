//! Searches for the cheapest plan, by weighted cost.
//!
//! It tries one choice at a time, accepts it if it costs less, and ends after a round without a change. The
//! search is bounded and deterministic.

use bgdyn_runtime::Dd;

use super::geometry::Geometry;
use super::plan::{MomentaPlan, PartialsPlan, Plan};
use crate::expr::Cost;
use crate::function::Considered;

/// Largest number of rounds over all choices.
const ROUNDS: usize = 2;

/// Largest number of bodies for which the choices are tried one by one: the cost of a search grows with
/// the square of their number.
pub(super) const SEARCHED: usize = 16;

/// Number of plans that a search returns.
const KEPT: usize = 4;

/// A plan, and its cost before factoring.
#[derive(Clone)]
pub(super) struct Tried {
    pub plan: Plan,
    pub cost: Cost,
}

/// The results of a search.
#[derive(Clone, Default)]
pub(in crate::formulation) struct BestPlan {
    /// The cheapest plans, the cheapest one first; many choices do not change the cost.
    pub(super) plans: Vec<Tried>,
    /// For each of the least costs, the first plan with it.
    steps: Vec<Tried>,
}

impl BestPlan {
    fn see(&mut self, plan: &Plan, cost: Cost) {
        let tried = || Tried {
            plan: plan.clone(),
            cost,
        };
        let weight = cost.weighted();
        let above = |all: &[Tried]| all.partition_point(|t| t.cost.weighted() <= weight);
        let rank = above(&self.plans);
        if rank < KEPT && self.plans.iter().all(|t| t.plan != *plan) {
            self.plans.insert(rank, tried());
            self.plans.truncate(KEPT);
        }
        let rank = above(&self.steps);
        let known = rank > 0 && self.steps[rank - 1].cost.weighted() == weight;
        if rank < KEPT && !known {
            self.steps.insert(rank, tried());
            self.steps.truncate(KEPT);
        }
    }

    /// Puts this plan before all others.
    pub(super) fn take(&mut self, plan: Plan, cost: Cost) {
        self.plans.retain(|t| t.plan != plan);
        self.plans.insert(0, Tried { plan, cost });
    }

    /// Returns the cost of the chosen plan, before factoring.
    pub(super) fn cost(&self) -> Cost {
        self.plans[0].cost
    }

    /// Returns the chosen plan.
    pub(super) fn taken(&self) -> &Plan {
        &self.plans[0].plan
    }

    /// Returns the chosen plan, and the cheapest ones of other costs, for readers of the function: each
    /// with all its differences from the chosen one.
    pub(super) fn considered(&self, geometry: &Geometry) -> Vec<Considered> {
        let taken = &self.plans[0];
        let weight = taken.cost.weighted();
        let others = self.steps.iter().filter(|t| t.cost.weighted() != weight);
        let considered = |t: &Tried| Considered {
            what: describe(geometry, &t.plan) + &differences(geometry, &taken.plan, &t.plan),
            cost: t.cost,
        };
        [taken].into_iter().chain(others).map(considered).collect()
    }
}

/// Returns the cheapest plans found.
///
/// With many bodies the initial plans are compared only. If a joint has several velocities, choices for all
/// bodies at once and then one round over the positions of origins follow: humanoids need them.
pub(super) fn search(
    geometry: &Geometry,
    momenta: MomentaPlan,
    cost: impl Fn(&Plan) -> Cost,
) -> BestPlan {
    let few = geometry.bodies.len() <= SEARCHED;
    let free = geometry.bodies.iter().any(|body| !body.axial);
    let (rounds, changes) = match (few, free) {
        (true, _) => (ROUNDS, changes(geometry)),
        (false, true) => (1, changes_of_all(geometry)),
        (false, false) => (0, Vec::new()),
    };
    let mut best = BestPlan::default();
    for start in starts(geometry, momenta) {
        improve(&mut best, start, &changes, rounds, &cost);
    }
    if !few && free {
        let start = best.taken().clone();
        improve(&mut best, start, &slide_changes(geometry), 1, &cost);
    }
    best
}

/// Tries the changes in turn from a plan, and keeps each that costs less.
fn improve(
    best: &mut BestPlan,
    start: Plan,
    changes: &[PlanChange<'_>],
    rounds: usize,
    cost: impl Fn(&Plan) -> Cost,
) {
    let mut weigh = |plan: &Plan| {
        let cost = cost(plan);
        best.see(plan, cost);
        cost.weighted()
    };
    let mut plan = start;
    let mut least = weigh(&plan);
    // After a whole round without a gain, every choice was tried on the current plan.
    let mut in_vain = 0;
    for change in std::iter::repeat_n(changes, rounds).flatten() {
        in_vain += 1;
        if in_vain > changes.len() {
            break;
        }
        let mut tried = plan.clone();
        change(&mut tried);
        if tried == plan {
            continue;
        }
        let c = weigh(&tried);
        if c < least {
            (least, plan, in_vain) = (c, tried, 0);
        }
    }
}

/// Returns the cheapest of the plans that differ in one position of an origin or in the unit of length.
pub(super) fn refined(geometry: &Geometry, start: &Plan, cost: impl Fn(&Plan) -> Cost) -> BestPlan {
    let mut best = BestPlan::default();
    let changes = match geometry.bodies.len() <= SEARCHED {
        true => slide_changes(geometry),
        false => Vec::new(),
    };
    improve(&mut best, start.clone(), &changes, 1, cost);
    best
}

/// Returns the initial plans: with and without groups. On parents without an axis also with every origin
/// next to its parent: the legs of one base share products, so that moving one leg alone can cost more.
fn starts(geometry: &Geometry, momenta: MomentaPlan) -> Vec<Plan> {
    let n = geometry.bodies.len();
    let tip = |j: usize| geometry.axial_tip(j);
    let plan = |grouped, slides: Vec<Dd>| Plan {
        slides,
        unit: Dd::ONE,
        grouped,
        in_basis: (0..n).map(tip).collect(),
        aimed: (0..n).map(tip).collect(),
        carried: vec![0; n],
        apart: vec![false; n],
        base_parameters: true,
        short_moment: false,
        linear_first: false,
        views: vec![PartialsPlan::default(); n],
        momenta,
    };
    let mut all_slides = vec![(0..n).map(|j| slides(geometry, j)[0]).collect::<Vec<Dd>>()];
    if geometry.bodies.iter().any(|body| !body.axial) {
        let mut next = vec![Dd::ZERO; n];
        for j in 0..n {
            next[j] = next_to_parent(geometry, j, &next);
        }
        all_slides.push(next);
    }
    let groups = geometry.bodies.iter().any(|b| b.parallel);
    let grouped: &[bool] = if groups { &[true, false] } else { &[false] };
    let all = grouped
        .iter()
        .flat_map(|&g| all_slides.iter().map(move |p| (g, p)));
    all.map(|(grouped, slides)| plan(grouped, slides.clone()))
        .collect()
}

/// Returns the displacement of the origin of body j that brings it closest to its parent's, which is
/// displaced as in `slides`.
fn next_to_parent(geometry: &Geometry, j: usize, slides: &[Dd]) -> Dd {
    let body = &geometry.bodies[j];
    match body.parent {
        Some(p) if body.axial => {
            let parent_z = body.twist.transpose().column(2);
            parent_z.0[2] * slides[p] - body.offset.0[2]
        }
        _ => Dd::ZERO,
    }
}

type PlanChange<'a> = Box<dyn Fn(&mut Plan) + 'a>;

/// Returns every position of an origin and every unit of length, as a change of a plan.
fn slide_changes(geometry: &Geometry) -> Vec<PlanChange<'_>> {
    let mut changes: Vec<PlanChange<'_>> = Vec::new();
    for j in 0..geometry.bodies.len() {
        for h in slides(geometry, j) {
            changes.push(Box::new(move |plan| plan.slides[j] = h));
        }
        if geometry.bodies.iter().any(|body| !body.axial) {
            changes.push(Box::new(move |plan| {
                plan.slides[j] = next_to_parent(geometry, j, &plan.slides);
            }));
        }
    }
    for unit in units(geometry) {
        changes.push(Box::new(move |plan| plan.unit = unit));
    }
    changes
}

/// Returns every single choice, as a change of a plan.
fn changes(geometry: &Geometry) -> Vec<PlanChange<'_>> {
    let n = geometry.bodies.len();
    let mut changes = slide_changes(geometry);
    for j in (0..n).filter(|&j| geometry.bodies[j].axial) {
        changes.push(Box::new(move |plan| plan.in_basis[j] ^= true));
    }
    for j in (0..n).filter(|&j| geometry.axial_tip(j)) {
        changes.push(Box::new(move |plan| plan.aimed[j] ^= true));
    }
    for j in (0..n).filter(|&j| geometry.bodies[j].varying) {
        for joints in 0..=joints_to_base(geometry, j) {
            for apart in [false, true] {
                changes.push(Box::new(move |plan| {
                    (plan.carried[j], plan.apart[j]) = (joints, apart);
                }));
            }
        }
    }
    changes.push(Box::new(|plan| plan.short_moment ^= true));
    if geometry.bodies.iter().any(|body| !body.axial) {
        changes.push(Box::new(|plan| plan.linear_first ^= true));
    }
    changes
}

/// Returns choices for all bodies at once, for mechanisms with many bodies.
fn changes_of_all(geometry: &Geometry) -> Vec<PlanChange<'_>> {
    let mut changes: Vec<PlanChange<'_>> = vec![
        Box::new(|plan| plan.short_moment ^= true),
        Box::new(|plan| plan.linear_first ^= true),
        Box::new(|plan| *plan = plan.unturned()),
        Box::new(|plan| plan.in_basis.fill(false)),
    ];
    for unit in units(geometry) {
        changes.push(Box::new(move |plan| plan.unit = unit));
    }
    changes
}

/// Returns the number of joints between the body and the base.
fn joints_to_base(geometry: &Geometry, mut j: usize) -> usize {
    let mut joints = 1;
    while let Some(p) = geometry.bodies[j].parent {
        (j, joints) = (p, joints + 1);
    }
    joints
}

/// Returns the possible positions of the origin of body j along its axis: the feet of the common normals
/// with the axes of its children and of its parent; and the original position. On a parent without an
/// axis those next to the parent's origin.
fn slides(geometry: &Geometry, j: usize) -> Vec<Dd> {
    let body = &geometry.bodies[j];
    if !body.axial {
        return vec![Dd::ZERO];
    }
    let mut slides: Vec<Dd> = Vec::new();
    for child in geometry.bodies.iter().filter(|b| b.parent == Some(j)) {
        let (on_parent, own) = child.normal_feet();
        slides.push(if child.parallel { own } else { on_parent });
    }
    match body.parent.map(|p| &geometry.bodies[p]) {
        Some(parent) if parent.axial => slides.push(-body.normal_feet().1),
        Some(_) => slides.extend(body.near_parent()),
        None => {}
    }
    slides.push(Dd::ZERO);
    let mut distinct: Vec<Dd> = Vec::new();
    for h in slides {
        if !distinct.contains(&h) {
            distinct.push(h);
        }
    }
    distinct
}

/// Returns the units of length: metres, and the distances between joints, without that of the base.
fn units(geometry: &Geometry) -> Vec<Dd> {
    let mut units = vec![Dd::ONE];
    for body in geometry.bodies.iter().filter(|b| b.parent.is_some()) {
        let (on_parent, own) = body.normal_feet();
        for length in [body.offset.0[0], on_parent, own] {
            let length = length.abs();
            if length > Dd::ZERO && !units.contains(&length) {
                units.push(length);
            }
        }
    }
    units
}

/// Describes the choices of `plan` that differ from those of another and that [`describe`] omits.
fn differences(geometry: &Geometry, other: &Plan, plan: &Plan) -> String {
    let mut words = String::new();
    for (j, body) in geometry.bodies.iter().enumerate() {
        let name = &body.name;
        if plan.slides[j] != other.slides[j] {
            let along = plan.slides[j].to_f64();
            words += &format!("; origin of {name} moved {along} m along its axis");
        }
        if plan.aimed[j] != other.aimed[j] {
            let where_to = if plan.aimed[j] { "at" } else { "away from" };
            words += &format!("; x of {name} turned {where_to} its centre of mass");
        }
    }
    if plan.short_moment != other.short_moment {
        let which = if plan.short_moment {
            "its component"
        } else {
            "U D"
        };
        words += &format!("; moment about an axis from {which}");
    }
    if plan.linear_first != other.linear_first {
        let which = if plan.linear_first {
            "translations"
        } else {
            "rotations"
        };
        words += &format!("; {which} of the root eliminated first");
    }
    words
}

/// Describes the plan in words.
pub(super) fn describe(geometry: &Geometry, plan: &Plan) -> String {
    let named = |flags: &[bool]| -> String {
        let names = geometry.bodies.iter().zip(flags).filter(|(_, on)| **on);
        names
            .map(|(b, _)| b.name.as_str())
            .collect::<Vec<_>>()
            .join(", ")
    };
    let mut words = Vec::new();
    if plan.grouped {
        words.push("parallel axes grouped".to_string());
    }
    if plan.unit != Dd::ONE {
        words.push(format!("unit of length {} m", plan.unit.to_f64()));
    }
    if plan.in_basis.contains(&true) {
        words.push(format!("inertia turned for {}", named(&plan.in_basis)));
    }
    let carried: Vec<String> = geometry
        .bodies
        .iter()
        .zip(&plan.carried)
        .filter(|(body, joints)| body.varying && **joints > 0)
        .map(|(body, joints)| format!("{} by {joints}", body.name))
        .collect();
    if !carried.is_empty() {
        words.push(format!("parameters moved inwards: {}", carried.join(", ")));
    }
    if plan.apart.contains(&true) {
        words.push(format!("point masses apart on {}", named(&plan.apart)));
    }
    if words.is_empty() {
        "plain".into()
    } else {
        words.join("; ")
    }
}
