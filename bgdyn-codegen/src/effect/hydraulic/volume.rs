//! The fluid of hydraulic nodes, their pressure, and the law of a volume of fluid.

use bgdyn_runtime::Dd;

use super::keys::{BULK_MODULUS, FLUID, FLUID_KEYWORD, VACUUM};
use crate::bond_graph::{BondNetwork, GraphNodeId, NodeKind};
use crate::declaration::{Element, SceneContext};
use crate::effort_sums::EffortSums;
use crate::expr::Expr;
use crate::fault::{Faults, Help, wording};
use crate::format::Dimension;
use crate::layout::{InitialValueAs, StateLayout};

// Names of the values that nodes and elements share

/// Of a node: p, Pa.
pub(super) const PRESSURE: &str = "pressure";
/// Of a node: h, J/m³.
pub(super) const ENTHALPY: &str = "enthalpy";
/// Of a volume: W/V.
pub(super) const DENSITY: &str = "density";
/// Of a volume: V, m³.
pub(super) const VOLUME: &str = "volume";
/// Of a supply or a tank: marks a source.
pub(super) const SOURCE: &str = "source";
/// Of an element in a chain: its flow, m³/s.
pub(super) const FLOW: &str = "flow";

// Fluids

/// Returns the fluid of a node: the one it names, or the only one.
pub(super) fn fluid_of<'a>(node: &Element, elements: &'a [Element]) -> Option<&'a Element> {
    let mut fluids = elements
        .iter()
        .filter(|e| e.effect.keyword() == FLUID_KEYWORD);
    match node.name(&FLUID) {
        Some(name) => fluids.find(|f| f.name == name),
        None => fluids.next().filter(|_| fluids.next().is_none()),
    }
}

/// Refuses a node without a fluid.
pub(super) fn has_fluid(node: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
    if fluid_of(node, beside.elements).is_some() {
        return;
    }
    let all = beside.elements.iter();
    let fluids = all.filter(|e| e.effect.keyword() == FLUID_KEYWORD);
    let known: Vec<&str> = fluids.map(|fluid| fluid.name.as_str()).collect();
    let asked = node.name(&FLUID);
    faults.push(wording::no_fluid(&node.location, &node.name, asked, &known));
}

/// Refuses an element between nodes of different fluids.
pub(super) fn one_fluid(element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
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
        let (location, name) = (&element.location, &element.name);
        faults.push(wording::two_fluids(location, name, [one, other]));
    }
}

/// Returns β of a node's fluid.
pub(super) fn bulk_modulus<'g>(node: &Element, sums: &EffortSums<'g, '_>) -> Expr<'g> {
    let fluid = fluid_of(node, sums.elements());
    fluid.map_or(sums.b.number(1.0), |f| sums.number(f, &BULK_MODULUS))
}

/// Adds the 0-junction of a volume's pressure with the compliance of its fluid; `volume` is its text.
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

/// Declares the state of a volume of fluid.
pub(super) fn declare_volume(node: &str, layout: &mut StateLayout) {
    let about = format!("volume at reference density of the fluid in `{node}`");
    let entered = InitialValueAs {
        dimension: Dimension::Pressure,
        least: Dd::from_f64(VACUUM),
        way_out: Help::PressureAboveVacuum.text(),
    };
    layout.state_entered(node.to_owned(), Dimension::Volume, about, entered);
}

/// Adds the law of a volume V of fluid, and returns its pressure.
pub(super) fn fill<'g>(
    element: &Element,
    node: &str,
    volume: Expr<'g>,
    sums: &mut EffortSums<'g, '_>,
) -> Expr<'g> {
    let bulk = bulk_modulus(element, sums);
    let reference = sums.state(node);
    let one = sums.b.number(1.0);
    let density = (reference / volume).named(|| format!("density_{node}"));
    let pressure = (bulk * density.ln()).named(|| format!("p_{node}"));
    sums.share(node, PRESSURE, pressure);
    sums.share(node, DENSITY, density);
    sums.share(node, ENTHALPY, bulk * (density - one));
    sums.share(node, VOLUME, volume);
    sums.store(bulk * (reference - volume) - pressure * volume);
    read_pressure(node, pressure, sums);
    pressure
}

/// Returns W = V e^{p/β}.
pub(super) fn filled<'g>(
    element: &Element,
    sums: &EffortSums<'g, '_>,
    node: &str,
    pressure: Expr<'g>,
) -> Expr<'g> {
    let volume = sums.shared(node, VOLUME).unwrap_or(sums.b.number(1.0));
    volume * (pressure / bulk_modulus(element, sums)).exp()
}

/// Returns h = β (e^{p/β} − 1).
pub(super) fn enthalpy<'g>(
    element: &Element,
    pressure: Expr<'g>,
    sums: &EffortSums<'g, '_>,
) -> Expr<'g> {
    let bulk = bulk_modulus(element, sums);
    bulk * ((pressure / bulk).exp() - sums.b.number(1.0))
}

pub(super) fn read_pressure<'g>(node: &str, pressure: Expr<'g>, sums: &mut EffortSums<'g, '_>) {
    let about = format!("pressure in `{node}`, Pa");
    sums.reading(format!("{node}_pressure"), pressure, "Pa", about);
}

/// Returns the pressure of a node.
pub(super) fn pressure<'g>(node: &str, sums: &EffortSums<'g, '_>) -> Expr<'g> {
    sums.shared(node, PRESSURE).unwrap_or(sums.b.zero())
}
