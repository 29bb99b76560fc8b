//! Velocity products: the rates of the transformers, d/dt ∂r_i/∂q_j and ρ̇_j, with the gyroscopic
//! term ω × J ω. Quasi-static scenes do without.

use super::{Effect, Element};
use crate::bond_graph::BondGraph;
use crate::mechanism::Mechanism;
use crate::spec::Key;

pub(super) struct VelocityProducts;

impl Effect for VelocityProducts {
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

    fn alter(&self, _: &Element, _: &Mechanism, graph: &mut BondGraph) {
        graph.velocity_products = true;
    }
}
