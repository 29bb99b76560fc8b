//! Evenly distributed positions from numbers in 0 … 1.

use bgdyn_runtime::closure::PARTS;

use super::context::ModelContext;
use super::parameters::of_model;
use super::position_function::{PositionFunction, joint_by_joint, signature};
use super::style::Style;
use crate::bond_graph::{ClosedTree, JointSegment, joint_segments};
use crate::plan::{dependent_joint, independent_positions};

/// What it is without loops and wheels.
const ABOUT: [&str; 3] = [
    "Positions that are evenly distributed if the NV numbers u are, each in 0 ... 1 without 1: angles in -pi ... pi,",
    "displacements in -1 ... 1 m, quaternions over all rotations (Shoemake, Uniform random rotations, Graphics Gems III,",
    "1992).",
];

/// Returns the function of a mechanism without loops and contacts.
pub(super) fn sample(context: &ModelContext<'_>) -> PositionFunction {
    let joints = joint_segments(&context.model.bond_graph);
    PositionFunction {
        about: ABOUT.to_vec(),
        signature: signature(context, "void", "sample", "u", "NQ"),
        body: sampled(&joints, context.style),
    }
}

/// Returns the statements that sample all joints.
fn sampled(joints: &[JointSegment], style: &Style) -> Vec<String> {
    let mut lines = joint_by_joint(joints, "sample", "u", style);
    lines.retain(|line| line != "(void)q;");
    lines
}

/// Returns the function of a mechanism with loops or contacts, after one that samples its joints. With positions that
/// close it calls `newton`.
pub(super) fn closed_sample(
    closed: &ClosedTree,
    closes: bool,
    context: &ModelContext<'_>,
) -> [PositionFunction; 2] {
    let (style, real) = (context.style, context.style.real());
    let slips = closed.closure.nonholonomic();
    let (joints, count) = match closed.closure.closes_along() {
        true => (joint_segments(&closed.tree), "NT"),
        false => (joint_segments(&context.model.bond_graph), "NV"),
    };
    let [count, nq] = [count, "NQ"].map(|size| style.constant(size));
    let signature_of_joints = format!(
        "static void {}(const {real} u[{count}], {real} result[{nq}])",
        style.global("sample_joints")
    );
    let of_joints = PositionFunction {
        about: Vec::new(),
        signature: signature_of_joints,
        body: sampled(&joints, style),
    };
    let given = of_model(context.naming, style, true).map_or("", |_| "parameters, ");
    let newton = |q: &str| format!("{}({given}{q})", style.global("newton"));
    let (way, body) = match slips {
        true => (
            "With wheels and loops closed; where they do not close, the last closed positions on the way from `neutral`.",
            along_constraints(closed, closes.then_some(newton), style),
        ),
        false => (
            "With loops the closed positions next to them on the way from `neutral`.",
            match closed.closure.closes_along() {
                true => along_velocities(closed, given, style),
                false => towards(closed, &newton("found"), style),
            },
        ),
    };
    let whole = PositionFunction {
        about: ABOUT.into_iter().chain([way]).collect(),
        signature: signature(context, "void", "sample", "u", "NQ"),
        body,
    };
    [of_joints, whole]
}

/// Returns the statements that go from the closed position of the start to sampled ones, in equal parts of the
/// independent positions as far as the loops close.
fn towards(closed: &ClosedTree, newton: &str, style: &Style) -> Vec<String> {
    let (real, nq) = (style.real(), style.constant("NQ"));
    let start = closed.closure.start.iter();
    let start: Vec<String> = start.map(|x| style.number(x.hi())).collect();
    let independents = independent_positions(closed);
    let dependents = closed.closure.closing();
    let dependents: Vec<usize> = dependents
        .map(|j| dependent_joint(closed, j).position)
        .collect();
    // 1: moves towards the target; 2: closes; 0: outside of loops.
    let kinds = (0..start.len()).map(|p| match () {
        () if independents.contains(&p) => "1",
        () if dependents.contains(&p) => "2",
        () => "0",
    });
    let kinds: Vec<&str> = kinds.collect();
    vec![
        format!("const {real} start[{nq}] = {{{}}};", start.join(", ")),
        "/* 1: in a loop, independent; 2: in a loop, dependent; 0: in none */".into(),
        format!("const int kinds[{nq}] = {{{}}};", kinds.join(", ")),
        format!("{real} target[{nq}];"),
        format!("{real} found[{nq}];"),
        format!("{real} last[{nq}];"),
        format!("{}(u, target);", style.global("sample_joints")),
        format!("for (int p = 0; p < {nq}; ++p) {{"),
        "    last[p] = (kinds[p] != 0) ? start[p] : target[p];".into(),
        "}".into(),
        format!("for (int part = 1; part <= {PARTS}; ++part) {{"),
        format!(
            "    const {real} share = ({real})part / {};",
            style.number(PARTS as f64)
        ),
        format!("    for (int p = 0; p < {nq}; ++p) {{"),
        "        found[p] = (kinds[p] == 1) ? start[p] + (target[p] - start[p]) * share : last[p];"
            .into(),
        "    }".into(),
        format!("    if ({newton} == 0) {{"),
        "        memcpy(last, found, sizeof last);".into(),
        "    }".into(),
        "}".into(),
        "memcpy(result, last, sizeof last);".into(),
    ]
}

/// Returns the statements that go from the closed position of the start along the independent velocities that lead to
/// sampled positions, in equal parts as far as the loops close.
fn along_velocities(closed: &ClosedTree, given: &str, style: &Style) -> Vec<String> {
    let (real, nq) = (style.real(), style.constant("NQ"));
    let nv = style.constant("NV");
    let start = closed.closure.start.iter();
    let start: Vec<String> = start.map(|x| style.number(x.hi())).collect();
    let mut lines = sampled_tree(closed, style);
    lines.extend([
        format!("const {real} start[{nq}] = {{{}}};", start.join(", ")),
        format!("{real} way[{nv}];"),
        format!("{real} last[{nq}];"),
        format!("{}(found, start, way);", style.global("difference")),
        format!("for (int j = 0; j < {nv}; ++j) {{"),
        format!(
            "    way[j] = way[j] * {};",
            style.number(1.0 / PARTS as f64)
        ),
        "}".into(),
        "memcpy(last, start, sizeof last);".into(),
        format!("for (int part = 1; part <= {PARTS}; ++part) {{"),
        format!(
            "    if ({}({given}last, way, found) == 0) {{",
            style.global("integrate")
        ),
        "        memcpy(last, found, sizeof last);".into(),
        "    }".into(),
        "}".into(),
        "memcpy(result, last, sizeof last);".into(),
    ]);
    lines
}

/// Returns the statements that sample the positions `found` of the open tree: at the numbers `u` of the independent
/// velocities, and in the middle for the others.
fn sampled_tree(closed: &ClosedTree, style: &Style) -> Vec<String> {
    let (real, nq, nt) = (style.real(), style.constant("NQ"), style.constant("NT"));
    let independents = closed.closure.independents.iter().enumerate();
    let mut lines = vec![
        format!("{real} moved[{nt}];"),
        format!("{real} found[{nq}];"),
        format!("for (int j = 0; j < {nt}; ++j) {{"),
        format!("    moved[j] = {};", style.number(0.5)),
        "}".into(),
    ];
    lines.extend(independents.map(|(k, j)| format!("moved[{}] = u[{k}];", j.0)));
    lines.push(format!("{}(moved, found);", style.global("sample_joints")));
    lines
}

/// Returns the statements that make all positions `found` NaN on a condition.
pub(super) fn all_nan(condition: &str, style: &Style) -> [String; 5] {
    let (real, nq) = (style.real(), style.constant("NQ"));
    [
        format!("if ({condition}) {{"),
        format!("    for (int p = 0; p < {nq}; ++p) {{"),
        format!("        found[p] = ({real})NAN;"),
        "    }".into(),
        "}".into(),
    ]
}

/// Returns the statements that sample the independent velocities' joints, the others in the middle, and close by
/// `newton`. Where that does not close, they go from the closed position of the start along the independent velocities,
/// in equal parts as far as wheels and loops close.
fn along_constraints(
    closed: &ClosedTree,
    newton: Option<impl Fn(&str) -> String>,
    style: &Style,
) -> Vec<String> {
    let mut lines = sampled_tree(closed, style);
    if let Some(newton) = newton {
        let real = style.real();
        let [nq, nv, nt] = ["NQ", "NV", "NT"].map(|size| style.constant(size));
        let start = closed.closure.start.iter();
        let start: Vec<String> = start.map(|x| style.number(x.hi())).collect();
        let independents = closed.closure.independents.iter().enumerate();
        let share = style.number(1.0 / PARTS as f64);
        lines.extend([
            format!("{real} target[{nq}];"),
            "memcpy(target, found, sizeof target);".into(),
            format!("if ({} != 0) {{", newton("found")),
            format!("    const {real} start[{nq}] = {{{}}};", start.join(", ")),
            format!("    {real} way[{nv}];"),
            format!("    {real} next[{nq}];"),
            format!("    {}(target, start, way);", style.global("difference")),
            format!("    for (int j = 0; j < {nt}; ++j) {{"),
            format!("        moved[j] = {};", style.number(0.0)),
            "    }".into(),
        ]);
        lines
            .extend(independents.map(|(k, j)| format!("    moved[{}] = way[{k}] * {share};", j.0)));
        lines.extend([
            "    memcpy(found, start, sizeof found);".into(),
            format!("    for (int part = 1; part <= {PARTS}; ++part) {{"),
            format!("        {}(found, moved, next);", style.global("moved")),
            format!("        if ({} == 0) {{", newton("next")),
            "            memcpy(found, next, sizeof found);".into(),
            "        }".into(),
            "    }".into(),
            "}".into(),
        ]);
    }
    lines.push("memcpy(result, found, sizeof found);".into());
    lines
}
