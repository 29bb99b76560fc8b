//! The fluid of nodes: which one it is, its pressure, and the law of a volume that it fills.

use bgdyn_runtime::Dd;

use super::keys::{BULK_MODULUS, FLUID, FLUID_KEYWORD, VACUUM};
use crate::bond_graph::{BondNetwork, GraphNodeId, NodeKind};
use crate::declaration::{Beside, Element};
use crate::expr::Ex;
use crate::fault::{Faults, wording};
use crate::format::Dimension;
use crate::laws::Laws;
use crate::layout::{Entered, Layout};

// What nodes and elements share

/// Of a node: p, Pa.
pub(super) const PRESSURE: &str = "pressure";
/// Of a node: h, J/m³.
pub(super) const ENTHALPY: &str = "enthalpy";
/// Of a volume: W/V.
pub(super) const DENSITY: &str = "density";
/// Of a volume: V, m³.
pub(super) const VOLUME: &str = "volume";
/// Of a supply or a tank: that it gives and takes what runs.
pub(super) const SOURCE: &str = "source";
/// Of an element in a chain: its flow, m³/s.
pub(super) const FLOW: &str = "flow";

// Fluids

/// The fluid of a node: the one it names, or the only one.
pub(super) fn fluid_of<'a>(node: &Element, elements: &'a [Element]) -> Option<&'a Element> {
    let mut fluids = elements
        .iter()
        .filter(|e| e.effect.keyword() == FLUID_KEYWORD);
    match node.name(FLUID.name) {
        Some(name) => fluids.find(|f| f.name == name),
        None => fluids.next().filter(|_| fluids.next().is_none()),
    }
}

/// Refuses a node without a fluid.
pub(super) fn has_fluid(node: &Element, beside: &Beside<'_>, faults: &mut Faults) {
    if fluid_of(node, beside.elements).is_some() {
        return;
    }
    let all = beside.elements.iter();
    let fluids = all.filter(|e| e.effect.keyword() == FLUID_KEYWORD);
    let known: Vec<&str> = fluids.map(|fluid| fluid.name.as_str()).collect();
    let asked = node.name(FLUID.name);
    faults.push(wording::no_fluid(&node.place, &node.name, asked, &known));
}

/// Refuses an element between nodes of different fluids.
pub(super) fn one_fluid(element: &Element, beside: &Beside<'_>, faults: &mut Faults) {
    let owner = |node: &&str| {
        let mut all = beside.elements.iter();
        all.find(|e| e.nodes().iter().any(|own| own == node))
    };
    let joined = element.joins();
    let fluids = joined.iter().filter_map(owner);
    let mut names: Vec<&str> = fluids
        .filter_map(|node| fluid_of(node, beside.elements))
        .map(|fluid| fluid.name.as_str())
        .collect();
    names.dedup();
    if let [one, other, ..] = names[..] {
        let (place, name) = (&element.place, &element.name);
        faults.push(wording::two_fluids(place, name, [one, other]));
    }
}

/// β of a node's fluid.
pub(super) fn bulk_modulus<'g>(node: &Element, laws: &Laws<'g, '_>) -> Ex<'g> {
    let fluid = fluid_of(node, laws.elements());
    fluid.map_or(laws.b.number(1.0), |f| laws.number(f, &BULK_MODULUS))
}

/// The 0-junction of a volume's pressure with the compliance of its fluid; `volume` is its text.
pub(super) fn add_volume(
    element: &Element,
    node: &str,
    volume: Option<String>,
    scene: &[Element],
    network: &mut BondNetwork,
) -> GraphNodeId {
    let fluid = fluid_of(element, scene).map_or("fluid", |fluid| &fluid.name);
    let volume = volume.map_or(String::new(), |v| format!(", {v}"));
    let pressure = network.add_pressure(node);
    network.add_on(
        pressure,
        NodeKind::Compliance,
        format!("{fluid} in {node}{volume}"),
    );
    pressure
}

/// The state of a volume of fluid.
pub(super) fn declare_volume(node: &str, layout: &mut Layout) {
    let about = format!("volume at reference density of the fluid in `{node}`");
    let entered = Entered {
        dimension: Dimension::Pressure,
        least: Dd::from_f64(VACUUM),
        way_out: "write its pressure, against the surroundings; less than a vacuum there is none",
    };
    layout.state_entered(node.to_owned(), Dimension::Volume, about, entered);
}

/// The law of a volume V of fluid; its pressure.
pub(super) fn fill<'g>(
    element: &Element,
    node: &str,
    volume: Ex<'g>,
    laws: &mut Laws<'g, '_>,
) -> Ex<'g> {
    let bulk = bulk_modulus(element, laws);
    let reference = laws.state(node);
    let one = laws.b.number(1.0);
    let density = (reference / volume).named(|| format!("density_{node}"));
    let pressure = (bulk * density.ln()).named(|| format!("p_{node}"));
    laws.share(node, PRESSURE, pressure);
    laws.share(node, DENSITY, density);
    laws.share(node, ENTHALPY, bulk * (density - one));
    laws.share(node, VOLUME, volume);
    laws.store(bulk * (reference - volume) - pressure * volume);
    read_pressure(node, pressure, laws);
    pressure
}

/// W = V e^{p/β}
pub(super) fn filled<'g>(
    element: &Element,
    laws: &Laws<'g, '_>,
    node: &str,
    pressure: Ex<'g>,
) -> Ex<'g> {
    let volume = laws.shared(node, VOLUME).unwrap_or(laws.b.number(1.0));
    volume * (pressure / bulk_modulus(element, laws)).exp()
}

/// h = β (e^{p/β} − 1)
pub(super) fn enthalpy<'g>(element: &Element, pressure: Ex<'g>, laws: &Laws<'g, '_>) -> Ex<'g> {
    let bulk = bulk_modulus(element, laws);
    bulk * ((pressure / bulk).exp() - laws.b.number(1.0))
}

pub(super) fn read_pressure<'g>(node: &str, pressure: Ex<'g>, laws: &mut Laws<'g, '_>) {
    let about = format!("pressure in `{node}`, Pa");
    laws.reading(format!("{node}_pressure"), pressure, "Pa", about);
}

/// The pressure of a node.
pub(super) fn pressure<'g>(node: &str, laws: &Laws<'g, '_>) -> Ex<'g> {
    laws.shared(node, PRESSURE).unwrap_or(laws.b.zero())
}
