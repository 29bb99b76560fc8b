//! The sizes of a mechanism, and the tables of its names and limits.

use super::context::ModelContext;
use super::table::{Size, Table};
use super::undetermined::{undetermined, undetermined_table};
use crate::function::Function;
use crate::mechanism::{CoordinateId, Limits};
use crate::method::{Method, Shape};
use crate::plan::{
    actuated_pivot_names, closing_names, loop_names, operational_pivot_names, pivot_names,
    tree_pivot_names,
};

/// Returns the sizes that signatures and tables use.
pub(super) fn sizes(context: &ModelContext<'_>) -> Vec<Size> {
    let (model, mechanism) = (context.model, &context.model.mechanism);
    let mut sizes = vec![
        ("NQ", "positions", mechanism.nq()),
        ("NV", "velocities", mechanism.nv()),
    ];
    if let Some(closed) = model.bond_graph.closed.as_deref() {
        let closure = &closed.closure;
        sizes.extend([
            ("NT", "velocities of the open tree", context.nt),
            ("NC", "rows of loops and contacts", closure.rows.len()),
            ("NR", "loops and contacts", closure.loops.len()),
        ]);
        let actuated = closure.actuated.as_ref();
        sizes.extend(actuated.map(|all| ("NA", "actuated joints", all.joints.len())));
        let undetermined = undetermined(context).len();
        let about = "loads that are statically undetermined";
        sizes.extend((undetermined > 0).then_some(("NS", about, undetermined)));
    }
    let prescribed = mechanism.prescribed_names().len();
    if prescribed > 0 {
        sizes.push(("NP", "prescribed joints", prescribed));
    }
    if model.functions.iter().any(is_of_links) {
        sizes.push(("NL", "links", link_names(context).len()));
    }
    if model.has_regressors() {
        sizes.push(("NB", "bodies of regressors", model.body_names().len()));
        sizes.push(("NBP", "base parameters", model.base_parameters.len()));
    }
    let contacts = model.contact_names().len();
    sizes.extend((contacts > 0).then_some(("NK", "contacts", contacts)));
    sizes
}

fn is_of_links(function: &Function) -> bool {
    function.shape() == Shape::LinkWrenches
}

fn link_names<'a>(context: &ModelContext<'a>) -> Vec<&'a str> {
    let links = context.model.mechanism.links().iter();
    let seen = links.filter(|link| !link.hidden);
    seen.map(|link| link.name.as_str()).collect()
}

/// Returns the tables, without empty ones: C has no empty arrays.
pub(super) fn tables(context: &ModelContext<'_>) -> Vec<Table> {
    let model = context.model;
    let (joints, positions) = (&context.naming.joints, &context.naming.positions);
    let mut tables = vec![
        names(
            context,
            "Names of the moving joints, in the order of the velocities.",
            "joint_names",
            "NV",
            joints,
        ),
        names(
            context,
            "Names of the positions.",
            "position_names",
            "NQ",
            positions,
        ),
    ];
    tables.extend(names_of_loops(context));
    tables.push(undetermined_table(context));
    let prescribed = model.mechanism.prescribed_names();
    let prescribed: Vec<&str> = prescribed.iter().map(String::as_str).collect();
    let about = "Names of the prescribed joints, in the order of `drive_efforts`.";
    tables.push(names(context, about, "prescribed_names", "NP", &prescribed));
    if model.functions.iter().any(is_of_links) {
        let links = link_names(context);
        tables.push(names(
            context,
            "Names of the links, parents before children.",
            "link_names",
            "NL",
            &links,
        ));
    }
    if model.has_regressors() {
        let about = "Names of the bodies of regressors: the links that joints move, each with all that is fixed to it.";
        tables.push(names(
            context,
            about,
            "body_names",
            "NB",
            &model.body_names(),
        ));
        let base: Vec<&str> = model.base_parameters.iter().map(String::as_str).collect();
        let about = "The base parameters as formulas of the parameters of the bodies.";
        tables.push(names(context, about, "base_parameter_names", "NBP", &base));
    }
    if model.all_methods().any(Method::inverts_task) {
        let graph = &model.bond_graph;
        let all = operational_pivot_names(graph.closed.as_deref(), graph);
        let about = "Names of the joints, of loops and contacts after them, and of the directions of a frame after these: the causes of missing operational inertias.";
        let size = match graph.closed {
            Some(_) => "NV + NR + 6",
            None => "NV + 6",
        };
        tables.push(names(context, about, "operational_pivot_names", size, &all));
    }
    let about = "Names of the contacts, in the order of the file; a capsule has two, a box eight.";
    let contacts = model.contact_names();
    tables.push(names(context, about, "contact_names", "NK", &contacts));
    tables.extend(limits(context));
    tables.retain(|table| !table.elements.is_empty());
    tables
}

fn names_of_loops(context: &ModelContext<'_>) -> Vec<Table> {
    let graph = &context.model.bond_graph;
    let Some(closed) = graph.closed.as_deref() else {
        return Vec::new();
    };
    let has = |is: fn(&Method) -> bool| context.model.functions.iter().any(|f| is(&f.method));
    let rows = closed.closure.rows.iter();
    let rows: Vec<String> = rows.map(|row| closed.closure.row_name(row)).collect();
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let loops: Vec<&str> = loop_names(closed).collect();
    let table = |about, name, size, all: &[&str]| names(context, about, name, size, all);
    let mut tables = vec![
        table(
            "Names of the joints of the open tree, in the order of its velocities.",
            "tree_joint_names",
            "NT",
            &context.naming.tree_joints,
        ),
        table(
            "Names of the rows: the loop or contact, and the direction.",
            "constraint_names",
            "NC",
            &rows,
        ),
        table(
            "Names of the loops and contacts, in the order of `reactions`.",
            "reaction_names",
            "NR",
            &loops,
        ),
        table(
            "Names of the joints, then of the loops and contacts: the causes of missing accelerations.",
            "pivot_names",
            "NV + NR",
            &pivot_names(closed, graph),
        ),
    ];
    if has(|m| m.of_tree() && m.shape().checked()) {
        let about = "Names of the joints of the open tree, then of the loops and contacts: the causes of missing results.";
        tables.push(table(
            about,
            "tree_pivot_names",
            "NT + NR",
            &tree_pivot_names(closed),
        ));
    }
    if let Some(actuated) = &closed.closure.actuated {
        let about = "Names of the actuated joints, in the order of the open tree.";
        tables.push(table(
            about,
            "actuated_names",
            "NA",
            &closed.joint_names(actuated),
        ));
    }
    if has(|m| matches!(m, Method::ActuatedInverse(_))) {
        let about = "Names of the actuated joints, then of the loops, then of the joints: the causes of missing efforts.";
        tables.push(table(
            about,
            "actuated_pivot_names",
            "NA + NR + NV",
            &actuated_pivot_names(closed, graph),
        ));
    }
    if has(|m| *m == Method::ClosingStep) || context.model.assembles {
        let about = "Names of the positions, then of the loops and contacts: the causes of positions that do not close.";
        tables.push(table(
            about,
            "closing_names",
            "NQ + NR",
            &closing_names(closed, graph),
        ));
    }
    tables
}

/// Returns a table of names; `size` is a sum of sizes.
fn names(
    context: &ModelContext<'_>,
    about: &'static str,
    name: &str,
    size: &str,
    names: &[&str],
) -> Table {
    let style = context.style;
    let (name, size) = (style.global(name), style.sized(size));
    Table {
        about,
        declaration: format!("const char *const {name}[{size}]"),
        elements: names.iter().map(|name| format!("\"{name}\"")).collect(),
    }
}

/// Returns the limits of the moving joints.
fn limits(context: &ModelContext<'_>) -> Vec<Table> {
    type OfJoint = fn(&Limits) -> Option<f64>;
    const LIMITS: [(&str, &str, OfJoint, bool); 4] = [
        (
            "lower_limits",
            "Smallest positions of the moving joints, rad or m; infinite where there is no limit.",
            |l| l.lower,
            true,
        ),
        ("upper_limits", "Largest positions.", |l| l.upper, false),
        (
            "velocity_limits",
            "Largest speeds, rad/s or m/s.",
            |l| l.velocity,
            false,
        ),
        (
            "effort_limits",
            "Largest efforts, N m or N.",
            |l| l.effort,
            false,
        ),
    ];
    let (style, mechanism) = (context.style, &context.model.mechanism);
    let table = |(name, about, of, is_lower): (&str, _, OfJoint, bool)| {
        let none = if is_lower {
            f64::NEG_INFINITY
        } else {
            f64::INFINITY
        };
        let limits = (0..context.nv).map(|j| of(&mechanism.joint(CoordinateId(j)).limits));
        let (real, name, size) = (style.real(), style.global(name), style.constant("NV"));
        Table {
            about,
            declaration: format!("const {real} {name}[{size}]"),
            elements: limits.map(|x| style.number(x.unwrap_or(none))).collect(),
        }
    };
    LIMITS.into_iter().map(table).collect()
}
