//! Effects of which a joint has one at most.

use super::Element;
use crate::fault::{Fault, Faults};

/// Of some effects a joint has no more than one: two frictions that hold would not know which of
/// them does.
pub(crate) fn once_per_joint(elements: &[Element], faults: &mut Faults) {
    let on = |e: &Element| (e.effect.keyword(), e.name("joint").map(str::to_owned));
    for (i, element) in elements.iter().enumerate() {
        let first = elements[..i].iter().find(|e| on(e) == on(element));
        if let Some(first) = first.filter(|e| e.effect.once_per_joint()) {
            let (kind, joint) = on(element);
            let message = format!(
                "`{}` and `{}` are both of type `{kind}` at `{}`",
                first.name,
                element.name,
                joint.unwrap_or_default()
            );
            let fault = Fault::new(&element.place, "repeated-effect", message);
            faults.push(fault.with_help("a joint has one of them: leave the other out"));
        }
    }
}
