//! The effects called for.

use super::super::causality::{Chain, chains};
use super::{given, joint_names};
use crate::effect::{Beside, Context, Declared, Element, called, once_per_joint};
use crate::fault::{Fault, Faults};
use crate::mechanism::{LinkId, Mechanism, Places};
use crate::spec::SceneSpec;

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
    }
}

/// The effects called for, checked, in the order in which their laws run; those in series.
pub(super) fn elements(
    spec: &SceneSpec,
    whole: &Mechanism,
    reduced: &Mechanism,
    faults: &mut Faults,
) -> (Vec<Element>, Vec<Chain>) {
    let mut wanted: Vec<Declared> = Vec::new();
    let free = joint_names(reduced);
    for raw in given(&spec.effects) {
        let called = called(raw, whole.effects(), faults).into_iter();
        let each: Vec<Declared> = called
            .flat_map(|declared| declared.of_each_joint(&free, faults))
            .collect();
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
    let all = joint_names(whole);
    let locked = all.into_iter().filter(|name| !free.contains(name));
    let context = context(reduced, locked.map(str::to_owned).collect()).with(wanted.iter());
    taken(&wanted, whole, faults);
    let mut elements: Vec<Element> = wanted
        .iter()
        .filter_map(|d| d.element(&context, faults))
        .collect();
    once_per_joint(&elements, faults);
    elements.sort_by_key(|e| e.effect.order());
    // Where one is missing, others would seem to be joined to nothing.
    if elements.len() < wanted.len() {
        return (elements, vec![]);
    }
    let beside = Beside {
        elements: &elements,
        mechanism: reduced,
    };
    for element in &elements {
        element.effect.fits(element, &beside, faults);
    }
    let chains = chains(&elements, faults);
    (elements, chains)
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
