//! An orifice, fixed or opened by an input: turbulent flow q = k √Δp (Merritt 1967, chapter 3),
//! with a laminar part where it is given, Δp = R q + q|q|/k². That law is smooth at Δp = 0, solved
//! for the flow it is q = 2 Δp / (R + √(R² + 4|Δp|/k²)). An opening u scales the flow.

use super::flow::{Drop, resist};
use super::keys::{FAMILY, FROM, LAMINAR, ORIFICE, TO, joins_two};
use super::volume::one_fluid;
use crate::bond_graph::BondNetwork;
use crate::declaration::{Beside, Declaration, Element, Given};
use crate::effect::{Effect, nodes};
use crate::fault::Faults;
use crate::format::{Dimension, Key, Reads};
use crate::laws::Laws;
use crate::layout::Layout;

pub(in crate::effect) struct Orifice;

const OPENING: Key = Key {
    name: "opening",
    reads: Reads::Input,
    needed: false,
    about: "u, name of an input, held to 0 … 1; always open without it",
};

impl Declaration for Orifice {
    fn keyword(&self) -> &'static str {
        "orifice"
    }

    fn family(&self) -> &'static str {
        FAMILY
    }

    fn summary(&self) -> &'static str {
        "orifice: q = u k sgn(Δp) √|Δp|; with a laminar part Δp = R q/u + q|q|/(u k)²"
    }

    fn symbol(&self) -> &'static str {
        "R"
    }

    fn keys(&self) -> &'static [Key] {
        &[ORIFICE, FROM, TO, OPENING, LAMINAR]
    }

    fn order(&self) -> u8 {
        2
    }

    fn in_series(&self, element: &Element) -> bool {
        element.name(OPENING.name).is_none()
    }

    fn rules(&self, given: &mut Given<'_>) {
        let why = "what lets nothing through is left out";
        given.positive(&[ORIFICE.name], why);
        given.positive(&[LAMINAR.name], "leave it out for turbulent flow alone");
        joins_two(given, FROM.name, TO.name);
    }

    fn fits(&self, element: &Element, beside: &Beside<'_>, faults: &mut Faults) {
        one_fluid(element, beside, faults);
    }

    fn declare(&self, element: &Element, layout: &mut Layout) {
        if let Some(opening) = element.name(OPENING.name) {
            let about = format!("opening of `{opening}`, 0 … 1");
            layout.shared_input(opening, Dimension::One, about);
            let about = format!(
                "the opening of `{}` reaches 0 or 1, or leaves it",
                element.name
            );
            layout.event(limit(element), about);
        }
    }
}

impl Effect for Orifice {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let ends = [FROM, TO].map(|key| element.name(key.name).unwrap_or_default());
        nodes::add_pipe(nodes::label(element), ends, network);
    }

    fn law(&self, element: &Element, laws: &mut Laws<'_, '_>) {
        if let Some(opening) = element.name(OPENING.name) {
            let x = laws.input(opening);
            laws.event(&limit(element), x.min(laws.b.number(1.0) - x));
        }
        resist(element, laws, |laws, drop| {
            let open = Drop::of(element, laws).flow(drop, laws.b);
            match element.name(OPENING.name) {
                Some(opening) => {
                    let (zero, one) = (laws.b.zero(), laws.b.number(1.0));
                    laws.input(opening).max(zero).min(one) * open
                }
                None => open,
            }
        });
    }
}

/// The name of the event at the ends of the opening, which are kinks of the law.
fn limit(element: &Element) -> String {
    format!("{}_limit", element.name)
}
