//! Reads YAML text into a checked machine or the equations of a scene, and reports all faults together.

use std::path::Path;

use crate::bond_graph;
use crate::effect;
use crate::fault::{Fault, Faults, Severity, wording};
use crate::files::stem;
use crate::format::{JointSpec, Located, SceneSpec, Spec, is_scene, parse, parse_scene};
use crate::machine::{self, Machine};
use crate::mechanism::Mechanism;
use crate::method;
use crate::refusal::Refusal;
use crate::scene::{self, Scene, Verdict};
use crate::system::SceneEquations;

/// The text of a mechanism or of a scene, and its surroundings.
pub struct SpecText<'a> {
    /// The text.
    pub text: &'a str,
    /// The stem of the file's name.
    pub stem: &'a str,
    /// Returns the text of a scene's mechanism, given its path in the scene, or the reason why there is none.
    pub load: &'a dyn Fn(&str) -> Result<String, String>,
}

impl<'a> SpecText<'a> {
    /// Returns the text of a mechanism, with nothing to load.
    pub fn mechanism(text: &'a str, stem: &'a str) -> Self {
        let load = &|path: &str| Err(format!("`{path}` is not loaded"));
        SpecText { text, stem, load }
    }
}

/// A checked mechanism, or the equations of a checked scene.
pub enum Checked {
    /// A mechanism.
    Mechanism(Box<Mechanism>),
    /// The equations of a scene.
    Scene(Box<SceneEquations>),
}

/// Parses and checks a mechanism or a scene; returns the warnings beside it.
///
/// # Errors
/// The faults of the mechanism, or of the scene or its mechanism.
pub fn read_text(spec: &SpecText<'_>) -> Result<(Checked, Faults), Refusal> {
    if is_scene(spec.text) {
        let (equations, warnings) = read_scene(spec.text, spec.stem, spec.load)?;
        return Ok((Checked::Scene(Box::new(equations)), warnings));
    }
    match read(spec.text, Some(spec.stem)) {
        (Some(mechanism), warnings) => Ok((Checked::Mechanism(Box::new(mechanism)), warnings)),
        (None, faults) => Err(Refusal::Spec(faults)),
    }
}

/// Parses and checks a spec. `stem` is the file's name without its extension, if there is a file; only the
/// part before its first dot is used.
///
/// The machine is returned exactly if no fault refuses the spec; there may be warnings in both cases. The
/// findings are in the order of the file.
pub fn read_machine(text: &str, stem: Option<&str>) -> (Option<Machine>, Faults) {
    let (spec, mut faults) = parse(text);
    let Some(spec) = spec else {
        return (None, faults);
    };
    let (machine, more) = machine::check(&spec, stem, &method::names(), &effect::kinds());
    faults.0.extend(more.0);
    if let Some(machine) = &machine {
        faults.0.extend(without_inertia(&machine.mechanism, &spec));
    }
    faults.sort();
    (machine, faults)
}

/// The same without the effects that the file declares.
pub fn read(text: &str, stem: Option<&str>) -> (Option<Mechanism>, Faults) {
    let (machine, faults) = read_machine(text, stem);
    (machine.map(|machine| machine.mechanism), faults)
}

/// Returns warnings for joints without inertia, for which forward dynamics always fails.
fn without_inertia(mechanism: &Mechanism, spec: &Spec) -> Vec<Fault> {
    let graph = bond_graph::build(mechanism);
    let links = spec.links.value().into_iter().flatten();
    let joints: Vec<&JointSpec> = links.filter_map(|link| link.joint.value()).collect();
    let found = graph.without_inertia().into_iter().filter_map(|j| {
        let name = &graph.coordinates[j.0].name;
        // A velocity of a joint with several is called JOINT_ENDING.
        let own = |joint: &&&JointSpec| {
            let rest = joint
                .name
                .value()
                .and_then(|own| name.strip_prefix(own.as_str()));
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
        };
        let length = |joint: &&&JointSpec| joint.name.value().map_or(0, String::len);
        let joint = joints.iter().filter(own).max_by_key(length)?;
        Some(wording::no_inertia(&joint.location, name))
    });
    found.collect()
}

/// Parses and checks a scene and its mechanism. `load` returns the text of a file from the path in the
/// scene.
///
/// # Errors
/// The faults of the scene or of its mechanism.
pub fn read_scene(
    text: &str,
    stem: &str,
    load: impl Fn(&str) -> Result<String, String>,
) -> Result<(SceneEquations, Faults), Refusal> {
    let (spec, mut faults) = parse_scene(text);
    let Some(spec) = spec else {
        return Err(Refusal::Spec(faults));
    };
    let alone = |mut faults: Faults| {
        faults
            .0
            .extend(scene::check_alone(&spec, Some(stem), &effect::kinds()).0);
        faults.sort();
        faults
    };
    let Some(path) = spec.mechanism.given() else {
        return Err(Refusal::Spec(alone(faults)));
    };
    let loaded = match load(&path.value) {
        Ok(loaded) => loaded,
        Err(why) => {
            let fault = wording::mechanism_unreadable(&path.location, &path.value, &why);
            faults.push(fault);
            return Err(Refusal::Spec(alone(faults)));
        }
    };
    let name = self::stem(Path::new(&path.value));
    let (machine, found) = read_machine(&loaded, Some(&name));
    let Some(machine) = machine else {
        let path = path.value.clone();
        return Err(Refusal::Mechanism {
            path,
            text: loaded,
            faults: found,
            scene: alone(faults),
        });
    };
    let (verdict, more) = scene::check(&spec, Some(stem), &machine, &effect::kinds());
    faults.0.extend(more.0);
    let system = match verdict {
        Verdict::Sound(scene) => match controlled(*scene, &spec, &machine, &load) {
            Ok(scene) => SceneEquations::new(scene),
            Err(Refusal::Spec(more)) => Err(more),
            Err(other) => return Err(other),
        },
        Verdict::Drawn(scene) => {
            let found = SceneEquations::new(*scene).err().unwrap_or_default();
            faults.0.extend(independent(found, &faults));
            Err(Faults::default())
        }
        Verdict::Refused => Err(Faults::default()),
    };
    let system = match system {
        Ok(system) => system,
        Err(more) => {
            faults.0.extend(more.0);
            faults.sort();
            return Err(Refusal::Spec(faults));
        }
    };
    for element in system.idle() {
        let (location, name) = (&element.location, &element.name);
        faults.push(wording::no_motion_there(location, name, &element.sites()));
    }
    faults.sort();
    for joint in system.without_inertia() {
        faults.push(wording::no_inertia_in_scene(&path.location, joint));
    }
    Ok((system, faults))
}

/// Adds the model of the controllers, if the scene has one.
fn controlled(
    scene: Scene,
    spec: &SceneSpec,
    own: &Machine,
    load: &dyn Fn(&str) -> Result<String, String>,
) -> Result<Scene, Refusal> {
    let other = match spec.mechanism_of_controllers() {
        Some(path) => Some(machine_of_controllers(path, load)?),
        None => None,
    };
    let machine = other.as_ref().unwrap_or(own);
    let (scene, faults) = scene::with_controller_model(scene, spec, machine, &effect::kinds());
    match faults.any_fault() {
        true => Err(Refusal::Spec(faults)),
        false => Ok(scene),
    }
}

/// Reads the mechanism of the controllers' model.
fn machine_of_controllers(
    path: &Located<String>,
    load: &dyn Fn(&str) -> Result<String, String>,
) -> Result<Machine, Refusal> {
    let text = load(&path.value).map_err(|why| {
        let fault = wording::controller_mechanism_unreadable(&path.location, &path.value, &why);
        Refusal::Spec(Faults(vec![fault]))
    })?;
    let (machine, faults) = read_machine(&text, Some(&stem(Path::new(&path.value))));
    machine.ok_or_else(|| Refusal::Mechanism {
        path: path.value.clone(),
        text,
        faults,
        scene: Faults::default(),
    })
}

/// Returns the faults of the equations of a scene with other faults that are no consequences of these:
/// values out of range may be due to an unreadable initial state.
fn independent(found: Faults, faults: &Faults) -> Vec<Fault> {
    let elsewhere = |f: &Fault| f.severity == Severity::Fault && f.path.is_empty();
    let start =
        ["initial", "lock"].iter().any(|key| faults.any_in(key)) || faults.0.iter().any(elsewhere);
    let mut found = found.0;
    found.retain(|f| !(start && f.rule == "effect-range"));
    found
}
