//! Computes flows between nodes: through one resistor, or through several in series.

use super::keys::{CONDUCTANCE, FROM, LAMINAR, ORIFICE, TO};
use super::volume::{DENSITY, ENTHALPY, FLOW, PRESSURE, SOURCE, enthalpy, pressure};
use crate::declaration::{Chain, Element};
use crate::effort_sums::EffortSums;
use crate::expr::{Builder, Expr};

/// Adds the flow q from one node to another, with the power terms of the nodes and of the resistor.
pub(super) fn run<'g>(from: &str, to: &str, q: Expr<'g>, sums: &mut EffortSums<'g, '_>) {
    let zero = sums.b.zero();
    let [before, after] = [from, to].map(|node| sums.shared(node, ENTHALPY).unwrap_or(zero));
    sums.dissipate((before - after) * q);
    for (node, into, enthalpy) in [(from, -q, before), (to, q, after)] {
        if let Some(density) = sums.shared(node, DENSITY) {
            sums.flow(node, into * density);
        } else if sums.shared(node, SOURCE).is_some() {
            sums.supply_by(node, -(enthalpy * into));
        }
    }
}

/// The pressure drop of a resistor, Δp = R q + q|q|/k².
#[derive(Clone, Copy)]
pub(super) struct Drop<'g> {
    /// R, Pa·s/m³.
    laminar: Expr<'g>,
    /// k, m³/(s·√Pa); `None` if the law is linear.
    orifice: Option<Expr<'g>>,
}

impl<'g> Drop<'g> {
    /// Returns the law of an orifice or a leakage.
    pub(super) fn of(element: &Element, sums: &EffortSums<'g, '_>) -> Self {
        let keys = element.effect.keys();
        match keys.contains(&CONDUCTANCE) {
            true => Drop {
                laminar: sums.b.number(1.0) / sums.number(element, &CONDUCTANCE),
                orifice: None,
            },
            false => Drop {
                laminar: sums.number(element, &LAMINAR),
                orifice: sums.optional(element, &ORIFICE),
            },
        }
    }

    /// Returns the law of several resistors in series: R = Σ R_i, 1/k² = Σ 1/k_i².
    pub(super) fn in_series(all: &[Self], b: &'g Builder) -> Self {
        let one = b.number(1.0);
        let laminar = all.iter().fold(b.zero(), |sum, d| sum + d.laminar);
        let squares = all.iter().filter_map(|d| d.orifice);
        let sum = squares.map(|k| one / (k * k)).reduce(|sum, s| sum + s);
        let orifice = sum.map(|sum| one / sum.sqrt());
        Drop { laminar, orifice }
    }

    /// Returns Δp of a flow.
    pub(super) fn of_flow(self, q: Expr<'g>) -> Expr<'g> {
        let laminar = self.laminar * q;
        match self.orifice {
            Some(k) => laminar + q * q.abs() / (k * k),
            None => laminar,
        }
    }

    /// Returns the flow of a pressure drop: q = 2 Δp / (R + √(R² + 4|Δp|/k²)).
    pub(super) fn flow(self, drop: Expr<'g>, b: &'g Builder) -> Expr<'g> {
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

/// Solves the chain through a junction, unless another junction of it did: the flow from the pressures at
/// the two ends, and the pressures between them.
pub(super) fn solve(junction: &Element, sums: &mut EffortSums<'_, '_>) {
    let through = |c: &&Chain| c.through.contains(&junction.name);
    let Some(chain) = sums.chains().iter().find(through) else {
        return;
    };
    if sums.shared(&junction.name, PRESSURE).is_some() {
        return;
    }
    let members: Vec<(&Element, bool)> = chain
        .members
        .iter()
        .map(|&(i, forward)| (&sums.elements()[i], forward))
        .collect();
    let drops: Vec<Drop<'_>> = members.iter().map(|(e, _)| Drop::of(e, sums)).collect();
    let mut at = pressure(&chain.from, sums);
    let whole = at - pressure(&chain.to, sums);
    let q = Drop::in_series(&drops, sums.b).flow(whole, sums.b);
    for (i, &(element, forward)) in members.iter().enumerate() {
        sums.share(&element.name, FLOW, if forward { q } else { -q });
        at = at - drops[i].of_flow(q);
        if let Some(node) = chain.through.get(i) {
            sums.share(node, PRESSURE, at);
            sums.share(node, ENTHALPY, enthalpy(junction, at, sums));
        }
    }
}

/// Adds the law of a resistor between two nodes; `own` is its flow if no chain has computed it.
pub(super) fn resist<'g>(
    element: &Element,
    sums: &mut EffortSums<'g, '_>,
    own: impl FnOnce(&EffortSums<'g, '_>, Expr<'g>) -> Expr<'g>,
) {
    let ends = [FROM, TO].map(|key| element.needed_name(&key));
    let [before, after] = ends.map(|node| pressure(node, sums));
    let q = sums
        .shared(&element.name, FLOW)
        .unwrap_or_else(|| own(sums, before - after));
    run(ends[0], ends[1], q, sums);
    let name = &element.name;
    sums.reading(
        format!("{name}_flow"),
        q,
        "m^3/s",
        format!("flow through `{name}`, m^3/s"),
    );
}
