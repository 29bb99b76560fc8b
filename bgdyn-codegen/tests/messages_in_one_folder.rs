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

#[test]
fn faults_are_made_in_the_folder_of_messages() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    rust_files(&source, &mut files);
    let mut found: Vec<String> = Vec::new();
    for file in files {
        let path = file.strip_prefix(&source).expect("a path below src");
        let path = path.to_string_lossy().replace('\\', "/");
        let text = fs::read_to_string(&file).expect("a readable source");
        if text.contains("Fault::new(") && !path.starts_with("fault/") {
            found.push(path);
        }
    }
    found.sort();
    assert!(
        found.is_empty(),
        "write a message as a function in `src/fault/wording` and call it: {found:?}"
    );
}
