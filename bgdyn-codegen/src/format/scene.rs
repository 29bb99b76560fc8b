//! The file of a scene as it was written.

use super::index::root_keys;
use super::walk::{At, Reader};
use super::yaml;
use super::{Dimension, Field, Located, Number, Raw};
use crate::fault::{Faults, Location};

/// A scene's file.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneSpec {
    /// The file's mapping.
    pub location: Location,
    /// Whether everything in the file could be read; nothing is built from half a spec.
    pub complete: bool,
    /// Version of the format.
    pub version: Field<Number>,
    /// Name of the scene.
    pub name: Field<String>,
    /// Text for the docs.
    pub description: Field<String>,
    /// Path of the mechanism's file, from this one.
    pub mechanism: Field<String>,
    /// Joints that stand still, with their coordinates.
    pub lock: Field<Vec<Raw>>,
    /// Whether all of `effects` could be read, or there is none.
    pub effects_read: bool,
    /// The effects called for: words, or names with keys.
    pub effects: Field<Vec<Raw>>,
    /// What drives the inputs.
    pub inputs: Field<Vec<Raw>>,
    /// Where the run begins.
    pub initial: Field<Vec<Raw>>,
    /// What is wanted of it.
    pub outputs: Field<Vec<Raw>>,
    /// How it is run.
    pub integration: Field<Raw>,
}

/// The key that makes a file a scene's.
const SCENE: &str = "scene";

/// Whether the text is a scene's: it has the key `scene`, in any place, and not `format` before it. Without
/// either: it names a mechanism and has no links.
pub fn is_scene(text: &str) -> bool {
    let keys = root_keys(text);
    let has = |wanted: &str| keys.iter().any(|key| key == wanted);
    match keys
        .iter()
        .find(|key| [SCENE, "format"].contains(&key.as_str()))
    {
        Some(key) => key == SCENE,
        None => has("mechanism") && !has("links"),
    }
}

/// Reads a scene. What cannot be read is reported and left out, the rest is there.
pub fn parse_scene(text: &str) -> (Option<SceneSpec>, Faults) {
    let mut reader = Reader::default();
    let tree = yaml::read(text, &mut reader.faults);
    let spec = tree.and_then(|tree| reader.scene(&At::root(&tree)));
    let complete = !reader.faults.any_fault();
    reader.faults.sort();
    let effects_read = |spec: &SceneSpec| match spec.effects {
        // An unknown key may be meant for it.
        Field::Absent => complete,
        _ => !reader.faults.any_in("effects"),
    };
    let spec = spec.map(|spec| SceneSpec {
        complete,
        effects_read: effects_read(&spec),
        ..spec
    });
    (spec, reader.faults)
}

impl Reader {
    fn scene(&mut self, at: &At<'_>) -> Option<SceneSpec> {
        let keys = [
            SCENE,
            "name",
            "description",
            "mechanism",
            "lock",
            "effects",
            "inputs",
            "initial",
            "outputs",
            "integration",
        ];
        let map = self.mapping(at, ("a mapping", "`scene: 1`, `mechanism: …`"), &keys)?;
        let version = "`scene: 1`, the version of the format";
        let path = "`mechanism: …`, the path of the mechanism's file, from this one";
        let whole = |name: &str, at: &At<'_>| {
            let location = at.location.clone();
            let value = name.to_owned();
            Raw::entry(Located { value, location }, at)
        };
        Some(SceneSpec {
            version: self.needed(&map, SCENE, version, |r, at| {
                r.number(at, &[Dimension::One])
            }),
            name: self.text_field(&map, "name"),
            description: self.text_field(&map, "description"),
            mechanism: self.needed(&map, "mechanism", path, Self::text),
            lock: self.field(&map, "lock", |r, at| {
                r.table(at, ("joints with their coordinates", "`wrist: 30 deg`"))
            }),
            effects: self.field(&map, "effects", |r, at| {
                let item = "each effect after a dash: `- gravity`";
                r.calls(at, ("a list of effects", item))
            }),
            inputs: self.field(&map, "inputs", |r, at| {
                r.table(at, ("inputs by name", "`shoulder: { constant: 2 }`"))
            }),
            initial: self.field(&map, "initial", |r, at| {
                r.table(at, ("initial values by name", "`shoulder: 10 deg`"))
            }),
            outputs: self.field(&map, "outputs", |r, at| {
                r.calls(at, ("a list of names", "`[shoulder, tool]`"))
            }),
            integration: self.field(&map, "integration", |_, at| Some(whole("integration", at))),
            location: map.location,
            complete: false,
            effects_read: false,
        })
    }
}
