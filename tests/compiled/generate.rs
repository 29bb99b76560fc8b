//! Generates the models, for the build script and for the tests; each of the two uses a part.
#![allow(dead_code)]

use std::path::Path;

use bgdyn_codegen::build_script::Build;
use bgdyn_codegen::emit::{OutputOptions, module, source_text};
use bgdyn_codegen::files::stem;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection;
use bgdyn_codegen::verify::{check_model, explain};

/// Models compiled with regressors.
const WITH_REGRESSORS: [&str; 2] = ["scara", "tree_04"];

/// Returns whether the model of a spec has regressors.
fn has_regressors(path: &Path) -> bool {
    WITH_REGRESSORS.contains(&stem(path).as_str())
}

fn options(path: &Path, derivatives: bool) -> Options {
    Options {
        derivatives,
        identification: has_regressors(path),
        ..Options::default()
    }
}

/// The model of a spec.
pub fn model(path: &Path, derivatives: bool) -> Model {
    let text = std::fs::read_to_string(path).expect("a spec");
    let (mechanism, faults) = bgdyn_codegen::read(&text, Some(&stem(path)));
    let shown = path.display().to_string();
    let mechanism = mechanism.unwrap_or_else(|| panic!("{}", faults.render(&shown, &text)));
    selection::model(mechanism, &options(path, derivatives)).expect("no name is asked for")
}

/// The model of a spec, compared with equation (6), and the text of its module.
pub fn model_and_text(path: &Path, derivatives: bool) -> (Model, String) {
    let model = model(path, derivatives);
    let found = check_model(&model);
    assert!(found.is_empty(), "{}: {}", path.display(), explain(&found));
    let file = path.file_name().expect("a file").to_string_lossy();
    let place = OutputOptions::source_text(file.into_owned());
    let text = source_text(module(&model, &place));
    (model, text)
}

/// The text of its module, as a user's build script has it.
pub fn source(path: &Path, derivatives: bool) -> String {
    let source = Build::new(path)
        .derivatives(derivatives)
        .identification(has_regressors(path))
        .source();
    source.unwrap_or_else(|error| panic!("{error}")).text
}
