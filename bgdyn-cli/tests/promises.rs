//! Texts of all kinds against what reader, check and importer promise.

use std::fs;
use std::path::Path;

use bgdyn_cli::promises::any_text;
use proptest::prelude::*;
use proptest::sample::{Index, select};

/// Specs, scenes and URDFs of the repository, sound ones and others.
fn seeds() -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folders = [
        "specs",
        "specs/invalid",
        "specs/scenes",
        "bgdyn-cli/tests/urdf",
    ];
    let mut files: Vec<_> = (folders.iter())
        .flat_map(|folder| fs::read_dir(root.join(folder)).expect("a folder"))
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.is_file())
        .collect();
    files.sort();
    assert!(files.len() > 80);
    let texts = files
        .into_iter()
        .map(|path| fs::read_to_string(path).expect("a text"));
    texts.collect()
}

#[test]
fn every_file_of_the_repository() {
    seeds().iter().for_each(|text| any_text(text));
}

/// Words of the formats, and what may do harm to a reader.
const WORDS: &[&str] = &[
    "solid: sphere",
    "solid: box",
    "radius: 0",
    "size: [1, 1]",
    "about: origin",
    "products: { xy: 1 }",
    "- a\n",
    "inertia:",
    "{ parameter: p, value: 1 }",
    "parameter: p",
    "effects:",
    "type: viscous",
    "lock: { a: 1 }",
    "scene: 1\n",
    "mechanism: a.yaml\n",
    "&a ",
    "*a",
    "<<: *a",
    "!t ",
    "---\n",
    "- ",
    "[",
    "]",
    "{",
    "}",
    "\"",
    "'",
    "|",
    "#",
    "\t",
    "\r\n",
    "\u{feff}",
    "\0",
    ".nan",
    "1e999",
    "-0",
    "90 deg",
    "5 mm",
    "kg",
    "é",
    "\u{2028}",
    "\n",
    "  ",
    "<",
    "/>",
    "<link name='x'/>",
    "<mimic joint='x'/>",
    "<joint",
    "</robot>",
    "&#0;",
    "&lt;",
    "]]>",
    "name: a",
    "parent: a",
];

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    #[test]
    fn files_cut_and_mended(
        seed in select(seeds()),
        edits in prop::collection::vec((any::<Index>(), 0usize..40, prop_oneof![select(WORDS).prop_map(String::from), ".{0,3}"]), 1..8),
    ) {
        let mut text: Vec<char> = seed.chars().collect();
        for (place, length, word) in edits {
            let from = place.index(text.len() + 1);
            let to = (from + length).min(text.len());
            text.splice(from..to, word.chars());
        }
        any_text(&text.into_iter().collect::<String>());
    }

    #[test]
    fn lines_of_two_files(a in select(seeds()), b in select(seeds()), cut in any::<Index>(), from in any::<Index>()) {
        let (a, b): (Vec<&str>, Vec<&str>) = (a.lines().collect(), b.lines().collect());
        let (cut, from) = (cut.index(a.len() + 1), from.index(b.len() + 1));
        any_text(&[&a[..cut], &b[from..]].concat().join("\n"));
    }
}
