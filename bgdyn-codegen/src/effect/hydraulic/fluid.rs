//! The fluid of a circuit: its bulk modulus.

use super::keys::{BULK_MODULUS, FAMILY, FLUID_KEYWORD};
use crate::bond_graph::BondNetwork;
use crate::declaration::{EffectKind, Element, ValueCheck};
use crate::effect::Effect;
use crate::fault::Help;
use crate::format::Key;

pub(in crate::effect) struct Fluid;

impl EffectKind for Fluid {
    fn keyword(&self) -> &'static str {
        FLUID_KEYWORD
    }

    fn family(&self) -> &'static str {
        FAMILY
    }

    fn summary(&self) -> &'static str {
        "fluid of constant bulk modulus: ρ = ρ₀ e^{p/β}"
    }

    fn symbol(&self) -> &'static str {
        "C"
    }

    fn keys(&self) -> &'static [Key] {
        &[BULK_MODULUS]
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        let why = Help::ModulusOfOil;
        check.positive(&[BULK_MODULUS], why);
    }
}

impl Effect for Fluid {
    fn elements(&self, _: &Element, _: &[Element], _: &mut BondNetwork) {
        // The volumes contain its compliance.
    }
}
