//! Writes a robot as the YAML text of a mechanism.

use super::model::{Frame, Inertial, Joint, Limits, Link, Loop, Mimic, Model};
use super::naming::shown;
use super::number::{Num, all_zero};
use super::placement::Placement;

/// Longer lines are broken.
const WIDTH: usize = 100;

/// A link in the notation of the mechanism.
pub(super) struct LinkEntry<'a> {
    pub(super) link: &'a Link,
    pub(super) name: &'a str,
    /// The name of the parent link; `None` for the fixed base.
    pub(super) parent: Option<&'a str>,
    pub(super) joint: Option<(&'a Joint, &'a str)>,
    /// The name of the joint that its joint follows, and whether both are angles or both displacements.
    pub(super) leader: Option<(&'a str, bool)>,
    /// A name for the joint that fixes a root, if the default name is in use.
    pub(super) mount: Option<String>,
    pub(super) allow_nonphysical: bool,
}

/// Returns the text up to the first link.
pub(super) fn head(model: &Model, snap: Option<&str>) -> String {
    let robot = match model.name.as_str() {
        "" => "robot without a name".to_owned(),
        name => format!("robot {}", shown(name)),
    };
    let mut text = format!(
        "# Imported from {} ({robot}) by bgdyn import\nformat: 1\n",
        model.source
    );
    if !model.name.is_empty() {
        text += &format!("label: {}\n", scalar(&model.name));
    }
    if let Some(snap) = snap {
        text += &format!("snap: {snap}\n");
    }
    if let Some(gravity) = &model.gravity {
        text += &format!("gravity: {}\n", list(gravity));
    }
    if model.moving_base {
        text += "base: given\n";
    }
    text + "\nlinks:\n"
}

/// Returns the list of frames, with their names and those of their links; empty without frames.
pub(super) fn frames(frames: &[(&Frame, &str, &str)]) -> String {
    let entry = |(frame, name, link): &(&Frame, &str, &str)| {
        let mut keys = vec![format!("name: {}", scalar(name))];
        if *name != frame.name {
            keys.push(format!("label: {}", scalar(&frame.name)));
        }
        keys.push(format!("link: {}", scalar(link)));
        keys.extend(origin(&frame.place));
        format!("  - {{ {} }}\n", keys.join(", "))
    };
    let entries: String = frames.iter().map(entry).collect();
    match entries.as_str() {
        "" => entries,
        _ => format!("\nframes:\n{entries}"),
    }
}

/// A loop with its name, and the names of its links.
pub(super) type NamedLoop<'a> = (&'a Loop, &'a str, [&'a str; 2]);

/// What an imported loop needs beside its places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Allowed {
    Nothing,
    /// Rows that follow from others, such as those of two points on one axis.
    Redundant,
    /// The same, with numbers of the file that are rounded.
    Rounded,
}

/// Returns the list of loops; empty without loops.
pub(super) fn loops(loops: &[NamedLoop<'_>], allowed: Allowed) -> String {
    let place = |place: &Placement, link: &str| {
        let keys = [Some(format!("link: {}", scalar(link))), origin(place)];
        let keys: Vec<String> = keys.into_iter().flatten().collect();
        format!("{{ {} }}", keys.join(", "))
    };
    let entry = |(one, name, [a, b]): &NamedLoop<'_>| {
        let mut lines = vec![format!("name: {}", scalar(name))];
        lines.push(format!("type: {}", one.kind));
        lines.extend(one.axis.as_ref().and_then(axis));
        lines.push(format!("a: {}", place(&one.a.place, a)));
        lines.push(format!("b: {}", place(&one.b.place, b)));
        if allowed != Allowed::Nothing {
            lines.push("redundant: allow".into());
        }
        if allowed == Allowed::Rounded {
            lines.push("tolerance: 1e-9 m".into());
        }
        format!("  - {}\n", lines.join("\n    "))
    };
    let entries: Vec<String> = loops.iter().map(entry).collect();
    match entries.is_empty() {
        true => String::new(),
        false => format!("\nloops:\n{}", entries.join("\n")),
    }
}

/// An effect that the mechanism declares.
pub(super) struct Effect<'a> {
    pub(super) name: String,
    pub(super) kind: &'static str,
    pub(super) joint: &'a str,
    /// Its keys with their numbers.
    pub(super) keys: Vec<(&'static str, Num)>,
}

/// Returns the effects that scenes can include; empty without effects.
pub(super) fn effects(effects: &[Effect<'_>]) -> String {
    let entry = |effect: &Effect<'_>| {
        let (name, kind, joint) = (&effect.name, effect.kind, scalar(effect.joint));
        let keys = effect.keys.iter();
        let keys: String = keys
            .map(|(key, value)| format!(", {key}: {}", value.text))
            .collect();
        format!("  {name}: {{ type: {kind}, joint: {joint}{keys} }}\n")
    };
    let entries: String = effects.iter().map(entry).collect();
    match entries.as_str() {
        "" => entries,
        _ => format!("\neffects:\n{entries}"),
    }
}

/// Returns one link of the list.
pub(super) fn entry(entry: &LinkEntry<'_>) -> String {
    let mut lines = vec![format!("name: {}", scalar(entry.name))];
    if entry.name != entry.link.name {
        lines.push(format!("label: {}", scalar(&entry.link.name)));
    }
    if let Some(parent) = entry.parent {
        lines.push(format!("parent: {}", scalar(parent)));
    }
    if let Some((joint, name)) = entry.joint {
        write_joint(joint, name, entry.leader, &mut lines);
    }
    let mount = entry
        .mount
        .as_ref()
        .map(|name| format!("name: {}", scalar(name)));
    let place = entry.link.place.as_ref().and_then(origin);
    if mount.is_some() || place.is_some() {
        let keys = [mount, Some("type: fixed".into()), place];
        let keys: Vec<String> = keys.into_iter().flatten().collect();
        lines.push(format!("joint: {{ {} }}", keys.join(", ")));
    }
    if let Some(inertial) = &entry.link.inertial {
        write_inertial(inertial, &mut lines);
    }
    if entry.allow_nonphysical {
        lines.push("nonphysical: allow".into());
    }
    format!("  - {}\n", lines.join("\n    "))
}

fn write_joint(joint: &Joint, name: &str, leader: Option<(&str, bool)>, lines: &mut Vec<String>) {
    let mut keys = vec![format!("name: {}", scalar(name))];
    if name != joint.name {
        keys.push(format!("label: {}", scalar(&joint.name)));
    }
    keys.push(format!("type: {}", joint.kind.keyword()));
    if joint.kind.has_axis() {
        keys.extend(axis(&joint.axis));
    }
    keys.extend(
        joint
            .lead
            .as_ref()
            .map(|lead| format!("lead: {}", lead.text)),
    );
    keys.extend(origin(&joint.origin));
    keys.extend(limits(&joint.limits));
    if let (Some(mimic), Some((leader, alike))) = (&joint.mimic, leader) {
        keys.push(follows(mimic, leader, alike));
    }
    let flow = format!("joint: {{ {} }}", keys.join(", "));
    if flow.len() + 4 <= WIDTH {
        lines.push(flow);
    } else {
        lines.push("joint:".into());
        lines.extend(keys.into_iter().map(|key| format!("  {key}")));
    }
}

/// Returns the key `mimic`. Between an angle and a displacement the ratio must be given.
fn follows(mimic: &Mimic, leader: &str, alike: bool) -> String {
    let mut keys = vec![format!("joint: {}", scalar(leader))];
    if !alike || mimic.ratio.value != 1.0 {
        keys.push(format!("ratio: {}", mimic.ratio.text));
    }
    if !mimic.offset.is_zero() {
        keys.push(format!("offset: {}", mimic.offset.text));
    }
    format!("mimic: {{ {} }}", keys.join(", "))
}

/// Returns the key `axis`; `None` for z, which is the default.
fn axis(axis: &[Num; 3]) -> Option<String> {
    let name = match axis.each_ref().map(|number| number.value) {
        [0.0, 0.0, 1.0] => return None,
        [1.0, 0.0, 0.0] => "x",
        [0.0, 1.0, 0.0] => "y",
        [-1.0, 0.0, 0.0] => "-x",
        [0.0, -1.0, 0.0] => "-y",
        [0.0, 0.0, -1.0] => "-z",
        _ => return Some(format!("axis: {}", list(axis))),
    };
    Some(format!("axis: {name}"))
}

fn origin(place: &Placement) -> Option<String> {
    let parts = [("xyz", &place.xyz), ("rpy", &place.rpy)]
        .into_iter()
        .filter(|(_, part)| !all_zero(*part));
    let parts: Vec<String> = parts
        .map(|(key, part)| format!("{key}: {}", list(part)))
        .collect();
    (!parts.is_empty()).then(|| format!("origin: {{ {} }}", parts.join(", ")))
}

fn limits(limits: &Limits) -> Option<String> {
    let Limits {
        lower,
        upper,
        velocity,
        effort,
    } = limits;
    let parts = [
        ("lower", lower),
        ("upper", upper),
        ("velocity", velocity),
        ("effort", effort),
    ];
    let parts = parts
        .into_iter()
        .filter_map(|(key, value)| Some(format!("{key}: {}", value.as_ref()?.text)));
    let parts: Vec<String> = parts.collect();
    (!parts.is_empty()).then(|| format!("limits: {{ {} }}", parts.join(", ")))
}

fn write_inertial(inertial: &Inertial, lines: &mut Vec<String>) {
    if !inertial.mass.is_zero() {
        lines.push(format!("mass: {}", inertial.mass.text));
    }
    if !all_zero(&inertial.com) {
        lines.push(format!("com: {}", list(&inertial.com)));
    }
    let entries = ["xx", "yy", "zz", "xy", "xz", "yz"]
        .into_iter()
        .zip(&inertial.tensor);
    let entries = entries.filter(|(_, entry)| !entry.is_zero());
    let mut entries: Vec<String> = entries
        .map(|(key, entry)| format!("{key}: {}", entry.text))
        .collect();
    if entries.is_empty() {
        return;
    }
    if !all_zero(&inertial.rpy) {
        entries.push(format!("rpy: {}", list(&inertial.rpy)));
    }
    let flow = format!("inertia: {{ {} }}", entries.join(", "));
    if flow.len() + 4 <= WIDTH {
        lines.push(flow);
    } else {
        lines.push("inertia:".into());
        lines.extend(entries.into_iter().map(|entry| format!("  {entry}")));
    }
}

fn list(numbers: &[Num; 3]) -> String {
    let [x, y, z] = numbers.each_ref().map(|number| number.text.as_str());
    format!("[{x}, {y}, {z}]")
}

/// Text as a YAML scalar: plain where nothing in it can be taken for anything else, quoted otherwise.
fn scalar(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.' | '/');
    let words = [
        "null", "true", "false", "yes", "no", "on", "off", "nan", "inf", "infinity",
    ];
    let letter = text.starts_with(|c: char| c.is_ascii_alphabetic());
    let spaced = text
        .split(' ')
        .all(|word| !word.is_empty() && word.chars().all(plain));
    if letter && spaced && !words.contains(&text.to_ascii_lowercase().as_str()) {
        return text.to_string();
    }
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            ' '..='~' => out.push(c),
            // Letters and signs of the Basic Multilingual Plane that YAML can print.
            '\u{a0}'..='\u{2027}' | '\u{202a}'..='\u{d7ff}' => out.push(c),
            c if u32::from(c) <= 0xffff => out.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => out.push_str(&format!("\\U{:08x}", u32::from(c))),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::scalar;

    #[test]
    fn scalars_are_quoted_where_needed() {
        for plain in ["arm", "Upper-Arm", "UR5 left", "a.b/c"] {
            assert_eq!(scalar(plain), plain);
        }
        for (text, quoted) in [
            ("null", r#""null""#),
            ("1e5", r#""1e5""#),
            ("a: b", r#""a: b""#),
            ("a  b", r#""a  b""#),
            ("say \"x\"\\\n", r#""say \"x\"\\\u000a""#),
            ("Größe \u{2028}🤖", "\"Größe \\u2028\\U0001f916\""),
            ("", r#""""#),
        ] {
            assert_eq!(scalar(text), quoted);
            let read: String = serde_yaml::from_str(quoted).unwrap();
            assert_eq!(read, text);
        }
    }
}
