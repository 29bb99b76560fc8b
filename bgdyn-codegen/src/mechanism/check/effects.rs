//! The effects that a mechanism declares: checked here, used by scenes.

use crate::effect::{Declared, Refused, declared};
use crate::fault::Faults;
use crate::mechanism::Mechanism;
use crate::scene::{context, joint_names, taken};
use crate::spec::Spec;

/// What can be said of the effects without the mechanism.
pub(super) fn alone(spec: &Spec, faults: &mut Faults) {
    for raw in spec.effects.value().into_iter().flatten() {
        declared(raw, faults);
    }
}

/// The effects, each sound by itself.
pub(super) fn effects(spec: &Spec, mechanism: &Mechanism, faults: &mut Faults) -> Vec<Declared> {
    let raws = spec.effects.value().map_or(&[][..], Vec::as_slice);
    if raws.is_empty() {
        return Vec::new();
    }
    let (mut found, mut refused) = (Vec::new(), Refused::default());
    for raw in raws {
        match declared(raw, faults) {
            Some(effect) => found.push(effect),
            None => refused.call(raw, &[]),
        }
    }
    let all = joint_names(mechanism);
    let each = found.iter().cloned();
    let each: Vec<Declared> = each.flat_map(|d| d.of_each_joint(&all, faults)).collect();
    let mut context = context(mechanism, Vec::new()).with(each.iter());
    context.refused = refused;
    taken(&each, mechanism, faults);
    for effect in &each {
        effect.element(&context, faults);
    }
    found
}
