//! An orifice, fixed or opened by an input.
//!
//! The flow is turbulent, q = k √Δp (Merritt 1967, chapter 3), with an optional laminar part, Δp = R q + q|q|/k².
//! This law is smooth at Δp = 0; its solution for the flow is q = 2 Δp / (R + √(R² + 4|Δp|/k²)). An opening u
//! scales the flow.

use super::flow::{Drop, resist};
use super::keys::{FAMILY, FROM, LAMINAR, ORIFICE, TO, joins_two};
use super::volume::one_fluid;
use crate::bond_graph::BondNetwork;
use crate::declaration::{EffectKind, Element, SceneContext, ValueCheck};
use crate::effect::{Effect, nodes};
use crate::effort_sums::EffortSums;
use crate::fault::{Faults, Help};
use crate::format::{Dimension, Key, Reads};
use crate::layout::StateLayout;

pub(in crate::effect) struct Orifice;

const OPENING: Key = Key {
    name: "opening",
    reads: Reads::Input,
    needed: false,
    about: "u, name of an input, held to 0 … 1; always open without it",
};

impl EffectKind for Orifice {
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
        element.name(&OPENING).is_none()
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        let why = Help::ClosedIsOptional;
        check.positive(&[ORIFICE], why);
        check.positive(&[LAMINAR], Help::LaminarIsOptional);
        joins_two(check, &FROM, &TO);
    }

    fn check_in_scene(&self, element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
        one_fluid(element, beside, faults);
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        if let Some(opening) = element.name(&OPENING) {
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
        let ends = [FROM, TO].map(|key| element.needed_name(&key));
        nodes::add_pipe(nodes::label(element), ends, network);
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        if let Some(opening) = element.name(&OPENING) {
            let x = sums.input(opening);
            sums.event(&limit(element), x.min(sums.b.number(1.0) - x));
        }
        resist(element, sums, |sums, drop| {
            let open = Drop::of(element, sums).flow(drop, sums.b);
            match element.name(&OPENING) {
                Some(opening) => {
                    let (zero, one) = (sums.b.zero(), sums.b.number(1.0));
                    sums.input(opening).max(zero).min(one) * open
                }
                None => open,
            }
        });
    }
}

/// Returns the name of the event at the ends of the opening, which are kinks of the law.
fn limit(element: &Element) -> String {
    format!("{}_limit", element.name)
}
