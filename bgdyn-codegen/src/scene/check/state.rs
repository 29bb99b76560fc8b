//! Builds the layout of a scene's state, and checks its parameters.

use super::joints;
use crate::declaration::Element;
use crate::fault::{Faults, wording};
use crate::layout::StateLayout;
use crate::mechanism::{Mechanism, Parameter};

/// Returns the layout of the state: the joints, then the parts that the effects add.
pub(super) fn layout(mechanism: &Mechanism, elements: &[Element]) -> StateLayout {
    let mut layout = joints::layout(mechanism);
    // Coordinates first: other effects may act on them.
    let (adding, rest): (Vec<&Element>, Vec<&Element>) =
        elements.iter().partition(|e| e.effect.adds_coordinate());
    for element in adding.into_iter().chain(rest) {
        element.effect.declare(element, &mut layout);
    }
    layout
}

/// Returns the mechanism's run-time parameters, followed by those of the effects. The motions of prescribed
/// joints are inputs.
pub(super) fn parameters(
    mechanism: &Mechanism,
    elements: &[Element],
    faults: &mut Faults,
) -> Vec<Parameter> {
    let given = |p: &usize| {
        let mut motions = mechanism.prescribed().iter().flat_map(|own| own.motion);
        motions.any(|parameter| parameter.0 == *p)
    };
    let own = (0..mechanism.parameters().len()).filter(|p| !given(p));
    let mut all: Vec<Parameter> = own.map(|p| mechanism.parameters()[p].clone()).collect();
    for element in elements {
        for (key, quantity) in element.quantities() {
            let Some(name) = &quantity.parameter else {
                continue;
            };
            let meaning = element.meaning(key);
            let unit = quantity.dimension.si();
            match all.iter_mut().find(|p| p.name == *name) {
                Some(known) if known.default != quantity.value || known.unit != unit => {
                    let first = (known.default.to_f64(), known.unit);
                    let values = [first, (quantity.value.to_f64(), unit)];
                    faults.push(wording::parameter_twice(&quantity.location, name, values));
                }
                // A payload's parameter belongs to the mechanism already.
                Some(known) if known.meaning == meaning => {}
                Some(known) => known.meaning += &format!(" and {meaning}"),
                None => all.push(Parameter {
                    name: name.clone(),
                    meaning,
                    default: quantity.value,
                    unit,
                }),
            }
        }
    }
    all
}
