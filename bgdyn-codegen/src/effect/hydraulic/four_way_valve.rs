//! A four-way valve, critically centred (Merritt 1967, chapter 5).
//!
//! A spool shifted by x connects the supply to one side and the other side to the tank, through orifices that
//! open with |x|.

use super::flow::{Drop, run};
use super::keys::{FAMILY, LAMINAR, ORIFICE, joins_two, node};
use super::volume::{one_fluid, pressure};
use crate::bond_graph::BondNetwork;
use crate::declaration::{EffectKind, Element, SceneContext, ValueCheck};
use crate::effect::{Effect, nodes};
use crate::effort_sums::EffortSums;
use crate::fault::{Faults, Help};
use crate::format::{Dimension, Key, Reads};
use crate::layout::StateLayout;

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
    element.name(&SPOOL).unwrap_or(&element.name)
}

impl EffectKind for FourWayValve {
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

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        let why = Help::ClosedIsOptional;
        check.positive(&[ORIFICE], why);
        check.positive(&[LAMINAR], Help::LaminarIsOptional);
        let ports = [SUPPLY, TANK, A, B];
        for (i, one) in ports.iter().enumerate() {
            for other in &ports[i + 1..] {
                joins_two(check, one, other);
            }
        }
    }

    fn check_in_scene(&self, element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
        one_fluid(element, beside, faults);
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
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
        let [supply, tank, a, b] = [SUPPLY, TANK, A, B].map(|key| element.needed_name(&key));
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

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        let [supply, tank, a, b] = [SUPPLY, TANK, A, B].map(|key| element.needed_name(&key));
        let [p_supply, p_tank, p_a, p_b] = [supply, tank, a, b].map(|n| pressure(n, sums));
        let (zero, one) = (sums.b.zero(), sums.b.number(1.0));
        let shift = sums.input(spool(element));
        sums.event(&format!("{}_centre", element.name), shift);
        sums.event(&format!("{}_limit", element.name), one - shift.abs());
        let x = shift.max(-one).min(one);
        let (back, opening) = (|yes, no| x.if_less(zero, yes, no), x.abs());
        // Two orifices are open at a time: to the side that is supplied, and from the side that returns.
        let (fed, returning) = (back(p_b, p_a), back(p_a, p_b));
        let drop = Drop::of(element, sums);
        let feed = opening * drop.flow(p_supply - fed, sums.b);
        let return_ = opening * drop.flow(returning - p_tank, sums.b);
        run(supply, a, back(zero, feed), sums);
        run(supply, b, back(feed, zero), sums);
        run(a, tank, back(return_, zero), sums);
        run(b, tank, back(zero, return_), sums);
        let name = &element.name;
        for (side, flow) in [("a", back(-return_, feed)), ("b", back(feed, -return_))] {
            let about = format!("flow of `{name}` into side {side}, m^3/s");
            sums.reading(format!("{name}_flow_{side}"), flow, "m^3/s", about);
        }
    }
}
