//! The effects that a mechanism declares: checked here, used by scenes.

use crate::effect::{Declared, declared};
use crate::fault::Faults;
use crate::mechanism::Mechanism;
use crate::scene::{context, joint_names, taken};
use crate::spec::Spec;

/// The effects, each sound by itself.
pub(super) fn effects(spec: &Spec, mechanism: &Mechanism, faults: &mut Faults) -> Vec<Declared> {
    let raws = spec.effects.value().map_or(&[][..], Vec::as_slice);
    if raws.is_empty() {
        return Vec::new();
    }
    let found: Vec<Declared> = raws
        .iter()
        .filter_map(|raw| declared(raw, faults))
        .collect();
    let all = joint_names(mechanism);
    let each = found.iter().cloned();
    let each: Vec<Declared> = each.flat_map(|d| d.of_each_joint(&all, faults)).collect();
    let context = context(mechanism, Vec::new()).with(each.iter());
    taken(&each, mechanism, faults);
    for effect in &each {
        effect.element(&context, faults);
    }
    found
}
