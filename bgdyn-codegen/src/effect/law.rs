//! The interface of an effect: its constitutive law, and what it changes in the bond graph.

use crate::bond_graph::{BondGraph, BondNetwork};
use crate::declaration::{EffectKind, Element};
use crate::effort_sums::EffortSums;
use crate::expr::Expr;
use crate::mechanism::Mechanism;

/// What an effect does: its constitutive law, and what it changes in the graph.
pub trait Effect: EffectKind {
    /// What it changes in the graph of links and joints.
    fn modify_graph(&self, _: &Element, _: &Mechanism, _: &mut BondGraph) {}

    /// The junctions, stores, resistors, transformers, gyrators and sources that it is in the bond graph,
    /// among the elements of its `scene`. The drawing and the balance of power read them.
    fn elements(&self, element: &Element, scene: &[Element], network: &mut BondNetwork);

    /// What its state stores where the scene enters `entered` for it: a volume for a pressure.
    fn initial_state<'g>(
        &self,
        _: &Element,
        _: &EffortSums<'g, '_>,
        _: &str,
        entered: Expr<'g>,
    ) -> Expr<'g> {
        entered
    }

    /// Its constitutive law.
    fn law(&self, _: &Element, _: &mut EffortSums<'_, '_>) {}
}
