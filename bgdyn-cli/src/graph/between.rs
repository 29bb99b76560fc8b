//! Drawing of elements that act along the line between two points: springs, dampers, cylinders.
//!
//! The rate ṡ of the line's length is a flow as a link's are: Σ_j ∂s/∂q_j q̇_j, over the joints on the
//! way from one place to the other.

use std::collections::BTreeSet;

use bgdyn_codegen::bond_graph::BondGraph;
use bgdyn_codegen::declaration::Element;
use bgdyn_codegen::mechanism::{CoordinateId, LinkId};
use bgdyn_codegen::system::System;

use super::chart::{Chart, Component, Flow, Link, Port, Transformer};
use super::fluid::Fluid;
use super::notation::{coordinates, subscript};

/// Whether an element acts along a line and can be drawn there.
pub(super) fn is_drawn(element: &Element) -> bool {
    let known = ["R", "C", "TF"].contains(&element.effect.symbol());
    known && element.names("between").is_some()
}

/// The lines of a scene, elements between the same places on one.
pub(super) fn lines(chart: &Chart, system: &System, fluid: &mut Fluid<'_>) -> Vec<Link> {
    let elements = || system.scene.elements.iter().filter(|e| is_drawn(e));
    let mut all: Vec<&[String; 2]> = Vec::new();
    for ends in elements().filter_map(|e| e.names("between")) {
        if !all.contains(&ends) {
            all.push(ends);
        }
    }
    let mut drawn = Vec::new();
    for (k, ends) in all.into_iter().enumerate() {
        let own = elements().filter(|e| e.names("between") == Some(ends));
        let ports: Vec<Port> = own.flat_map(|e| ports(e, fluid)).collect();
        let flow = Flow {
            symbol: format!("ṡ{}", subscript(k + 1)),
            transformers: transformers(chart, &system.graph, ends, &subscript(k + 1)),
            ports,
        };
        drawn.push(Link {
            name: format!("{} – {}, m/s", ends[0], ends[1]),
            velocities: Vec::new(),
            flows: vec![flow],
        });
    }
    drawn
}

/// What an element is on the junction of its line.
fn ports(element: &Element, fluid: &mut Fluid<'_>) -> Vec<Port> {
    let named = format!("{} ({})", element.name, element.effect.keyword());
    match element.effect.symbol() {
        "TF" => fluid.sides(element),
        symbol => vec![Port::taking(symbol, named)],
    }
}

/// From the velocities on the way between the places.
fn transformers(
    chart: &Chart,
    graph: &BondGraph,
    ends: &[String; 2],
    line: &str,
) -> Vec<Transformer> {
    let [one, other] = ends.each_ref().map(|place| moving(graph, place));
    let path: BTreeSet<CoordinateId> = one.symmetric_difference(&other).copied().collect();
    let numbers: Vec<usize> = path.iter().map(|j| j.0 + 1).collect();
    let from = |(place, name): (usize, &str)| {
        let j = graph.coordinate_named(name).filter(|j| path.contains(j))?;
        Some(Transformer {
            velocity: place,
            name: format!("∂s{line}/∂q{}", subscript(j.0 + 1)),
            modulus: vec![Component::Varying],
            varies: coordinates(&numbers),
        })
    };
    let names = chart.velocities.iter().map(|v| v.name.as_str());
    names.enumerate().filter_map(from).collect()
}

/// The coordinates that move a place.
fn moving(graph: &BondGraph, place: &str) -> BTreeSet<CoordinateId> {
    let site = graph.sites.iter().find(|site| site.name == place);
    let mut link: Option<LinkId> = site.and_then(|site| site.link);
    let mut found = BTreeSet::new();
    while let Some(LinkId(i)) = link {
        found.extend(graph.frames[i].coordinate);
        link = graph.frames[i].parent;
    }
    found
}
