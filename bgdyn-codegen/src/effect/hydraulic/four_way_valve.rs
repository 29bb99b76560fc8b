//! A four-way valve, critically centred (Merritt 1967, chapter 5): a spool shifted by x joins the
//! supply to one side and the other side to the tank, through orifices that open with |x|.

use super::flow::{Drop, run};
use super::keys::{FAMILY, LAMINAR, ORIFICE, joins_two, node};
use super::volume::{one_fluid, pressure};
use crate::bond_graph::BondNetwork;
use crate::declaration::{Beside, Declaration, Element, Given};
use crate::effect::{Effect, nodes};
use crate::fault::Faults;
use crate::format::{Dimension, Key, Reads};
use crate::laws::Laws;
use crate::layout::Layout;

pub(in crate::effect) struct FourWayValve;

const SUPPLY: Key = node("supply", "the node that feeds");
const TANK: Key = node("tank", "the node that takes what returns");
const A: Key = node("a", "the node that is fed where x > 0");
const B: Key = node("b", "the node that is fed where x < 0");
const SPOOL: Key = Key {
    name: "spool",
    reads: Reads::Input,
    needed: false,
    about: "x, name of an input, held to −1 … 1; the valve's own name without it",
};

/// The input that shifts the spool.
fn spool(element: &Element) -> &str {
    element.name(SPOOL.name).unwrap_or(&element.name)
}

impl Declaration for FourWayValve {
    fn keyword(&self) -> &'static str {
        "four_way_valve"
    }

    fn family(&self) -> &'static str {
        FAMILY
    }

    fn summary(&self) -> &'static str {
        "four-way valve: x > 0 joins supply to a and b to tank, x < 0 supply to b and a to tank, each q = |x| k sgn(Δp) √|Δp|"
    }

    fn symbol(&self) -> &'static str {
        "R"
    }

    fn keys(&self) -> &'static [Key] {
        &[ORIFICE, SUPPLY, TANK, A, B, SPOOL, LAMINAR]
    }

    fn order(&self) -> u8 {
        2
    }

    fn rules(&self, given: &mut Given<'_>) {
        let why = "what lets nothing through is left out";
        given.positive(&[ORIFICE.name], why);
        given.positive(&[LAMINAR.name], "leave it out for turbulent flow alone");
        let ports = [SUPPLY.name, TANK.name, A.name, B.name];
        for (i, one) in ports.iter().enumerate() {
            for other in &ports[i + 1..] {
                joins_two(given, one, other);
            }
        }
    }

    fn fits(&self, element: &Element, beside: &Beside<'_>, faults: &mut Faults) {
        one_fluid(element, beside, faults);
    }

    fn declare(&self, element: &Element, layout: &mut Layout) {
        let about = format!("shift of the spool of `{}`, −1 … 1", element.name);
        layout.shared_input(spool(element), Dimension::One, about);
        let name = &element.name;
        let about = format!("the spool of `{name}` passes its centre");
        layout.event(format!("{name}_centre"), about);
        let about = format!("the spool of `{name}` reaches one of its ends, or leaves it");
        layout.event(format!("{name}_limit"), about);
    }
}

impl Effect for FourWayValve {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let [supply, tank, a, b] =
            [SUPPLY, TANK, A, B].map(|key| element.name(key.name).unwrap_or_default());
        let ways = [
            (supply, a, '>'),
            (a, tank, '<'),
            (supply, b, '<'),
            (b, tank, '>'),
        ];
        for (from, to, sign) in ways {
            let text = format!("{}, open where x {sign} 0", element.name);
            nodes::add_pipe(text, [from, to], network);
        }
    }

    fn law(&self, element: &Element, laws: &mut Laws<'_, '_>) {
        let [supply, tank, a, b] =
            [SUPPLY, TANK, A, B].map(|key| element.name(key.name).unwrap_or_default());
        let [p_supply, p_tank, p_a, p_b] = [supply, tank, a, b].map(|n| pressure(n, laws));
        let (zero, one) = (laws.b.zero(), laws.b.number(1.0));
        let shift = laws.input(spool(element));
        laws.event(&format!("{}_centre", element.name), shift);
        laws.event(&format!("{}_limit", element.name), one - shift.abs());
        let x = shift.max(-one).min(one);
        let (back, opening) = (|yes, no| x.if_less(zero, yes, no), x.abs());
        // Two orifices are open at a time: to the side that is fed, from the side that returns.
        let (fed, returning) = (back(p_b, p_a), back(p_a, p_b));
        let drop = Drop::of(element, laws);
        let feed = opening * drop.flow(p_supply - fed, laws.b);
        let return_ = opening * drop.flow(returning - p_tank, laws.b);
        run(supply, a, back(zero, feed), laws);
        run(supply, b, back(feed, zero), laws);
        run(a, tank, back(return_, zero), laws);
        run(b, tank, back(zero, return_), laws);
        let name = &element.name;
        for (side, flow) in [("a", back(-return_, feed)), ("b", back(feed, -return_))] {
            let about = format!("flow of `{name}` into side {side}, m^3/s");
            laws.reading(format!("{name}_flow_{side}"), flow, "m^3/s", about);
        }
    }
}
