//! Gravity: the effort sources R_i = m_i g.

use super::Effect;
use crate::bond_graph::{BondGraph, BondNetwork};
use crate::declaration::{EffectKind, Element};
use crate::effort_sums::EffortSums;
use crate::format::{Dimension, Key, Reads};
use crate::math::Vec3;
use crate::mechanism::Mechanism;

pub(super) struct Gravity;

const ACCELERATION: Key = Key {
    name: "acceleration",
    reads: Reads::Vector(&[Dimension::Acceleration]),
    needed: false,
    about: "acceleration of free fall in world axes instead of the mechanism's",
};

impl EffectKind for Gravity {
    fn keyword(&self) -> &'static str {
        "gravity"
    }

    fn family(&self) -> &'static str {
        "gravity"
    }

    fn summary(&self) -> &'static str {
        "weight of every link, R_i = m_i g"
    }

    fn symbol(&self) -> &'static str {
        "Se"
    }

    fn built_in(&self) -> bool {
        true
    }

    fn keys(&self) -> &'static [Key] {
        &[ACCELERATION]
    }
}

impl Effect for Gravity {
    fn modify_graph(&self, element: &Element, mechanism: &Mechanism, graph: &mut BondGraph) {
        let other = element.vector(&ACCELERATION).map(Vec3);
        graph.add_gravity(other.unwrap_or(mechanism.gravity()));
    }

    fn elements(&self, _: &Element, _: &[Element], network: &mut BondNetwork) {
        network.claim_weights();
    }

    /// Adds V = −Σ m_i g · r_i.
    fn law(&self, _: &Element, sums: &mut EffortSums<'_, '_>) {
        if let [energy] = sums.potential_energy()[..] {
            sums.store(energy);
        }
    }
}
