//! What `bgdyn check --loops` reports in addition: ranks, and the range of each independent joint.

use bgdyn_codegen::mechanism::closure::{ClosedRange, Closure, RangeEnd};
use bgdyn_codegen::mechanism::{CoordinateId, Joint, Mechanism, Motion};
use serde_json::{Value, json};

/// Returns lines: the rank of each loop's rows and of all, and for each independent joint in a loop the range in which
/// the loops close, with the condition number of the dependent columns.
pub(super) fn lines(mechanism: &Mechanism) -> Vec<String> {
    let Some(closure) = mechanism.closure() else {
        return Vec::new();
    };
    let tree = mechanism.open();
    let mut ranks = closure.ranks();
    let all = ranks.pop();
    let mut lines: Vec<String> = Vec::new();
    for (one, rank) in closure.loops.iter().zip(ranks) {
        lines.push(format!("rank {}: {}", one.name, rank_words(rank)));
    }
    if let (Some(all), true) = (all, closure.loops.len() > 1) {
        lines.push(format!("rank of all: {}", rank_words(all)));
    }
    for range in ranges(closure, &tree) {
        lines.push(range_words(&range, &tree));
    }
    lines
}

/// Adds the same to the JSON of a closure.
pub(super) fn add(mechanism: &Mechanism, model: &mut Value) {
    let Some(closure) = mechanism.closure() else {
        return;
    };
    let tree = mechanism.open();
    let rank = |[closed, open]: [usize; 2]| json!({ "closed": closed, "open": open });
    let mut ranks = closure.ranks();
    if let Some(all) = ranks.pop() {
        model["rank"] = rank(all);
    }
    for (k, of_loop) in ranks.into_iter().enumerate() {
        model["loops"][k]["rank"] = rank(of_loop);
    }
    let ranges = ranges(closure, &tree).into_iter().map(|range| {
        let [least, most] = range.condition;
        let end = |k: usize| {
            let why = match range.why[k] {
                RangeEnd::Reach => "reach",
                RangeEnd::BranchesMeet => "branches-meet",
                RangeEnd::Limit(_) => "limit",
                RangeEnd::None => "none",
            };
            json!({ "position": range.ends[k], "why": why, "joint": limit(range.why[k], &tree) })
        };
        json!({
            "joint": tree.joint(range.joint).name,
            "lower": end(0),
            "upper": end(1),
            "whole_turn": is_whole_turn(&range, &tree),
            "condition": {
                "least": { "value": finite(least.0), "position": least.1 },
                "largest": { "value": finite(most.0), "position": most.1 },
            },
        })
    });
    model["ranges"] = ranges.collect();
}

/// A number, or null for one that is infinite.
fn finite(x: f64) -> Value {
    if x.is_finite() { json!(x) } else { Value::Null }
}

fn ranges(closure: &Closure, tree: &Mechanism) -> Vec<ClosedRange> {
    let joints = || (0..tree.nv()).map(|j| tree.joint(CoordinateId(j)));
    let limits: Vec<[Option<f64>; 2]> = joints()
        .map(|joint| [joint.limits.lower, joint.limits.upper])
        .collect();
    let turns: Vec<bool> = joints().map(turns).collect();
    closure.ranges(&limits, &turns)
}

fn turns(joint: &Joint) -> bool {
    joint.kind.motion == Motion::Rotation
}

fn is_whole_turn(range: &ClosedRange, tree: &Mechanism) -> bool {
    turns(tree.joint(range.joint)) && range.why.contains(&RangeEnd::None)
}

/// Returns the joint whose limit ends a range.
fn limit(why: RangeEnd, tree: &Mechanism) -> Option<String> {
    match why {
        RangeEnd::Limit(j) => Some(tree.joint(j).name.clone()),
        _ => None,
    }
}

fn rank_words([closed, open]: [usize; 2]) -> String {
    match closed == open {
        true => format!("{closed}"),
        false => format!("{closed} at closed positions, {open} elsewhere"),
    }
}

/// Returns "range crank_angle: a whole turn; condition 1.2 at 0.3 rad to 7.9 at 2.1 rad".
fn range_words(range: &ClosedRange, tree: &Mechanism) -> String {
    let joint = tree.joint(range.joint);
    let unit = match joint.kind.motion {
        Motion::Translation => "m",
        _ => "rad",
    };
    let end = |k: usize| {
        let why = match (range.why[k], limit(range.why[k], tree)) {
            (RangeEnd::Reach, _) => "end of reach".to_owned(),
            (RangeEnd::BranchesMeet, _) => "branches meet".to_owned(),
            (_, Some(name)) => format!("limit of {name}"),
            _ => "not followed farther".to_owned(),
        };
        // Without the sign of a zero.
        let at = (1e6 * range.ends[k]).round() * 1e-6 + 0.0;
        format!("{at:.6} {unit} ({why})")
    };
    let reach = match is_whole_turn(range, tree) {
        true => "a whole turn".to_owned(),
        false => format!("{} to {}", end(0), end(1)),
    };
    let condition = |(value, at): (f64, f64)| format!("{value:.3} at {at:.3} {unit}");
    let [least, most] = range.condition.map(condition);
    format!("range {}: {reach}; condition {least} to {most}", joint.name)
}
