//! Checks that messages about a spec or a scene are in `src/fault` only.

use std::fs;
use std::path::{Path, PathBuf};

fn rust_files(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of the sources") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            rust_files(&path, into);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            into.push(path);
        }
    }
}

/// Returns the source files outside `src/fault` with their texts.
fn sources() -> Vec<(String, String)> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    rust_files(&source, &mut files);
    let read = |file: PathBuf| {
        let path = file.strip_prefix(&source).expect("a path below src");
        let path = path.to_string_lossy().replace('\\', "/");
        let text = fs::read_to_string(&file).expect("a readable source");
        (path, text)
    };
    let mut all: Vec<(String, String)> = files.into_iter().map(read).collect();
    all.retain(|(path, _)| !path.starts_with("fault/"));
    all.sort();
    all
}

/// Returns the places in files whose path begins with `under`, at which one of these texts is.
fn places(under: &str, words: &[&str]) -> Vec<String> {
    let mut found = Vec::new();
    let mut searched = 0;
    for (path, text) in sources().iter().filter(|(path, _)| path.starts_with(under)) {
        searched += 1;
        let lines = text.lines().enumerate();
        let lines = lines.filter(|(_, line)| words.iter().any(|word| line.contains(word)));
        found.extend(lines.map(|(i, line)| format!("{path}:{}: {}", i + 1, line.trim())));
    }
    assert!(searched > 0, "no file in {under}");
    found
}

#[test]
fn faults_are_made_in_the_folder_of_messages() {
    let found = places("", &["Fault::new(", ".with_help("]);
    assert!(
        found.is_empty(),
        "write a message as a function in `src/fault/wording` and call it: {found:#?}"
    );
}

/// What a reader of files expects is text of a message: in the sources of the formats no string has an example.
#[test]
fn readers_expect_what_the_folder_of_messages_describes() {
    let words = ["\"`", "after a dash"];
    let found = [places("format/", &words), places("scene/", &words)].concat();
    // The only example that is computed is that of a group, from the names of its numbers.
    let found: Vec<&String> = found
        .iter()
        .filter(|place| !place.contains("keys.join"))
        .collect();
    assert!(
        found.is_empty(),
        "write it in `wording/expected.rs`: {found:#?}"
    );
}

/// The reasons and ways out of rules of effects are of the type `Help`; those that pass a layer that knows no faults
/// are texts of it.
#[test]
fn effects_give_no_reasons_of_their_own() {
    let found = places(
        "effect/",
        &[
            "way_out: \"",
            "let why = \"",
            "let way_out = \"",
            "Err(format!",
        ],
    );
    assert!(
        found.is_empty(),
        "write it in `wording/help.rs`: {found:#?}"
    );
}

/// The messages of overrides, which are no faults of a file.
#[test]
fn overrides_have_no_messages_of_their_own() {
    let found = places("scene/", &["Err(format!", "Err(\""]);
    assert!(
        found.is_empty(),
        "write it in `src/fault/wording`: {found:#?}"
    );
}
