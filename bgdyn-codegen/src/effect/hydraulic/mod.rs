//! Hydraulics: nodes with a pressure (supplies, tanks, line volumes, sides of cylinders, junctions)
//! and resistors that let fluid run between them, joined by name.
//!
//! The fluid has a constant bulk modulus β: its density is ρ = ρ₀ e^{p/β} (Merritt, Hydraulic
//! Control Systems, 1967, chapter 2), pressures measured against the surroundings. The state of a
//! volume V is the volume W that its fluid would fill at the reference density ρ₀, so p = β ln(W/V)
//! however V changes. A volume flow q carries Ẇ = q W/V: that is ṗ = β (q − V̇)/V.
//!
//! The fluid stores E = β (W − V) − p V. From ∂E/∂W = β (1 − V/W) and ∂E/∂V = −p follows
//! Ė = h q − p V̇ with h = β (W/V − 1) = β (e^{p/β} − 1), the enthalpy that a flow carries per volume.
//! So a resistor between nodes of pressures p₁ and p₂ dissipates (h₁ − h₂) q, which is never negative
//! as long as q has the sign of p₁ − p₂, and a source of pressure supplies h q. A resistor passes the
//! same volume at both ends, as hydraulics are usually written.

mod cylinder;
mod fluid;
mod four_way_valve;
mod junction;
mod leakage;
mod line;
mod orifice;
mod source;

use bgdyn_runtime::Dd;

use crate::declaration::Chain;
use crate::declaration::{Beside, Element, Given};
use crate::expr::{Builder, Ex};
use crate::fault::{Fault, Faults};
use crate::laws::Laws;
use crate::layout::{Entered, Layout};
use crate::spec::{Dimension, Key, Reads};
pub(super) use cylinder::Cylinder;
pub(super) use fluid::Fluid;
pub(super) use four_way_valve::FourWayValve;
pub(super) use junction::Junction;
pub(super) use leakage::Leakage;
pub(super) use line::Line;
pub(super) use orifice::Orifice;
pub(super) use source::{Supply, Tank};

/// The word by which a scene calls for all of it.
const FAMILY: &str = "hydraulics";

// What nodes and elements share

/// Of a node: p, Pa.
const PRESSURE: &str = "pressure";
/// Of a node: h, J/m³.
const ENTHALPY: &str = "enthalpy";
/// Of a volume: W/V.
const DENSITY: &str = "density";
/// Of a volume: V, m³.
const VOLUME: &str = "volume";
/// Of a supply or a tank: that it gives and takes what runs.
const SOURCE: &str = "source";
/// Of an element in a chain: its flow, m³/s.
const FLOW: &str = "flow";

/// The fluid of a node.
const FLUID: Key = Key {
    name: "fluid",
    reads: Reads::Word(&[]),
    needed: false,
    about: "name of its fluid; needed where the scene has several",
};

const fn node(name: &'static str, about: &'static str) -> Key {
    Key {
        name,
        reads: Reads::Node,
        needed: true,
        about,
    }
}

const fn number(
    name: &'static str,
    fit: &'static [Dimension],
    needed: bool,
    about: &'static str,
) -> Key {
    Key {
        name,
        reads: Reads::Number(fit),
        needed,
        about,
    }
}

/// The two nodes of a resistor.
const FROM: Key = node("from", "the node that a positive flow leaves");
const TO: Key = node("to", "the node that a positive flow enters");
/// The two numbers of an orifice's law.
const ORIFICE: Key = number(
    "flow",
    &[Dimension::OrificeFlow],
    true,
    "k, flow per root of the pressure drop when fully open",
);
const LAMINAR: Key = number(
    "resistance",
    &[Dimension::FlowResistance],
    false,
    "R, pressure drop per flow where the flow is small; 0 without it, and then dq/dΔp is infinite at Δp = 0",
);

/// The least pressure there is, against the surroundings: no fluid, Pa.
const VACUUM: f64 = -101_325.0;

/// Refuses what is called a pressure but less than a vacuum.
fn no_less_than_vacuum(given: &mut Given<'_>, key: &str) {
    let too_small = given
        .number(key)
        .filter(|q| q.value < Dd::from_f64(VACUUM))
        .map(|q| (q.place.clone(), q.text.clone()));
    if let Some((place, text)) = too_small {
        let message = format!("`{key}` is {text}, less than a vacuum: {VACUUM} Pa");
        let help = "pressures are measured against the surroundings";
        given.fault(&place, "effect-pressure", message, help);
    }
}

/// Refuses an element that joins a node to itself.
fn joins_two(given: &mut Given<'_>, one: &str, other: &str) {
    let (a, b) = (given.element.name(one), given.element.name(other));
    if let Some(node) = a.filter(|_| a == b) {
        let message = format!("`{one}` and `{other}` are the same node, `{node}`: nothing runs");
        let place = given.element.place.clone();
        given.fault(&place, "joined-to-nothing", message, "join two nodes");
    }
}

// Fluids

/// The fluid of a node: the one it names, or the only one.
fn fluid_of<'a>(node: &Element, elements: &'a [Element]) -> Option<&'a Element> {
    let mut fluids = elements
        .iter()
        .filter(|e| e.effect.keyword() == fluid::KEYWORD);
    match node.name(FLUID.name) {
        Some(name) => fluids.find(|f| f.name == name),
        None => fluids.next().filter(|_| fluids.next().is_none()),
    }
}

/// Refuses a node without a fluid.
fn has_fluid(node: &Element, beside: &Beside<'_>, faults: &mut Faults) {
    if fluid_of(node, beside.elements).is_some() {
        return;
    }
    let all = beside.elements.iter();
    let fluids = all.filter(|e| e.effect.keyword() == fluid::KEYWORD);
    let known: Vec<String> = fluids.map(|f| format!("`{}`", f.name)).collect();
    let name = &node.name;
    let message = match (node.name(FLUID.name), known.as_slice()) {
        (_, []) => format!("`{name}` has no fluid: the scene calls for none"),
        (Some(fluid), _) => format!("no fluid of this scene is called `{fluid}`"),
        (None, several) => format!("which of the fluids {} is in `{name}`?", several.join(", ")),
    };
    let help = match known.as_slice() {
        [] => {
            "add `oil: { type: fluid, bulk_modulus: … }` and call for it: `- hydraulics` calls for all of it".to_owned()
        }
        known => format!("write `fluid: …`: one of {}", known.join(", ")),
    };
    faults.push(Fault::new(&node.place, "no-fluid", message).with_help(help));
}

/// Refuses an element between nodes of different fluids.
fn one_fluid(element: &Element, beside: &Beside<'_>, faults: &mut Faults) {
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
        let name = &element.name;
        let message = format!("`{name}` joins `{one}` and `{other}`: two fluids");
        let fault = Fault::new(&element.place, "two-fluids", message);
        faults.push(fault.with_help("join nodes of one fluid"));
    }
}

/// β of a node's fluid.
fn bulk_modulus<'g>(node: &Element, laws: &Laws<'g, '_>) -> Ex<'g> {
    let fluid = fluid_of(node, laws.elements());
    fluid.map_or(laws.b.number(1.0), |f| laws.number(f, &fluid::BULK_MODULUS))
}

// Nodes

/// The state of a volume of fluid.
fn declare_volume(node: &str, layout: &mut Layout) {
    let about = format!("volume at reference density of the fluid in `{node}`");
    let entered = Entered {
        dimension: Dimension::Pressure,
        least: Dd::from_f64(VACUUM),
        way_out: "write its pressure, against the surroundings; less than a vacuum there is none",
    };
    layout.state_entered(node.to_owned(), Dimension::Volume, about, entered);
}

/// The law of a volume V of fluid; its pressure.
fn fill<'g>(element: &Element, node: &str, volume: Ex<'g>, laws: &mut Laws<'g, '_>) -> Ex<'g> {
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
fn filled<'g>(element: &Element, laws: &Laws<'g, '_>, node: &str, pressure: Ex<'g>) -> Ex<'g> {
    let volume = laws.shared(node, VOLUME).unwrap_or(laws.b.number(1.0));
    volume * (pressure / bulk_modulus(element, laws)).exp()
}

/// h = β (e^{p/β} − 1)
fn enthalpy<'g>(element: &Element, pressure: Ex<'g>, laws: &Laws<'g, '_>) -> Ex<'g> {
    let bulk = bulk_modulus(element, laws);
    bulk * ((pressure / bulk).exp() - laws.b.number(1.0))
}

fn read_pressure<'g>(node: &str, pressure: Ex<'g>, laws: &mut Laws<'g, '_>) {
    let about = format!("pressure in `{node}`, Pa");
    laws.reading(format!("{node}_pressure"), pressure, "Pa", about);
}

/// The pressure of a node.
fn pressure<'g>(node: &str, laws: &Laws<'g, '_>) -> Ex<'g> {
    laws.shared(node, PRESSURE).unwrap_or(laws.b.zero())
}

// Flows

/// Lets the flow q run from one node to another: what each of them and what the resistor makes of
/// it.
fn run<'g>(from: &str, to: &str, q: Ex<'g>, laws: &mut Laws<'g, '_>) {
    let zero = laws.b.zero();
    let [before, after] = [from, to].map(|node| laws.shared(node, ENTHALPY).unwrap_or(zero));
    laws.dissipate((before - after) * q);
    for (node, into, enthalpy) in [(from, -q, before), (to, q, after)] {
        if let Some(density) = laws.shared(node, DENSITY) {
            laws.flow(node, into * density);
        } else if laws.shared(node, SOURCE).is_some() {
            laws.supply_by(node, -(enthalpy * into));
        }
    }
}

/// The pressure drop of a resistor, Δp = R q + q|q|/k².
#[derive(Clone, Copy)]
struct Drop<'g> {
    /// R, Pa·s/m³
    laminar: Ex<'g>,
    /// k, m³/(s·√Pa); none where the law is linear.
    orifice: Option<Ex<'g>>,
}

impl<'g> Drop<'g> {
    /// Of an orifice or a leakage.
    fn of(element: &Element, laws: &Laws<'g, '_>) -> Self {
        let keys = element.effect.keys();
        match keys.contains(&leakage::CONDUCTANCE) {
            true => Drop {
                laminar: laws.b.number(1.0) / laws.number(element, &leakage::CONDUCTANCE),
                orifice: None,
            },
            false => Drop {
                laminar: laws.number(element, &LAMINAR),
                orifice: laws.optional(element, &ORIFICE),
            },
        }
    }

    /// Of several in series: R = Σ R_i, 1/k² = Σ 1/k_i².
    fn in_series(all: &[Self], b: &'g Builder) -> Self {
        let one = b.number(1.0);
        let laminar = all.iter().fold(b.zero(), |sum, d| sum + d.laminar);
        let squares = all.iter().filter_map(|d| d.orifice);
        let sum = squares.map(|k| one / (k * k)).reduce(|sum, s| sum + s);
        let orifice = sum.map(|sum| one / sum.sqrt());
        Drop { laminar, orifice }
    }

    /// Δp of a flow.
    fn of_flow(self, q: Ex<'g>) -> Ex<'g> {
        let laminar = self.laminar * q;
        match self.orifice {
            Some(k) => laminar + q * q.abs() / (k * k),
            None => laminar,
        }
    }

    /// The flow of a pressure drop: q = 2 Δp / (R + √(R² + 4|Δp|/k²)).
    fn flow(self, drop: Ex<'g>, b: &'g Builder) -> Ex<'g> {
        let r = self.laminar;
        match self.orifice {
            None => drop / r,
            Some(k) if r.is_zero() => k * drop.sign() * drop.abs().sqrt(),
            Some(k) => {
                let root = (r * r + b.number(4.0) * drop.abs() / (k * k)).sqrt();
                b.number(2.0) * drop / (r + root)
            }
        }
    }
}

/// Solves the chain through a junction, if no other junction of it has: one flow, from the pressures
/// at its two ends, and the pressures between.
fn solve(junction: &Element, laws: &mut Laws<'_, '_>) {
    let through = |c: &&Chain| c.through.contains(&junction.name);
    let Some(chain) = laws.chains().iter().find(through) else {
        return;
    };
    if laws.shared(&junction.name, PRESSURE).is_some() {
        return;
    }
    let members: Vec<(&Element, bool)> = chain
        .members
        .iter()
        .map(|&(i, forward)| (&laws.elements()[i], forward))
        .collect();
    let drops: Vec<Drop<'_>> = members.iter().map(|(e, _)| Drop::of(e, laws)).collect();
    let mut at = pressure(&chain.from, laws);
    let whole = at - pressure(&chain.to, laws);
    let q = Drop::in_series(&drops, laws.b).flow(whole, laws.b);
    for (i, &(element, forward)) in members.iter().enumerate() {
        laws.share(&element.name, FLOW, if forward { q } else { -q });
        at = at - drops[i].of_flow(q);
        if let Some(node) = chain.through.get(i) {
            laws.share(node, PRESSURE, at);
            laws.share(node, ENTHALPY, enthalpy(junction, at, laws));
        }
    }
}

/// The law of a resistor between two nodes; `own` is its flow where no chain has told it.
fn resist<'g>(
    element: &Element,
    laws: &mut Laws<'g, '_>,
    own: impl FnOnce(&Laws<'g, '_>, Ex<'g>) -> Ex<'g>,
) {
    let ends = [FROM, TO].map(|key| element.name(key.name).unwrap_or_default());
    let [before, after] = ends.map(|node| pressure(node, laws));
    let q = laws
        .shared(&element.name, FLOW)
        .unwrap_or_else(|| own(laws, before - after));
    run(ends[0], ends[1], q, laws);
    let name = &element.name;
    laws.reading(
        format!("{name}_flow"),
        q,
        "m^3/s",
        format!("flow through `{name}`, m^3/s"),
    );
}
