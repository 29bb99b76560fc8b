//! What is computed without a run: findings, bond graph, equations, counts, code, schemas.

use bgdyn_cli::commands::{check, ops};
use bgdyn_cli::graph::{mechanism_svg, scene_svg};
use bgdyn_cli::schema;
use bgdyn_cli::spec_file::SpecFile;
use bgdyn_codegen::backend::FilesError;
use bgdyn_codegen::backend::{BackendError, GivenOptions, backend_named};
use bgdyn_codegen::closed_form::{NoClosedForm, closed_form, latex, text};
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::pipeline::generate_files;
use bgdyn_codegen::refusal::Refusal;
use bgdyn_codegen::selection;
use bgdyn_codegen::system::SceneEquations;
use serde_json::{Value, json};

/// Significant digits of printed equations, as the command has them.
const DIGITS: usize = 6;

/// Returns the report of `bgdyn check --json`, with the lines of `bgdyn check`. A text of another kind is a finding too.
pub(crate) fn check(file: &SpecFile) -> Value {
    if let Some((rule, message)) = other_kind(file) {
        let finding = json!({ "severity": "fault", "line": 1, "column": 1, "path": "", "rule": rule, "message": message });
        return json!({ "ok": false, "findings": [finding], "lines": [] });
    }
    let found = check::checked(file, false);
    let lines = found.lines.clone();
    let mut report = found.report(&file.path.display().to_string());
    report["lines"] = lines.into();
    report
}

/// Returns the rule and the message for a text that is neither of the two kinds, or not the one that its place is for:
/// a file with a mechanism beside it is a scene.
fn other_kind(file: &SpecFile) -> Option<(&'static str, &'static str)> {
    if file.urdf().is_some() {
        return Some((
            "urdf-given",
            "this is a URDF, not a spec: the command `bgdyn import` writes the spec of it",
        ));
    }
    match (file.is_scene(), file.mechanism.is_some()) {
        (true, false) => Some((
            "scene-given",
            "this is a scene (`scene: 1`): it belongs under Scene, and its mechanism here",
        )),
        (false, true) => Some((
            "no-scene",
            "this is no scene: a scene has the keys `scene: 1` and `mechanism`; a mechanism (`format: 1`) belongs under Mechanism",
        )),
        _ => None,
    }
}

/// Returns the bond graph as SVG, of a scene with its effects.
pub(crate) fn graph(file: &SpecFile) -> Result<Value, String> {
    let svg = match file.is_scene() {
        true => scene_svg(&scene(file)?),
        false => mechanism_svg(&mechanism(file)?),
    };
    Ok(svg.into())
}

/// Returns the efforts of a mechanism as text and as LaTeX.
pub(crate) fn equations(file: &SpecFile, limit: usize) -> Result<Value, String> {
    let mechanism = match file.is_scene() {
        true => scene(file)?.scene.mechanism,
        false => mechanism(file)?,
    };
    let form = closed_form(&mechanism, limit).map_err(|refused| no_closed_form(&refused, limit))?;
    Ok(json!({ "text": text(&form, DIGITS), "latex": latex(&form, DIGITS) }))
}

fn no_closed_form(refused: &NoClosedForm, limit: usize) -> String {
    match refused {
        NoClosedForm::TooLong { .. }
        | NoClosedForm::LongSum { .. }
        | NoClosedForm::ManyProducts { .. } => format!(
            "Too long for a closed form: {refused}, and the limit is {limit} terms. Give joints that may stand still the type `fixed`, or raise the limit."
        ),
        _ => format!("There is no closed form: {refused}."),
    }
}

/// Returns the operations of each function by name, and its formulation.
pub(crate) fn counts(file: &SpecFile) -> Result<Value, String> {
    let options = Options::default();
    let functions = match file.is_scene() {
        true => selection::scene_functions(&scene(file)?, &options),
        false => {
            let model = selection::model(mechanism(file)?, &options);
            model
                .map_err(|names| refused(file, Refusal::Options(names)))?
                .functions
        }
    };
    let report = ops::counts(&functions).map_err(|e| e.to_string())?;
    let mut report: Value = serde_json::from_str(&report).map_err(|e| e.to_string())?;
    let each = functions.iter();
    report["formulations"] = each
        .map(|f| (f.name().to_owned(), json!(f.formulation)))
        .collect();
    // Objects of JSON lose the order of the module.
    report["order"] = functions.iter().map(|f| f.name()).collect();
    Ok(report)
}

/// Returns the files that a backend writes: name and text of each.
pub(crate) fn code(file: &SpecFile, backend: &str) -> Result<Value, String> {
    let backend = backend_named(backend)?;
    let name = file.path.display().to_string();
    let of_backend = |BackendError::Option(message)| message;
    let given = GivenOptions::new(name, backend.name(), backend.options(), []);
    let given = given.map_err(of_backend)?;
    let load = |path: &str| file.load(path);
    let spec = file.with_load(&load);
    let written = generate_files(&spec, &Options::default(), backend, &given);
    let (files, _) = written.map_err(|error| match error {
        FilesError::Refused(refusal) => refused(file, refusal),
        FilesError::Backend(error) => of_backend(error),
    })?;
    let each = files.into_iter();
    Ok(each
        .map(|file| json!({ "name": file.name, "text": file.text }))
        .collect())
}

/// Returns the JSON Schemas of mechanisms and of scenes.
pub(crate) fn schemas() -> Value {
    json!({ "mechanism": schema::mechanism(), "scene": schema::scene() })
}

/// Returns the checked scene.
pub(crate) fn scene(file: &SpecFile) -> Result<SceneEquations, String> {
    let read = file.read_scene();
    read.map(|(system, _)| system)
        .map_err(|refusal| refused(file, refusal))
}

fn mechanism(file: &SpecFile) -> Result<Mechanism, String> {
    let (mechanism, faults) = file.read();
    mechanism.ok_or_else(|| format!("{} has {}", file.path.display(), faults.tally()))
}

/// Returns a refusal in one line; its faults are found by a check.
fn refused(file: &SpecFile, refusal: Refusal) -> String {
    file.refusal(refusal).1
}
