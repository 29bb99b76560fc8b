//! The trait of effects: the constitutive law, and the changes in the bond graph.

use crate::bond_graph::{BondGraph, BondNetwork};
use crate::declaration::{EffectKind, Element};
use crate::effort_sums::EffortSums;
use crate::expr::Expr;
use crate::mechanism::Mechanism;

/// An effect: its constitutive law, and its changes in the graph.
pub trait Effect: EffectKind {
    /// Changes the graph of links and joints.
    fn modify_graph(&self, _: &Element, _: &Mechanism, _: &mut BondGraph) {}

    /// Adds its junctions, stores, resistors, transformers, gyrators and sources to the bond graph;
    /// `scene` are all elements. The drawing and the balance of power use them.
    fn elements(&self, element: &Element, scene: &[Element], network: &mut BondNetwork);

    /// Returns the initial value of its state if the scene gives `entered` for it: a volume for a
    /// pressure.
    fn initial_state<'g>(
        &self,
        _: &Element,
        _: &EffortSums<'g, '_>,
        _: &str,
        entered: Expr<'g>,
    ) -> Expr<'g> {
        entered
    }

    /// Adds its constitutive law.
    fn law(&self, _: &Element, _: &mut EffortSums<'_, '_>) {}
}
