//! The velocities that lead from one position to another, joint by joint.

use super::context::ModelContext;
use super::position_function::{PositionFunction, signature};
use super::style::Style;
use crate::bond_graph::{JointSegment, joint_segments};

/// Returns the inverse of `integrate`. With loops and wheels it has the independent velocities of the way in the open
/// tree; joints that follow others have none.
pub(super) fn difference(context: &ModelContext<'_>) -> PositionFunction {
    let (style, graph) = (context.style, &context.model.bond_graph);
    let (joints, independents): (_, Vec<usize>) = match &graph.closed {
        Some(closed) => {
            let all = closed.closure.independents.iter();
            (joint_segments(&closed.tree), all.map(|j| j.0).collect())
        }
        None => (joint_segments(graph), (0..context.nv).collect()),
    };
    let (real, count) = (style.real(), style.constant("NV"));
    let mut body = vec![format!("{real} found[{count}];")];
    let (mut q, mut v) = (0, 0);
    for joint in &joints {
        body.extend(of_joint(joint, (q, v), &independents, style));
        (q, v) = (q + joint.nq, v + joint.nv);
    }
    body.push("memcpy(result, found, sizeof found);".into());
    let about = [
        "Velocities that lead from q0 to q1 in one unit of time: q1 - q0, and for joints with several velocities the",
        "logarithm of their group, with turns no longer than pi.",
    ];
    let of_constraints =
        ["These are the independent velocities of the way without loops and wheels."];
    let closed = graph.closed.iter().flat_map(|_| of_constraints);
    PositionFunction {
        about: about.into_iter().chain(closed).collect(),
        signature: signature(context, "void", "difference", "q1 q0", "NV"),
        body,
    }
}

/// Returns the statements for a joint whose positions and velocities begin at these indices.
fn of_joint(
    joint: &JointSegment,
    (q, v): (usize, usize),
    independents: &[usize],
    style: &Style,
) -> Vec<String> {
    let stored = |k: usize| independents.iter().position(|&j| j == v + k);
    let stored: Vec<(usize, usize)> = (0..joint.nv)
        .filter_map(|k| Some((k, stored(k)?)))
        .collect();
    if stored.is_empty() {
        return Vec::new();
    }
    if joint.manifold.is_empty() {
        let store = |(k, at)| format!("found[{at}] = q1[{}] - q0[{}];", q + k, q + k);
        return stored.into_iter().map(store).collect();
    }
    let real = style.real();
    let of = |name: &str| style.global(&format!("{}_{name}", joint.manifold));
    let mut lines = Vec::new();
    // A quaternion of any length is scaled first.
    let ends = ["q1", "q0"].map(|end| {
        if !joint.any_length {
            return format!("&{end}[{q}]");
        }
        let unit = format!("unit_{end}_{q}");
        lines.push(format!("{real} {unit}[{}];", joint.nq));
        lines.push(format!("{}(&{end}[{q}], {unit});", of("normalize")));
        unit
    });
    let ([to, from], way) = (ends, format!("way_{q}"));
    lines.push(format!("{real} {way}[{}];", joint.nv));
    lines.push(format!("{}({to}, {from}, {way});", of("difference")));
    let store = |(k, at)| format!("found[{at}] = {way}[{k}];");
    lines.extend(stored.into_iter().map(store));
    lines
}
