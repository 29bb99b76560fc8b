//! The effects called for.

use super::super::causality::{Chain, chains};
use super::{given, joint_names};
use crate::effect::{Beside, Context, Declared, Element, Refused, called, once_per_joint};
use crate::fault::{Fault, Faults};
use crate::mechanism::{LinkId, Mechanism, Places};
use crate::spec::{Raw, SceneSpec};

/// The names that effects may refer to.
pub(crate) fn context(mechanism: &Mechanism, locked: Vec<String>) -> Context {
    let coordinate = |&link: &LinkId| {
        let joint = &mechanism.links()[link.0].joint;
        (joint.name.clone(), joint.kind.motion)
    };
    let limits = |&link: &LinkId| {
        let joint = &mechanism.links()[link.0].joint;
        (joint.name.clone(), joint.limits)
    };
    Context {
        coordinates: mechanism.coordinates().iter().map(coordinate).collect(),
        limits: mechanism.coordinates().iter().map(limits).collect(),
        added: Vec::new(),
        locked,
        places: Places::new(mechanism),
        nodes: Vec::new(),
        refused: Refused::default(),
    }
}

/// The effects called for.
pub(super) struct Called {
    /// Checked, in the order in which their laws run.
    pub(super) elements: Vec<Element>,
    /// Those in series.
    pub(super) chains: Vec<Chain>,
    /// Those that are missing.
    pub(super) refused: Refused,
}

/// The effects called for, checked.
pub(super) fn elements(
    spec: &SceneSpec,
    whole: &Mechanism,
    reduced: &Mechanism,
    faults: &mut Faults,
) -> Called {
    let mut refused = Refused::default();
    if !spec.effects_read {
        refused.unread();
    }
    let free = joint_names(reduced);
    let wanted = wanted(spec, (whole, &free), &mut refused, faults);
    let all = joint_names(whole);
    let locked = all.into_iter().filter(|name| !free.contains(name));
    let mut context = context(reduced, locked.map(str::to_owned).collect());
    context.refused = refused.clone();
    let context = context.with(wanted.iter());
    taken(&wanted, whole, faults);
    let mut elements: Vec<Element> = Vec::new();
    for declared in &wanted {
        match declared.element(&context, faults) {
            Some(element) => elements.push(element),
            None => refused.effect(declared),
        }
    }
    once_per_joint(&elements, faults);
    elements.sort_by_key(|e| e.effect.order());
    let beside = Beside {
        elements: &elements,
        mechanism: reduced,
    };
    // Where one is missing, others of its kind would seem to be joined to nothing.
    for element in &elements {
        if !refused.may_be(element.effect.family()) {
            element.effect.fits(element, &beside, faults);
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

/// What can be said of the effects that a scene gives with their types, without its mechanism.
pub(super) fn alone(spec: &SceneSpec, faults: &mut Faults) {
    let typed = |raw: &&Raw| raw.is_mapping() && raw.peek("type").is_some();
    for raw in given(&spec.effects).iter().filter(typed) {
        crate::effect::declared(raw, faults);
    }
}

/// The effects called for, each once, with the values that it has here; one for each joint where it is
/// of several, of the `free` ones where it is of all.
fn wanted(
    spec: &SceneSpec,
    (whole, free): (&Mechanism, &[&str]),
    refused: &mut Refused,
    faults: &mut Faults,
) -> Vec<Declared> {
    let mut wanted: Vec<Declared> = Vec::new();
    for raw in given(&spec.effects) {
        let before = faults.count();
        let called = called(raw, whole.effects(), faults).into_iter();
        let each = called.flat_map(|declared| declared.of_each_joint(free, faults));
        let each: Vec<Declared> = each.collect();
        if each.is_empty() && faults.count() > before {
            refused.call(raw, whole.effects());
        }
        for declared in each {
            let name = &declared.name.value;
            if wanted.iter().any(|w| w.name.value == *name) {
                let message = format!("the effect `{name}` is called for twice");
                let fault = Fault::new(&raw.name.place, "repeated-effect", message);
                faults.push(fault.with_help("leave one of them out"));
                continue;
            }
            wanted.push(declared);
        }
    }
    wanted
}

/// The mechanism with what the effects change in it.
pub(super) fn reduced(mut mechanism: Mechanism, elements: &[Element]) -> Mechanism {
    for element in elements {
        element.effect.reduce(element, &mut mechanism);
    }
    mechanism
}

/// The names of effects and of their nodes are parts of the state's, so they must be no joint's
/// and each must be the only one.
pub(crate) fn taken(all: &[Declared], mechanism: &Mechanism, faults: &mut Faults) {
    let joints = mechanism.links().iter().map(|l| &l.joint.name);
    let bodies = mechanism.links().iter().map(|l| &l.name);
    let frames = mechanism.frames().iter().map(|f| &f.name);
    let known: Vec<&String> = joints.chain(bodies).chain(frames).collect();
    let own = |declared: &Declared| {
        let mut own = declared.nodes();
        own.push(declared.name.value.clone());
        own.sort();
        own.dedup();
        own
    };
    for (i, declared) in all.iter().enumerate() {
        let place = &declared.name.place;
        for name in own(declared) {
            if known.contains(&&name) {
                let message = format!("`{name}` is a joint, a link or a frame already");
                let fault = Fault::new(place, "repeated-name", message);
                faults.push(fault.with_help("give the effect a name of its own: `elbow_friction`"));
            }
            let other = all[..i].iter().find(|other| own(other).contains(&name));
            if let Some(other) = other.filter(|other| other.name.value != declared.name.value) {
                let other = &other.name.value;
                let message = format!("`{name}` is a name of the effect `{other}` already");
                let fault = Fault::new(place, "repeated-name", message);
                faults.push(fault.with_help(
                    "the sides of a cylinder `boom` are called `boom_a` and `boom_b`: name one of the two otherwise",
                ));
            }
        }
    }
}
