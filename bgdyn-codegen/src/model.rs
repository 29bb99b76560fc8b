//! The steps in order: from a spec's text to a model, from a model to code.

use std::path::Path;
use std::rc::Rc;

use proc_macro2::TokenStream;

use crate::bond_graph::{self, BondGraph};
use crate::cut::cut;
use crate::emit;
use crate::fault::{Fault, Faults, Severity};
use crate::formulation::{self, Search};
use crate::function::Function;
use crate::interface::{Interface, SceneInterface};
use crate::mechanism::Mechanism;
use crate::method::Method;
pub use crate::options::{
    Asked, DYNAMICS, Options, Preference, Unknown, formulation_named, preference_named,
};
use crate::scene::{self, Verdict};
use crate::spec::{is_scene, parse_scene};
use crate::system::System;
use crate::verify::{Difference, check_functions, check_scene};

/// A mechanism with the functions generated for it.
pub struct Model {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Its bond graph.
    pub bond_graph: BondGraph,
    /// One function per method generated.
    pub functions: Vec<Function>,
}

impl Model {
    /// Builds the bond graph and chooses a function for each method asked for.
    ///
    /// # Errors
    /// Every name asked for that the mechanism does not have.
    pub fn new(mechanism: Mechanism, options: &Options) -> Result<Self, Vec<Unknown>> {
        let bond_graph = bond_graph::build(&mechanism);
        let methods = options.select(&bond_graph.sites, bond_graph.coordinates.len())?;
        let search = Search::new(&bond_graph, options.formulation);
        let found = methods
            .into_iter()
            .filter_map(|m| chosen(&search, m, options));
        let found: Vec<Function> = found.collect();
        drop(search);
        let functions = found.into_iter().map(|f| finished(f, options)).collect();
        Ok(Model {
            mechanism,
            bond_graph,
            functions,
        })
    }

    /// The function of a method.
    pub fn function(&self, method: Method) -> Option<&Function> {
        self.functions.iter().find(|f| f.method == method)
    }
}

/// One function of a mechanism, without the others.
pub fn function(mechanism: &Mechanism, method: Method, options: &Options) -> Option<Function> {
    let graph = bond_graph::build(mechanism);
    let chosen = chosen(&Search::new(&graph, options.formulation), method, options);
    chosen.map(|f| finished(f, options))
}

/// The last passes. What was chosen for its digits keeps the order of its sums: among more orders the
/// choice would go by chance.
fn finished(function: Function, options: &Options) -> Function {
    let function = match options.prefer {
        Preference::Operations => function.arranged(),
        Preference::Accuracy => function,
    };
    cut(function.fused())
}

/// The function of a method that these options mean.
fn chosen(search: &Search<'_>, method: Method, options: &Options) -> Option<Function> {
    match options.prefer {
        Preference::Operations => search.function(method).map(Rc::unwrap_or_clone),
        Preference::Accuracy => {
            formulation::most_accurate(search.graph, method, options.formulation)
        }
    }
}

/// Reads a scene and the mechanism it names. `load` gives the text of a file from the path that
/// the scene writes.
///
/// # Errors
/// What is wrong with the scene or with its mechanism.
pub fn read_scene(
    text: &str,
    stem: &str,
    load: impl FnOnce(&str) -> Result<String, String>,
) -> Result<(System, Faults), Refusal> {
    let (spec, mut faults) = parse_scene(text);
    let Some(spec) = spec else {
        return Err(Refusal::Spec(faults));
    };
    let alone = |mut faults: Faults| {
        faults.0.extend(scene::check_alone(&spec, Some(stem)).0);
        faults.sort();
        faults
    };
    let Some(path) = spec.mechanism.given() else {
        return Err(Refusal::Spec(alone(faults)));
    };
    let loaded = match load(&path.value) {
        Ok(loaded) => loaded,
        Err(why) => {
            let message = format!("the mechanism `{}` cannot be read: {why}", path.value);
            let fault = Fault::new(&path.place, "no-mechanism", message);
            faults.push(fault.with_help("write its path from the scene's own folder"));
            return Err(Refusal::Spec(alone(faults)));
        }
    };
    let name = self::stem(Path::new(&path.value));
    let (mechanism, found) = crate::read(&loaded, Some(&name));
    let Some(mechanism) = mechanism else {
        let path = path.value.clone();
        return Err(Refusal::Mechanism {
            path,
            text: loaded,
            faults: found,
            scene: alone(faults),
        });
    };
    let (verdict, more) = scene::check(&spec, Some(stem), &mechanism);
    faults.0.extend(more.0);
    let system = match verdict {
        Verdict::Sound(scene) => System::new(*scene),
        Verdict::Drawn(scene) => {
            let found = System::new(*scene).err().unwrap_or_default();
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
    faults.sort();
    for joint in system.without_inertia() {
        let path = &path.place;
        let message = format!(
            "in this scene nothing gives the joint `{joint}` inertia: it has no acceleration of its own"
        );
        let fault = Fault::new(path, "no-inertia", message).with_help(
            "call for `inertia` or for a rotor, or lock the joint; `inverse` is sound as it is",
        );
        faults.push(fault.into_warning());
    }
    Ok((system, faults))
}

/// What is wrong with the equations of a scene that has faults, where it does not follow from these: values
/// out of range may come from a start that could not be read.
fn independent(found: Faults, faults: &Faults) -> Vec<Fault> {
    let elsewhere = |f: &Fault| f.severity == Severity::Fault && f.path.is_empty();
    let start =
        ["initial", "lock"].iter().any(|key| faults.any_in(key)) || faults.0.iter().any(elsewhere);
    let mut found = found.0;
    found.retain(|f| !(start && f.rule == "effect-range"));
    found
}

/// The functions of a scene: the usual ones, what its method of integration needs, and what is
/// asked for.
pub fn scene_functions(system: &System, options: &Options) -> Vec<Function> {
    let roles = system.roles_with(options.jacobian, options.canonical);
    let roles = roles.into_iter();
    roles.map(|role| system.function(role)).collect()
}

/// Why there is no module.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// What is wrong with the spec.
    Spec(Faults),
    /// What is wrong with the mechanism that a scene names.
    Mechanism {
        /// Its path, as the scene writes it.
        path: String,
        /// Its text.
        text: String,
        /// What is wrong with it.
        faults: Faults,
        /// What is wrong with the scene besides.
        scene: Faults,
    },
    /// Names asked for that the mechanism does not have, options that have no place here.
    Options(Vec<Unknown>),
    /// Functions that do not equal equation (6): a fault of the generator.
    Unequal(Vec<Difference>),
}

/// From a spec's text to the tokens of its module, with warnings if there are any. `stem` is the
/// file's stem, `place` says where and from what the code is generated.
///
/// # Errors
/// Every fault found in the spec; or, where it has none, every name asked for that it lacks.
pub fn generate(
    text: &str,
    stem: &str,
    place: &emit::Place,
    options: &Options,
) -> Result<(TokenStream, Faults), Refusal> {
    let (mechanism, findings) = crate::read(text, Some(stem));
    let Some(mechanism) = mechanism else {
        return Err(Refusal::Spec(findings));
    };
    let model = Model::new(mechanism, options).map_err(Refusal::Options)?;
    if options.verify {
        let name = model.mechanism.name();
        equal(check_functions(name, &model.bond_graph, &model.functions))?;
    }
    Ok((emit::module(&model, place), findings))
}

/// The same for a file that may be a mechanism's or a scene's. A scene's mechanism is read by
/// `load`, from the path that the scene writes.
///
/// # Errors
/// As [`generate`], and as [`read_scene`].
pub fn generate_file(
    text: &str,
    stem: &str,
    place: &emit::Place,
    options: &Options,
    load: impl FnOnce(&str) -> Result<String, String>,
) -> Result<(TokenStream, Faults), Refusal> {
    if !is_scene(text) {
        return generate(text, stem, place, options);
    }
    let (system, findings) = read_scene(text, stem, load)?;
    let misplaced = options.of_mechanisms();
    if !misplaced.is_empty() {
        return Err(Refusal::Options(misplaced));
    }
    let functions = scene_functions(&system, options);
    if options.verify {
        equal(check_scene(&system, &functions))?;
    }
    Ok((emit::scene_module(&system, &functions, place), findings))
}

fn equal(differences: Vec<Difference>) -> Result<(), Refusal> {
    match differences.is_empty() {
        true => Ok(()),
        false => Err(Refusal::Unequal(differences)),
    }
}

/// The module of a refused spec, or of one that could not be read (`text` is empty then): all a
/// caller can name, nothing that runs. `load` gives the text of a scene's mechanism. Nothing where the
/// stem cannot name a module.
pub fn fallback(
    text: &str,
    stem: &str,
    place: &emit::Place,
    load: impl FnOnce(&str) -> Result<String, String>,
) -> Option<TokenStream> {
    if is_scene(text) {
        let path = mechanism_of(text).unwrap_or_default();
        let written = load(&path).ok();
        let of = self::stem(Path::new(&path));
        let mechanism = written.as_deref().map(|written| (written, of.as_str()));
        let scene = SceneInterface::guess(text, stem, mechanism);
        return scene.map(|scene| emit::scene_fallback(&scene, place));
    }
    Interface::guess(text, stem).map(|interface| emit::fallback(&interface, place))
}

/// The name of a spec's module: the file's name up to its first dot.
pub fn stem(path: &Path) -> String {
    let name = path.file_name().map(|n| n.to_string_lossy());
    let stem = name.as_deref().and_then(|n| n.split('.').next());
    stem.unwrap_or_default().to_string()
}

/// The path of a file that is named by its path from another file.
pub fn beside(file: &Path, path: &str) -> std::path::PathBuf {
    file.parent().unwrap_or(Path::new("")).join(path)
}

/// The mechanism that a scene's text names, if it is a scene's and names one.
pub fn mechanism_of(text: &str) -> Option<String> {
    let scene = is_scene(text).then(|| parse_scene(text).0).flatten()?;
    scene.mechanism.value().cloned()
}
