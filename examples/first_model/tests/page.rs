//! The pages show this crate's files, and what its programs print.

use std::process::Command;

const FIRST_MODEL: &str = include_str!("../../../docs/first_model.md");
const TESTS_TO_COPY: &str = include_str!("../../../docs/tests_to_copy.md");

fn shows(page: &str, language: &str, text: &str) {
    let block = format!("```{language}\n{text}```\n");
    assert!(page.contains(&block), "not on the page:\n{block}");
}

#[test]
fn the_first_model_is_this_crate() {
    shows(FIRST_MODEL, "yaml", include_str!("../specs/head.yaml"));
    shows(FIRST_MODEL, "rust", include_str!("../src/bin/hold.rs"));
    shows(FIRST_MODEL, "rust", include_str!("../src/bin/turn.rs"));
}

#[test]
fn the_programs_print_what_the_page_shows() {
    for (name, program) in [
        ("hold", env!("CARGO_BIN_EXE_hold")),
        ("turn", env!("CARGO_BIN_EXE_turn")),
    ] {
        let output = Command::new(program).output().expect("the program starts");
        let printed = String::from_utf8(output.stdout).expect("UTF-8");
        shows(
            FIRST_MODEL,
            "console",
            &format!("$ cargo run -q --bin {name}\n{printed}"),
        );
    }
}

#[test]
fn the_tests_to_copy_are_those_that_run() {
    for test in [
        include_str!("laws/textbook.rs"),
        include_str!("laws/mass_matrix.rs"),
        include_str!("laws/skew.rs"),
        include_str!("laws/energy.rs"),
        include_str!("laws/round_trip.rs"),
        include_str!("laws/derivatives.rs"),
        include_str!("laws/payload.rs"),
        include_str!("generated.rs"),
    ] {
        shows(TESTS_TO_COPY, "rust", test);
    }
}
