//! Whole mechanisms in the pages of documentation are sound.

use std::fs;
use std::path::{Path, PathBuf};

/// Returns the pages of a folder and of its folders.
fn pages(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let of = |path: PathBuf| match path.is_dir() {
        true => pages(&path),
        false => vec![path],
    };
    let mut all: Vec<PathBuf> = paths.flat_map(of).collect();
    all.retain(|path| path.extension().is_some_and(|end| end == "md"));
    all.sort();
    all
}

/// Returns the mechanisms of a page: blocks of YAML that begin with the version and have links.
fn mechanisms(page: &str) -> Vec<&str> {
    let blocks = page.split("```yaml\n").skip(1);
    let blocks = blocks.map(|rest| rest.split("```").next().unwrap_or_default());
    blocks
        .filter(|block| block.starts_with("format: 1") && block.contains("\nlinks:"))
        .collect()
}

#[test]
fn every_mechanism_in_the_documentation_is_sound() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut all = pages(&root.join("docs"));
    all.push(root.join("README.md"));
    let mut seen = 0;
    for path in all {
        let page = fs::read_to_string(&path).expect("a page");
        for block in mechanisms(&page) {
            let name = block.lines().find_map(|line| line.strip_prefix("name: "));
            let name = name.and_then(|rest| rest.split_whitespace().next());
            let (machine, faults) = bgdyn_codegen::read(block, Some(name.unwrap_or("m")));
            let told: Vec<&str> = faults.0.iter().map(|f| f.message.as_str()).collect();
            assert!(machine.is_some(), "{}: {told:?}\n{block}", path.display());
            seen += 1;
        }
    }
    assert!(seen >= 12, "{seen} mechanisms");
}
