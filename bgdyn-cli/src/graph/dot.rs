//! Prints a drawing in the language of Graphviz.
//!
//! Half arrows are half heads, causal strokes are bars at a bond's end; a bond of three components is a
//! double line.

use std::fmt::Write;

use super::chart::{Chart, ChartLink, Flow, Port, Transformer};

impl Chart {
    /// Returns the drawing as the text of a DOT file.
    pub(crate) fn dot(&self) -> String {
        let notes = self.notes.iter().map(|note| format!("\n{note}"));
        let title = format!("{}: bond graph{}", self.title, notes.collect::<String>());
        let mut text = format!(
            "// {}\ndigraph bond_graph {{\n  label={};\n  labelloc=t;\n  rankdir=LR;\n  fontname=\"sans-serif\";\n  ranksep=0.3;\n  nodesep=0.12;\n  node [shape=plaintext, fontname=\"sans-serif\", fontsize=12, margin=0.05, width=0, height=0];\n  edge [arrowsize=0.9];\n",
            self.census(),
            quoted(&title),
        );
        for (j, velocity) in self.velocities.iter().enumerate() {
            let name = format!("{}\n1\n{}", velocity.symbol, velocity.name);
            node(&mut text, 1, &format!("v{j}"), &name);
            for (k, port) in velocity.ports.iter().enumerate() {
                one_port(
                    &mut text,
                    port,
                    &format!("v{j}"),
                    &format!("v{j}_{k}"),
                    false,
                );
            }
        }
        for (i, link) in self.bands().enumerate() {
            cluster(&mut text, i, link);
        }
        text + "}\n"
    }
}

/// Writes a link's junctions, transformers and one-ports in a cluster.
fn cluster(text: &mut String, i: usize, link: &ChartLink) {
    let title = quoted(&link.name);
    *text += &format!("  subgraph cluster_{i} {{\n    label={title};\n    color=gray80;\n");
    for (k, flow) in link.flows.iter().enumerate() {
        let one = format!("l{i}_{k}");
        node(text, 2, &one, &format!("1\n{}", flow.symbol));
        for (p, port) in flow.ports.iter().enumerate() {
            one_port(text, port, &one, &format!("{one}_{p}"), flow.is_vector());
        }
        for t in &flow.transformers {
            node(text, 2, &format!("{one}_t{}", t.velocity), &words(t));
        }
        if flow.sums() {
            node(text, 2, &format!("{one}_sum"), "0");
        }
    }
    *text += "  }\n";
    for (k, flow) in link.flows.iter().enumerate() {
        transformers(text, flow, &format!("l{i}_{k}"));
    }
}

/// Writes bonds from the velocities through the transformers to a flow's 1-junction.
fn transformers(text: &mut String, flow: &Flow, one: &str) {
    let sum = format!("{one}_sum");
    for t in &flow.transformers {
        let own = format!("{one}_t{}", t.velocity);
        bond(
            text,
            1,
            &format!("v{}", t.velocity),
            &own,
            Some(BondEnd::Tail),
            false,
        );
        let target = if flow.sums() { &sum } else { one };
        bond(text, 1, &own, target, Some(BondEnd::Tail), flow.is_vector());
    }
    if flow.sums() {
        bond(text, 1, &sum, one, Some(BondEnd::Tail), flow.is_vector());
    }
}

fn words(t: &Transformer) -> String {
    match t.varies.as_str() {
        "" => format!("{}\n{}", t.symbol(), t.vector()),
        varies => format!("{}\n{}\n{varies}", t.symbol(), t.vector()),
    }
}

/// Writes a port of a junction, and the nodes behind it.
fn one_port(text: &mut String, port: &Port, junction: &str, own: &str, triple: bool) {
    let words = match port.symbol {
        sign @ ("0" | "1") => format!("{sign}\n{}", port.text).trim_end().to_owned(),
        symbol => format!("{symbol}: {}", port.text),
    };
    let more = port.more.iter().map(|more| format!("\n{more}"));
    let indent = if triple { 2 } else { 1 };
    node(text, indent, own, &(words + &more.collect::<String>()));
    let stroke = |on: bool| {
        if on == port.feeds {
            BondEnd::Head
        } else {
            BondEnd::Tail
        }
    };
    let stroke = port.on_junction.map(stroke);
    match port.feeds {
        true => bond(text, indent, own, junction, stroke, triple),
        false => bond(text, indent, junction, own, stroke, triple),
    }
    for (k, behind) in port.ports.iter().enumerate() {
        one_port(text, behind, own, &format!("{own}_{k}"), triple);
    }
}

fn node(text: &mut String, indent: usize, name: &str, words: &str) {
    let indent = "  ".repeat(indent);
    writeln!(text, "{indent}{name} [label={}];", quoted(words)).expect("text");
}

/// An end of a bond.
#[derive(Clone, Copy, PartialEq, Eq)]
enum BondEnd {
    Tail,
    Head,
}

/// Writes a bond with its half arrow at `to` and its causal stroke at one end.
fn bond(
    text: &mut String,
    indent: usize,
    from: &str,
    to: &str,
    stroke: Option<BondEnd>,
    triple: bool,
) {
    let mut style = vec![match stroke {
        Some(BondEnd::Head) => "arrowhead=teelvee",
        _ => "arrowhead=lvee",
    }];
    if stroke == Some(BondEnd::Tail) {
        style.extend(["dir=both", "arrowtail=tee"]);
    }
    if triple {
        style.push("color=\"black:black\"");
    }
    let indent = "  ".repeat(indent);
    writeln!(text, "{indent}{from} -> {to} [{}];", style.join(", ")).expect("text");
}

/// Returns a text in quotes, its lines one below the other.
fn quoted(text: &str) -> String {
    let text = text.replace('\\', "\\\\").replace('"', "\\\"");
    format!("\"{}\"", text.replace('\n', "\\n"))
}
