//! Adds a scene's effects to the drawing: nodes at joints, and flows along lines and at sites of links.

use bgdyn_codegen::bond_graph::{BondGraph, BondNetwork, GraphNode, NodePart, PlacePort, PortSite};
use bgdyn_codegen::system::SceneEquations;

use super::chart::{Chart, ChartLink, Component, Flow, Transformer};
use super::chart_of_graph::drive;
use super::notation::{coordinates, subscript};
use super::unfold::Unfolding;

impl Chart {
    /// Returns the drawing of a scene.
    pub(crate) fn of_scene(system: &SceneEquations) -> Self {
        let (scene, network) = (&system.scene, &system.network);
        let graph = system.graph.of_all_joints();
        let drive = |part: &NodePart| drive(graph, &scene.layout.prescribed, part);
        let mut unfolding = Unfolding::new(network, &drive);
        let description = scene.description.as_deref();
        let mut chart = Chart::of_graph(graph, &mut unfolding, &scene.name, description);
        chart.add_ports(graph, network, &mut unfolding);
        if !graph.velocity_products && chart.varies() {
            let note = "The rates of the transformers are left out: no velocity products.";
            chart.notes.push(note.into());
        }
        let missing = not_met(system, &unfolding);
        if !missing.is_empty() {
            let names = missing.join(", ");
            chart.notes.push(format!("Not drawn: {names}."));
        }
        chart
    }

    /// Adds the flows along lines, at sites of links, of loops, and at contacts.
    pub(super) fn add_ports(
        &mut self,
        graph: &BondGraph,
        network: &BondNetwork,
        unfolding: &mut Unfolding<'_>,
    ) {
        let chart = self;
        let (mut lines, mut sites, mut loops, mut contacts) = (0, 0, 0, 0);
        for port in network.ports.iter().filter(|p| !p.coordinates.is_empty()) {
            let own = unfolding.ports_of(port.junction);
            let (name, symbol, partial, all) = match &port.site {
                PortSite::Line([a, b]) => {
                    lines += 1;
                    let n = subscript(lines);
                    let name = format!("{a} – {b}, m/s");
                    (name, format!("ṡ{n}"), format!("∂s{n}/∂q"), &mut chart.lines)
                }
                PortSite::Site(site) => {
                    sites += 1;
                    let n = subscript(sites);
                    let name = format!("{site}, rad/s and m/s");
                    (
                        name,
                        format!("V{n}"),
                        format!("J{n} of q"),
                        &mut chart.sites,
                    )
                }
                PortSite::Loop(name) => {
                    loops += 1;
                    let n = subscript(loops);
                    let name = format!("loop {name}, rad/s and m/s");
                    (name, format!("ċ{n}"), format!("∂c{n}/∂q"), &mut chart.loops)
                }
                PortSite::Contact(name) => {
                    contacts += 1;
                    let n = subscript(contacts);
                    let name = format!("contact {name}, m/s");
                    (
                        name,
                        format!("γ{n}"),
                        format!("∂γ{n}/∂q̇"),
                        &mut chart.contacts,
                    )
                }
            };
            let names = chart.velocities.iter().map(|v| v.name.as_str());
            let flow = Flow {
                symbol,
                transformers: transformers(graph, names, port, &partial),
                ports: own,
            };
            all.push(ChartLink {
                name,
                velocities: Vec::new(),
                flows: vec![flow],
            });
        }
    }
}

/// Returns the elements with nodes, none of which was visited.
fn not_met<'a>(system: &'a SceneEquations, unfolding: &Unfolding<'_>) -> Vec<&'a str> {
    let network = &system.network;
    let elements = system.scene.elements.iter().enumerate();
    let missing = elements.filter(|(at, _)| {
        let is_own = |node: &GraphNode| node.part == NodePart::Effect && node.element == Some(*at);
        let mut own = network
            .ids()
            .filter(|id| is_own(&network.nodes[id.0]))
            .peekable();
        own.peek().is_some() && own.all(|id| !unfolding.has_met(id))
    });
    missing.map(|(_, e)| e.name.as_str()).collect()
}

/// Returns the transformers from the velocities that change a flow, in the order of the drawing.
fn transformers<'a>(
    graph: &BondGraph,
    names: impl Iterator<Item = &'a str>,
    port: &PlacePort,
    partial: &str,
) -> Vec<Transformer> {
    let numbers: Vec<usize> = port.coordinates.iter().map(|j| j.0 + 1).collect();
    let from = |(place, name): (usize, &str)| {
        let j = graph.coordinate_named(name)?;
        port.coordinates.contains(&j).then(|| Transformer {
            velocity: place,
            name: format!("{partial}{}", subscript(j.0 + 1)),
            modulus: vec![Component::Varying],
            varies: coordinates(&numbers),
        })
    };
    names.enumerate().filter_map(from).collect()
}
