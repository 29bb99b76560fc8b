//! Search for the cheapest plan: one choice at a time, each tried and kept where it costs less,
//! until a round changes nothing. Bounded, deterministic.

use bgdyn_runtime::Dd;

use super::frames::{Plan, View};
use super::geometry::Geometry;

/// Rounds over all choices at the most.
const ROUNDS: usize = 2;

/// Bodies beyond which the choices are not tried one by one: the cost of a search grows with the
/// square of their number.
pub(super) const SEARCHED: usize = 16;

/// The cheapest plans found, the cheapest one first; at least one, at most `most`.
pub(super) fn search(geometry: &Geometry, most: usize, cost: impl Fn(&Plan) -> usize) -> Vec<Plan> {
    let n = geometry.bodies.len();
    let mut best: Vec<(usize, Plan)> = Vec::new();
    let mut keep = |c: usize, plan: &Plan| {
        let place = best.partition_point(|(other, _)| *other <= c);
        if place < most && best.iter().all(|(_, other)| other != plan) {
            best.insert(place, (c, plan.clone()));
            best.truncate(most);
        }
    };
    for start in starts(geometry) {
        let mut plan = start;
        let mut least = cost(&plan);
        keep(least, &plan);
        let rounds = if n <= SEARCHED { ROUNDS } else { 0 };
        let changes = changes(geometry);
        // Once round without a gain, every choice was tried on the plan as it stands.
        let mut in_vain = 0;
        for change in std::iter::repeat_n(&changes, rounds).flatten() {
            in_vain += 1;
            if in_vain > changes.len() {
                break;
            }
            let mut tried = plan.clone();
            change(&mut tried);
            if tried == plan {
                continue;
            }
            let c = cost(&tried);
            keep(c, &tried);
            if c < least {
                (least, plan, in_vain) = (c, tried, 0);
            }
        }
    }
    best.into_iter().map(|(_, plan)| plan).collect()
}

/// A plan in which each place of an origin and each unit of length was tried once.
pub(super) fn refined(geometry: &Geometry, start: Plan, cost: impl Fn(&Plan) -> usize) -> Plan {
    let mut plan = start;
    if geometry.bodies.len() > SEARCHED {
        return plan;
    }
    let mut least = cost(&plan);
    for change in places(geometry) {
        let mut tried = plan.clone();
        change(&mut tried);
        if tried == plan {
            continue;
        }
        let c = cost(&tried);
        if c < least {
            (least, plan) = (c, tried);
        }
    }
    plan
}

/// Plans to start from: with and without groups.
fn starts(geometry: &Geometry) -> Vec<Plan> {
    let n = geometry.bodies.len();
    let tip = |j: usize| geometry.bodies.iter().all(|b| b.parent != Some(j));
    let plan = |grouped| Plan {
        slides: (0..n).map(|j| slides(geometry, j)[0]).collect(),
        unit: Dd::ONE,
        grouped,
        in_basis: (0..n).map(tip).collect(),
        aimed: (0..n).map(tip).collect(),
        carried: vec![0; n],
        apart: vec![false; n],
        base_parameters: true,
        short_moment: false,
        views: vec![View::default(); n],
    };
    let groups = geometry.bodies.iter().any(|b| b.parallel());
    if groups {
        vec![plan(true), plan(false)]
    } else {
        vec![plan(false)]
    }
}

type Change = Box<dyn Fn(&mut Plan)>;

/// Every place for an origin and every unit of length, as a change of a plan.
fn places(geometry: &Geometry) -> Vec<Change> {
    let mut changes: Vec<Change> = Vec::new();
    for j in 0..geometry.bodies.len() {
        for h in slides(geometry, j) {
            changes.push(Box::new(move |plan| plan.slides[j] = h));
        }
    }
    for unit in units(geometry) {
        changes.push(Box::new(move |plan| plan.unit = unit));
    }
    changes
}

/// Every single choice, as a change of a plan.
fn changes(geometry: &Geometry) -> Vec<Change> {
    let n = geometry.bodies.len();
    let mut changes = places(geometry);
    for j in 0..n {
        changes.push(Box::new(move |plan| plan.in_basis[j] ^= true));
    }
    for j in (0..n).filter(|&j| geometry.bodies.iter().all(|b| b.parent != Some(j))) {
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
    changes
}

/// How many joints are between the body and the base.
fn joints_to_base(geometry: &Geometry, mut j: usize) -> usize {
    let mut joints = 1;
    while let Some(p) = geometry.bodies[j].parent {
        (j, joints) = (p, joints + 1);
    }
    joints
}

/// Where the origin of body j may go along its axis: the feet of the common normals with its
/// children's axes, and with its parent's; where it was.
fn slides(geometry: &Geometry, j: usize) -> Vec<Dd> {
    let body = &geometry.bodies[j];
    let mut slides: Vec<Dd> = Vec::new();
    for child in geometry.bodies.iter().filter(|b| b.parent == Some(j)) {
        let (on_parent, own) = child.normal_feet();
        slides.push(if child.parallel() { own } else { on_parent });
    }
    if body.parent.is_some() {
        slides.push(-body.normal_feet().1);
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

/// Units of length: metres, and the distances between joints. Where the base stands is none.
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

/// The plan in words.
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
