//! Flows between nodes: through one resistor, or through several in series.

use super::keys::{CONDUCTANCE, FROM, LAMINAR, ORIFICE, TO};
use super::volume::{DENSITY, ENTHALPY, FLOW, PRESSURE, SOURCE, enthalpy, pressure};
use crate::declaration::{Chain, Element};
use crate::expr::{Builder, Ex};
use crate::laws::Laws;

/// Lets the flow q run from one node to another: what each of them and what the resistor makes of
/// it.
pub(super) fn run<'g>(from: &str, to: &str, q: Ex<'g>, laws: &mut Laws<'g, '_>) {
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
pub(super) struct Drop<'g> {
    /// R, Pa·s/m³
    laminar: Ex<'g>,
    /// k, m³/(s·√Pa); none where the law is linear.
    orifice: Option<Ex<'g>>,
}

impl<'g> Drop<'g> {
    /// Of an orifice or a leakage.
    pub(super) fn of(element: &Element, laws: &Laws<'g, '_>) -> Self {
        let keys = element.effect.keys();
        match keys.contains(&CONDUCTANCE) {
            true => Drop {
                laminar: laws.b.number(1.0) / laws.number(element, &CONDUCTANCE),
                orifice: None,
            },
            false => Drop {
                laminar: laws.number(element, &LAMINAR),
                orifice: laws.optional(element, &ORIFICE),
            },
        }
    }

    /// Of several in series: R = Σ R_i, 1/k² = Σ 1/k_i².
    pub(super) fn in_series(all: &[Self], b: &'g Builder) -> Self {
        let one = b.number(1.0);
        let laminar = all.iter().fold(b.zero(), |sum, d| sum + d.laminar);
        let squares = all.iter().filter_map(|d| d.orifice);
        let sum = squares.map(|k| one / (k * k)).reduce(|sum, s| sum + s);
        let orifice = sum.map(|sum| one / sum.sqrt());
        Drop { laminar, orifice }
    }

    /// Δp of a flow.
    pub(super) fn of_flow(self, q: Ex<'g>) -> Ex<'g> {
        let laminar = self.laminar * q;
        match self.orifice {
            Some(k) => laminar + q * q.abs() / (k * k),
            None => laminar,
        }
    }

    /// The flow of a pressure drop: q = 2 Δp / (R + √(R² + 4|Δp|/k²)).
    pub(super) fn flow(self, drop: Ex<'g>, b: &'g Builder) -> Ex<'g> {
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
pub(super) fn solve(junction: &Element, laws: &mut Laws<'_, '_>) {
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
pub(super) fn resist<'g>(
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
