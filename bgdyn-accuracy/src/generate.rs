//! Generates the source text of a scene's variants, which is compiled and measured.
//!
//! Build scripts and the command `bgdyn accuracy` use it.

use std::fmt::Write;

use bgdyn_codegen::emit::{OutputOptions, scene_module, source_text, struct_ident};
use bgdyn_codegen::fault::Location;
use bgdyn_codegen::format::Located;
use bgdyn_codegen::formulation::FORMULATIONS;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::{Method, SceneFunction};
use bgdyn_codegen::options::Options;
use bgdyn_codegen::scene::{IntegratorName, Scene, StepControl};
use bgdyn_codegen::selection::scene_functions;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::MOST_EVENT_CONTACTS;

/// Largest number of coordinates for which the literal sum is generated: it grows with the cube of their
/// number.
const LITERAL: usize = 4;

/// Prefix of a family of effects that is left out.
pub const ALL_BUT: &str = "all but ";

/// Returns the operations of one call of the scene's `derivative`; a pair of sine and cosine counts as
/// one.
pub fn operations(system: &SceneEquations) -> usize {
    let o = system.function(SceneFunction::Derivative).operations();
    o.total() + o.div + o.sqrt + o.sincos + o.other
}

/// A scene with some of its effects.
#[derive(Debug)]
pub struct Ablation {
    /// The effects: `none`, `gravity+inertia`, `all but friction`.
    pub effects: String,
    /// Its equations; `None` if the measured output does not exist without the other effects.
    pub system: Option<SceneEquations>,
}

/// Returns the scene with one output, the measured one: the first site among its outputs, else the first
/// coordinate of a joint among them, else the first output, and without outputs the first coordinate.
///
/// `None` if the scene has nothing to measure.
pub fn measured(system: &SceneEquations) -> Option<SceneEquations> {
    let outputs = &system.scene.outputs;
    let is_site = |name: &str| system.graph.sites.iter().any(|s| s.name == name);
    let joints = &system.graph.coordinates;
    let positions = &system.scene.layout.positions;
    let is_joint = |name: &str| {
        joints.iter().any(|c| c.name == name) || positions.iter().any(|p| p.name == name)
    };
    let first = |holds: &dyn Fn(&str) -> bool| outputs.iter().find(|o| holds(&o.value)).cloned();
    let coordinate = || {
        let value = positions.first()?.name.clone();
        let location = Location::file();
        Some(Located { value, location })
    };
    let found = first(&is_site)
        .or_else(|| first(&is_joint))
        .or_else(|| outputs.first().cloned())
        .or_else(coordinate)?;
    with_output(&system.scene, found)
}

fn with_output(scene: &Scene, output: Located<String>) -> Option<SceneEquations> {
    let mut scene = scene.clone();
    scene.outputs = vec![output];
    SceneEquations::new(scene).ok()
}

/// Returns the scene with an increasing number of effects, family by family, and with all except each one;
/// `system` is the result of [`measured`].
pub fn ablations(system: &SceneEquations) -> Vec<Ablation> {
    let elements = &system.scene.elements;
    let mut families: Vec<&str> = Vec::new();
    for element in elements {
        if !families.contains(&element.effect.family()) {
            families.push(element.effect.family());
        }
    }
    let with = |effects: String, kept: &[&str]| {
        let scene = system
            .scene
            .with_effects(|e| kept.contains(&e.effect.family()));
        let system = with_output(&scene, system.scene.outputs[0].clone());
        Ablation { effects, system }
    };
    let mut found = Vec::new();
    for n in 0..families.len() {
        let effects = match n {
            0 => "none".into(),
            _ => families[..n].join("+"),
        };
        found.push(with(effects, &families[..n]));
    }
    for family in families.iter().filter(|_| families.len() > 1) {
        let rest: Vec<&str> = families.iter().copied().filter(|f| f != family).collect();
        found.push(with(format!("{ALL_BUT}{family}"), &rest));
    }
    found
}

/// Returns the integrator that the scene names; an integrator of the canonical form is replaced by the
/// same one in velocities.
fn own_integrator(system: &SceneEquations) -> IntegratorName {
    system.scene.integration.method.on_velocities()
}

/// Returns the integrator and the step control of a scene, with their names in a study.
pub fn own_way(system: &SceneEquations) -> (&'static str, crate::StepControl) {
    let step_control = match system.scene.integration.step_control {
        StepControl::Step(h) => crate::StepControl::Step(h),
        StepControl::Tolerance(tolerance) => crate::StepControl::Tolerance(tolerance),
    };
    (own_integrator(system).name(), step_control)
}

/// Checks that a scene has a reference: rigid contacts that can be solved from event to event.
///
/// # Errors
/// A sentence, if there are more than [`MOST_EVENT_CONTACTS`].
pub fn check_contacts(system: &SceneEquations) -> Result<(), String> {
    let number = system.scene.layout.rigid_contacts.len();
    if number <= MOST_EVENT_CONTACTS {
        return Ok(());
    }
    Err(format!(
        "the scene `{}` has {number} rigid contacts: the reference of a study goes from event to event, which takes at most {MOST_EVENT_CONTACTS}. Leave contacts out or use `compliant_contact`; `bgdyn simulate` compares a run with one of half the step",
        system.scene.name
    ))
}

/// Returns the [`Scheme`](crate::Scheme) by which integrators that do not solve for impulses of contacts meet a scene.
fn scheme(system: &SceneEquations) -> &'static str {
    match system.scene.layout.rigid_contacts.is_empty() {
        true => "bgdyn_accuracy::AsItIs",
        false => "bgdyn_accuracy::ByEvents",
    }
}

/// Returns the text of a module with the scene's name: its variants, and `test_case()`, which returns
/// their [`TestCase`](crate::TestCase). The crate that includes it depends on `bgdyn` and
/// `bgdyn-accuracy`; `end` replaces the scene's own, s.
///
/// # Errors
/// A sentence, if the scene has nothing to measure or too many rigid contacts.
pub fn variants(system: &SceneEquations, end: Option<f64>) -> Result<String, String> {
    check_contacts(system)?;
    let name = &system.scene.name;
    let full =
        measured(system).ok_or_else(|| format!("the scene `{name}` has nothing to measure"))?;
    let structure = struct_ident(name);
    let own = own_integrator(&full);
    let mut text = format!("/// The scene `{name}` and its variants.\npub mod {name} {{\n");
    let mut calls = String::new();
    let all = Options {
        jacobian: true,
        canonical: true,
        ..Options::default()
    };
    let functions = scene_functions(&full, &all);
    text += &module(&full, &functions, "all")?;
    let role = |f: &Function| matches!(f.method, Method::Scene(SceneFunction::CanonicalRates));
    let contacts = scheme(&full);
    let mut of_all = |call: &str, scalar: &str, contacts: &str| {
        let model = format!("all::{structure}::<{scalar}>::default()");
        writeln!(calls, "test_case.{call}({model}{contacts});").expect("text");
    };
    let by = format!(", {contacts}");
    of_all("methods", "f64", &by);
    if functions.iter().any(role) {
        of_all("momenta", "f64", "");
    }
    of_all("single", "f32", &by);
    of_all("reference", "bgdyn_accuracy::Dd", &by);
    for (formulation, functions) in formulations(&full) {
        text += &module(&full, &functions, formulation)?;
        let model = format!("{formulation}::{structure}::<f64>::default()");
        writeln!(
            calls,
            "test_case.formulation({formulation:?}, {model}, {contacts});"
        )
        .expect("text");
    }
    let options = Options {
        jacobian: own.needs_jacobian(),
        ..Options::default()
    };
    let call = match own.needs_jacobian() {
        true => "ablation_with_slope",
        false => "ablation",
    };
    // Types of bgdyn-sim have the names of the integrators.
    let integrator = struct_ident(own.name());
    let method = format!("bgdyn_accuracy::bgdyn_sim::{integrator}::default");
    let add = |effects: &str, system: &SceneEquations, model: &str, text: &mut String| {
        let contacts = match own.solves_contacts() {
            true => "bgdyn_accuracy::AsItIs",
            false => scheme(system),
        };
        writeln!(
            text,
            "test_case.{call}({effects:?}, {model}, {contacts}, {method});"
        )
        .expect("text");
    };
    let price = |effects: &str, system: &SceneEquations, model: &str, text: &mut String| {
        let (count, contacts) = (operations(system), scheme(system));
        writeln!(
            text,
            "test_case.price({effects:?}, {count}, {model}, {contacts});"
        )
        .expect("text");
    };
    let model = format!("all::{structure}::<f64>::default()");
    add("all", &full, &model, &mut calls);
    price("all", &full, &model, &mut calls);
    for (i, ablation) in ablations(&full).iter().enumerate() {
        let Some(system) = &ablation.system else {
            writeln!(calls, "test_case.missing_ablation({:?});", ablation.effects).expect("text");
            continue;
        };
        let inner = format!("ablation_{i}");
        text += &module(system, &scene_functions(system, &options), &inner)?;
        let model = format!("{inner}::{structure}::<f64>::default()");
        add(&ablation.effects, system, &model, &mut calls);
        if ablation.effects.starts_with(ALL_BUT) {
            price(&ablation.effects, system, &model, &mut calls);
        }
    }
    text += &format!(
        "/// What is measured of it.\npub fn test_case() -> bgdyn_accuracy::TestCase {{\nlet mut test_case = {};\ntest_case.kinked = {};\n{calls}test_case\n}}\n}}\n",
        opening(&full, end),
        kinked(&full)
    );
    Ok(text)
}

/// Returns whether a scene's laws have kinks: events that change no mode.
pub fn kinked(system: &SceneEquations) -> bool {
    let layout = &system.scene.layout;
    layout.events.iter().any(|e| layout.mode_of(e).is_none())
}

/// Returns the call that creates the test case.
fn opening(full: &SceneEquations, end: Option<f64>) -> String {
    let scene = &full.scene;
    let (method, step_control) = own_way(full);
    let step_control = match step_control {
        crate::StepControl::Step(h) => format!("Step({h:?})"),
        crate::StepControl::Tolerance(t) => format!("Tolerance({t:?})"),
    };
    let names = [
        &scene.name,
        &scene.description.clone().unwrap_or_default(),
        &scene.outputs[0].value,
        full.outputs[0].unit,
    ];
    let end = end.unwrap_or(scene.integration.end);
    format!(
        "bgdyn_accuracy::TestCase::new({names:?}, {end:?}, {method:?}, bgdyn_accuracy::StepControl::{step_control})"
    )
}

/// Returns the functions of the scene with its derivative by each formulation that supports it.
fn formulations(full: &SceneEquations) -> Vec<(&'static str, Vec<Function>)> {
    let few = full.graph.coordinates.len() <= LITERAL;
    let mut found = Vec::new();
    for formulation in FORMULATIONS {
        let name = formulation.name();
        if name == "literal" && !few {
            continue;
        }
        let Some(derivative) = full.derivative_by(formulation) else {
            continue;
        };
        let functions = scene_functions(full, &Options::default()).into_iter();
        let replaced = functions.map(|f| match f.method {
            Method::Scene(SceneFunction::Derivative) => derivative.clone(),
            _ => f,
        });
        found.push((name, replaced.collect()));
    }
    found
}

/// Returns one variant's module.
fn module(system: &SceneEquations, functions: &[Function], name: &str) -> Result<String, String> {
    let place = OutputOptions::source_text(system.scene.name.clone()).with_module(name)?;
    Ok(source_text(scene_module(system, functions, &place)))
}
