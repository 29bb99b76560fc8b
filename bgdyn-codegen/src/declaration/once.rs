//! Checks that a joint has at most one effect of certain types.

use super::Element;
use crate::fault::{Faults, wording};

/// Refuses a second effect of a type that a joint can have once: with two dry frictions at one joint,
/// the share of each in the holding effort would be undetermined.
pub(crate) fn once_per_joint(elements: &[Element], faults: &mut Faults) {
    let on = |e: &Element| (e.effect.keyword(), e.joint().map(str::to_owned));
    for (i, element) in elements.iter().enumerate() {
        let first = elements[..i].iter().find(|e| on(e) == on(element));
        if let Some(first) = first.filter(|e| e.effect.once_per_joint()) {
            let (kind, joint) = on(element);
            let names = [first.name.as_str(), &element.name];
            let joint = joint.unwrap_or_default();
            faults.push(wording::two_of_type_at_joint(
                &element.location,
                names,
                kind,
                &joint,
            ));
        }
    }
}
