//! What a C file has beside the functions of a model: how positions change with velocities.
//!
//! Joint by joint as in Rust: q + dv, or a function of `bgdyn_runtime::manifold` for joints with several velocities.
//! Loops and contacts are in [`super::closing`].

use super::closing;
use super::context::ModelContext;
use super::difference::difference;
use super::position_function::{PositionFunction, joint_by_joint, signature};
use super::sample::sample;
use crate::bond_graph::{JointSegment, joint_segments};

/// Returns the functions of positions, each after those that it calls. A mechanism without positions has none.
pub(super) fn position_functions(context: &ModelContext<'_>) -> Vec<PositionFunction> {
    if context.model.mechanism.nq() == 0 {
        return Vec::new();
    }
    let graph = &context.model.bond_graph;
    let mut functions = vec![neutral(context), normalize(context)];
    match &graph.closed {
        Some(closed) => functions.extend(closing::closing_functions(closed, context)),
        None if context.nv == 0 => {}
        None => {
            let joints = joint_segments(graph);
            let about = vec![
                "Rates of the positions at the velocities v: 1/s for the components of a quaternion.",
            ];
            let signature = signature(context, "void", "position_rates", "q v", "NQ");
            let body = joint_by_joint(&joints, "position_rates", "v", context.style);
            functions.push(PositionFunction {
                about,
                signature,
                body,
            });
            let about = vec![
                "Positions after the velocities dv for one unit of time: q + dv, and for joints with several velocities the",
                "exponential of their group; quaternions get the length 1.",
            ];
            let signature = self::signature(context, "void", "integrate", "q dv", "NQ");
            let body = joint_by_joint(&joints, "integrate", "dv", context.style);
            functions.push(PositionFunction {
                about,
                signature,
                body,
            });
            functions.push(sample(context));
        }
    }
    functions.extend((context.nv > 0).then(|| difference(context)));
    functions
}

fn neutral(context: &ModelContext<'_>) -> PositionFunction {
    let (style, graph) = (context.style, &context.model.bond_graph);
    let (about, values): (_, Vec<f64>) = match &graph.closed {
        Some(closed) => (
            "A position at which all loops close and all wheels touch.",
            closed.closure.start.iter().map(|x| x.hi()).collect(),
        ),
        None => {
            let joints = joint_segments(graph);
            let of_joint = |joint: &JointSegment| {
                let mut own = vec![0.0; joint.nq];
                if let ("spherical" | "floating", Some(last)) = (joint.manifold, own.last_mut()) {
                    *last = 1.0;
                }
                own
            };
            let values = joints.iter().flat_map(of_joint).collect();
            (
                "The position with every coordinate zero and every quaternion (0, 0, 0, 1).",
                values,
            )
        }
    };
    let store = |(k, x): (usize, &f64)| format!("result[{k}] = {};", style.number(*x));
    PositionFunction {
        about: vec![about],
        signature: signature(context, "void", "neutral", "", "NQ"),
        body: values.iter().enumerate().map(store).collect(),
    }
}

fn normalize(context: &ModelContext<'_>) -> PositionFunction {
    let graph = &context.model.bond_graph;
    let joints = match &graph.closed {
        Some(closed) => joint_segments(&closed.tree),
        None => joint_segments(graph),
    };
    PositionFunction {
        about: vec!["The positions with quaternions of length 1."],
        signature: signature(context, "void", "normalize", "q", "NQ"),
        body: joint_by_joint(&joints, "normalize", "", context.style),
    }
}
