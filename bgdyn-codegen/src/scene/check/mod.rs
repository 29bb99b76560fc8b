//! Checks a scene's file: the only code that constructs a [`Scene`], and the faults that prevent it.

mod control;
mod controller_model;
mod effects;
mod followed;
mod hold;
mod initial;
mod inputs;
mod joints;
mod limits;
mod locks;
mod outputs;
mod pose;
mod prescribed;
mod rigid_contacts;
mod run;
mod state;

pub(super) use controller_model::missing;
pub use controller_model::with_controller_model;
pub use limits::{integral_name, limit_events};

use bgdyn_runtime::Dd;

use super::{FileEntries, Initial, Scene};
use crate::declaration::{EffectKinds, RejectedEffects};
use crate::fault::{Faults, Location, wording};
use crate::format::{Field, Located, SceneSpec};
use crate::layout::StateLayout;
use crate::machine::Machine;
use crate::name::is_identifier;

/// The only version of the format.
const VERSION: f64 = 1.0;

/// The result of the check of a scene.
pub enum Verdict {
    /// The scene is valid.
    Sound(Box<Scene>),
    /// The scene is refused, but its effects are valid: its equations can be built, and checked as well.
    Drawn(Box<Scene>),
    /// The scene is refused, and its equations cannot be built.
    Refused,
}

/// Checks a scene against every rule. `stem` is the file's stem, `machine` its mechanism with effects,
/// `kinds` all effects.
pub fn check(
    spec: &SceneSpec,
    stem: Option<&str>,
    machine: &Machine,
    kinds: &EffectKinds,
) -> (Verdict, Faults) {
    let mut faults = Faults::default();
    let (scene, drawn) = scene(spec, stem, (machine, kinds), &mut faults);
    let sound = spec.complete && !faults.any_fault();
    faults.forget_following();
    faults.sort();
    let scene = Box::new(scene);
    let verdict = match (sound, drawn) {
        (true, _) => Verdict::Sound(scene),
        (false, true) => Verdict::Drawn(scene),
        (false, false) => Verdict::Refused,
    };
    (verdict, faults)
}

/// Checks a scene as far as possible without its mechanism.
pub fn check_alone(spec: &SceneSpec, stem: Option<&str>, kinds: &EffectKinds) -> Faults {
    let mut faults = Faults::default();
    version(spec, &mut faults);
    name(spec, stem, &mut faults);
    run::integration(&spec.integration, &mut faults);
    effects::alone(spec, kinds, &mut faults);
    faults.sort();
    faults
}

/// Returns the state and the outputs that a scene seems to have, whether it is valid or not.
pub(crate) fn sketch(
    spec: &SceneSpec,
    machine: &Machine,
    kinds: &EffectKinds,
) -> (StateLayout, Vec<Located<String>>) {
    let (scene, _) = scene(spec, None, (machine, kinds), &mut Faults::default());
    (scene.layout, scene.outputs)
}

/// Returns the scene, and whether its equations can be built.
fn scene(
    spec: &SceneSpec,
    stem: Option<&str>,
    (whole, kinds): (&Machine, &EffectKinds),
    faults: &mut Faults,
) -> (Scene, bool) {
    version(spec, faults);
    let name = name(spec, stem, faults);
    let mechanism = locks::locked(spec, whole, faults);
    let before = faults.count();
    let effects::Called {
        elements,
        chains,
        refused,
    } = effects::elements(spec, (whole, kinds), &mechanism, faults);
    let sound = faults.count() == before && refused.is_empty();
    let integration = run::integration(&spec.integration, faults);
    let unloaded = mechanism.clone();
    let empty = Scene {
        name: String::new(),
        description: spec.description.value().cloned(),
        mechanism,
        elements,
        chains,
        layout: StateLayout::default(),
        parameters: Vec::new(),
        drives: Vec::new(),
        limits: Vec::new(),
        control: None,
        controller_model: None,
        initial: Initial::default(),
        outputs: effects::given(&spec.outputs)
            .iter()
            .map(|o| o.name.clone())
            .collect(),
        integration,
        written: FileEntries {
            inputs: effects::given(&spec.inputs).to_vec(),
            effort_limits: spec.effort_limits.value().cloned(),
            control: spec.control.value().cloned(),
            initial: effects::given(&spec.initial).to_vec(),
            unloaded,
            modes: None,
        },
    };
    let scene = assembled(empty, &refused, faults);
    let scene = rigid_contacts::with_integrator(spec, scene);
    canonical(spec, &scene, faults);
    rigid_contacts::check(spec, &scene, faults);
    let moving = moving_base(spec, &scene, faults);
    let carried = prescribed::places(&scene, faults);
    prescribed::canonical(spec, &scene, faults);
    control::canonical(&scene, spec.control.value(), faults);
    let drawn = sound && !moving && !carried && scene.layout.repeated().is_none();
    if !drawn {
        outputs::names(&scene, &refused, faults);
    }
    let scene = Scene {
        // A missing name was reported as a fault.
        name: name.unwrap_or_default(),
        ..scene
    };
    (scene, drawn)
}

/// Returns the scene with the layout of its state, from its elements and its file.
pub(in crate::scene) fn assembled(
    scene: Scene,
    refused: &RejectedEffects,
    faults: &mut Faults,
) -> Scene {
    let mechanism = effects::reduced(scene.written.unloaded.clone(), &scene.elements);
    let scene = Scene { mechanism, ..scene };
    let mut layout = state::layout(&scene.mechanism, &scene.elements);
    let inputs = &scene.written.inputs;
    inputs::add_efforts(&mut layout, inputs);
    let parameters = state::parameters(&scene.mechanism, &scene.elements, faults);
    let mut drives = inputs::drives(&layout, inputs, refused, faults);
    let written = (&inputs[..], scene.written.effort_limits.as_ref());
    let mut limits = limits::limits((&scene.mechanism, &layout), written, faults);
    let sampling = scene.written.control.as_ref();
    let anti_windup = (&drives[..], &limits[..], &inputs[..]);
    limits::check_anti_windup(&layout, anti_windup, faults);
    limits::add_events(&mut layout, &drives, &limits, sampling.is_some());
    limits::add_integrals(&mut layout, &mut drives);
    let control = control::control((&layout, &drives), sampling, faults);
    limits.resize(drives.len(), None);
    // Repeated names of effects were reported already.
    let reported = faults.0.iter().any(|f| f.rule == "repeated-name");
    if let Some(name) = layout.repeated().filter(|_| !reported) {
        faults.push(wording::repeated_state_or_input(&Location::file(), name));
    }
    followed::check((&scene.mechanism, &layout), &drives, inputs, faults);
    Scene {
        parameters,
        drives,
        limits,
        control,
        initial: initial::initial(
            (&scene.mechanism, &layout),
            &scene.written.initial,
            refused,
            faults,
        ),
        layout,
        ..scene
    }
}

fn version(spec: &SceneSpec, faults: &mut Faults) {
    if let Some(version) = spec.version.given()
        && version.value.value != Dd::from_f64(VERSION)
    {
        let text = &version.value.text;
        faults.push(wording::unknown_scene_version(&version.location, text));
    }
}

fn name(spec: &SceneSpec, stem: Option<&str>, faults: &mut Faults) -> Option<String> {
    let stem = stem.map(|stem| stem.split('.').next().unwrap_or(stem));
    match (&spec.name, stem) {
        (Field::Broken, _) => None,
        (Field::Absent, None) => {
            faults.push(wording::no_name(&spec.location));
            None
        }
        (Field::Absent, Some(stem)) => {
            if !is_identifier(stem) {
                faults.push(wording::stem_not_identifier(&spec.location, stem));
            }
            Some(stem.to_owned())
        }
        (Field::Given(name), stem) => {
            if !is_identifier(&name.value) {
                faults.push(wording::not_identifier(&name.location, &name.value));
            }
            if let Some(stem) = stem.filter(|stem| *stem != name.value) {
                let (location, name) = (&name.location, &name.value);
                faults.push(wording::name_differs_from_file(location, name, stem));
            }
            Some(name.value.clone())
        }
    }
}

/// Refuses a base whose motion is given: its power is not in the balance of a scene. Returns whether it is.
fn moving_base(spec: &SceneSpec, scene: &Scene, faults: &mut Faults) -> bool {
    let moving = scene.mechanism.base().is_some();
    if let (true, Some(path)) = (moving, spec.mechanism.given()) {
        faults.push(wording::moving_base(&path.location, &path.value));
    }
    moving
}

/// Refuses the canonical form of joints with quasi-velocities, of loops, and of constraints on velocities.
fn canonical(spec: &SceneSpec, scene: &Scene, faults: &mut Faults) {
    let joint = scene.layout.quasi_joints.first();
    let method = scene.integration.method;
    let constrained = joint.is_none() && scene.layout.needs_position_rates();
    if let (true, true, Some(raw)) = (
        constrained,
        method.needs_canonical(),
        spec.integration.value(),
    ) {
        let names = (method.name(), method.on_velocities().name());
        let what = match &scene.layout.loops[..] {
            [] => scene.layout.coupled_names(),
            loops => loops.iter().map(String::as_str).collect(),
        };
        faults.push(wording::canonical_of_constraints(
            &raw.location,
            &what,
            names,
        ));
    }
    if let (Some(joint), true, Some(raw)) =
        (joint, method.needs_canonical(), spec.integration.value())
    {
        let natural = method.on_velocities().name();
        let (location, name) = (&raw.location, method.name());
        faults.push(wording::canonical_of_quasi_velocities(
            location,
            name,
            &joint.name,
            natural,
        ));
    }
}
