//! Checks the effects that a scene uses.

use super::super::causality::chains;
use crate::declaration::{
    Chain, Declaration, EachOf, EffectKinds, Element, NameScope, RejectedEffects, SceneContext,
    TYPE, check_unique_names, once_per_joint, resolve_call,
};
use crate::fault::{Faults, wording};
use crate::format::{Field, Raw, SceneSpec};
use crate::machine::Machine;
use crate::mechanism::Mechanism;

/// The effects of a scene.
pub(super) struct Called {
    /// Checked elements, in the order in which their laws run.
    pub(super) elements: Vec<Element>,
    /// Elements in series.
    pub(super) chains: Vec<Chain>,
    /// Names of refused effects.
    pub(super) refused: RejectedEffects,
}

/// Returns the checked effects of a scene.
pub(super) fn elements(
    spec: &SceneSpec,
    (whole, kinds): (&Machine, &EffectKinds),
    reduced: &Mechanism,
    faults: &mut Faults,
) -> Called {
    let mut refused = RejectedEffects::default();
    if !spec.effects_read {
        refused.unread();
    }
    let free = reduced.joint_names();
    let free: Vec<&str> = free.iter().map(String::as_str).collect();
    let mut single = reduced.one_degree_names();
    let dependents = reduced.dependent_velocities().into_iter();
    let of_one = dependents.filter(|own| own.position.is_some());
    single.extend(of_one.map(|own| own.name));
    let single: Vec<&str> = single.iter().map(String::as_str).collect();
    let wanted = wanted(spec, (whole, kinds, &single), &mut refused, faults);
    let all = whole.mechanism.joint_names();
    let locked = all
        .into_iter()
        .filter(|name| !free.contains(&name.as_str()));
    let mut locked: Vec<String> = locked.collect();
    let followers = whole.mechanism.followers();
    let still = |name: &str| reduced.followers().all(|(joint, ..)| joint.name != name);
    locked.extend(
        followers
            .map(|(joint, ..)| joint.name.clone())
            .filter(|name| still(name)),
    );
    let mut context = NameScope::of(reduced, locked);
    context.refused = refused.clone();
    let context = context.with(wanted.iter());
    check_unique_names(&wanted, &whole.mechanism, faults);
    let mut elements: Vec<Element> = Vec::new();
    for declared in &wanted {
        match declared.element(&context, faults) {
            Some(element) => elements.push(element),
            None => refused.effect(declared),
        }
    }
    once_per_joint(&elements, faults);
    elements.sort_by_key(|e| e.effect.order());
    let beside = SceneContext {
        elements: &elements,
        mechanism: reduced,
    };
    held_followers(&elements, reduced, faults);
    // If one is missing, others of its kind would seem to have no connection.
    for element in &elements {
        if !refused.may_be(element.effect.family()) {
            element.effect.check_in_scene(element, &beside, faults);
        }
    }
    let alone = elements.iter().filter(|e| e.effect.is_junction());
    let whole = |e: &Element| !refused.may_be(e.effect.family());
    let chains = match alone.into_iter().all(whole) {
        true => chains(&elements, faults),
        false => vec![],
    };
    Called {
        elements,
        chains,
        refused,
    }
}

/// Refuses effects that can hold a joint at rest, which have modes, on joints that follow several others or that are
/// dependent in a loop: the hold would couple other joints.
fn held_followers(elements: &[Element], mechanism: &Mechanism, faults: &mut Faults) {
    let several = mechanism
        .followers()
        .filter(|(_, coupling, _)| coupling.velocities.len() > 1);
    for (joint, coupling, _) in several {
        let on = |e: &&Element| e.joint() == Some(joint.name.as_str());
        for element in elements.iter().filter(on) {
            if can_hold(element, mechanism) {
                let (keyword, leaders) = (element.effect.keyword(), mechanism.leaders(coupling));
                faults.push(wording::effect_on_follower_of_several(
                    &element.location,
                    keyword,
                    &joint.name,
                    &leaders,
                ));
            }
        }
    }
    let dependents = mechanism.dependent_velocities();
    let dependent = |name: &str| dependents.iter().any(|own| own.name == name);
    for element in elements {
        let joint = element.joint().filter(|joint| dependent(joint));
        if let Some(joint) = joint.filter(|_| can_hold(element, mechanism)) {
            let keyword = element.effect.keyword();
            faults.push(wording::hold_of_dependent(
                &element.location,
                keyword,
                joint,
            ));
        }
    }
}

/// Returns whether an effect has modes.
fn can_hold(element: &Element, mechanism: &Mechanism) -> bool {
    let mut layout = super::joints::layout(mechanism);
    element.effect.declare(element, &mut layout);
    !layout.modes.is_empty()
}

/// Checks the effects that a scene declares with their types, without its mechanism.
pub(super) fn alone(spec: &SceneSpec, kinds: &EffectKinds, faults: &mut Faults) {
    let typed = |raw: &&Raw| raw.is_mapping() && raw.peek(TYPE.name).is_some();
    for raw in given(&spec.effects).iter().filter(typed) {
        crate::declaration::parse_declaration(raw, kinds, faults);
    }
}

/// Returns the effects of a scene, each once, with their values in this scene. An effect on several joints
/// or contacts is expanded to one for each; the word "all" means the joints in `single`.
fn wanted(
    spec: &SceneSpec,
    (whole, kinds, single): (&Machine, &EffectKinds, &[&str]),
    refused: &mut RejectedEffects,
    faults: &mut Faults,
) -> Vec<Declaration> {
    let mut wanted: Vec<Declaration> = Vec::new();
    let each_of = EachOf {
        joints: single,
        contacts: whole.mechanism.contact_pairs(),
    };
    for raw in given(&spec.effects) {
        let before = faults.count();
        let called = resolve_call(raw, &whole.effects, kinds, faults).into_iter();
        let each = called.flat_map(|declared| declared.of_each(&each_of, faults));
        let each: Vec<Declaration> = each.collect();
        if each.is_empty() && faults.count() > before {
            refused.call(raw, &whole.effects, kinds);
        }
        for declared in each {
            let name = &declared.name.value;
            if wanted.iter().any(|w| w.name.value == *name) {
                faults.push(wording::effect_listed_twice(&raw.name.location, name));
                continue;
            }
            wanted.push(declared);
        }
    }
    wanted
}

/// Returns the mechanism with the changes by the effects.
pub(super) fn reduced(mut mechanism: Mechanism, elements: &[Element]) -> Mechanism {
    for element in elements {
        element.effect.modify_mechanism(element, &mut mechanism);
    }
    mechanism
}

/// Returns the entries of a list; empty if it is missing or unreadable.
pub(super) fn given(field: &Field<Vec<Raw>>) -> &[Raw] {
    field.value().map_or(&[], Vec::as_slice)
}
