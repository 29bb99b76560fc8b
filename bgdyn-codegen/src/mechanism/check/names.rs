//! Checks names: they are unique identifiers, and the mechanism has the name of its file.

use std::collections::BTreeMap;

use crate::fault::{Fault, Faults, Location, wording};
use crate::format::{Field, FrameSpec, JointSpec, LinkSpec, Located, Spec};
use crate::mechanism::joint::{JOINT_TYPES, Motion};
use crate::name::{WORLD, is_identifier};

/// The only name whose struct, `T`, would hide the type parameter of generated code.
const TYPE_PARAMETER: &str = "t";

/// Returns the mechanism's name: the file's stem up to its first dot, or the spec's `name`.
pub(super) fn mechanism_name(
    spec: &Spec,
    stem: Option<&str>,
    faults: &mut Faults,
) -> Option<String> {
    let stem = stem.map(|stem| stem.split('.').next().unwrap_or(stem));
    let fault = match (&spec.name, stem) {
        (Field::Broken, _) => return None,
        (Field::Absent, None) => Some(wording::no_name(&spec.location)),
        (Field::Absent, Some(stem)) => {
            (!is_identifier(stem)).then(|| wording::stem_not_identifier(&spec.location, stem))
        }
        (Field::Given(name), stem) => {
            not_identifier(name).or_else(|| stem.and_then(|stem| differs(name, stem)))
        }
    };
    faults.0.extend(fault);
    let name = spec.name.value().map(String::as_str).or(stem)?;
    if name == TYPE_PARAMETER {
        let location = spec.name.given().map_or(&spec.location, |n| &n.location);
        faults.push(wording::taken_name(location, name));
    }
    Some(name.to_owned())
}

fn differs(name: &Located<String>, stem: &str) -> Option<Fault> {
    (name.value != stem).then(|| wording::name_differs_from_file(&name.location, &name.value, stem))
}

fn not_identifier(name: &Located<String>) -> Option<Fault> {
    (!is_identifier(&name.value)).then(|| wording::not_identifier(&name.location, &name.value))
}

/// Checks the names of links, frames and joints.
pub(super) fn check(links: &[LinkSpec], frames: &[FrameSpec], faults: &mut Faults) {
    let mut carriers = SeenNames::new("links and frames");
    for link in links {
        carriers.add_body(&link.name, faults);
    }
    for frame in frames {
        carriers.add_body(&frame.name, faults);
    }
    let mut joints = SeenNames::new("joints");
    for joint in links.iter().filter_map(|link| link.joint.value()) {
        if let Some(name) = joint.name.given() {
            faults.0.extend(not_identifier(name));
            joints.add(&name.value, &name.location, faults);
        }
    }
    for link in links {
        parts(link, &mut carriers, &mut joints, faults);
    }
    functions(links, frames, faults);
    for link in links.iter().filter(|link| named_after_link(link)) {
        if let Some(name) = link.name.given() {
            joints.add_mount(&mount_name(&name.value), &name.location, faults);
        }
    }
}

/// The names of a link's or frame's methods begin with these.
const CARRIER_METHODS: [&str; 4] = ["pose", "velocity", "jacobian_world", "jacobian_dot_v_world"];

/// Checks that no function of a joint's pose has the name of another function of the model.
fn functions(links: &[LinkSpec], frames: &[FrameSpec], faults: &mut Faults) {
    let mut seen = SeenNames::new("functions of the model");
    let names = links.iter().map(|link| &link.name);
    let names = names.chain(frames.iter().map(|frame| &frame.name));
    for name in names.filter_map(Field::given) {
        for method in CARRIER_METHODS {
            let function = format!("{method}_{}", name.value);
            // A name that is not unique is reported already.
            seen.first.entry(function).or_insert(name.location.clone());
        }
    }
    for joint in links.iter().filter_map(|link| link.joint.value()) {
        let word = joint.kind.value().map(String::as_str);
        let kind = JOINT_TYPES.iter().find(|kind| Some(kind.keyword) == word);
        let (Some(kind), Some(name)) = (kind, joint.name.given()) else {
            continue;
        };
        if let Motion::Compound(motion) = kind.motion {
            for function in motion.access_names(&name.value).into_iter().flatten() {
                seen.add(&function, &name.location, faults);
            }
        }
    }
}

/// Adds the names of the velocities and positions of a joint with several, and of the massless link between
/// two joints in series.
fn parts(link: &LinkSpec, carriers: &mut SeenNames, joints: &mut SeenNames, faults: &mut Faults) {
    let Some(joint) = link.joint.value() else {
        return;
    };
    let word = joint.kind.value().map(String::as_str);
    let kind = JOINT_TYPES.iter().find(|kind| Some(kind.keyword) == word);
    let (Some(kind), Some(name)) = (kind, joint.name.given()) else {
        return;
    };
    let named: Vec<String> = kind
        .suffixes()
        .iter()
        .map(|suffix| format!("{}_{suffix}", name.value))
        .collect();
    for part in &named {
        joints.add(part, &name.location, faults);
    }
    if let (false, Some(own), Some(first)) =
        (kind.chain.is_empty(), link.name.value(), named.first())
    {
        carriers.add(&format!("{own}_{first}"), &name.location, faults);
    }
}

/// Returns the name of a fixed joint without a name.
pub(super) fn mount_name(link: &str) -> String {
    format!("{link}_mount")
}

fn named_after_link(link: &LinkSpec) -> bool {
    let fixed = |joint: &JointSpec| joint.kind.value().is_some_and(|kind| kind == "fixed");
    match &link.joint {
        Field::Absent => true,
        Field::Broken => false,
        Field::Given(joint) => joint.value.name.is_absent() && fixed(&joint.value),
    }
}

/// Names that must be unique among `what`, each with the location of the first one.
struct SeenNames {
    what: &'static str,
    first: BTreeMap<String, Location>,
}

impl SeenNames {
    fn new(what: &'static str) -> Self {
        SeenNames {
            what,
            first: BTreeMap::new(),
        }
    }

    fn add_body(&mut self, name: &Field<String>, faults: &mut Faults) {
        let Some(name) = name.given() else { return };
        if name.value == WORLD {
            return faults.push(wording::world_is_reserved(&name.location));
        }
        faults.0.extend(not_identifier(name));
        self.add(&name.value, &name.location, faults);
    }

    fn add_mount(&mut self, name: &str, location: &Location, faults: &mut Faults) {
        match self.first.get(name) {
            // The link's own name is not unique, which is reported already.
            Some(first) if first.path.ends_with("].name") => {}
            Some(first) => faults.push(wording::repeated_mount(location, name, first)),
            None => self.add(name, location, faults),
        }
    }

    fn add(&mut self, name: &str, location: &Location, faults: &mut Faults) {
        match self.first.get(name) {
            Some(first) => faults.push(wording::repeated_name(location, name, self.what, first)),
            None => {
                self.first.insert(name.to_owned(), location.clone());
            }
        }
    }
}
