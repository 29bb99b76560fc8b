//! Files whose tests use private items. Those tests stand in the files themselves, and run here.
#![allow(dead_code, missing_docs)]

use std::fs;
use std::path::Path;

#[path = "../../src/formulation/recursion/regressor/independent.rs"]
mod independent;
#[path = "../../src/plan/inline.rs"]
mod inline;
#[path = "../../src/legend.rs"]
mod legend;
#[path = "../../src/plan/order.rs"]
mod order;
#[path = "../../src/fault/suggest.rs"]
mod suggest;

/// Tests in other files of the generator would never run.
#[test]
fn no_other_file_has_tests_of_its_own() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let (mut folders, mut found) = (vec![root.clone()], Vec::new());
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("a file").path();
            if path.is_dir() {
                folders.push(path);
            } else if fs::read_to_string(&path)
                .expect("text")
                .contains("#[cfg(test)]")
            {
                let inner = path.strip_prefix(&root).expect("below the root");
                found.push(inner.to_string_lossy().replace('\\', "/"));
            }
        }
    }
    found.sort();
    let independent = "formulation/recursion/regressor/independent.rs";
    let run = [
        "fault/suggest.rs",
        independent,
        "legend.rs",
        "plan/order.rs",
    ];
    assert_eq!(found, run);
}
