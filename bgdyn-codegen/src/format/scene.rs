//! Parses the file of a scene.

use super::index::root_keys;
use super::walk::{At, Reader};
use super::yaml;
use super::{Dimension, Field, Located, Number, Raw};
use crate::fault::wording::expected;
use crate::fault::{Faults, Location};

/// A scene's file.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneSpec {
    /// Location of the file's mapping.
    pub location: Location,
    /// Whether everything in the file was parsed; nothing is built from an incomplete spec.
    pub complete: bool,
    /// Version of the format.
    pub version: Field<Number>,
    /// Name of the scene.
    pub name: Field<String>,
    /// Text for the documentation.
    pub description: Field<String>,
    /// Path of the mechanism's file, relative to this one.
    pub mechanism: Field<String>,
    /// Locked joints, with their coordinates.
    pub lock: Field<Vec<Raw>>,
    /// Whether all of `effects` was parsed, or is absent.
    pub effects_read: bool,
    /// The effects of the scene: words, or names with keys.
    pub effects: Field<Vec<Raw>>,
    /// The sources of the inputs.
    pub inputs: Field<Vec<Raw>>,
    /// Whether the limits of efforts in the mechanism's file act.
    pub effort_limits: Field<Raw>,
    /// How controllers are sampled.
    pub control: Field<Raw>,
    /// The model by which torques are computed, if it is not the scene's own.
    pub controller_model: Field<ControllerModelSpec>,
    /// The initial state.
    pub initial: Field<Vec<Raw>>,
    /// The outputs.
    pub outputs: Field<Vec<Raw>>,
    /// The integration.
    pub integration: Field<Raw>,
}

impl SceneSpec {
    /// Returns the path of the mechanism of the controllers' model; `None` if it is that of the scene.
    pub fn mechanism_of_controllers(&self) -> Option<&Located<String>> {
        self.controller_model.given()?.value.mechanism.given()
    }
}

/// The model of a scene's controllers; what is absent is that of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct ControllerModelSpec {
    /// Its location.
    pub location: Location,
    /// Path of the mechanism's file, relative to the scene's.
    pub mechanism: Field<String>,
    /// The effects that it contains.
    pub effects: Field<Vec<Raw>>,
    /// Values of run-time parameters.
    pub parameters: Field<Vec<Raw>>,
}

/// The key that marks the file of a scene.
const SCENE: &str = "scene";

/// Returns whether the text is a scene: it has the key `scene`, at any position, and not `format` before
/// it. A text without either key is a scene if it names a mechanism and has no links.
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

/// Parses a scene. Unreadable parts are reported and omitted; the rest is returned.
pub fn parse_scene(text: &str) -> (Option<SceneSpec>, Faults) {
    let mut reader = Reader::default();
    let tree = yaml::read(text, &mut reader.faults);
    let spec = tree.and_then(|tree| reader.scene(&At::root(&tree)));
    let complete = !reader.faults.any_fault();
    reader.faults.sort();
    let effects_read = |spec: &SceneSpec| match spec.effects {
        // An unknown key may be a misspelling of it.
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
            "effort_limits",
            "control",
            "controller_model",
            "initial",
            "outputs",
            "integration",
        ];
        let map = self.mapping(at, expected::SCENE, &keys)?;
        let version = expected::SCENE_KEY;
        let path = expected::MECHANISM_KEY;
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
            lock: self.field(&map, "lock", |r, at| r.table(at, expected::LOCKS)),
            effects: self.field(&map, "effects", |r, at| r.calls(at, expected::CALLS)),
            inputs: self.field(&map, "inputs", |r, at| r.table(at, expected::INPUTS)),
            effort_limits: self.field(&map, "effort_limits", |_, at| {
                Some(whole("effort_limits", at))
            }),
            control: self.field(&map, "control", |_, at| Some(whole("control", at))),
            controller_model: self.field(&map, "controller_model", Self::controller_model),
            initial: self.field(&map, "initial", |r, at| r.table(at, expected::INITIAL)),
            outputs: self.field(&map, "outputs", |r, at| r.calls(at, expected::OUTPUTS)),
            integration: self.field(&map, "integration", |_, at| Some(whole("integration", at))),
            location: map.location,
            complete: false,
            effects_read: false,
        })
    }

    fn controller_model(&mut self, at: &At<'_>) -> Option<ControllerModelSpec> {
        let keys = ["mechanism", "effects", "parameters"];
        let map = self.mapping(at, expected::CONTROLLER_MODEL, &keys)?;
        Some(ControllerModelSpec {
            mechanism: self.text_field(&map, "mechanism"),
            effects: self.field(&map, "effects", |r, at| r.calls(at, expected::CALLS)),
            parameters: self.field(&map, "parameters", |r, at| {
                r.table(at, expected::PARAMETERS)
            }),
            location: map.location,
        })
    }
}
