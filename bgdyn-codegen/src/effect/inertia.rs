//! Link inertia, lumped or distributed.
//!
//! The second stage of a study adds its terms to the equations of the first (Kuzmin 2007, conclusion).

use super::Effect;
use crate::bond_graph::{BondGraph, BondNetwork};
use crate::declaration::{EffectKind, Element};
use crate::format::{Key, Reads};
use crate::mechanism::Mechanism;

pub(super) struct LinkInertia;

/// The word for masses at the centres of mass.
const LUMPED: &str = "lumped";

const STAGE: Key = Key {
    name: "stage",
    reads: Reads::Word(&["distributed", LUMPED]),
    needed: false,
    about: "`distributed` (also where nothing is said) or `lumped`; scenes without this effect are lumped",
};

impl EffectKind for LinkInertia {
    fn keyword(&self) -> &'static str {
        "inertia"
    }

    fn family(&self) -> &'static str {
        "inertia"
    }

    fn summary(&self) -> &'static str {
        "link inertia: masses at the centres of mass (lumped), or with the tensors J_i (distributed)"
    }

    fn symbol(&self) -> &'static str {
        "I"
    }

    fn built_in(&self) -> bool {
        true
    }

    fn keys(&self) -> &'static [Key] {
        &[STAGE]
    }
}

impl Effect for LinkInertia {
    fn modify_graph(&self, element: &Element, mechanism: &Mechanism, graph: &mut BondGraph) {
        if !element.says(&STAGE, LUMPED) {
            graph.add_link_inertia(mechanism);
        }
    }

    fn elements(&self, _: &Element, _: &[Element], _: &mut BondNetwork) {
        // The stores are those of the links.
    }
}
