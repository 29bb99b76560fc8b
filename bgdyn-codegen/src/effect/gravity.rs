//! Gravity: the effort sources R_i = m_i g.

use super::Effect;
use crate::bond_graph::{BondGraph, BondNetwork};
use crate::declaration::{Declaration, Element};
use crate::format::{Dimension, Key, Reads};
use crate::laws::Laws;
use crate::math::Vec3;
use crate::mechanism::Mechanism;

pub(super) struct Gravity;

impl Declaration for Gravity {
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
        &[Key {
            name: "acceleration",
            reads: Reads::Vector(&[Dimension::Acceleration]),
            needed: false,
            about: "acceleration of free fall in world axes instead of the mechanism's",
        }]
    }
}

impl Effect for Gravity {
    fn alter(&self, element: &Element, mechanism: &Mechanism, graph: &mut BondGraph) {
        let other = element.vector("acceleration").map(Vec3);
        graph.weigh(other.unwrap_or(mechanism.gravity()));
    }

    fn elements(&self, _: &Element, _: &[Element], network: &mut BondNetwork) {
        network.claim_weights();
    }

    /// V = −Σ m_i g · r_i
    fn law(&self, _: &Element, laws: &mut Laws<'_, '_>) {
        if let [energy] = laws.potential_energy()[..] {
            laws.store(energy);
        }
    }
}
