//! Bond graph nodes that several effects add in the same way, and their texts.

use super::keys::{AT, INERTIA, RATIO, REFERENCE};
use crate::bond_graph::{BondNetwork, GraphNodeId, NodeKind, PortSite, PowerTerm};
use crate::declaration::{Element, undeclared};
use crate::format::Key;

/// Returns the label of an element: `seal (viscous)`.
pub(super) fn label(element: &Element) -> String {
    format!("{} ({})", element.name, element.effect.keyword())
}

/// Returns a number in the file's text: `R = 0.6 ohm`.
pub(super) fn number(element: &Element, symbol: &str, key: &Key) -> String {
    format!("{symbol} = {}", element.written(key).unwrap_or_default())
}

/// Returns the 1-junction of the flow that the element acts on: of its `joint`, or of the line between its
/// two sites.
pub(super) fn port(element: &Element, network: &mut BondNetwork) -> GraphNodeId {
    match element.ends() {
        Some(ends) => network.port(PortSite::Line(ends.clone())),
        None => {
            let joint = element.joint();
            network.velocity(joint.unwrap_or_else(|| undeclared(element, "port", "joint")))
        }
    }
}

/// Returns the 1-junction of the motion of the element's site.
pub(super) fn site(element: &Element, network: &mut BondNetwork) -> GraphNodeId {
    let name = element.needed_name(&AT).to_owned();
    network.port(PortSite::Site(name))
}

/// Returns the 1-junction of the relative velocity at the element's contact.
pub(super) fn contact(element: &Element, network: &mut BondNetwork) -> GraphNodeId {
    let name = element.contact();
    let name = name.unwrap_or_else(|| undeclared(element, "port", "contact"));
    network.port(PortSite::Contact(name.to_owned()))
}

/// Adds a resistor or a compliance at the element's port.
pub(super) fn add_at_port(
    element: &Element,
    kind: NodeKind,
    network: &mut BondNetwork,
) -> GraphNodeId {
    let port = port(element, network);
    network.add_on(port, kind, label(element))
}

/// Adds a resistor or a compliance at the port of an element that may have a reference. With a moving reference it
/// acts on the difference of the two flows.
pub(super) fn add_acting(
    element: &Element,
    kind: NodeKind,
    network: &mut BondNetwork,
) -> GraphNodeId {
    let Some(reference) = element.name(&REFERENCE) else {
        return add_at_port(element, kind, network);
    };
    let port = port(element, network);
    let flow = match element.joint() {
        Some(_) => "q̇",
        None => "ṡ",
    };
    let zero = network.add(NodeKind::Zero, "");
    network.bond(port, zero);
    let difference = network.add(NodeKind::One, format!("{flow} − {reference}"));
    network.bond(zero, difference);
    let acting = network.add_on(difference, kind, label(element));
    let moving = network.add(NodeKind::FlowSource, format!("rate of {reference}"));
    network.bond(zero, moving);
    acting
}

/// Adds the store of a rotor behind its gear, N² J, to a junction.
pub(super) fn add_rotor(
    element: &Element,
    junction: GraphNodeId,
    network: &mut BondNetwork,
) -> GraphNodeId {
    let inertia = number(element, "J", &INERTIA);
    let text = match element.written(&RATIO) {
        Some(ratio) => format!("N²J of {}, {inertia}, N = {ratio}", element.name),
        None => format!("{}, {inertia}", element.name),
    };
    network.add_on(junction, NodeKind::Inertia, text)
}

/// Returns the power terms of a gear that may have the efficiency of this key.
pub(super) fn gear_losses(element: &Element, efficiency: &Key) -> &'static [PowerTerm] {
    match element.quantity(efficiency) {
        Some(_) => &[PowerTerm::Dissipated],
        None => &[],
    }
}

/// Adds a resistor between two hydraulic nodes.
pub(super) fn add_pipe(text: String, [from, to]: [&str; 2], network: &mut BondNetwork) {
    let flow = network.add(NodeKind::One, "q");
    network.add_on(flow, NodeKind::Resistor, text);
    let [from, to] = [from, to].map(|node| network.pressure(node));
    network.bond(from, flow);
    network.bond(flow, to);
}
