//! What dampers and smooth friction share: an effort that depends on the slip of a port against
//! its counterpart, and takes from it all the power it is given.

use crate::declaration::Element;
use crate::expr::Ex;
use crate::format::Dimension;
use crate::laws::Laws;
use crate::layout::{Layout, Level};

/// The counterpart's speed is an input, where there is one.
pub(super) fn declare(element: &Element, layout: &mut Layout) {
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
    laws: &mut Laws<'g, '_>,
    effort: impl FnOnce(&Laws<'g, '_>, Ex<'g>) -> Ex<'g>,
) {
    let port = laws.port(element);
    let counterpart = laws.reference(element.name("reference"), Level::Rate);
    let slip = port.rate - counterpart;
    let effort = effort(laws, slip);
    laws.push(&port, effort);
    laws.dissipate(-(effort * slip));
    laws.supply(effort * counterpart);
}
