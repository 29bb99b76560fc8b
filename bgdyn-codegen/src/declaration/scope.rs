//! Names: those that effects may refer to, and those that they take themselves.

use super::{Context, Declared, Refused};
use crate::fault::{Fault, Faults};
use crate::mechanism::{LinkId, Mechanism, Places};

impl Context {
    /// The names of a mechanism; `locked` are joints that a scene holds.
    pub fn of(mechanism: &Mechanism, locked: Vec<String>) -> Context {
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
}

/// The names of effects and of their nodes are parts of the state's, so they must be no joint's
/// and each must be the only one.
pub(crate) fn check_unique_names(all: &[Declared], mechanism: &Mechanism, faults: &mut Faults) {
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
