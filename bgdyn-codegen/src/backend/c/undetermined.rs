//! The table of the loads that equations of rigid bodies do not determine.

use bgdyn_runtime::Dd;

use super::context::ModelContext;
use super::files::comment;
use super::table::Table;
use crate::math::Vec3;
use crate::plan::{UndeterminedLoad, undetermined_loads};

/// Returns the loads, if a function returns loads of loops or contacts.
pub(super) fn undetermined(context: &ModelContext<'_>) -> Vec<UndeterminedLoad> {
    let model = context.model;
    let closed = model.bond_graph.closed.as_deref();
    let closed = closed.filter(|_| model.functions.iter().any(|f| f.method.has_loads()));
    closed.map_or(Vec::new(), |closed| undetermined_loads(&closed.closure))
}

/// Returns the table; it is empty if all loads are determined.
pub(super) fn undetermined_table(context: &ModelContext<'_>) -> Table {
    let style = context.style;
    let [kind, name] = ["undetermined", "undetermined_loads"].map(|name| style.global(name));
    let components = |of: Vec3<Dd>| {
        let all = of.0.map(|x| style.number(x.to_f64()));
        format!("{{{}}}", all.join(", "))
    };
    let element = |load: UndeterminedLoad| {
        let [force, moment] = [load.force, load.moment].map(components);
        format!("{{{}, \"{}\", {force}, {moment}}}", load.reaction, load.row)
    };
    Table {
        about: "The loads that are statically undetermined.",
        declaration: format!("const struct {kind} {name}[{}]", style.constant("NS")),
        elements: undetermined(context).into_iter().map(element).collect(),
    }
}

/// Returns the type of its elements with its documentation; nothing if all loads are determined.
pub(super) fn undetermined_type(context: &ModelContext<'_>) -> Vec<String> {
    if undetermined(context).is_empty() {
        return Vec::new();
    }
    let (style, real) = (context.style, context.style.real());
    let mut lines = comment(&[
        "A load that equations of rigid bodies do not determine, because its row holds at every position of the joints, or",
        "follows from other rows: the component of `reactions` along it is zero, and the links of the loop may carry any",
        "such load in addition; where the row follows from others, these carry the opposite. Axes as those of `reactions`;",
        "of a universal joint at the position `neutral`; at the centre of a spherical loop.",
    ]);
    lines.extend([
        format!("struct {} {{", style.global("undetermined")),
        "    int reaction; /* index in the order of `reactions`, from 0 */".into(),
        "    const char *row; /* the row without a multiplier */".into(),
        format!("    {real} force[3]; /* direction of the force; zero for a moment */"),
        format!("    {real} moment[3]; /* direction of the moment; zero for a force */"),
        "};".into(),
        String::new(),
    ]);
    lines
}
