//! Guesses the interface of a module whose spec is refused: its dimensions and the names of its parts.

mod scene;

use crate::format::{Field, LinkSpec, Spec};
use crate::mechanism::joint::{JOINT_TYPES, JointType, Motion};
use crate::mechanism::{base_parameter_names, prescribed_parameter_names};
use crate::name::is_identifier;
pub use scene::SceneInterface;

/// The interface of a module without its mechanism.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interface {
    /// The module's name.
    pub name: String,
    /// Names of the moving joints; empty if the spec gives none.
    pub joints: Vec<String>,
    /// Names of the links; empty if the spec gives none.
    pub links: Vec<String>,
    /// Names of the frames; empty if the spec gives none.
    pub frames: Vec<String>,
    /// Names of the run-time parameters.
    pub parameters: Vec<String>,
    /// Whether the motion of the base is given at run time.
    pub base: bool,
    /// Names of the joints whose motion is prescribed.
    pub prescribed: Vec<String>,
    /// Whether the corrected spec will certainly have this number of joints.
    pub certain: bool,
}

impl Interface {
    /// Returns the interface that the author of the spec most likely means. `None` if the stem cannot name
    /// a module.
    pub fn guess(text: &str, stem: &str) -> Option<Self> {
        if !is_identifier(stem) {
            return None;
        }
        let (spec, _) = crate::format::parse(text);
        let (_, faults) = crate::read::read(text, Some(stem));
        let links = spec.as_ref().and_then(links);
        let Some(links) = links else {
            return Some(Interface {
                name: stem.into(),
                joints: vec![String::new(); moving_words(text)],
                links: vec![],
                frames: vec![],
                parameters: parameter_words(text),
                base: false,
                prescribed: vec![],
                certain: false,
            });
        };
        let word = spec.as_ref().and_then(|spec| spec.base.value());
        let base = word.is_some_and(|word| word == "given");
        let mut parameters = parameter_words(text);
        parameters.extend(base.then(base_parameter_names).into_iter().flatten());
        let prescribed = spec.as_ref().map(prescribed).unwrap_or_default();
        let motions = prescribed.iter();
        parameters.extend(motions.flat_map(|joint| prescribed_parameter_names(joint)));
        let own = |joint: &String| !prescribed.contains(joint);
        Some(Interface {
            name: stem.into(),
            joints: links.iter().filter_map(moving_joint).filter(own).collect(),
            links: links
                .iter()
                .map(|l| l.name.value().cloned().unwrap_or_default())
                .collect(),
            frames: spec.as_ref().map(frames).unwrap_or_default(),
            parameters,
            base,
            prescribed,
            certain: links.iter().all(is_plain)
                && spec
                    .as_ref()
                    .is_some_and(|spec| spec.constraints.is_absent())
                && !faults.0.iter().any(|f| shapes_the_tree(&f.path)),
        })
    }
}

fn links(spec: &Spec) -> Option<&[LinkSpec]> {
    spec.links.value().map(Vec::as_slice)
}

fn frames(spec: &Spec) -> Vec<String> {
    let frames = spec.frames.value().map(Vec::as_slice).unwrap_or_default();
    frames
        .iter()
        .filter_map(|f| f.name.value().cloned())
        .collect()
}

/// Returns the joints that constraints prescribe, each once.
fn prescribed(spec: &Spec) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for raw in spec.constraints.value().into_iter().flatten() {
        let given = raw
            .peek("type")
            .is_some_and(|word| word.value == "prescribed");
        let joint = raw.peek("joint").filter(|_| given);
        if let Some(joint) = joint.filter(|j| is_identifier(&j.value) && !names.contains(&j.value))
        {
            names.push(joint.value);
        }
    }
    names
}

/// Returns the name of the link's joint, if it seems to be a moving one.
fn moving_joint(link: &LinkSpec) -> Option<String> {
    let joint = match &link.joint {
        Field::Absent => return None,
        Field::Broken => return Some(String::new()),
        Field::Given(joint) => &joint.value,
    };
    let fixed = joint.kind.value().is_some_and(|kind| kind == "fixed");
    (!fixed).then(|| joint.name.value().cloned().unwrap_or_default())
}

/// Returns whether the link's joint has at most one position, which is its own.
fn is_plain(link: &LinkSpec) -> bool {
    let Some(joint) = link.joint.value() else {
        return true;
    };
    let word = joint.kind.value();
    let kind = JOINT_TYPES
        .iter()
        .find(|kind| Some(kind.keyword) == word.map(String::as_str));
    let compound =
        |kind: &&&JointType| !kind.chain.is_empty() || matches!(kind.motion, Motion::Compound(_));
    kind.filter(compound).is_none() && joint.mimic.is_absent()
}

/// Returns whether a fault at this path makes the number of joints uncertain.
fn shapes_the_tree(path: &str) -> bool {
    let mut parts = path.split('.');
    let links = parts.next().unwrap_or_default();
    if !(links.is_empty() || links == "links" || links.starts_with("links[")) {
        return false;
    }
    let rest: Vec<&str> = parts.collect();
    matches!(rest.as_slice(), [] | ["joint"] | ["joint", "type"])
}

/// Returns the values of the keys `parameter` that are identifiers, each once. They are found in the text,
/// because a list with one invalid number has no parameters after parsing.
fn parameter_words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let lines = text.lines().filter_map(|line| line.split('#').next());
    for after in lines.flat_map(|line| line.split("parameter:").skip(1)) {
        let after = after.trim_start().trim_start_matches(['"', '\'']);
        let end = after.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
        let word = &after[..end.unwrap_or(after.len())];
        if is_identifier(word) && !words.iter().any(|w| w == word) {
            words.push(word.to_owned());
        }
    }
    words
}

/// Returns the number of words in the text that are moving joint types; the only information in a text
/// that is no YAML.
fn moving_words(text: &str) -> usize {
    let moving = |word: &str| {
        JOINT_TYPES
            .iter()
            .any(|t| t.keyword == word && t.motion != Motion::None)
    };
    text.lines()
        .filter_map(|line| line.split('#').next()?.split_once("type:"))
        .filter(|(_, value)| {
            let value = value.trim_start();
            let end = value.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
            moving(&value[..end.unwrap_or(value.len())])
        })
        .count()
}
