//! The common law of dampers and smooth friction.
//!
//! The effort depends on the slip of a port against its counterpart, and dissipates the power that it receives.

use super::keys::REFERENCE;
use crate::declaration::Element;
use crate::effort_sums::EffortSums;
use crate::expr::Expr;
use crate::format::Dimension;
use crate::layout::{Level, StateLayout};

/// Declares the counterpart's speed as an input, if the element has a reference.
pub(super) fn declare(element: &Element, layout: &mut StateLayout) {
    if let Some(reference) = element.name(&REFERENCE) {
        let dimension = match element.joint() {
            Some(joint) => layout.position_of(joint),
            None => Dimension::Length,
        };
        layout.reference(reference, Level::Rate, Level::Rate, dimension);
    }
}

/// Adds the effort τ(s) at the slip s = ṗ − ṙ. It dissipates −τ s; the counterpart supplies τ ṙ of it.
pub(super) fn resist<'g>(
    element: &Element,
    sums: &mut EffortSums<'g, '_>,
    effort: impl FnOnce(&EffortSums<'g, '_>, Expr<'g>) -> Expr<'g>,
) {
    let port = sums.port(element);
    let counterpart = sums.reference(element.name(&REFERENCE), Level::Rate);
    let slip = port.rate - counterpart;
    let effort = effort(sums, slip);
    sums.push(&port, effort);
    sums.dissipate(-(effort * slip));
    sums.supply(effort * counterpart);
}
