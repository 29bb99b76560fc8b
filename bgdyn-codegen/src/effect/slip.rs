//! What dampers and smooth friction share: an effort that depends on the slip of a port against
//! its counterpart, and takes from it all the power it is given.

use crate::declaration::Element;
use crate::effort_sums::EffortSums;
use crate::expr::Expr;
use crate::format::Dimension;
use crate::layout::{Level, StateLayout};

/// The counterpart's speed is an input, where there is one.
pub(super) fn declare(element: &Element, layout: &mut StateLayout) {
    if let Some(reference) = element.name("reference") {
        let dimension = match element.name("joint") {
            Some(joint) => layout.position_of(joint),
            None => Dimension::Length,
        };
        layout.reference(reference, Level::Rate, Level::Rate, dimension);
    }
}

/// Pushes the effort τ(s) at the slip s = ṗ − ṙ. It takes −τ s of power, of which the counterpart
/// brings τ ṙ.
pub(super) fn resist<'g>(
    element: &Element,
    sums: &mut EffortSums<'g, '_>,
    effort: impl FnOnce(&EffortSums<'g, '_>, Expr<'g>) -> Expr<'g>,
) {
    let port = sums.port(element);
    let counterpart = sums.reference(element.name("reference"), Level::Rate);
    let slip = port.rate - counterpart;
    let effort = effort(sums, slip);
    sums.push(&port, effort);
    sums.dissipate(-(effort * slip));
    sums.supply(effort * counterpart);
}
