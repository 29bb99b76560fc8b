//! Velocity products: the rates of the transformers, with the gyroscopic term.
//!
//! They are d/dt ∂r_i/∂q_j, ρ̇_j and ω × J ω. Quasi-static scenes omit them.

use super::Effect;
use crate::bond_graph::{BondGraph, BondNetwork};
use crate::declaration::{EffectKind, Element};
use crate::format::Key;
use crate::mechanism::Mechanism;

pub(super) struct VelocityProducts;

impl EffectKind for VelocityProducts {
    fn keyword(&self) -> &'static str {
        "velocity_products"
    }

    fn family(&self) -> &'static str {
        "velocity_products"
    }

    fn summary(&self) -> &'static str {
        "Coriolis, centrifugal and gyroscopic efforts: C(q, v) v"
    }

    fn symbol(&self) -> &'static str {
        "MTF"
    }

    fn built_in(&self) -> bool {
        true
    }

    fn keys(&self) -> &'static [Key] {
        &[]
    }
}

impl Effect for VelocityProducts {
    fn modify_graph(&self, _: &Element, _: &Mechanism, graph: &mut BondGraph) {
        graph.multibody.velocity_products = true;
    }

    fn elements(&self, _: &Element, _: &[Element], _: &mut BondNetwork) {
        // The rates of the transformers add no nodes.
    }
}
