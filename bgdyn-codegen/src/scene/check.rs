//! The one step that makes a [`Scene`]: a scene's file that obeys every rule, or all that breaks
//! one.

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;

use super::causality::{Chain, chains};
use super::layout::{Coordinate, Layout, Store};
use super::reduce::held;
use super::signal::{self, Drive, INTEGRATION};
use super::{Initial, Integration, Scene, Written};
use crate::effect::{Beside, Context, Declared, Element, called, once_per_joint};
use crate::fault::{Fault, Faults, Place, unknown_name, wording};
use crate::mechanism::name::is_identifier;
use crate::mechanism::{CoordinateId, LinkId, Mechanism, Motion, Parameter, Pose};
use crate::spec::{Dimension, Entry, Field, Located, Raw, SceneSpec};

/// The only version of the format there is.
const VERSION: f64 = 1.0;

/// Step and length of a run whose scene says nothing of them, s.
const STEP: f64 = 1e-3;
const END: f64 = 1.0;

/// Checks a scene against every rule. `stem` is the file's stem, `mechanism` what it names.
///
/// The scene is there exactly if nothing refuses it.
pub fn check(
    spec: &SceneSpec,
    stem: Option<&str>,
    mechanism: &Mechanism,
) -> (Option<Scene>, Faults) {
    let mut faults = Faults::default();
    let scene = scene(spec, stem, mechanism, &mut faults);
    faults.sort();
    let sound = spec.complete && !faults.any_fault();
    (scene.filter(|_| sound), faults)
}

fn scene(
    spec: &SceneSpec,
    stem: Option<&str>,
    whole: &Mechanism,
    faults: &mut Faults,
) -> Option<Scene> {
    version(spec, faults);
    let name = name(spec, stem, faults);
    let locked = locks(spec, whole, faults);
    let mechanism = whole.welded(&locked);
    let (elements, chains) = elements(spec, whole, &mechanism, faults);
    let integration = integration(&spec.integration, faults);
    let unloaded = mechanism.clone();
    let empty = Scene {
        name: String::new(),
        description: spec.description.value().cloned(),
        mechanism,
        elements,
        chains,
        layout: Layout::default(),
        parameters: Vec::new(),
        drives: Vec::new(),
        initial: Initial::default(),
        outputs: given(&spec.outputs)
            .iter()
            .map(|o| o.name.clone())
            .collect(),
        integration: integration?,
        written: Written {
            inputs: given(&spec.inputs).to_vec(),
            initial: given(&spec.initial).to_vec(),
            unloaded,
        },
    };
    let scene = assembled(empty, faults);
    Some(Scene {
        name: name?,
        ..scene
    })
}

/// The scene with its state laid out: what follows from its elements and what the file says.
pub(super) fn assembled(scene: Scene, faults: &mut Faults) -> Scene {
    let mechanism = reduced(scene.written.unloaded.clone(), &scene.elements);
    let scene = Scene { mechanism, ..scene };
    let mut layout = layout(&scene.mechanism, &scene.elements);
    let inputs = &scene.written.inputs;
    add_efforts(&mut layout, inputs);
    // Names of effects that repeat were told already.
    let told = faults.0.iter().any(|f| f.rule == "repeated-name");
    if let Some(name) = layout.repeated().filter(|_| !told) {
        let message = format!("`{name}` is the name of two parts of the state, or of two inputs");
        let fault = Fault::new(&Place::file(), "repeated-name", message);
        faults.push(fault.with_help("give one of the effects or inputs another name"));
    }
    Scene {
        parameters: parameters(&scene.mechanism, &scene.elements, faults),
        drives: drives(&layout, inputs, faults),
        initial: initial(&layout, &scene.written.initial, faults),
        layout,
        ..scene
    }
}

fn given(field: &Field<Vec<Raw>>) -> &[Raw] {
    field.value().map_or(&[], Vec::as_slice)
}

fn version(spec: &SceneSpec, faults: &mut Faults) {
    if let Some(version) = spec.version.given()
        && version.value.value != Dd::from_f64(VERSION)
    {
        let message = format!("there is no version {} of the format", version.value.text);
        let fault = Fault::new(&version.place, "version", message);
        faults.push(fault.with_help("write `scene: 1`"));
    }
}

fn name(spec: &SceneSpec, stem: Option<&str>, faults: &mut Faults) -> Option<String> {
    let stem = stem.map(|stem| stem.split('.').next().unwrap_or(stem));
    match (&spec.name, stem) {
        (Field::Broken, _) => None,
        (Field::Absent, None) => {
            faults.push(wording::no_name(&spec.place));
            None
        }
        (Field::Absent, Some(stem)) => {
            if !is_identifier(stem) {
                faults.push(wording::stem_not_identifier(&spec.place, stem));
            }
            Some(stem.to_owned())
        }
        (Field::Given(name), stem) => {
            if !is_identifier(&name.value) {
                faults.push(wording::not_identifier(&name.place, &name.value));
            }
            if let Some(stem) = stem.filter(|stem| *stem != name.value) {
                let (place, name) = (&name.place, &name.value);
                faults.push(wording::name_differs_from_file(place, name, stem));
            }
            Some(name.value.clone())
        }
    }
}

/// The joints that stand still, with the pose in which they hold their links.
fn locks(spec: &SceneSpec, mechanism: &Mechanism, faults: &mut Faults) -> Vec<(LinkId, Pose)> {
    let mut locked = Vec::new();
    for raw in given(&spec.lock) {
        let name = &raw.name.value;
        let joints = mechanism.coordinates().iter();
        let found = joints
            .copied()
            .find(|l| mechanism.links()[l.0].joint.name == *name);
        let Some(link) = found else {
            let known: Vec<&str> = joint_names(mechanism);
            let message = unknown_name("moving joint", name, &known, &known.join(", "));
            let fault = Fault::new(&raw.name.place, "unknown-name", message);
            faults
                .push(fault.with_help("`lock` holds joints at their coordinates: `wrist: 30 deg`"));
            continue;
        };
        let joint = &mechanism.links()[link.0].joint;
        let [position, ..] = dimensions(joint.kind.motion);
        if let Some(at) = raw.number(&[position], faults) {
            locked.push((link, held(joint, at.value.value)));
        }
    }
    locked
}

fn joint_names(mechanism: &Mechanism) -> Vec<&str> {
    let of = |link: &LinkId| mechanism.links()[link.0].joint.name.as_str();
    mechanism.coordinates().iter().map(of).collect()
}

/// What position, velocity and effort of a joint measure.
fn dimensions(motion: Motion) -> [Dimension; 3] {
    match motion {
        Motion::Translation => [Dimension::Length, Dimension::Speed, Dimension::Force],
        _ => [Dimension::Angle, Dimension::AngularSpeed, Dimension::Torque],
    }
}

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
    let links = mechanism.links().iter().map(|l| l.name.clone());
    let frames = mechanism.frames().iter().map(|f| f.name.clone());
    Context {
        coordinates: mechanism.coordinates().iter().map(coordinate).collect(),
        limits: mechanism.coordinates().iter().map(limits).collect(),
        added: Vec::new(),
        locked,
        places: links.chain(frames).collect(),
        nodes: Vec::new(),
    }
}

/// The effects called for, checked, in the order in which their laws run; those in series.
fn elements(
    spec: &SceneSpec,
    whole: &Mechanism,
    reduced: &Mechanism,
    faults: &mut Faults,
) -> (Vec<Element>, Vec<Chain>) {
    let mut wanted: Vec<Declared> = Vec::new();
    for raw in given(&spec.effects) {
        for declared in called(raw, whole.effects(), faults) {
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
    let free = joint_names(reduced);
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
fn reduced(mut mechanism: Mechanism, elements: &[Element]) -> Mechanism {
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

/// What the state is made of: the joints, then what the effects add.
fn layout(mechanism: &Mechanism, elements: &[Element]) -> Layout {
    let coordinate = |j: usize| {
        let joint = mechanism.joint(CoordinateId(j));
        Coordinate {
            name: joint.name.clone(),
            store: Store::Links(CoordinateId(j)),
            stored: true,
            dimensions: dimensions(joint.kind.motion),
            rate_name: format!("{}_rate", joint.name),
            starts_with: None,
        }
    };
    let mut layout = Layout {
        coordinates: (0..mechanism.nv()).map(coordinate).collect(),
        ..Layout::default()
    };
    // Coordinates first: others may act on them.
    let (adding, rest): (Vec<&Element>, Vec<&Element>) =
        elements.iter().partition(|e| e.effect.adds_coordinate());
    for element in adding.into_iter().chain(rest) {
        element.effect.declare(element, &mut layout);
    }
    layout
}

/// Efforts of coordinates are inputs where the scene names them.
fn add_efforts(layout: &mut Layout, inputs: &[Raw]) {
    for raw in inputs {
        let name = &raw.name.value;
        let known = layout.inputs.iter().any(|input| input.name == *name);
        let stored = |c: &&Coordinate| c.name == *name && c.stored;
        if !known && layout.coordinates.iter().any(|c| stored(&c)) {
            let about = format!("effort at `{name}`");
            layout.drive(name.clone(), name, name, about);
        }
    }
}

/// The mechanism's run-time parameters, then those of the effects called for.
fn parameters(mechanism: &Mechanism, elements: &[Element], faults: &mut Faults) -> Vec<Parameter> {
    let mut all = mechanism.parameters().to_vec();
    for element in elements {
        for (key, quantity) in element.quantities() {
            let Some(name) = &quantity.parameter else {
                continue;
            };
            let meaning = element.meaning(key);
            let unit = quantity.dimension.si();
            match all.iter_mut().find(|p| p.name == *name) {
                Some(known) if known.default != quantity.value || known.unit != unit => {
                    let message = format!("the parameter `{name}` has two values");
                    let fault = Fault::new(&quantity.place, "parameter-twice", message);
                    faults.push(fault.with_help("give one of them another name"));
                }
                // A payload's is the mechanism's already.
                Some(known) if known.meaning == meaning => {}
                Some(known) => known.meaning += &format!(" and {meaning}"),
                None => all.push(Parameter {
                    name: name.clone(),
                    meaning,
                    default: quantity.value,
                    unit,
                }),
            }
        }
    }
    all
}

/// What drives each input.
fn drives(layout: &Layout, inputs: &[Raw], faults: &mut Faults) -> Vec<Drive> {
    let mut drives = vec![Drive::Given; layout.inputs.len()];
    for raw in inputs {
        let name = &raw.name.value;
        let Some(i) = layout.inputs.iter().position(|part| part.name == *name) else {
            let known: Vec<&str> = layout.inputs.iter().map(|p| p.name.as_str()).collect();
            let efforts = layout.coordinates.iter().filter(|c| c.stored);
            let all: Vec<&str> = known
                .into_iter()
                .chain(efforts.map(|c| c.name.as_str()))
                .collect();
            let message = unknown_name("input", name, &all, &all.join(", "));
            let fault = Fault::new(&raw.name.place, "unknown-input", message);
            faults
                .push(fault.with_help("inputs are efforts of joints and what the effects declare"));
            continue;
        };
        let part = &layout.inputs[i];
        let follows = part.follows.as_ref().map(|name| layout.position_of(name));
        let effort = part.drives.is_some_and(|j| layout.coordinates[j].stored);
        if let Some(drive) = signal::drive(raw, part.dimension, follows, effort, faults) {
            drives[i] = drive;
        }
    }
    // A reference's derivatives follow from its course: first its rate, then the rate's rate.
    for (name, of) in [("_acceleration", "_rate"), ("_rate", "")] {
        for i in 0..drives.len() {
            let base = layout.inputs[i].name.strip_suffix(name);
            let base = base.map(|base| format!("{base}{of}"));
            let found = |base: String| layout.inputs.iter().position(|p| p.name == base);
            if let (Some(base), Drive::Given) = (base.and_then(found), &drives[i]) {
                drives[i] = Drive::RateOf(base);
            }
        }
    }
    // What follows from what the caller gives is given by the caller.
    for i in 0..drives.len() {
        let mut root = i;
        while let Drive::RateOf(base) = drives[root] {
            root = base;
        }
        if drives[root] == Drive::Given {
            drives[i] = Drive::Given;
        }
    }
    drives
}

/// Where the run begins.
fn initial(layout: &Layout, entries: &[Raw], faults: &mut Faults) -> Initial {
    let mut initial = Initial {
        q: vec![Dd::ZERO; layout.nq()],
        v: vec![Dd::ZERO; layout.nv()],
        x: vec![Dd::ZERO; layout.nx()],
        modes: vec![Dd::ZERO; layout.modes.len()],
    };
    let mut places: BTreeMap<String, (usize, usize, Dimension)> = BTreeMap::new();
    for (j, c) in layout.coordinates.iter().enumerate() {
        if c.stored {
            places.insert(c.name.clone(), (0, j, c.dimensions[0]));
        }
        places.insert(c.rate_name.clone(), (1, j, c.dimensions[1]));
    }
    for (i, part) in layout.states.iter().enumerate() {
        let given = part.entered.map_or(part.dimension, |e| e.dimension);
        places.insert(part.name.clone(), (2, i, given));
    }
    for (i, part) in layout.modes.iter().enumerate() {
        places.insert(format!("{}_mode", part.name), (3, i, part.dimension));
    }
    let mut given: Vec<(usize, usize)> = Vec::new();
    for raw in entries {
        let name = &raw.name.value;
        let Some(&(kind, i, dimension)) = places.get(name) else {
            let known: Vec<&str> = places.keys().map(String::as_str).collect();
            let message = unknown_name("part of the state", name, &known, &known.join(", "));
            let fault = Fault::new(&raw.name.place, "unknown-name", message);
            faults.push(fault.with_help("joints by their names, rates as `shoulder_rate`"));
            continue;
        };
        if let Some(number) = raw.number(&[dimension], faults) {
            let value = number.value.value;
            given.push((kind, i));
            let entered = layout.states.get(i).filter(|_| kind == 2);
            if let Some(entered) = entered.and_then(|part| part.entered)
                && value < entered.least
            {
                let (text, least) = (&number.value.text, entered.least.to_f64());
                let unit = entered.dimension.si();
                let message = format!("`{name}` begins with {text}, less than {least} {unit}");
                let fault = Fault::new(&number.place, "initial", message);
                faults.push(fault.with_help(entered.way_out));
            }
            match kind {
                0 => initial.q[i] = value,
                1 => initial.v[i] = value,
                2 => initial.x[i] = value,
                _ => initial.modes[i] = value,
            }
        }
    }
    // A drive stands where its joint stands, and moves with it.
    for (j, c) in layout.coordinates.iter().enumerate() {
        let with = c
            .starts_with
            .as_ref()
            .and_then(|name| layout.coordinate_named(name));
        let Some(k) = with else { continue };
        if !given.contains(&(0, j)) {
            initial.q[j] = initial.q[k];
        }
        if !given.contains(&(1, j)) {
            initial.v[j] = initial.v[k];
        }
    }
    initial
}

fn integration(field: &Field<Raw>, faults: &mut Faults) -> Option<Integration> {
    let mut wanted = Integration {
        method: "rk4".into(),
        step: STEP,
        end: END,
    };
    let raw = match field {
        Field::Absent => return Some(wanted),
        Field::Broken => return None,
        Field::Given(raw) => &raw.value,
    };
    let what = (
        "how the scene is run",
        "`{ method: rk4, step: 1 ms, end: 5 s }`",
    );
    let fields = raw.fields(what, &INTEGRATION, faults)?;
    if let Some(Located {
        value: Entry::Text(word),
        place,
    }) = fields.get("method")
    {
        wanted.method = word.clone();
        if word != "rk4" {
            let message = unknown_name("integration method", word, &["rk4"], "rk4");
            faults.push(Fault::new(place, "unknown-name", message).with_help("write `rk4`"));
        }
    }
    for (key, target) in [("step", &mut wanted.step), ("end", &mut wanted.end)] {
        if let Some(Located {
            value: Entry::Number(number),
            place,
        }) = fields.get(key)
        {
            *target = number.value.to_f64();
            if number.value <= Dd::ZERO {
                let message = format!("`{key}` is {}: it must be greater than 0", number.text);
                let fault = Fault::new(place, "time", message);
                faults.push(fault.with_help("write a time such as `1 ms`"));
            }
        }
    }
    Some(wanted)
}
