//! Emits the legend of a module: the names and signs that its functions use, with their meaning.

use std::collections::BTreeSet;

use crate::expr::{Graph, Node, NodeId, reachable};
use crate::function::Function;
use crate::legend::{AXES, LegendQuantity, QUANTITIES, SIGNS};

/// Returns lines of documentation for the names and signs in the code; empty without names.
pub(super) fn legend(functions: &[&Function]) -> Vec<String> {
    let (mut patterns, mut titles) = (BTreeSet::new(), BTreeSet::new());
    for function in functions {
        for id in nodes(function) {
            let name = name(&function.graph, id).and_then(LegendQuantity::of_name);
            patterns.extend(name.map(|(quantity, _)| quantity.pattern()));
            titles.extend(function.graph.section(id));
        }
    }
    let signs = SIGNS.iter();
    let signs = signs.filter(|(sign, _)| titles.iter().any(|title| title.contains(sign)));
    let signs = signs.map(|(_, meaning)| format!(" - {meaning}"));
    let quantities = QUANTITIES
        .iter()
        .filter(|q| patterns.contains(&q.pattern()));
    let rows = quantities.map(|q| {
        let (pattern, meaning, unit) = (q.pattern(), q.meaning, q.unit_in(1.0));
        format!(" | `{pattern}` | {meaning} | {unit} |")
    });
    let (signs, rows): (Vec<_>, Vec<_>) = (signs.collect(), rows.collect());
    let mut lines = Vec::new();
    if rows.is_empty() && signs.is_empty() {
        return lines;
    }
    lines.extend([String::new(), " # Names in the code".into(), String::new()]);
    lines.extend(AXES.iter().map(|line| format!(" {line}")));
    if !signs.is_empty() {
        lines.push(String::new());
        lines.extend(signs);
    }
    if !rows.is_empty() {
        lines.extend([
            String::new(),
            " | name | meaning | unit |".into(),
            " |---|---|---|".into(),
        ]);
        lines.extend(rows);
    }
    lines
}

/// Returns the nodes that a function computes.
fn nodes(function: &Function) -> impl Iterator<Item = NodeId> {
    let outputs = function.blocks.iter().flat_map(|b| &b.outputs).copied();
    let needed = reachable(&function.graph, &outputs.collect::<Vec<_>>());
    (0..needed.len())
        .filter(move |&i| needed[i])
        .map(NodeId::at)
}

/// Returns the name of a node.
fn name(graph: &Graph, id: NodeId) -> Option<&str> {
    match graph.node(id) {
        Node::Constant(c) => graph.constant_name(c.value()),
        _ => graph.name(id),
    }
    .map(|name| name.text.as_str())
}
