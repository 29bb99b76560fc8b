//! What a C file has beside the functions of a model: how positions change with velocities.
//!
//! Joint by joint as in Rust: q + dv, or a function of `bgdyn_runtime::manifold` for joints with several velocities.
//! Loops and contacts are in [`super::closing`].

use super::closing;
use super::context::FunctionContext;
use super::parameters::of_model;
use super::style::Style;
use crate::method::Method;
use crate::plan::{JointSegment, joint_segments};

/// The number of components of a quaternion, the last positions of a joint that has one.
const QUATERNION: usize = 4;

/// A function of positions.
pub(super) struct PositionFunction {
    /// What it does; empty for a function of the file itself.
    pub(super) about: Vec<&'static str>,
    /// Its signature, without a semicolon.
    pub(super) signature: String,
    /// Its statements.
    pub(super) body: Vec<String>,
}

/// Returns the functions of positions, each after those that it calls. A mechanism without positions has none.
pub(super) fn position_functions(context: &FunctionContext<'_>) -> Vec<PositionFunction> {
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
        }
    }
    functions
}

/// Returns whether the file has the function of a method.
pub(super) fn has(context: &FunctionContext<'_>, method: Method) -> bool {
    context.model.function(method).is_some()
}

/// Returns a signature: `q` has NQ components, other arguments have NV.
pub(super) fn signature(
    context: &FunctionContext<'_>,
    kind: &str,
    name: &str,
    arguments: &str,
    size: &str,
) -> String {
    let (style, real) = (context.style, context.style.real());
    let parameters = of_model(context.naming, style, true).map(|p| p.declaration);
    // Of loops and contacts: functions that call those of the model.
    let calls =
        context.model.bond_graph.closed.is_some() && !matches!(name, "neutral" | "normalize");
    let parameters = parameters.filter(|_| calls);
    let argument = |name: &str| {
        let size = style.constant(if name == "q" { "NQ" } else { "NV" });
        format!("const {real} {name}[{size}]")
    };
    let arguments = arguments.split_whitespace().map(argument);
    let result = format!("{real} result[{}]", style.constant(size));
    let all: Vec<String> = parameters
        .into_iter()
        .chain(arguments)
        .chain([result])
        .collect();
    format!("{kind} {}({})", style.global(name), all.join(", "))
}

fn neutral(context: &FunctionContext<'_>) -> PositionFunction {
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

fn normalize(context: &FunctionContext<'_>) -> PositionFunction {
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

/// Returns the statements that compute a vector of positions joint by joint from `q` and the velocities with this name,
/// which may be the same array as the result.
pub(super) fn joint_by_joint(
    joints: &[JointSegment],
    name: &str,
    velocities: &str,
    style: &Style,
) -> Vec<String> {
    let count = style.constant("NQ");
    let real = style.real();
    let mut lines = vec![format!("{real} found[{count}];")];
    let (mut q, mut v) = (0, 0);
    let mut reads_q = false;
    for joint in joints {
        match joint.manifold {
            "" => {
                for k in 0..joint.nq {
                    let value = plain(joint, name, (q + k, v + k), velocities, style);
                    reads_q |= value.contains("q[");
                    lines.push(format!("found[{}] = {value};", q + k));
                }
            }
            _ => {
                reads_q = true;
                lines.extend(manifold(joint, name, (q, v), velocities, style));
            }
        }
        (q, v) = (q + joint.nq, v + joint.nv);
    }
    if !reads_q {
        lines.insert(0, "(void)q;".into());
    }
    lines.push("memcpy(result, found, sizeof found);".into());
    lines
}

/// Returns a position, or its rate, of a joint with one velocity; that of one that follows others is the sum of
/// ratio · velocity.
fn plain(
    joint: &JointSegment,
    name: &str,
    (q, v): (usize, usize),
    velocities: &str,
    style: &Style,
) -> String {
    let term = |&(j, ratio): &(usize, f64)| {
        let ratio = style.number(ratio);
        format!("{ratio} * {velocities}[{j}]")
    };
    let moved = match joint.leaders.is_empty() {
        true => format!("{velocities}[{v}]"),
        false => joint
            .leaders
            .iter()
            .map(term)
            .collect::<Vec<_>>()
            .join(" + "),
    };
    match name {
        "integrate" if !joint.leaders.is_empty() => format!("q[{q}] + ({moved})"),
        "integrate" => format!("q[{q}] + {moved}"),
        "position_rates" => moved,
        _ => format!("q[{q}]"),
    }
}

/// Returns the statements for a joint with several velocities. A quaternion of any length is scaled first; its own rates
/// are proportional to its length.
fn manifold(
    joint: &JointSegment,
    name: &str,
    (q, v): (usize, usize),
    velocities: &str,
    style: &Style,
) -> Vec<String> {
    let (real, of) = (style.real(), |name: &str| {
        style.global(&format!("{}_{name}", joint.manifold))
    });
    let call = |from: &str| match name {
        "normalize" => format!("{}({from}, &found[{q}]);", of(name)),
        _ => format!("{}({from}, &{velocities}[{v}], &found[{q}]);", of(name)),
    };
    let own = format!("&q[{q}]");
    if !joint.any_length || name == "normalize" {
        return vec![call(&own)];
    }
    let unit = format!("unit_{q}");
    let mut lines = vec![
        format!("{real} {unit}[{}];", joint.nq),
        format!("{}({own}, {unit});", of("normalize")),
        call(&unit),
    ];
    if name == "position_rates" {
        let first = joint.nq - QUATERNION;
        let (rates, at) = (style.global("spherical_position_rates"), v + joint.nv - 3);
        lines.push(format!(
            "{rates}(&q[{}], &{velocities}[{at}], &found[{}]);",
            q + first,
            q + first
        ));
    }
    lines
}
