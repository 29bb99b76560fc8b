//! The folders of the generator import each other one way only: what stands in the list, and nothing
//! else. A line is a file or folder of `src` with those that it may use; each stands below it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// From the ground up. A folder may use those named behind it, which stand above it in this list.
const LAYERS: &[(&str, &[&str])] = &[
    ("math", &[]),
    ("name", &[]),
    ("unit", &[]),
    ("legend", &[]),
    ("expr", &["math"]),
    ("fault", &["name", "unit"]),
    ("spec", &["fault", "unit"]),
    ("files", &["spec"]),
    ("columns", &["expr"]),
    ("mechanism", &["fault", "math", "name", "spec"]),
    ("layout", &["mechanism", "unit"]),
    ("bond_graph", &["math", "mechanism"]),
    ("method", &["bond_graph", "fault"]),
    ("function", &["bond_graph", "columns", "expr", "method"]),
    ("products", &["expr", "function"]),
    ("cut", &["expr", "function", "method", "products"]),
    (
        "formulation",
        &[
            "bond_graph",
            "columns",
            "expr",
            "function",
            "math",
            "mechanism",
            "method",
        ],
    ),
    (
        "closed_form",
        &["bond_graph", "expr", "formulation", "mechanism", "method"],
    ),
    (
        "declaration",
        &["fault", "layout", "mechanism", "name", "spec"],
    ),
    ("machine", &["declaration", "fault", "mechanism", "spec"]),
    (
        "scene",
        &[
            "declaration",
            "fault",
            "layout",
            "machine",
            "math",
            "mechanism",
            "name",
            "spec",
        ],
    ),
    (
        "laws",
        &[
            "bond_graph",
            "declaration",
            "expr",
            "formulation",
            "math",
            "method",
            "scene",
            "spec",
        ],
    ),
    (
        "effect",
        &[
            "bond_graph",
            "declaration",
            "expr",
            "fault",
            "laws",
            "layout",
            "math",
            "mechanism",
            "spec",
        ],
    ),
    (
        "system",
        &[
            "bond_graph",
            "cut",
            "declaration",
            "effect",
            "expr",
            "fault",
            "formulation",
            "function",
            "laws",
            "layout",
            "math",
            "method",
            "scene",
            "spec",
        ],
    ),
    (
        "verify",
        &[
            "bond_graph",
            "expr",
            "formulation",
            "function",
            "method",
            "system",
        ],
    ),
    ("options", &["bond_graph", "fault", "formulation", "method"]),
    ("refusal", &["fault", "options", "verify"]),
    (
        "read",
        &[
            "bond_graph",
            "effect",
            "fault",
            "files",
            "machine",
            "mechanism",
            "method",
            "refusal",
            "scene",
            "spec",
            "system",
        ],
    ),
    ("model", &["bond_graph", "function", "mechanism", "method"]),
    (
        "interface",
        &[
            "bond_graph",
            "effect",
            "machine",
            "mechanism",
            "name",
            "read",
            "scene",
            "spec",
            "system",
        ],
    ),
    (
        "emit",
        &[
            "bond_graph",
            "columns",
            "expr",
            "function",
            "interface",
            "legend",
            "mechanism",
            "method",
            "model",
            "name",
            "scene",
            "system",
        ],
    ),
    (
        "pipeline",
        &[
            "bond_graph",
            "cut",
            "emit",
            "fault",
            "files",
            "formulation",
            "function",
            "interface",
            "mechanism",
            "method",
            "model",
            "options",
            "read",
            "refusal",
            "spec",
            "system",
            "verify",
        ],
    ),
    (
        "build_script",
        &[
            "emit", "fault", "files", "options", "pipeline", "refusal", "verify",
        ],
    ),
];

/// The Rust files below a folder.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// What the code of a file uses of the crate, tests and comments aside; what the crate's root passes
/// on goes by the name of its own folder.
fn used(text: &str) -> BTreeSet<String> {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code.lines().filter(|l| !l.trim_start().starts_with("//"));
    let code: String = lines.collect::<Vec<_>>().join("\n");
    let mut found = BTreeSet::new();
    for rest in code.split("crate::").skip(1) {
        let word: String = rest
            .chars()
            .take_while(|c| c.is_ascii_alphanumeric() || *c == '_')
            .collect();
        assert!(
            !word.is_empty(),
            "write one `use crate::…` a folder: {rest:.40}"
        );
        found.insert(match word.as_str() {
            "read_machine" | "read_scene" => "read".to_owned(),
            _ => word,
        });
    }
    found
}

#[test]
fn folders_import_one_way() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut all = Vec::new();
    files(&src, &mut all);
    let mut arrows: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for path in &all {
        let inside = path.strip_prefix(&src).expect("a file of the crate");
        let first = inside.iter().next().expect("a name").to_string_lossy();
        let own = first.trim_end_matches(".rs").to_owned();
        if own == "lib" {
            continue;
        }
        let mut used = used(&fs::read_to_string(path).expect("text"));
        used.remove(&own);
        arrows.entry(own).or_default().extend(used);
    }
    let mut wrong = Vec::new();
    for (own, used) in &arrows {
        let Some((_, allowed)) = LAYERS.iter().find(|(name, _)| name == own) else {
            wrong.push(format!("`{own}` has no line in the list"));
            continue;
        };
        for other in used.iter().filter(|o| !allowed.contains(&o.as_str())) {
            wrong.push(format!(
                "`{own}` uses `{other}`, which its line does not allow"
            ));
        }
        for other in allowed.iter().filter(|o| !used.contains(**o)) {
            wrong.push(format!(
                "`{own}` does not use `{other}`: take it out of its line"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The list itself has no circle: each line names lines before it only.
#[test]
fn the_list_has_no_circle() {
    for (i, (own, allowed)) in LAYERS.iter().enumerate() {
        for other in *allowed {
            let below = LAYERS[..i].iter().any(|(name, _)| name == other);
            assert!(
                below,
                "`{own}` may use `{other}`, which does not stand before it"
            );
        }
    }
}
