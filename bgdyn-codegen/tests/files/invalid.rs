//! Tests the user's messages for each file of `specs/invalid`: one fault per file.

use std::fs;
use std::path::{Path, PathBuf};

fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/invalid");
    let entries = fs::read_dir(folder).expect("the folder specs/invalid");
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    files.sort();
    files
}

#[test]
fn every_invalid_spec_has_its_one_fault() {
    let files = files();
    assert!(files.len() >= 25);
    let mut shown = String::new();
    for file in files {
        let text = fs::read_to_string(&file).expect("a readable spec");
        let stem = file
            .file_stem()
            .and_then(|stem| stem.to_str())
            .expect("a stem");
        let (mechanism, faults) = bgdyn_codegen::read(&text, Some(stem));
        let rendered = faults.render(&format!("specs/invalid/{stem}.yaml"), &text);
        assert!(mechanism.is_none() && faults.any_fault(), "{stem} is valid");
        assert_eq!(faults.0.len(), 1, "{stem}:\n{rendered}");
        shown += &rendered;
        shown += "\n";
    }
    insta::assert_snapshot!(shown);
}
