//! A machine: a mechanism and the effects that its file declares for scenes.

use crate::declaration::{Context, Declared, Kinds, Refused, check_unique_names, declared};
use crate::fault::{Faults, wording};
use crate::format::Spec;
use crate::mechanism::{self, Mechanism};

/// A mechanism that passed every check, with its declared effects.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// Links, joints, frames.
    pub mechanism: Mechanism,
    /// What else may act in it, in the file's order.
    pub effects: Vec<Declared>,
}

/// Checks a spec against every rule. `stem` is the file's name without its ending, if there is a
/// file; only what stands before its first dot counts. `methods` are the names of what is generated,
/// which no run-time parameter may have, `kinds` the effects that there are.
///
/// The machine is there exactly if nothing refuses the spec.
pub fn check(
    spec: &Spec,
    stem: Option<&str>,
    methods: &[String],
    kinds: &Kinds,
) -> (Option<Machine>, Faults) {
    let mut faults = Faults::default();
    let mechanism = mechanism::check(spec, stem, methods, &mut faults);
    let machine = match mechanism {
        None => {
            alone(spec, kinds, &mut faults);
            None
        }
        Some(mechanism) => Some(Machine {
            effects: effects(spec, &mechanism, kinds, &mut faults),
            mechanism,
        }),
    };
    let still = machine.as_ref().is_some_and(|m| m.mechanism.nv() == 0) && !faults.any_fault();
    if let Some(links) = spec.links.given().filter(|_| still) {
        faults.push(wording::no_coordinates(&links.place));
    }
    faults.sort();
    let sound = spec.complete && !faults.any_fault();
    faults.forget_following();
    (machine.filter(|_| sound), faults)
}

/// What can be said of the effects without the mechanism.
fn alone(spec: &Spec, kinds: &Kinds, faults: &mut Faults) {
    for raw in spec.effects.value().into_iter().flatten() {
        declared(raw, kinds, faults);
    }
}

/// The effects, each sound by itself.
fn effects(
    spec: &Spec,
    mechanism: &Mechanism,
    kinds: &Kinds,
    faults: &mut Faults,
) -> Vec<Declared> {
    let raws = spec.effects.value().map_or(&[][..], Vec::as_slice);
    if raws.is_empty() {
        return Vec::new();
    }
    let (mut found, mut refused) = (Vec::new(), Refused::default());
    for raw in raws {
        match declared(raw, kinds, faults) {
            Some(effect) => found.push(effect),
            None => refused.call(raw, &[], kinds),
        }
    }
    let all = mechanism.joint_names();
    let each = found.iter().cloned();
    let each: Vec<Declared> = each.flat_map(|d| d.of_each_joint(&all, faults)).collect();
    let mut context = Context::of(mechanism, Vec::new()).with(each.iter());
    context.refused = refused;
    check_unique_names(&each, mechanism, faults);
    for effect in &each {
        effect.element(&context, faults);
    }
    found
}
