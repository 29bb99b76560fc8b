//! Generates the models, for the build script and for the tests.

use std::path::Path;

use bgdyn_codegen::build_script::Build;
use bgdyn_codegen::files::stem;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;

/// The model of a spec.
pub fn model(path: &Path, derivatives: bool) -> Model {
    let text = std::fs::read_to_string(path).expect("a spec");
    let (mechanism, faults) = bgdyn_codegen::read(&text, Some(&stem(path)));
    let shown = path.display().to_string();
    let mechanism = mechanism.unwrap_or_else(|| panic!("{}", faults.render(&shown, &text)));
    let options = Options {
        derivatives,
        ..Options::default()
    };
    bgdyn_codegen::pipeline::model(mechanism, &options).expect("no name is asked for")
}

/// The text of its module.
pub fn source(path: &Path, derivatives: bool) -> String {
    let source = Build::new(path).derivatives(derivatives).source();
    source.unwrap_or_else(|error| panic!("{error}")).text
}
