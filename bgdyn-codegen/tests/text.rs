//! Compares the generated text with the text stored beside the tests, so that reviews show a change of the
//! output.
//!
//! The stored text was written by another process; `tests/compiled` compares the text of every spec
//! between two processes.

use std::path::Path;

use bgdyn_codegen::build_script::Build;

fn text(spec: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../specs")
        .join(spec);
    let source = Build::new(path).source();
    source.unwrap_or_else(|error| panic!("{error}")).text
}

#[test]
fn text_of_the_double_pendulum() {
    insta::assert_snapshot!(text("double_pendulum.yaml"));
}

#[test]
fn text_of_the_scara() {
    insta::assert_snapshot!(text("scara.yaml"));
}

/// The literal sum, whose text is longer, cut into blocks if it is too long.
#[test]
fn text_of_the_literal_sum() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/double_pendulum.yaml");
    let literal = Build::new(path)
        .formulation("literal")
        .methods(["mass_matrix"]);
    let source = literal.source();
    insta::assert_snapshot!(source.unwrap_or_else(|error| panic!("{error}")).text);
}
