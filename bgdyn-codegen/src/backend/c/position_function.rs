//! A function of positions, and vectors of positions that are computed joint by joint.

use std::f64::consts::PI;

use super::context::ModelContext;
use super::files::{comment, lines_of};
use super::parameters::of_model;
use super::style::Style;
use crate::bond_graph::JointSegment;

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

impl PositionFunction {
    /// Returns the function of a definition in C.
    pub(super) fn of_definition(text: &str, about: Vec<&'static str>) -> Self {
        let (signature, body) = text.split_once("\n{\n").unwrap_or((text, ""));
        let body = body.trim_end().trim_end_matches('}').lines();
        let body = body.map(|line| line.strip_prefix("    ").unwrap_or(line).to_string());
        PositionFunction {
            about,
            signature: signature.into(),
            body: body.collect(),
        }
    }

    /// Returns its declaration with its documentation; nothing for a function of the file itself.
    pub(super) fn prototype(&self) -> Vec<String> {
        if self.about.is_empty() {
            return Vec::new();
        }
        let mut lines = comment(&self.about);
        lines.extend([format!("{};", self.signature), String::new()]);
        lines
    }

    /// Returns its definition with its documentation.
    pub(super) fn definition(&self) -> String {
        let (about, signature) = (lines_of(comment(&self.about)), &self.signature);
        let body: String = self
            .body
            .iter()
            .map(|line| format!("    {line}\n"))
            .collect();
        format!("{about}{signature}\n{{\n{body}}}\n\n")
    }
}

/// Returns a signature: `q`, `q1` and `q0` have NQ components, other arguments have NV.
pub(super) fn signature(
    context: &ModelContext<'_>,
    kind: &str,
    name: &str,
    arguments: &str,
    size: &str,
) -> String {
    let (style, real) = (context.style, context.style.real());
    let parameters = of_model(context.naming, style, true).map(|p| p.declaration);
    // Of loops and contacts: functions that call those of the model.
    let calls = context.model.bond_graph.closed.is_some()
        && !matches!(name, "neutral" | "normalize" | "difference");
    let parameters = parameters.filter(|_| calls);
    let argument = |name: &str| {
        let size = style.constant(if name.starts_with('q') { "NQ" } else { "NV" });
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
                reads_q |= name != "sample";
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
        "sample" if joint.nv > 0 => {
            let half = if joint.turns { PI } else { 1.0 };
            let [one, half] = [1.0, half].map(|x| style.number(x));
            format!("({moved} + {moved} - {one}) * {half}")
        }
        "sample" => style.number(0.0),
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
    if name == "sample" {
        return vec![format!("{}(&{velocities}[{v}], &found[{q}]);", of(name))];
    }
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
