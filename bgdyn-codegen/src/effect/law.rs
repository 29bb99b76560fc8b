//! The interface of an effect: its constitutive law, and what it changes in the bond graph.

use crate::bond_graph::{BondGraph, BondNetwork};
use crate::declaration::{Declaration, Element};
use crate::expr::Ex;
use crate::laws::Laws;
use crate::mechanism::Mechanism;

/// What an effect does: its constitutive law, and what it changes in the graph.
pub trait Effect: Declaration {
    /// What it changes in the graph of links and joints.
    fn alter(&self, _: &Element, _: &Mechanism, _: &mut BondGraph) {}

    /// The junctions, stores, resistors, transformers, gyrators and sources that it is in the bond graph,
    /// among the elements of its `scene`. The drawing and the balance of power read them.
    fn elements(&self, element: &Element, scene: &[Element], network: &mut BondNetwork);

    /// What its state stores where the scene gives `given` for it: a volume for a pressure.
    fn start<'g>(&self, _: &Element, _: &Laws<'g, '_>, _: &str, given: Ex<'g>) -> Ex<'g> {
        given
    }

    /// Its constitutive law.
    fn law(&self, _: &Element, _: &mut Laws<'_, '_>) {}
}
