//! Checks that imports inside each crate have one direction: no cycle between files, and folders import
//! only what their line in `layers/` permits.
//!
//! A file that uses another one is in a higher layer: a reader who begins at the lowest layer never needs
//! a later file.

mod circles;
mod layers;
mod read;
mod type_names;
mod words;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use circles::{circles, description};
use read::imports;

/// The checked crates, by their folders.
const CRATES: &[&str] = &[
    "bgdyn-accuracy",
    "bgdyn-cli",
    "bgdyn-codegen",
    "bgdyn-identification",
    "bgdyn-jit",
    "bgdyn-macros",
    "bgdyn-python",
    "bgdyn-runtime",
    "bgdyn-sim",
    "bgdyn-web",
];

#[test]
fn files_of_a_crate_import_each_other_in_one_direction() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = String::new();
    for name in CRATES {
        let source = root.join(name).join("src");
        let imports = imports(&source);
        assert!(imports.len() > 2, "{name}: no files are found");
        for circle in circles(&imports) {
            found += &description(name, &imports, &circle);
        }
    }
    assert!(found.is_empty(), "circles of imports:\n{found}");
}

#[test]
fn folders_import_what_their_line_allows() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut wrong = Vec::new();
    for name in CRATES {
        let list = root
            .join("tests/imports/layers")
            .join(format!("{name}.txt"));
        let list = fs::read_to_string(list).expect("a list of layers");
        let found = layers::arrows(&imports(&root.join(name).join("src")), &list);
        wrong.extend(
            layers::differences(&found, &list)
                .iter()
                .map(|w| format!("{name}: {w}")),
        );
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Each crate has only one type of each name.
#[test]
fn no_crate_has_two_types_of_one_name() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut wrong = Vec::new();
    for name in CRATES {
        let source = root.join(name).join("src");
        let files = imports(&source).into_keys();
        let repeated = type_names::repeated(&source, files);
        wrong.extend(repeated.iter().map(|line| format!("{name}: {line}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A formulation can be read, and removed, separately: it imports the files directly in `formulation/`,
/// and nothing of the other formulations.
#[test]
fn formulations_do_not_import_each_other() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("bgdyn-codegen/src");
    // Returns the folder of a formulation that contains a file, if any.
    let folder = |file: &Path| {
        let mut parts = file.iter().map(|part| part.to_string_lossy().into_owned());
        let is_formulation = parts.next()? == "formulation";
        let name = parts.next().filter(|_| is_formulation)?;
        parts.next().map(|_| name)
    };
    let mut seen = BTreeSet::new();
    for (file, others) in imports(&source) {
        let Some(own) = folder(&file) else { continue };
        for other in others.keys() {
            let theirs = folder(other).unwrap_or_else(|| own.clone());
            assert_eq!(
                own,
                theirs,
                "{} imports {}",
                file.display(),
                other.display()
            );
        }
        seen.insert(own);
    }
    assert!(seen.len() >= 3, "{seen:?}");
}

/// Writes a small crate to a folder and returns its cycles, as names of files.
fn circles_of(name: &str, files: &[(&str, &str)]) -> Vec<Vec<String>> {
    let folder = std::env::temp_dir().join(format!("import_circles_{name}_{}", std::process::id()));
    for (file, text) in files {
        let path = folder.join(file);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a new folder");
        fs::write(path, text).expect("a new file");
    }
    let found = circles(&imports(&folder));
    fs::remove_dir_all(&folder).expect("a folder of this test");
    let names = |circle: BTreeSet<PathBuf>| {
        let name = |path: PathBuf| path.to_string_lossy().replace('\\', "/");
        circle.into_iter().map(name).collect()
    };
    found.into_iter().map(names).collect()
}

#[test]
fn a_circle_through_a_name_that_a_module_passes_on_is_found() {
    let files = [
        ("lib.rs", "mod a; mod b; mod c; pub use c::C;"),
        ("a.rs", "use crate::b::{self, B}; pub fn a() { b::f(); }"),
        ("b/mod.rs", "mod inner; pub use inner::B; pub fn f() {}"),
        ("b/inner.rs", "use crate::C; pub struct B(C);"),
        ("c.rs", "pub struct C; fn c() { let _ = crate::a::a; }"),
    ];
    assert_eq!(
        circles_of("passed_on", &files),
        [["a.rs", "b/inner.rs", "c.rs"]]
    );
}

#[test]
fn a_child_that_uses_what_its_parent_defines_is_found() {
    let files = [
        ("lib.rs", "mod parent;"),
        (
            "parent/mod.rs",
            "mod child; pub struct P; pub fn f() { child::g() }",
        ),
        ("parent/child.rs", "use super::P; pub fn g() {}"),
    ];
    let wanted = [["parent/child.rs", "parent/mod.rs"]];
    assert_eq!(circles_of("parent", &files), wanted);
}

#[test]
fn tests_comments_texts_and_declarations_are_no_imports() {
    let files = [
        ("lib.rs", "mod parent;"),
        (
            "parent/mod.rs",
            "mod child; pub use child::g; // crate::parent::child::g\n pub struct P;",
        ),
        (
            "parent/child.rs",
            "use super::P; pub fn g() -> &'static str { \"crate::x\" }\n\
             #[cfg(test)] mod tests { use super::super::other::x; }",
        ),
        ("parent/other.rs", "use super::g; pub fn x() {}"),
    ];
    assert!(circles_of("none", &files).is_empty());
}
